"""Variants of the paper's formulas as text, for any numbers: balls, chains through via points, whole curves.

The formulas of the paper itself come from ``bezier``. Norm conditions ||v|| <= r are written v.v <= r^2.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from bezier.methods.control.statements import number
from bezier.methods.control.system import AXES

Number = int | Fraction
Point = Sequence[Number]


def coordinates(point: str, dimension: int = 3) -> list[str]:
    """The variables of a control point, e.g. ``q1x, q1y, q1z``."""
    return [f"{point}{axis}" for axis in AXES[:dimension]]


def within(terms: Sequence[str], radius_squared: Number | str) -> str:
    """The vector of these coordinates has at most this norm."""
    bound = radius_squared if isinstance(radius_squared, str) else number(radius_squared)
    return " + ".join(f"({term})^2" for term in terms) + f" <= {bound}"


def ball(variables: Sequence[str], centre: Point, radius_squared: Number) -> str:
    """The point of these variables lies in the closed ball."""
    return within([f"{v} - {number(c)}" for v, c in zip(variables, centre, strict=True)], radius_squared)


def in_balls(variables: Sequence[str], centres: Sequence[Point], radius_squared: Number) -> str:
    """The point lies in all balls of one radius."""
    return " and ".join(ball(variables, centre, radius_squared) for centre in centres)


def chain(via: Sequence[Point], radius_squared: Number) -> str:
    """C1 quadratic curves through these via points, as (8) for two: the first control point is free.

    The control points c0, c1, ... obey c(i) + c(i+1) = 2 V(i) and lie in the ball.
    """
    dimension = len(via[0])
    points = [coordinates(f"c{i}_", dimension) for i in range(len(via) + 1)]
    equations = [
        f"{after} = 2*{number(v)} - {before}"
        for i, point in enumerate(via)
        for before, after, v in zip(points[i], points[i + 1], point, strict=True)
    ]
    bound = ", ".join(v for point in points[1:] for v in point)
    return f"ex {bound}. " + " and ".join([*equations, *(within(point, radius_squared) for point in points)])


def chain_region(via: Sequence[Point], radius_squared: Number) -> str:
    """What ``chain`` says of the first control point: c(i) is c0 or -c0, shifted, and lies in the ball."""
    first = coordinates("c0_", len(via[0]))
    side, shift, parts = 1, [Fraction(0)] * len(first), [within(first, radius_squared)]
    for point in via:
        side, shift = -side, [2 * v - s for v, s in zip(point, shift, strict=True)]
        parts.append(within([f"{number(s)} + {number(side)}*{c}" for c, s in zip(first, shift)], radius_squared))
    return " and ".join(parts)


def whole_curve(start: Point, control: Sequence[str], end: Point, radius_squared: Number) -> str:
    """The quadratic curve itself, not only its control points, stays in the ball (a condition on ``control``)."""
    terms = [
        f"(1 - t)^2*{number(s)} + 2*t*(1 - t)*({c}) + t^2*{number(e)}"
        for s, c, e in zip(start, control, end, strict=True)
    ]
    return f"all t. t >= 0 and t <= 1 -> {within(terms, radius_squared)}"
