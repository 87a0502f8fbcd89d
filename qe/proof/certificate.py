"""Certificates: what an answer hands over so that code sharing nothing with its producer can check it.

A certificate has a kind and a payload. As JSON it carries a format version and, as the last and weakest line of
defence, the SHA-256 digest of its content: the checker looks at the meaning of every entry first.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import ClassVar

from qe.arguments import whole as whole_number
from qe.errors import CertificateRejected, InputError
from qe.exact.algebraic import RealAlgebraic
from qe.exact.ring import Poly, Ring
from qe.formula.syntax import Formula
from qe.proof.cells import CellTable
from qe.proof.cells_json import CellEvidence, cells_from_json, cells_to_json
from qe.proof.entry import Entry, Json, formula_to_json, poly_to_text, read_json
from qe.services import Service, service

FORMAT = "bezier-qe certificate"
VERSIONS = (1, 2)
"""The versions that are read. Written is the lowest that can say it: 2 where a derivation is inside, else 1."""


@dataclass(frozen=True)
class Kind:
    """What a certificate proves, by the name under which files have it. These are the engine's; other packages bring
    more, each with its checker (``qe.certify.verify.checkers``).

    CELLS: truth values on the cells of a (partial) cylindrical algebraic decomposition, and the formula that
    follows. OPTIMUM: an optimal point of a convex problem, or that there is none. WITNESS: that an assignment
    satisfies a quantifier-free formula. SUBSTITUTION: that linear equations eliminate an existential block.
    DERIVATION: that a formula is equivalent to another, step by step. SOLUTIONS: that a system has these real
    solutions, and no others. CLASSIFICATION: where a parametric system has how many. PARTS: where a formula is true
    and where false, the rest being open. BUNDLE: several certificates with labels.
    """

    value: str

    CELLS: ClassVar[Kind]
    OPTIMUM: ClassVar[Kind]
    WITNESS: ClassVar[Kind]
    SUBSTITUTION: ClassVar[Kind]
    DERIVATION: ClassVar[Kind]
    SOLUTIONS: ClassVar[Kind]
    CLASSIFICATION: ClassVar[Kind]
    PARTS: ClassVar[Kind]
    BUNDLE: ClassVar[Kind]


for _name, _value in ((name, Kind(name.lower())) for name in Kind.__annotations__ if name.isupper()):
    setattr(Kind, _name, _value)


@dataclass(frozen=True, slots=True)
class Labelled:
    """One member of a bundle."""

    label: str
    certificate: Certificate


@dataclass(frozen=True, slots=True)
class Root:
    """The only real root in (low, high) of the polynomial with these integer coefficients, from degree 0 up."""

    coefficients: tuple[int, ...]
    low: Fraction
    high: Fraction

    @staticmethod
    def of(value: Fraction | RealAlgebraic) -> Root | Fraction:
        """A number as the witness certificate wants it: rational, or by polynomial and isolating interval."""
        if isinstance(value, Fraction):
            return value
        return value.as_fraction() if value.is_rational else Root(value.minimal_polynomial, *value.interval())


Payload = CellEvidence | tuple[Labelled, ...] | dict[str, Json]


@dataclass(frozen=True, slots=True, repr=False)
class Certificate:
    """Payload by kind: CELLS: ``CellEvidence``; BUNDLE: a tuple of ``Labelled``; the others: plain JSON data.

    ``digests`` is set for certificates read from text: the digest stated there and the one of what was read.
    """

    kind: Kind
    payload: Payload
    digests: tuple[str, str] | None = field(default=None, compare=False)

    def __repr__(self) -> str:
        members = f", {len(self.payload)} members" if isinstance(self.payload, tuple) else ""
        return f"Certificate({self.kind.value}{members})"

    @staticmethod
    def cells(table: CellTable, answer: Formula | None = None) -> Certificate:
        """That ``table`` is a correct cell table and (if given) that ``answer`` is equivalent to its formula."""
        return Certificate(Kind.CELLS, CellEvidence(table, answer))

    @staticmethod
    def decided(table: CellTable, true: Formula, false: Formula) -> Certificate:
        """That ``true`` implies the formula of a table with open cells, and ``false`` its negation."""
        return Certificate(Kind.CELLS, CellEvidence(table, None, (true, false)))

    @staticmethod
    def parts(
        order: Sequence[str], question: Formula, true: Formula, false: Formula, proofs: Iterable[Certificate]
    ) -> Certificate:
        """That ``true`` implies ``question`` and ``false`` its negation, by what is proved of its parts."""
        payload: dict[str, Json] = {
            "order": list(order),
            "question": formula_to_json(question, quantified=True),
            "true": formula_to_json(true),
            "false": formula_to_json(false),
            "proofs": [proof.to_data() for proof in proofs],
        }
        return Certificate(Kind.PARTS, payload)

    @staticmethod
    def bundle(members: Iterable[tuple[str, Certificate]]) -> Certificate:
        """Several certificates, each with a label."""
        return Certificate(Kind.BUNDLE, tuple(Labelled(label, c) for label, c in members))

    @staticmethod
    def witness(matrix: Formula, order: Sequence[str], values: Sequence[Root | Fraction]) -> Certificate:
        """That the quantifier-free ``matrix`` (over the ring of ``order``) holds where the variables have ``values``.

        A value is a rational number or a ``Root``.
        """
        numbers: list[Json] = [_value_to_json(v, name) for v, name in zip(values, order, strict=True)]
        payload: dict[str, Json] = {"order": list(order), "matrix": formula_to_json(matrix), "values": numbers}
        return Certificate(Kind.WITNESS, payload)

    @staticmethod
    def substitution(
        matrix: Formula, order: Sequence[str], solved: Sequence[tuple[str, Poly]], answer: Formula
    ) -> Certificate:
        """That the existential variables ``solved`` (with their equations, in order of use) give ``answer``."""
        payload: dict[str, Json] = {
            "order": list(order),
            "variables": [name for name, _ in solved],
            "matrix": formula_to_json(matrix),
            "solved": [[name, poly_to_text(equation)] for name, equation in solved],
            "answer": formula_to_json(answer),
        }
        return Certificate(Kind.SUBSTITUTION, payload)

    @staticmethod
    def derivation(order: Sequence[str], start: Formula, steps: Iterable[Json], answer: Formula) -> Certificate:
        """That ``start`` <-> ``answer`` (over the ring of ``order``) by these steps, see ``qe.kernel.derivation``."""
        payload: dict[str, Json] = {
            "order": list(order),
            "start": formula_to_json(start, quantified=True),
            "steps": list(steps),
            "answer": formula_to_json(answer, quantified=True),
        }
        return Certificate(Kind.DERIVATION, payload)

    @property
    def trusts(self) -> tuple[str, ...]:
        """The theorems without proof, by name, that it needs beside the primitives of the kernel (``qe.theorems``)."""
        names: tuple[str, ...] = service(Service.TRUSTS)(self)
        return names

    @property
    def version(self) -> int:
        """The version of the format in which it is written."""
        if isinstance(self.payload, tuple):
            return max((m.certificate.version for m in self.payload), default=1)
        if isinstance(self.payload, CellEvidence):
            return 1 if self.payload.parts is None else 2
        return 2 if self.kind in (Kind.DERIVATION, Kind.PARTS) else 1

    def to_data(self) -> dict[str, Json]:
        """Kind and payload as JSON data."""
        if isinstance(self.payload, CellEvidence):
            return {"kind": self.kind.value, "payload": cells_to_json(self.payload)}
        if isinstance(self.payload, tuple):
            members: list[Json] = [{"label": m.label, **m.certificate.to_data()} for m in self.payload]
            return {"kind": self.kind.value, "certificates": members}
        return {"kind": self.kind.value, "payload": self.payload}

    def to_json(self, *, indent: int | None = None) -> str:
        """The certificate as text, with version and digest; equal certificates give equal text."""
        if indent is not None:
            whole_number(indent, "indent", 80)
        whole: dict[str, Json] = {"format": FORMAT, "version": self.version, **self.to_data()}
        whole["digest"] = digest(whole)
        separators = (",", ":") if indent is None else None
        return json.dumps(whole, ensure_ascii=False, indent=indent, separators=separators)

    @staticmethod
    def from_json(text: str) -> Certificate:
        """The certificate in ``text``. ``InputError`` if it is not JSON of this format and version;
        ``CertificateRejected``, naming the entry, if something in it is malformed. A wrong digest is kept for the
        checker, which reports it when it finds nothing worse.
        """
        if not isinstance(text, str):
            raise InputError(f"certificate: text in JSON expected, {type(text).__name__} found")
        try:
            whole = read_json(text)
        except (ValueError, RecursionError) as error:
            raise InputError(f"not a certificate: {error}") from None
        if not isinstance(whole, dict) or whole.get("format") != FORMAT:
            raise InputError(f'not a certificate: expected an object with "format": "{FORMAT}"')
        version = whole.get("version")
        if version not in VERSIONS or isinstance(version, bool):
            raise InputError(f"certificate version {version!r} is not one of {VERSIONS}, which are known here")
        stated = whole.get("digest")
        if not isinstance(stated, str):
            raise CertificateRejected("digest", "expected a string")
        content = {k: v for k, v in whole.items() if k not in ("format", "version", "digest")}
        try:
            read = certificate_from(Entry(content, ""))
        except RecursionError:
            raise InputError("certificate nested too deeply") from None
        if read.version != version:
            raise InputError(f"certificate version {version}: what it holds is written in version {read.version}")
        return Certificate(read.kind, read.payload, (stated, digest(whole)))


def written(
    rule: str, place: Sequence[int], before: Formula, after: Formula, context: Iterable[Formula], evidence: Json
) -> Json:
    """One step of a derivation as JSON data."""
    return {
        "rule": rule,
        "at": list(place),
        "before": formula_to_json(before, quantified=True),
        "after": formula_to_json(after, quantified=True),
        "context": [formula_to_json(f, quantified=True) for f in context],
        "evidence": evidence,
    }


@dataclass(frozen=True, slots=True)
class Proof:
    """``certificate`` of an answer, or the ``reason`` why there is none; ``unchecked``: the rules of the steps of its
    derivation that no checker has accepted; ``checked``: whether the checkers have accepted the whole certificate."""

    certificate: Certificate | None
    unchecked: tuple[str, ...] = ()
    checked: bool = False
    reason: str = ""


def digest(whole: dict[str, Json]) -> str:
    """The SHA-256 digest of the canonical text of everything but the digest itself."""
    content = {k: v for k, v in whole.items() if k != "digest"}
    canonical = json.dumps(content, ensure_ascii=True, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(canonical.encode()).hexdigest()


def _value_to_json(value: Root | Fraction, name: str) -> Json:
    if isinstance(value, Fraction):
        return str(value)
    ring = Ring.of((name,))
    poly = ring.from_terms({(k,): c for k, c in enumerate(value.coefficients) if c})
    return {"polynomial": poly_to_text(poly.normal()[1]), "interval": [str(value.low), str(value.high)]}


def certificate_from(entry: Entry, labelled: bool = False) -> Certificate:
    """The certificate that ``to_data`` writes. Raises ``CertificateRejected`` where an entry is malformed."""
    extra = ("label",) if labelled else ()
    if not isinstance(entry.value, dict):
        raise entry.fail("expected an object")
    prefix = f"{entry.path}." if entry.path else ""
    kind = Kind(Entry(entry.value.get("kind"), f"{prefix}kind").text())
    if kind == Kind.BUNDLE:
        members = entry.fields("kind", "certificates", *extra)[1]
        return Certificate(kind, tuple(_member(m) for m in members.items()))
    payload = entry.fields("kind", "payload", *extra)[1]
    if kind == Kind.CELLS:
        return Certificate(kind, cells_from_json(payload))
    if not isinstance(payload.value, dict):
        raise payload.fail("expected an object")
    return Certificate(kind, payload.value)


def _member(entry: Entry) -> Labelled:
    if not isinstance(entry.value, dict):
        raise entry.fail("expected an object")
    label = Entry(entry.value.get("label"), f"{entry.path}.label").text()
    return Labelled(label, certificate_from(entry, labelled=True))
