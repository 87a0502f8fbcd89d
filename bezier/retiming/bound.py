"""Seconds that no motion along a path can beat, by weak duality, in rational numbers.

A motion along q(s), from rest to rest, is described by b(s) = (ds/dt)^2 >= 0, absolutely continuous between the stops;
its acceleration is q'' b + q' b'/2, its velocity squared q'^2 b, its time T the integral of b^(-1/2). At a stop q' b
tends to 0, also where q' does: speed^2 = q'^2 b is at most a multiple of the distance from there.

THEOREM. Let lambda be a vector of functions that is linear on each interval, mu >= 0 constant and u >= 0 linear there,
with S = (lambda . q'' - lambda' . q') / 2 + sum mu_i q_i'^2, such that u^3 <= 2 S on each interval and lambda . q'
never jumps upwards, except at stops. Then T is at least the sum over all intervals of the integral of
3 u / 2 - sum a_i |lambda_i| - sum mu_i v_i^2.

PROOF. b^(-1/2) >= 3 u / 2 - u^3 b / 2, the tangent at b = u^-2. The integral of u^3 b / 2 is at most that of S b. By
parts, S b is lambda . (q'' b + q' b'/2) + sum mu_i q_i'^2 b, less the derivative of lambda . q' b / 2, whose integrals
add up to something positive where lambda . q' jumps downwards, and nothing at stops. Limits bound the rest. A part of
lambda may count by its Euclidean norm against the limit of the norm, and mu by that of |q'|^2.

The integral of a convex function of lambda is at most that of its chord. That u^3 <= 2 S is a sentence for the kernel.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from bezier.curves.enclosure import root_above
from bezier.input.numbers import parse
from bezier.retiming.grid import Bounds, Grid, Interval
from bezier.retiming.law import LONGEST, short
from bezier.retiming.proposals import Proposal
from bezier.trajectories.limits import is_below
from bezier.trajectories.piecewise import Row, Trajectory
from qe.errors import Unable
from qe.exact.rational_poly import RationalPoly

ZERO = Fraction(0)
Vector = tuple[Fraction, ...]
LESS = tuple(Fraction(1, 1 << k) for k in (24, 18, 14, 10, 7, 4, 2, 0))
"""Shares by which u is lowered, in this order, until u^3 <= 2 S."""
NOISE = 1e-7
PLACES = 30
"""Binary digits of multipliers; of those whose differences count, ten more."""


@dataclass(frozen=True, slots=True)
class Weights:
    """Multipliers on an interval: of the accelerations of the axes and of their norm at both ends, of the velocities
    (that of their norm is the last one), and u at both ends."""

    interval: Interval
    axes: tuple[Vector, Vector]
    norm: tuple[Vector, Vector]
    speeds: Vector
    rates: tuple[Fraction, Fraction]

    def __str__(self) -> str:
        """What ``read`` reads."""
        rows = (*self.axes, *self.norm, self.speeds, self.rates)
        numbers = " | ".join(" ".join(map(str, row)) for row in rows)
        return f"piece {self.interval.piece + 1} from {self.interval.low} for {self.interval.length}: {numbers}"

    @staticmethod
    def read(text: str) -> Weights:
        """Raises ``ValueError``."""
        head, _, numbers = text.partition(": ")
        _, piece, _, low, _, length = head.split(" ")
        rows = [tuple(parse(x, LONGEST) for x in row.split()) for row in numbers.split(" | ")]
        first, second, third, fourth, speeds, (u, v) = rows
        return Weights(
            Interval(int(piece) - 1, Fraction(low), Fraction(length)), (first, second), (third, fourth), speeds, (u, v)
        )

    def momentum(self, slopes: Row, end: int) -> Fraction:
        """lambda . q' at the beginning or at the end."""
        at = end * self.interval.length
        sums = (a + b for a, b in zip(self.axes[end], self.norm[end], strict=True))
        return sum((x * p(at) for x, p in zip(sums, slopes, strict=True) if x), ZERO)

    def excess(self, slopes: Row, bends: Row) -> RationalPoly:
        """u^3 - 2 S, by the parameter since the beginning of the interval."""
        h = self.interval.length
        u = _line(*self.rates, h)
        total = u * u * u
        for i, (p, q) in enumerate(zip(slopes, bends, strict=True)):
            a, b = (self.axes[j][i] + self.norm[j][i] for j in (0, 1))
            if a or b:
                total = total - _line(a, b, h) * q + RationalPoly.of([(b - a) / h]) * p
            if weight := self.speeds[i] + self.speeds[-1]:
                total = total - RationalPoly.of([2 * weight]) * p * p
        return total

    def value(self, bounds: Bounds) -> Fraction:
        """The integral of 3 u / 2, less what the multipliers cost. Raises ``ValueError`` where one has no limit."""
        d, h = len(self.speeds) - 1, self.interval.length
        velocities = (*(bounds.velocity or (None,) * d), bounds.velocity_norm)
        cost = (
            h * _dot([abs(a) + abs(b) for a, b in zip(*self.axes, strict=True)], bounds.acceleration or (None,) * d) / 2
        )
        lengths = [root_above(sum((x * x for x in part), ZERO), 80) for part in self.norm]
        cost += h * _dot([sum(lengths, ZERO)], [bounds.acceleration_norm]) / 2
        cost += h * _dot(self.speeds, [None if v is None else v * v for v in velocities])
        return Fraction(3, 4) * h * sum(self.rates) - cost


def _dot(weights: Sequence[Fraction], limits: Sequence[Fraction | None]) -> Fraction:
    if any(w and limit is None for w, limit in zip(weights, limits, strict=True)):
        raise ValueError("a multiplier without a limit")
    return sum((w * limit for w, limit in zip(weights, limits, strict=True) if w and limit is not None), ZERO)


def _line(start: Fraction, end: Fraction, h: Fraction) -> RationalPoly:
    return RationalPoly.of([start, (end - start) / h])


def bound(path: Trajectory, stops: Collection[int], bounds: Bounds, weights: Sequence[Weights]) -> Fraction:
    """The seconds of the theorem, all of it checked but u^3 <= 2 S. Raises ``ValueError`` where it is no bound."""
    place, total, before = (0, ZERO), ZERO, Fraction(0)
    d = len(path.names)
    for part in weights:
        cut = part.interval
        if place != (cut.piece, cut.low) or cut.length <= 0 or cut.low + cut.length > path.lengths[cut.piece]:
            raise ValueError("intervals that cover the path expected")
        if any(len(row) != d for row in (*part.axes, *part.norm)) or len(part.speeds) != d + 1:
            raise ValueError("a multiplier for each axis expected")
        if min(*part.speeds, *part.rates) < 0:
            raise ValueError("multipliers of at least 0 expected")
        slopes, _ = cut.derivatives(path)
        if not (cut.low == 0 and cut.piece in stops) and part.momentum(slopes, 0) > before:
            raise ValueError("multipliers jump")
        before = part.momentum(slopes, 1)
        total += part.value(bounds)
        end = cut.low + cut.length
        place = (cut.piece + 1, ZERO) if end == path.lengths[cut.piece] else (cut.piece, end)
    if place != (len(path.pieces), ZERO):
        raise ValueError("intervals that cover the path expected")
    return total


def weights(grid: Grid, given: Proposal) -> Iterator[Weights]:
    """Rational multipliers near the proposed ones that keep the conditions of the theorem. Raises ``Unable``."""
    before = ZERO
    for k, cut in enumerate(grid.intervals):
        (a, b), (c, d) = given.axes[k], given.norm[k]
        axes, norm = (_rounded(a), _rounded(b)), (_rounded(c), _rounded(d))
        speeds, (u, v) = tuple(short(float(x), PLACES) for x in given.speeds[k]), given.rates[k]
        slopes, bends = cut.derivatives(grid.path)
        part = Weights(cut, axes, norm, speeds, (Fraction(float(u)), Fraction(float(v))))
        if cut.low or cut.piece not in grid.stops:
            part = _lowered(part, slopes, before)
        before = part.momentum(slopes, 1)
        yield _kept(part, slopes, bends)


def _rounded(values: Any) -> Vector:
    """Without what is nothing next to the largest one."""
    least = NOISE * abs(values).max()
    return tuple(short(float(x), PLACES + 10) if abs(x) > least else ZERO for x in values)


def _lowered(part: Weights, slopes: Row, before: Fraction) -> Weights:
    """With the first multiplier changed by so little that lambda . q' does not jump upwards, where q' jumps."""
    jump = part.momentum(slopes, 0) - before
    if jump <= 0:
        return part
    at = [p(ZERO) for p in slopes]
    i = max(range(len(at)), key=lambda k: abs(at[k]))
    if not at[i]:
        raise Unable("the path stands still where its derivative jumps")
    less = short(jump / at[i] * (1 + Fraction(1, 1 << PLACES)), PLACES + 10)
    if any(map(any, part.axes)):
        return replace(part, axes=(_less(part.axes[0], i, less), part.axes[1]))
    return replace(part, norm=(_less(part.norm[0], i, less), part.norm[1]))


def _less(vector: Vector, i: int, by: Fraction) -> Vector:
    return (*vector[:i], vector[i] - by, *vector[i + 1 :])


def _kept(part: Weights, slopes: Row, bends: Row) -> Weights:
    for share in LESS:
        u, v = (short(x * (1 - share), PLACES) for x in part.rates)
        lower = replace(part, rates=(u, v))
        if is_below(lower.excess(slopes, bends), part.interval.length, 1, ZERO):
            return lower
    raise Unable("the proposed multipliers prove nothing")
