"""Reading JSON strictly: every value knows where it stands, so that a wrong one is named.

Readers raise ``CertificateRejected`` with the path of the entry and what was expected there.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import assert_never

from qe.errors import CertificateRejected
from qe.exact.ring import Poly, Ring, format_poly
from qe.formula.syntax import FALSE, TRUE, And, Atom, Constant, Exists, ForAll, Formula, Not, Or, Relation, RootAtom
from qe.spelling import QUOTED, between_quotes, unquoted

Json = None | bool | int | str | list["Json"] | dict[str, "Json"]

MAX_EXPONENT = 10_000
MAX_NESTING = 200
_RATIONAL = re.compile(r"-?(0|[1-9][0-9]*)(/[1-9][0-9]*)?", re.ASCII)
_PLAIN = re.compile(r"[^\W\d]\w*'*")
_NAME = rf"(?:{_PLAIN.pattern}|{QUOTED})"
_POWER = re.compile(rf"({_NAME})(?:\^([1-9][0-9]*))?")
_TERM = re.compile(rf"(-?)([1-9][0-9]*)?\*?({_POWER.pattern}(?:\*{_POWER.pattern})*)?")
_SIGN = re.compile(r" ([+-]) ")


def no_floats(text: str) -> Json:
    """Refuses a number that JSON writes with a point, an exponent or a name."""
    raise ValueError(f"inexact number {text}")


def read_json(text: str, decimal: Callable[[str], Json] = no_floats) -> Json:
    """The value of a JSON text without NaN, infinity and a name that occurs twice in one object.

    Raises ``ValueError`` (for decimals also, unless ``decimal`` takes them), ``RecursionError``.
    """
    found: Json = json.loads(text, parse_float=decimal, parse_constant=no_floats, object_pairs_hook=_no_repeats)
    return found


def _no_repeats(pairs: list[tuple[str, Json]]) -> dict[str, Json]:
    found = dict(pairs)
    if len(found) != len(pairs):
        raise ValueError("a name occurs twice in one object")
    return found


@dataclass(frozen=True, slots=True)
class Entry:
    """A JSON value and its path, such as ``root.stack.cells[3].truth``."""

    value: Json
    path: str

    def fail(self, reason: str) -> CertificateRejected:
        """The error that names this entry."""
        return CertificateRejected(self.path or "certificate", reason)

    def fields(self, *names: str, optional: tuple[str, ...] = ()) -> list[Entry]:
        """The members of an object that must have exactly these names, in the order given; optional ones last."""
        if not isinstance(self.value, dict):
            raise self.fail("expected an object")
        for name in names:
            if name not in self.value:
                raise self.fail(f'missing "{name}"')
        unknown = sorted(set(self.value) - set(names) - set(optional))
        if unknown:
            raise self.fail(f'unknown "{unknown[0]}"')
        prefix = f"{self.path}." if self.path else ""
        return [Entry(self.value.get(name), prefix + name) for name in (*names, *optional)]

    def items(self) -> Iterator[Entry]:
        """The elements of a list."""
        if not isinstance(self.value, list):
            raise self.fail("expected a list")
        for i, value in enumerate(self.value):
            yield Entry(value, f"{self.path}[{i}]")

    def row(self, *members: str) -> list[Entry]:
        """The elements of a list that has one for each of these, which the error names."""
        found = list(self.items())
        if len(found) != len(members):
            raise self.fail(f"expected [{', '.join(members)}]")
        return found

    def names(self) -> tuple[str, ...]:
        """A list of names of variables, none of them empty, each once."""
        found = tuple(entry.text() for entry in self.items())
        if not all(found):
            raise self.fail("a variable without a name")
        if len(set(found)) < len(found):
            raise self.fail("a variable is listed twice")
        return found

    def text(self) -> str:
        """The value, which has to be a string."""
        if not isinstance(self.value, str):
            raise self.fail("expected a string")
        return self.value

    def integer(self, least: int = 0) -> int:
        """The value, which has to be an integer of at least ``least``."""
        if not isinstance(self.value, int) or isinstance(self.value, bool) or self.value < least:
            raise self.fail(f"expected an integer of at least {least}")
        return self.value

    def rational(self) -> Fraction:
        """A rational number written in lowest terms, such as ``-3/4``."""
        text = self.text()
        if not _RATIONAL.fullmatch(text):
            raise self.fail(f"expected a rational number such as -3/4, found {text[:40]!r}")
        try:
            number = Fraction(text)
        except ValueError:
            raise self.fail("number too long") from None
        if str(number) != text:
            raise self.fail(f"expected lowest terms, {number} and not {text}")
        return number

    def truth(self) -> bool | None:
        """The value, which has to be true or false."""
        if self.value is not None and not isinstance(self.value, bool):
            raise self.fail("expected true, false or null")
        return self.value

    def polynomial(self, ring: Ring) -> Poly:
        """A polynomial in the text form of ``poly_to_text``, in exactly that form."""
        text = self.text()
        return ring.remembered(("text", text), lambda: self._parsed(text, ring))

    def _parsed(self, text: str, ring: Ring) -> Poly:
        try:
            poly = parse_poly(text, ring)
        except (ValueError, KeyError):
            raise self.fail(f"expected a polynomial in {', '.join(ring.names)}") from None
        if poly_to_text(poly) != text:
            raise self.fail("the polynomial is not in normal form")
        return poly


def poly_to_text(poly: Poly) -> str:
    """The polynomial as certificates hold it: names that are no plain words stand between backquotes."""
    return poly.ring.remembered(("text of", poly), lambda: format_poly(poly, _spelled))


@lru_cache(maxsize=10_000)
def _spelled(name: str) -> str:
    return name if _PLAIN.fullmatch(name) else between_quotes(name)


def parse_poly(text: str, ring: Ring) -> Poly:
    """The polynomial that ``poly_to_text`` prints as ``text``; ``ValueError`` or ``KeyError`` if there is none.

    Some texts that are never printed are read as well; the caller compares.
    """
    terms: dict[tuple[tuple[int, int], ...], int] = {}
    at, sign = 0, 1
    while text != "0":
        matched = _TERM.match(text, at)
        if matched is None or matched.end() == at or (at and matched[1]):
            raise ValueError(text[at : at + 40])
        powers: dict[int, int] = {}
        for name, exponent in _POWER.findall(matched[3] or ""):
            if len(exponent) > 5 or int(exponent or 1) > MAX_EXPONENT:
                raise ValueError(exponent[:40])
            i = ring.index[unquoted(name) if name.startswith("`") else name]
            powers[i] = powers.get(i, 0) + int(exponent or 1)
        terms[tuple(sorted(powers.items()))] = (-sign if matched[1] else sign) * int(matched[2] or 1)
        at = matched.end()
        if at == len(text):
            break
        joint = _SIGN.match(text, at)
        if joint is None:
            raise ValueError(text[at : at + 40])
        at, sign = joint.end(), 1 if joint[1] == "+" else -1
    return ring.from_sparse(terms.items())


def formula_to_json(formula: Formula, *, quantified: bool = False) -> Json:
    """Formulas as JSON: ``true``, ``["and", ...]``, ``["atom", poly, relation]``, ...; with ``quantified`` also
    ``["exists", [names], f]`` and ``["forall", [names], f]``, which are refused otherwise."""

    def inner(part: Formula) -> Json:
        return formula_to_json(part, quantified=quantified)

    match formula:
        case Constant(value):
            return value
        case Atom(poly, relation):
            return ["atom", poly_to_text(poly), relation.value]
        case RootAtom(variable, relation, poly, k):
            return ["root", variable, relation.value, poly_to_text(poly), k]
        case And(args):
            return ["and", *map(inner, args)]
        case Or(args):
            return ["or", *map(inner, args)]
        case Not(arg):
            return ["not", inner(arg)]
        case Exists(variables, body) | ForAll(variables, body) if quantified:
            return ["exists" if isinstance(formula, Exists) else "forall", list(variables), inner(body)]
        case Exists() | ForAll():
            raise CertificateRejected("matrix", "a quantifier where a quantifier-free formula is needed")
        case _:
            assert_never(formula)


def formula_from_json(entry: Entry, ring: Ring, *, quantified: bool = False) -> Formula:
    """The formula written by ``formula_to_json``, exactly as it stands (nothing is simplified).

    Refused: a name that is bound below a quantifier that binds it, and one that is both free and bound (``clashes``).
    """
    formula = _formula(entry, ring, 0, quantified)
    if formula.bound and not formula.bound.isdisjoint(formula.free):
        raise entry.fail(f"{min(formula.bound.intersection(formula.free))} is both free and bound")
    return formula


def _formula(entry: Entry, ring: Ring, depth: int, quantified: bool) -> Formula:
    def inner(part: Entry) -> Formula:
        return _formula(part, ring, depth + 1, quantified)

    if isinstance(entry.value, bool):
        return TRUE if entry.value else FALSE
    parts = list(entry.items())
    if not parts or depth > MAX_NESTING:
        raise entry.fail("expected a formula")
    kind, rest = parts[0].text(), parts[1:]
    if kind in ("and", "or") and len(rest) >= 2:
        args = tuple(map(inner, rest))
        return And(args) if kind == "and" else Or(args)
    if kind == "not" and len(rest) == 1:
        return Not(inner(rest[0]))
    if quantified and kind in ("exists", "forall") and len(rest) == 2:
        names, body = variables_from_json(rest[0], ring), inner(rest[1])
        if body.bound.intersection(names):
            raise rest[0].fail(f"{min(body.bound.intersection(names))} is bound once more inside")
        return (Exists if kind == "exists" else ForAll)(names, body)
    if kind == "atom" and len(rest) == 2:
        return Atom(polynomial_from_json(rest[0], ring), relation_from_json(rest[1]))
    if kind == "root" and len(rest) == 4:
        variable, k = rest[0].text(), rest[3].value
        if variable not in ring.index:
            raise rest[0].fail("unknown variable")
        if not isinstance(k, int) or isinstance(k, bool) or k == 0:
            raise rest[3].fail("expected a root number, not 0")
        return RootAtom(variable, relation_from_json(rest[1]), polynomial_from_json(rest[2], ring), k)
    raise entry.fail('expected ["and", ...], ["or", ...], ["not", f], ["atom", p, rel] or ["root", x, rel, p, k]')


def variables_from_json(entry: Entry, ring: Ring) -> tuple[str, ...]:
    """One or more different variables of the ring."""
    names = tuple(e.text() for e in entry.items())
    if not names or len(set(names)) < len(names) or not ring.index.keys() >= set(names):
        raise entry.fail("expected different variables of the order")
    return names


def polynomial_from_json(entry: Entry, ring: Ring) -> Poly:
    """A polynomial as atoms have it: primitive, with positive leading coefficient, not constant."""
    poly = entry.polynomial(ring)
    if poly.is_constant or poly.normal()[0] != 1:
        raise entry.fail("expected a primitive polynomial with positive leading coefficient")
    return poly


def relation_from_json(entry: Entry) -> Relation:
    """One of the six relations."""
    try:
        return Relation(entry.text())
    except ValueError:
        raise entry.fail("expected one of = /= < <= > >=") from None
