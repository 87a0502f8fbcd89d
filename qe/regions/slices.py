"""Areas of plane slices in closed form: what makes volumes of balls and half-spaces quick.

Over one x, a piece of space is the set between two functions of y on an interval. Where these are polynomials in
y, or (-b ± sqrt(q))/(2a) with a constant and q of degree 2 in y with a constant negative leading coefficient
(ellipsoids), the integral over y is elementary: with q = A y^2 + B y + C, A < 0, D = B^2 - 4AC and
u = (2Ay + B)/sqrt(D), ∫ sqrt(q) dy = (2Ay + B) sqrt(q)/(4A) + D asin(u)/(8A sqrt(-A)).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from qe.decomposition.pieces import Piece, RootFunction
from qe.exact.enclosure import Jet, Sides, constant, evaluate
from qe.exact.ring import Poly

Y, Z = 1, 2


def has_closed_slices(piece: Piece) -> bool:
    """Whether both bounds of the third variable are of the shapes described above."""
    return len(piece.ranges) == 3 and all(_integrable(r) for r in (piece.ranges[Z].lower, piece.ranges[Z].upper))


def _integrable(root: RootFunction | None) -> bool:
    if root is None:
        return False
    if root.value is not None:
        return False
    c = root.poly.coefficients(Z)
    if not c[-1].is_constant or len(c) > 3:
        return False
    if len(c) == 2:
        return True
    q = _discriminant(c).coefficients(Y)
    return len(q) == 3 and q[2].is_constant and q[2].constant_value() < 0


def _discriminant(c: tuple[Poly, ...]) -> Poly:
    return c[1] * c[1] - 4 * (c[2] * c[0])


@dataclass(frozen=True, slots=True)
class _End:
    """One end of the y interval: its jet and the root function it is."""

    y: Jet
    root: RootFunction


def slice_area(piece: Piece, low: Jet, high: Jet, at: Mapping[int, Jet], sides: Sides) -> Jet | None:
    """The area of the slice: ``at`` holds the first variable's jet, ``low`` and ``high`` are the ends of the second."""
    r = piece.ranges[Y]
    assert r.lower is not None and r.upper is not None
    ends = _End(low, r.lower), _End(high, r.upper)
    top, bottom = (_integral(b, ends, at, sides) for b in (piece.ranges[Z].upper, piece.ranges[Z].lower))
    return None if top is None or bottom is None else top - bottom


def _integral(bound: RootFunction | None, ends: tuple[_End, _End], at: Mapping[int, Jet], sides: Sides) -> Jet | None:
    """The integral of one bound over the y interval."""
    assert bound is not None
    c = bound.poly.coefficients(Z)
    lead = c[-1].constant_value()
    if len(c) == 2:
        return _polynomial(c[0], ends, at, sides).over(-lead)
    flat = _polynomial(c[1], ends, at, sides)
    curved = _root(_discriminant(c), ends, at, sides)
    if curved is None:
        return None
    lower = (bound.k == 1) == (lead > 0)
    return ((-flat) - curved if lower else curved - flat).over(2 * lead)


def _polynomial(f: Poly, ends: tuple[_End, _End], at: Mapping[int, Jet], sides: Sides) -> Jet:
    low, high = ends[0].y, ends[1].y
    total, low_power, high_power = constant(0, sides), low, high
    for j, c in enumerate(f.coefficients(Y)):
        total = total + evaluate(c, at, sides) * (high_power - low_power).over(j + 1)
        low_power, high_power = low_power * low, high_power * high
    return total


def _root(q: Poly, ends: tuple[_End, _End], at: Mapping[int, Jet], sides: Sides) -> Jet | None:
    lowest, linear, leading = q.coefficients(Y)
    lead = leading.constant_value()
    b = evaluate(linear, at, sides)
    d = b * b - evaluate(lowest, at, sides).scaled(4 * lead)
    scale = d.root().inverse()
    if scale is None:
        return None
    high, low = (_primitive(e, q, lead, b, d, scale, at, sides) for e in reversed(ends))
    return None if high is None or low is None else high - low


def _primitive(
    end: _End, q: Poly, lead: int, b: Jet, d: Jet, scale: Jet, at: Mapping[int, Jet], sides: Sides
) -> Jet | None:
    """The antiderivative at one end; where the end is a root of q itself, asin is exactly ±pi/2 there."""
    radical = constant(-lead, sides).root().inverse()
    assert radical is not None
    if end.root.poly == q.normal()[1]:
        angle = constant(1 if end.root.k == 1 else -1, sides).arcsine()
        return (d * angle * radical).over(8 * lead)
    slope = end.y.scaled(2 * lead) + b
    value = evaluate(q, {**at, Y: end.y}, sides).root()
    return (slope * value).over(4 * lead) + (d * (slope * scale).arcsine() * radical).over(8 * lead)
