"""Checker for certificates of kind "containment": a whole Bezier curve satisfies a convex condition.

THEOREM. A polynomial whose Bernstein coefficients on [a, b] are all nonnegative is nonnegative on [a, b] (Farouki
2012, section 3). For control points P_0, ..., P_n the margin r^2 - |P(t) - c|^2 has on [0, 1] the Bernstein
coefficients r^2 - sum_{i+j=k} C(n,i) C(n,j) / C(2n,k) (P_i - c).(P_j - c), and b - a.P(t) has b - a.P_k. De
Casteljau's algorithm gives the control points on each piece between two breaks. The certificate holds the control
points, the condition and the breaks; everything else is computed here.
"""

from __future__ import annotations

from fractions import Fraction

from bezier.certify.bernstein import Vector, product, read_points, restricted, total
from qe.certify.kinds import BroughtKind
from qe.errors import CertificateRejected
from qe.expert.arithmetic.numbers import read_field, read_number
from qe.expert.arithmetic.residue import Residue, RootField, add, of_rationals, scale
from qe.options import Budget
from qe.proof.entry import Entry, Json


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
