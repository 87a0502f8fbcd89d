"""Checker for certificates of kind "containment": a whole Bezier curve satisfies a convex condition.

THEOREM. A polynomial whose Bernstein coefficients on [a, b] are all nonnegative is nonnegative on [a, b] (Farouki
2012, section 3). For control points P_0, ..., P_n the margin r^2 - |P(t) - c|^2 has on [0, 1] the Bernstein
coefficients r^2 - sum_{i+j=k} C(n,i) C(n,j) / C(2n,k) (P_i - c).(P_j - c), and b - a.P(t) has b - a.P_k. De
Casteljau's algorithm gives the control points on each piece between two breaks. The certificate holds the control
points, the condition and the breaks; everything else is computed here.

Polynomials in Bernstein form over a number field, for the checkers of certificates about curves.

A polynomial of degree n on [0, 1] is the list b_0, ..., b_n with p(t) = sum_k C(n,k) t^k (1-t)^(n-k) b_k. On [a, b] it
lies between its smallest and its largest Bernstein coefficient for [a, b] (Farouki, "The Bernstein polynomial basis: a
centennial retrospective", CAGD 2012, section 3).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from math import comb

from qe.certify.kinds import BroughtKind
from qe.errors import CertificateRejected
from qe.expert.arithmetic.numbers import read_field, read_number
from qe.expert.arithmetic.residue import ZERO, Residue, RootField, add, of_rationals, scale
from qe.options import Budget
from qe.proof.entry import Entry, Json

Vector = list[Residue]
MAX_DEGREE = 64


def read_points(entry: Entry, field: RootField) -> list[Vector]:
    """Control points of one dimension, at most ``MAX_DEGREE`` + 1 of them."""
    points = [[read_number(c, field) for c in p.items()] for p in entry.items()]
    if not 1 <= len(points) <= MAX_DEGREE + 1 or not points[0] or len({len(p) for p in points}) != 1:
        raise entry.fail(f"expected at most {MAX_DEGREE + 1} points of one dimension")
    return points


def total(values: Sequence[Residue]) -> Residue:
    """The sum."""
    result = ZERO
    for value in values:
        result = add(result, value)
    return result


def product(a: Sequence[Residue], b: Sequence[Residue], field: RootField) -> list[Residue]:
    """c_k = sum_{i+j=k} C(m,i) C(n,j) / C(m+n,k) a_i b_j (Farouki 2012, section 4)."""
    m, n = len(a) - 1, len(b) - 1
    out = [ZERO] * (m + n + 1)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            weight = Fraction(comb(m, i) * comb(n, j), comb(m + n, i + j))
            out[i + j] = add(out[i + j], scale(field.multiply(x, y), weight))
    return out


def constant(value: Fraction, degree: int) -> list[Residue]:
    """A constant polynomial written with this degree."""
    return [of_rationals([value])] * (degree + 1)


def restricted(b: Sequence[Residue], low: Fraction, high: Fraction) -> list[Residue]:
    """The coefficients on [low, high], 0 <= low < high <= 1, mapped to [0, 1]."""
    piece = list(b) if high == 1 else _left(b, high)
    return list(reversed(_left(list(reversed(piece)), 1 - low / high))) if low else piece


def _left(coefficients: Sequence[Residue], t: Fraction) -> list[Residue]:
    """De Casteljau: the coefficients on [0, t], mapped to [0, 1]."""
    row, out = list(coefficients), [coefficients[0]]
    while len(row) > 1:
        row = [add(scale(x, 1 - t), scale(y, t)) for x, y in pairwise(row)]
        out.append(row[0])
    return out


def check_containment(payload: dict[str, Json], budget: Budget | None = None) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the entry that fails."""
    numbers, points_entry, condition, breaks_entry = Entry(payload, "payload").fields(
        "field", "points", "condition", "breaks"
    )
    field = read_field(numbers, budget)
    points = read_points(points_entry, field)
    breaks = [b.rational() for b in breaks_entry.items()]
    if len(breaks) < 2 or breaks[0] != 0 or breaks[-1] != 1 or breaks != sorted(set(breaks)):
        raise breaks_entry.fail("expected ascending numbers from 0 to 1")
    margin = _margin(condition, points, field)
    for i in range(1, len(breaks)):
        piece = restricted(margin, breaks[i - 1], breaks[i])
        if any(field.sign(c) < 0 for c in piece):
            raise CertificateRejected(f"payload.breaks[{i}]", "a Bernstein coefficient before this break is negative")


def _margin(condition: Entry, points: list[Vector], field: RootField) -> list[Residue]:
    """The Bernstein coefficients of the condition's margin along the curve."""
    if not isinstance(condition.value, dict):
        raise condition.fail("expected an object")
    if "normal" in condition.value:
        normal, offset = condition.fields("normal", "offset")
        a = [c.rational() for c in normal.items()]
        if len(a) != len(points[0]):
            raise normal.fail(f"expected {len(points[0])} numbers")
        b = of_rationals([offset.rational()])
        along = [total([scale(x, -c) for c, x in zip(a, p, strict=True)]) for p in points]
        return [add(b, s) for s in along]
    centre, radius = condition.fields("centre", "radius_squared")
    c = [x.rational() for x in centre.items()]
    if len(c) != len(points[0]):
        raise centre.fail(f"expected {len(points[0])} numbers")
    moved = [[add(x, of_rationals([-s])) for x, s in zip(p, c, strict=True)] for p in points]
    r = read_number(radius, field)
    squares = [product(x, x, field) for x in zip(*moved, strict=True)]
    return [add(r, scale(total(row), Fraction(-1))) for row in zip(*squares, strict=True)]


KIND = BroughtKind(check_containment, lambda _: "about a curve, see the entries of its payload")
