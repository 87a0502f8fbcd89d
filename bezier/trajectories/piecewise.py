"""A trajectory: for each axis a polynomial between exact times.

All numbers are rational. A float is the dyadic number that it is, so nothing is rounded; but polynomials of floats do
not join exactly, so continuity is decided up to a tolerance that the caller states, and the exact jumps are said.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cached_property
from itertools import pairwise

from bezier.curves import bernstein as bs
from bezier.curves.curve import Bezier
from qe.errors import InputError
from qe.exact.rational_poly import RationalPoly, largest_gap

QUANTITIES = ("position", "velocity", "acceleration", "jerk")
"""By the order of the derivative."""
Row = tuple[RationalPoly, ...]


@dataclass(frozen=True, slots=True)
class Jump:
    """The largest difference of a derivative from the left to the right of a break."""

    order: int
    axis: int
    time: Fraction
    size: Fraction


@dataclass(frozen=True)
class Trajectory:
    """On [breaks[i], breaks[i + 1]] axis k is at pieces[i][k](t - breaks[i]). Invariant: the breaks ascend strictly."""

    names: tuple[str, ...]
    breaks: tuple[Fraction, ...]
    pieces: tuple[Row, ...]

    def __post_init__(self) -> None:
        if not self.pieces or len(self.breaks) != len(self.pieces) + 1:
            raise InputError("trajectory: expected at least two times, and one polynomial between neighbours")
        if any(a >= b for a, b in pairwise(self.breaks)):
            raise InputError("trajectory: expected times that ascend strictly")
        if not self.names or any(len(row) != len(self.names) for row in self.pieces):
            raise InputError("trajectory: expected a polynomial for each axis, and at least one axis")
        if len({*self.names}) < len(self.names) or not all(self.names):
            raise InputError(f"trajectory: expected different names of axes, found {', '.join(self.names)}")

    @cached_property
    def lengths(self) -> list[Fraction]:
        """How long each piece takes."""
        return [b - a for a, b in pairwise(self.breaks)]

    def curve(self, i: int) -> Bezier:
        """A piece as a curve in space; a third coordinate that is missing is 0."""
        row, length, columns = self.pieces[i], self.lengths[i], []
        degree = max(0, *(p.degree for p in row))
        for p in row:
            scaled = [c * length**k for k, c in enumerate(p.coefficients())]
            columns.append(bs.from_power([*scaled, *[Fraction(0)] * (degree + 1 - len(scaled))]))
        columns += [(Fraction(0),) * (degree + 1)] * (3 - len(row))
        return Bezier.of(list(zip(*columns, strict=True)))

    def derivative(self, order: int) -> tuple[Row, ...]:
        """The pieces of a derivative."""
        rows = self.pieces
        for _ in range(order):
            rows = tuple(tuple(p.derivative() for p in row) for row in rows)
        return rows

    def jump(self, order: int, rows: Sequence[Row] | None = None) -> Jump | None:
        """The largest jump of a derivative, whose pieces may be given; None where it has none."""
        place = largest_gap(self.derivative(order) if rows is None else rows, self.lengths)
        return None if place is None else Jump(order, place[1], self.breaks[place[0] + 1], place[2])

    def cut(self, times: Iterable[Fraction]) -> Trajectory:
        """The same with breaks at these times, too."""
        breaks, pieces, k = sorted({*self.breaks, *times}), list[Row](), 0
        for start in breaks[:-1]:
            k += start >= self.breaks[k + 1]
            inner = RationalPoly.of([start - self.breaks[k], 1])
            pieces.append(tuple(p.compose(inner) for p in self.pieces[k]))
        return Trajectory(self.names, tuple(breaks), tuple(pieces))


def hermite(length: Fraction, start: Sequence[Fraction], end: Sequence[Fraction]) -> RationalPoly:
    """The polynomial of least degree on [0, length] with this position (and velocity, and acceleration) at its ends."""
    total = [Fraction(0)] * (2 * len(start))
    for k, (first, last) in enumerate(_unit_hermite(len(start))):
        for j in range(len(total)):
            total[j] += (start[k] * first[j] + end[k] * last[j]) * length**k
    return RationalPoly.of([c / length**j for j, c in enumerate(total)])


@cache
def _unit_hermite(n: int) -> list[tuple[tuple[int | Fraction, ...], tuple[int | Fraction, ...]]]:
    """The polynomials on [0, 1] whose k-th derivative is 1 at one end and all others, up to n - 1, are 0."""
    half = Fraction(1, 2)
    if n == 1:
        return [((1, -1), (0, 1))]
    if n == 2:
        return [((1, 0, -3, 2), (0, 0, 3, -2)), ((0, 1, -2, 1), (0, 0, -1, 1))]
    return [
        ((1, 0, 0, -10, 15, -6), (0, 0, 0, 10, -15, 6)),
        ((0, 1, 0, -6, 8, -3), (0, 0, 0, -4, 7, -3)),
        ((0, 0, half, -3 * half, 3 * half, -half), (0, 0, 0, half, -1, half)),
    ]
