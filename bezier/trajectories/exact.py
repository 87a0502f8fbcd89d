"""Trajectories from exact numbers: power bases, Bezier and B-spline control points, and a path run through in time."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise

from bezier.curves import bernstein as bs
from bezier.trajectories.piecewise import Trajectory, hermite
from qe.errors import InputError
from qe.exact.rational_poly import RationalPoly

Rows = Sequence[Sequence[Fraction]]


def by_points(names: Sequence[str], times: Sequence[Fraction], states: Sequence[Rows]) -> Trajectory:
    """Interpolation of states: of each time positions (linear), velocities too (cubic), accelerations too (quintic).

    ``states[i][order][axis]``. So the joint trajectory controller of ROS 2 does it.
    """
    pieces = []
    for i, (a, b) in enumerate(pairwise(times)):
        if a >= b:
            raise InputError(f"trajectory: expected times that ascend strictly, found {float(a)} before {float(b)}")
        ends = zip(zip(*states[i], strict=True), zip(*states[i + 1], strict=True), strict=True)
        pieces.append(tuple(hermite(b - a, start, end) for start, end in ends))
    return Trajectory(tuple(names), tuple(times), tuple(pieces))


def by_control_points(points: Rows, length: Fraction) -> tuple[RationalPoly, ...]:
    """A Bezier piece: control points, each with all axes."""
    rows = (bs.to_power(values) for values in zip(*points, strict=True))
    return tuple(RationalPoly.of([Fraction(c) / length**k for k, c in enumerate(row)]) for row in rows)


def by_spline(names: Sequence[str], knots: Sequence[Fraction], points: Rows, degree: int) -> Trajectory:
    """A B-spline on [knots[degree], knots[n]]: the recursion of Cox and de Boor, with polynomials for its numbers."""
    n = len(points)
    if degree < 0 or n <= degree or len(knots) != n + degree + 1 or any(a > b for a, b in pairwise(knots)):
        raise InputError(f"B-spline: expected {n + degree + 1} ascending knots for {n} points of degree {degree}")
    breaks, pieces = [knots[degree]], []
    for span in range(degree, n):
        if knots[span] == knots[span + 1]:
            continue
        start = knots[span]
        pieces.append(tuple(_de_boor(knots, values, degree, span, start) for values in zip(*points, strict=True)))
        breaks.append(knots[span + 1])
    return Trajectory(tuple(names), tuple(breaks), tuple(pieces))


def _de_boor(
    knots: Sequence[Fraction], values: Sequence[Fraction], degree: int, span: int, start: Fraction
) -> RationalPoly:
    d = [RationalPoly.of([values[j]]) for j in range(span - degree, span + 1)]
    for r in range(1, degree + 1):
        for j in range(degree, r - 1, -1):
            i = span - degree + j
            wide = knots[i + degree + 1 - r] - knots[i]
            d[j] = d[j - 1] + RationalPoly.of([(start - knots[i]) / wide, 1 / wide]) * (d[j] - d[j - 1])
    return d[degree]


def composed(path: Trajectory, breaks: Sequence[Fraction], laws: Sequence[RationalPoly]) -> Trajectory:
    """q(s(t)): ``laws[i]`` is s on [breaks[i], breaks[i + 1]], by t - breaks[i], and does not fall there.

    Where s passes a break of the path inside an interval, that is cut at a rational time within 2^-80 of it: by so
    little the next polynomial of the path is used too early or too late.
    """
    times, pieces, k = list[Fraction](), [], 0
    for start, end, law in zip(breaks, breaks[1:], laws, strict=False):
        low, final = Fraction(0), end - start
        while low < final:
            while k + 2 < len(path.breaks) and law(low) >= path.breaks[k + 1]:
                k += 1
            last = k + 2 == len(path.breaks)
            high = final if last or law(final) <= path.breaks[k + 1] else _passage(law, path.breaks[k + 1], low, final)
            inner = law.compose(RationalPoly.of([low, 1])) - RationalPoly.of([path.breaks[k]])
            times.append(start + low)
            pieces.append(tuple(p.compose(inner) for p in path.pieces[k]))
            low = high
    return Trajectory(path.names, (*times, breaks[len(laws)]), tuple(pieces))


def _passage(law: RationalPoly, value: Fraction, low: Fraction, high: Fraction) -> Fraction:
    """A time at which s has reached the value, at most 2^-80 too late."""
    while high - low > Fraction(1, 2**80):
        middle = (low + high) / 2
        low, high = (low, middle) if law(middle) >= value else (middle, high)
    return high
