"""The formulas of Hatakeyama, Terui and Mikawa (SCSS 2024) and their variants as text, for any numbers.

Norm conditions ||v|| <= r are written v.v <= r^2. Formula (8) itself comes from ``bezier.quadratic``; here are
formula (7), the conditions (4) of the single curve, chains through any number of via points, and bare balls.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import ceil, comb, floor

Number = int | Fraction
Point = Sequence[Number]

AXES = "xyz"


def number(value: Number) -> str:
    """A number as a factor or a summand."""
    return f"({value})" if value < 0 or Fraction(value).denominator > 1 else str(value)


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


# --- formula (7): three cubic curves with C2 joins -------------------------------------------------------
def _inner_points(q0: Point, r0: Point) -> dict[str, list[str]]:
    """P1, P2, R1, R2 in terms of Q1 and Q2, equation (6)."""
    a, b = [number(c) for c in q0], [number(c) for c in r0]
    q1, q2 = (coordinates(name, len(q0)) for name in ("q1", "q2"))
    rows = list(zip(a, b, q1, q2, strict=True))
    return {
        "p1": [f"4*{s} - 4*{u} + {v}" for s, _, u, v in rows],
        "p2": [f"2*{s} - {u}" for s, _, u, _ in rows],
        "r1": [f"2*{e} - {v}" for _, e, _, v in rows],
        "r2": [f"{u} - 4*{v} + 4*{e}" for _, e, u, v in rows],
    }


def cubic_conditions(q0: Point, r0: Point, radius_squared: Number) -> str:
    """What (7) says of Q1 and Q2: six balls; the paper's answer would be equivalent to it."""
    free = [coordinates(name, len(q0)) for name in ("q1", "q2")]
    return " and ".join(within(point, radius_squared) for point in (*free, *_inner_points(q0, r0).values()))


def formula7(q0: Point, r0: Point, radius_squared: Number) -> str:
    """Formula (7) as printed: equation (6) for the quantified P1, P2, R1, R2, and six norms."""
    inner = _inner_points(q0, r0)
    bound = {name: coordinates(name, len(q0)) for name in inner}
    equations = [f"{v} = {term}" for name in inner for v, term in zip(bound[name], inner[name], strict=True)]
    points = [*bound.values(), *(coordinates(name, len(q0)) for name in ("q1", "q2"))]
    block = ", ".join(v for names in bound.values() for v in names)
    return f"ex {block}. " + " and ".join([*equations, *(within(point, radius_squared) for point in points)])


def cubic_objective(q0: Point, r0: Point) -> str:
    """|Q1 - Q0|^2 + |Q2 - Q1|^2 + |R0 - Q2|^2."""
    rows = zip(q0, r0, *(coordinates(name, len(q0)) for name in ("q1", "q2")), strict=True)
    return " + ".join(f"({u} - {number(a)})^2 + ({v} - {u})^2 + ({number(b)} - {v})^2" for a, b, u, v in rows)


# --- (4): one curve of degree n --------------------------------------------------------------------------
def single_curve(degree: int, a: Fraction, b: Fraction, height: str = "1") -> str:
    """The conditions (4) on y1, ..., y(n-1) with x0 = y0 = yn = 0, xn = 1: the curve passes (a, h) and (b, h).

    ``height`` is a number or a variable. The control points over [a, b] are those with a <= i/n <= b.
    """
    inner = [f"y{i}" for i in range(1, degree)]
    above = range(ceil(a * degree), floor(b * degree) + 1)
    parts = [
        " + ".join(f"{number(comb(degree, i) * t**i * (1 - t) ** (degree - i))}*y{i}" for i in range(1, degree))
        + f" = {height}"
        for t in (a, b)
    ]
    parts += [f"y{i} >= {height if i in above else 0}" for i in range(1, degree)]
    return f"ex {', '.join(inner)}. " + " and ".join(parts)


# --- quadratic curves through more via points --------------------------------------------------------------
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


def whole_curve(start: Point, control: Sequence[str], end: Point, radius_squared: Number) -> str:
    """The quadratic curve itself, not only its control points, stays in the ball (a condition on ``control``)."""
    terms = [
        f"(1 - t)^2*{number(s)} + 2*t*(1 - t)*({c}) + t^2*{number(e)}"
        for s, c, e in zip(start, control, end, strict=True)
    ]
    return f"all t. t >= 0 and t <= 1 -> {within(terms, radius_squared)}"
