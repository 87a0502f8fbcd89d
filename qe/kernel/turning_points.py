"""Where an atom can turn true on the real line, and what makes it vanish identically.

THEOREM. Fix the parameters, and let p*rel*0 be true at a place of the line (a point, or the points just right of one)
and false just before it. Then p is not identically 0 and the place is at a root e of p: the root itself for =, <=, >=
(which hold where p = 0), the points just right of it for <, >, /= (which do not). For p = q*f^m with q free of x, m
odd, f of degree 1 or 2 in x: if e is a simple root of f, then p changes its sign there, so it rises (p > 0, p >= 0)
or falls (p < 0, p <= 0) at e; f = a*x + b rises iff a > 0, and f = a*x^2 + b*x + c, a /= 0, rises at the root with
branch 1 and falls at the one with branch -1. If e is a double root, both branches are e. So the conditions on the
sign of q below keep a point for e in each case. Going left, rising and falling change places. (Loos & Weispfenning
1993.)
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from qe.errors import CertificateRejected
from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import FALSE, Atom, Formula, Relation
from qe.kernel.virtual_substitution import TestPoint

EQ, NE, LT, GT, GE = Relation.EQ, Relation.NE, Relation.LT, Relation.GT, Relation.GE

MOST_FACTORED = 400
"""A polynomial of more terms counts as one factor."""


@dataclass(frozen=True, slots=True)
class Turn:
    """The atom may turn true at ``point``, and only where ``conditions`` hold."""

    point: TestPoint
    conditions: tuple[Formula, ...]


def factored(p: Poly) -> tuple[tuple[Poly, int], ...]:
    """Factors with exponents whose product is p up to a constant; multiplied out here."""
    primitive = p.normal()[1]
    if primitive.total_degree == 1 or primitive.term_count() > MOST_FACTORED:
        return ((primitive, 1),)
    parts = primitive.factors()[1]
    product = p.ring.constant(1)
    for factor, exponent in parts:
        product = product * factor**exponent
    if product != primitive and -product != primitive:
        raise CertificateRejected("", "factors that do not multiply out")
    return parts


def inside(p: Poly, x: int) -> list[tuple[Poly, int]]:
    """The factors that contain the variable."""
    return [(f, m) for f, m in factored(p) if f.degree(x)]


def turns(given: Atom, x: int, side: int) -> list[Turn] | None:
    """Where the atom can turn true, going right (``side`` 1) or left (-1); None if a factor's degree exceeds 2."""
    parts = inside(given.poly, x)
    if any(f.degree(x) > 2 for f, _ in parts):
        return None
    relation = given.relation
    shift = side if relation.is_strict else 0
    content = None
    if len(parts) == 1 and parts[0][1] % 2 and relation not in (EQ, NE):
        content = given.poly.exact_divide(parts[0][0] ** parts[0][1])
    rising = side if relation in (GT, GE) else -side
    return [turn for f, _ in parts for turn in _of_factor(f, x, shift, content, rising)]


def _of_factor(f: Poly, x: int, shift: int, content: Poly | None, rising: int) -> Iterator[Turn]:
    """By the degree that is left where the coefficients above it vanish."""
    coefficients = f.coefficients(x)
    for degree, of_degree in ((2, _quadratic), (1, _linear)):
        if degree < len(coefficients) and coefficients[degree]:
            flat = tuple(atom(c, EQ) for c in coefficients[degree + 1 :])
            yield from of_degree(coefficients[: degree + 1], shift, content, rising, flat)


def _quadratic(
    coefficients: tuple[Poly, ...], shift: int, content: Poly | None, rising: int, given: tuple[Formula, ...]
) -> Iterator[Turn]:
    c, b, a = coefficients
    proper = (*given, atom(a, NE), atom(b * b - 4 * (a * c), GE))
    for branch in (-1, 1):
        towards = () if content is None else (atom(content, GT if branch == rising else LT),)
        yield from _if_possible(TestPoint((c, b, a), branch, shift), (*proper, *towards))


def _linear(
    coefficients: tuple[Poly, ...], shift: int, content: Poly | None, rising: int, given: tuple[Formula, ...]
) -> Iterator[Turn]:
    a = coefficients[1]
    there = atom(a, NE) if content is None else atom(content * a, GT if rising > 0 else LT)
    yield from _if_possible(TestPoint(coefficients, 0, shift), (*given, there))


def _if_possible(point: TestPoint, conditions: tuple[Formula, ...]) -> Iterator[Turn]:
    if conj(conditions) != FALSE:
        yield Turn(point, conditions)


def vanishing(p: Poly, x: int) -> Formula:
    """The condition that p vanishes identically in x: some factor does."""
    return disj(conj(atom(c, EQ) for c in reversed(f.coefficients(x)) if c) for f, _ in factored(p))
