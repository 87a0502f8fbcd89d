"""Certificates: what an answer hands over so that code sharing nothing with its producer can check it.

A certificate has a kind and a payload. As JSON it carries a format version and, as the last and weakest line of
defence, the SHA-256 digest of its content: the checker looks at the meaning of every entry first.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING, Any, ClassVar

from qe.arguments import whole as whole_number
from qe.arguments import wrong
from qe.errors import CertificateRejected, InputError, Unable
from qe.exact.algebraic import RealAlgebraic
from qe.exact.ring import Poly, Ring
from qe.formula.build import conj, convert, exists, forall
from qe.formula.syntax import FALSE, TRUE, And, Formula
from qe.formula.traverse import conjuncts
from qe.proof.entry import Entry, Json, formula_to_json, poly_to_text, read_json
from qe.services import Service, service

if TYPE_CHECKING:
    from qe.proof.cells import CellTable

FORMAT = "bezier-qe certificate"
VERSION = 3


@dataclass(frozen=True)
class Kind:
    """What a certificate is, by the name under which files have it.

    DERIVATION: that a formula is equivalent to another, by steps. BUNDLE: several certificates with labels. What else
    is written in a file has no checker.
    """

    value: str

    DERIVATION: ClassVar[Kind]
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


Evidence = dict[str, Json]
Payload = tuple[Labelled, ...] | dict[str, Json]


@dataclass(frozen=True, slots=True, repr=False)
class Certificate:
    """Payload by kind: BUNDLE: a tuple of ``Labelled``; the others: plain JSON data.

    ``digests`` is set for certificates read from text: the digest stated there and the one of what was read.
    """

    kind: Kind
    payload: Payload
    digests: tuple[str, str] | None = field(default=None, compare=False)

    def __repr__(self) -> str:
        members = f", {len(self.payload)} members" if isinstance(self.payload, tuple) else ""
        return f"Certificate({self.kind.value}{members})"

    @staticmethod
    def bundle(members: Iterable[tuple[str, Certificate]]) -> Certificate:
        """Several certificates, each with a label."""
        return Certificate(Kind.BUNDLE, tuple(Labelled(label, c) for label, c in members))

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

    @staticmethod
    def step(rule: str, order: Sequence[str], before: Formula, after: Formula, evidence: Evidence) -> Certificate:
        """That ``before`` <-> ``after``, by one step; in the derivation's order these names are the first."""
        used = {name for formula in (before, after) for name in (*formula.free, *formula.bound)}
        known = [name for formula in (before, after) if formula.ring for name in formula.ring.names if name in used]
        ring = Ring.of(dict.fromkeys((*order, *known, *sorted(used))))
        start, answer = convert(before, ring), convert(after, ring)
        return Certificate.derivation(ring.names, start, [written(rule, (), start, answer, (), evidence)], answer)

    @staticmethod
    def cells(table: CellTable, answer: Formula | None = None, start: Formula | None = None) -> Certificate:
        """That ``answer``, without quantifiers, is equivalent to the formula of the table, or to ``start``, of which
        this is a prenex form; without an answer: that the table is right."""
        from qe.proof.cells_json import cells_to_json

        question = prenex_form(table) if start is None else start
        if answer is None and not question.free and table.root.truth is not None:
            answer = TRUE if table.root.truth else FALSE
        after = question if answer is None else answer
        return Certificate.step("cells", table.order, question, after, {"cells": cells_to_json(table)})

    @staticmethod
    def decided(question: Formula, true: Formula, false: Formula, rule: str, evidence: Evidence) -> Certificate:
        """That the question holds where ``true`` does, and not where ``false`` does, by one step for each."""
        members = []
        for label, where, truth in (("true", true, TRUE), ("false", false, FALSE)):
            if where != FALSE:
                both, answer = conj((where, question)), conj((where, truth))
                place = (both.args.index(question),) if isinstance(both, And) and not isinstance(question, And) else ()
                known = () if where == TRUE else conjuncts(where)
                steps = [written(rule, place, question, truth, known, evidence)] if both != answer else []
                order = both.ring.names if both.ring else ()
                members.append((label, Certificate.derivation(order, both, steps, answer)))
        return Certificate.bundle(members)

    @staticmethod
    def witness(matrix: Formula, order: Sequence[str], values: Sequence[Root | Fraction]) -> Certificate:
        """That the quantifier-free ``matrix`` (over the ring of ``order``) holds where the variables have ``values``.

        A value is a rational number or a ``Root``.
        """
        numbers: list[Json] = [_value_to_json(v, name) for v, name in zip(values, order, strict=True)]
        return Certificate.step(
            "instance", order, exists(order, matrix), TRUE, {"order": list(order), "values": numbers}
        )

    @staticmethod
    def substitution(
        matrix: Formula, order: Sequence[str], solved: Sequence[tuple[str, Poly]], answer: Formula
    ) -> Certificate:
        """That the existential variables ``solved`` (with their equations, in order of use) give ``answer``; in these
        their coefficients are numbers."""
        ring = Ring.of(order)
        listed: list[Json] = []
        for name, equation in solved:
            normal = equation.convert(ring).normal()[1]
            lead = normal.leading(ring.index[name]).constant_value()
            listed.append([name, poly_to_text(normal), 1 if lead > 0 else -1])
        theory: dict[str, Json] = {"polynomials": [], "lemmas": [], "cases": []}
        evidence: Evidence = {"solved": listed, "theory": theory}
        question = exists([name for name, _ in solved], matrix)
        return Certificate.step("linear equation solved", order, question, answer, evidence)

    @property
    def parts(self) -> tuple[Certificate, ...]:
        """The members of a bundle and of those in it; of any other certificate itself alone."""
        if not isinstance(self.payload, tuple):
            return (self,)
        return tuple(part for member in self.payload for part in member.certificate.parts)

    @property
    def single_step(self) -> dict[str, Json]:
        """The step of a derivation by one step of its whole formula; nothing for others.

        At a place inside, what is known there may stand for a part of what the evidence seems to say.
        """
        steps = self.payload.get("steps") if isinstance(self.payload, dict) else None
        step = steps[0] if isinstance(steps, list) and len(steps) == 1 else None
        return step if isinstance(step, dict) and step.get("at") == [] else {}

    def evidence_for(self, rule: str) -> Any:
        """The evidence of a derivation by one step of this rule; None for others."""
        return self.single_step.get("evidence") if self.single_step.get("rule") == rule else None

    @property
    def trusts(self) -> tuple[str, ...]:
        """The theorems without proof, by name, that it needs besides the primitives of the kernel (``qe.theorems``)."""
        names: tuple[str, ...] = service(Service.TRUSTS)(self)
        return names

    def to_data(self) -> dict[str, Json]:
        """Kind and payload as JSON data."""
        if isinstance(self.payload, tuple):
            members: list[Json] = [{"label": m.label, **m.certificate.to_data()} for m in self.payload]
            return {"kind": self.kind.value, "certificates": members}
        return {"kind": self.kind.value, "payload": self.payload}

    def to_json(self, *, indent: int | None = None) -> str:
        """The certificate as text, with version and digest; equal certificates give equal text."""
        if indent is not None:
            whole_number(indent, "indent", 80)
        whole: dict[str, Json] = {"format": FORMAT, "version": VERSION, **self.to_data()}
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
            raise wrong("text", "a certificate in JSON", text)
        try:
            whole = read_json(text)
        except (ValueError, RecursionError) as error:
            raise InputError(f"not a certificate: {error}") from None
        if not isinstance(whole, dict) or whole.get("format") != FORMAT:
            raise InputError(f'not a certificate: expected an object with "format": "{FORMAT}"')
        version = whole.get("version")
        if version != VERSION or isinstance(version, bool):
            former = ", written before bezier-qe 0.2, which still reads it" if repr(version) in ("1", "2") else ""
            raise InputError(f"certificate of version {version!r}{former}; here version {VERSION} is expected")
        stated = whole.get("digest")
        if not isinstance(stated, str):
            raise CertificateRejected("digest", "expected a string")
        content = {k: v for k, v in whole.items() if k not in ("format", "version", "digest")}
        try:
            read = certificate_from(Entry(content, ""))
        except RecursionError:
            raise InputError("certificate nested too deeply") from None
        return Certificate(read.kind, read.payload, (stated, digest(whole)))


def table_of(certificate: Certificate) -> CellTable | None:
    """The table in a certificate that says no more than that it is one of its formula, which has no quantifiers."""
    from qe.proof.cells_json import cells_from_json

    evidence, payload = certificate.evidence_for("cells"), certificate.payload
    if not isinstance(evidence, dict) or not isinstance(payload, dict) or "start" not in payload:
        return None
    if payload["start"] != payload.get("answer"):
        return None
    table = cells_from_json(Entry(evidence.get("cells"), "payload.steps[0].evidence.cells"))
    return None if any(table.quantifiers) else table


def prenex_form(table: CellTable) -> Formula:
    """The formula of a table."""
    formula = table.matrix
    for name, kind in reversed(list(zip(table.order, table.quantifiers, strict=True))):
        formula = formula if not kind else (exists if kind == "E" else forall)((name,), formula)
    return formula


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
    import hashlib

    content = {k: v for k, v in whole.items() if k != "digest"}
    canonical = json.dumps(content, ensure_ascii=True, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(canonical.encode()).hexdigest()


def _value_to_json(value: Root | Fraction, name: str) -> Json:
    if isinstance(value, Fraction):
        try:
            return str(value)
        except ValueError:
            raise Unable(f"the value of {name} is too long for a certificate") from None
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
    if not isinstance(payload.value, dict):
        raise payload.fail("expected an object")
    return Certificate(kind, payload.value)


def _member(entry: Entry) -> Labelled:
    if not isinstance(entry.value, dict):
        raise entry.fail("expected an object")
    label = Entry(entry.value.get("label"), f"{entry.path}.label").text()
    return Labelled(label, certificate_from(entry, labelled=True))
