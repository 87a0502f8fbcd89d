"""A path q(s) cut into intervals, its derivatives there, and the places where every motion along it has to stop."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import accumulate, pairwise
from math import comb, hypot
from typing import Any

import numpy as np

from bezier.curves import bernstein as bs
from bezier.trajectories.limits import Limit
from bezier.trajectories.piecewise import Row, Trajectory
from qe.errors import InputError, Unable
from qe.exact.rational_poly import RationalPoly

ZERO = Fraction(0)
SMOOTH = 1e-9
"""The share of q' by which it may jump where the path counts as smooth: joins of floats."""
HALVINGS = 10
"""Of the first interval beside a stop."""
NEAR, BITS = 2**20, 80
"""How near to a zero of q' its direction is looked at, as a part of the piece; how exact such a zero is."""
FEWEST, FIRST = 4, 56
"""Equal parts of each piece, and of all pieces together, of the first grid."""


@dataclass(frozen=True, slots=True)
class Bounds:
    """|q_i'| <= ``velocity[i]`` and the same of the acceleration over time, and of the Euclidean norms; None: no such
    limit."""

    velocity: tuple[Fraction, ...] | None
    velocity_norm: Fraction | None
    acceleration: tuple[Fraction, ...] | None
    acceleration_norm: Fraction | None

    @staticmethod
    def of(limits: Sequence[Limit], axes: int) -> Bounds:
        """Raises ``InputError`` for limits of some of the axes, and where nothing limits the acceleration. Those of
        jerk are left aside."""
        for order in (1, 2):
            named = [x.axis for x in limits if x.order == order and x.axis is not None]
            if named and named != [*range(axes)]:
                raise InputError(f"retime: expected a limit for each of {axes} axes, found those of the axes {named}")
        each = [tuple(x.high for x in limits if x.order == k and x.axis is not None) or None for k in (1, 2)]
        norms = [next((x.high for x in limits if (x.order, x.axis) == (k, None)), None) for k in (1, 2)]
        if each[1] is None and norms[1] is None:
            raise InputError("retime: expected a limit acceleration or acceleration_norm, found neither")
        return Bounds(each[0], norms[0], each[1], norms[1])


@dataclass(frozen=True, slots=True)
class Interval:
    """The part of a piece of the path from ``low``, counted from its beginning, that is ``length`` long."""

    piece: int
    low: Fraction
    length: Fraction

    def derivatives(self, path: Trajectory) -> tuple[Row, Row]:
        """q' and q'', by the parameter since the beginning of the interval."""
        inner = RationalPoly.of([self.low, 1])
        first = tuple(p.derivative().compose(inner) for p in path.pieces[self.piece])
        return first, tuple(p.derivative() for p in first)


@dataclass(frozen=True, slots=True)
class Stop:
    """A break of the path at which every motion rests: an end, a jump of the direction, or (``by_choice``) q' = 0
    though the direction goes on. ``before``, ``after``: whether q' is not zero on that side, so that ds/dt has to be.
    """

    before: bool
    after: bool
    by_choice: bool = False


def even(path: Trajectory) -> Trajectory:
    """The same places by a parameter whose speed does not jump where the direction goes on, with breaks where it is 0
    inside of pieces and the direction goes on. Raises ``InputError`` for a piece that is one point."""
    zeros = []
    for start, row, h in zip(path.breaks, path.derivative(1), path.lengths, strict=False):
        for zero in _zeros(row, h):
            before, after = (_Direction.of(row, zero, side * h, 0.0).unit for side in (-1, 1))
            zeros += [start + zero] if before @ after > 0 else []
    path = path.cut(zeros) if zeros else path
    slopes, factors = path.derivative(1), [Fraction(1)]
    for row, h, following, (before, after) in zip(slopes, path.lengths, slopes[1:], _joins(path), strict=False):
        ratio, moving = Fraction(1), before.is_moving and after.is_moving
        jump, most = abs(before.speed - after.speed), max(before.speed, after.speed)
        if moving and not after.turns_from(before) and jump > SMOOTH * most:
            i = max(range(len(row)), key=lambda i: abs(row[i](h)))
            ratio = following[i](ZERO) / row[i](h)
        factors.append(Fraction(float(factors[-1] * ratio)))
    if set(factors) == {1}:
        return path
    lengths = (f * h for f, h in zip(factors, path.lengths, strict=True))
    inner = [RationalPoly.of([0, 1 / f]) for f in factors]
    rows = (tuple(p.compose(t) for p in row) for row, t in zip(path.pieces, inner, strict=True))
    return Trajectory(path.names, tuple(accumulate(lengths, initial=path.breaks[0])), tuple(rows))


def _ends(path: Trajectory) -> list[tuple[_Direction, _Direction]]:
    """How each piece begins and ends."""
    result = []
    for row, h in zip(path.derivative(1), path.lengths, strict=True):
        size = max(float(abs(p(at))) for p in row for at in (ZERO, h / 3, h / 2, h))
        result.append((_Direction.of(row, ZERO, h, size), _Direction.of(row, h, -h, size)))
    return result


def _joins(path: Trajectory) -> list[tuple[_Direction, _Direction]]:
    """Both sides of each break inside."""
    return [(before[1], after[0]) for before, after in pairwise(_ends(path))]


def stops_of(path: Trajectory) -> dict[int, Stop]:
    """The stops of an even path, by the numbers of their breaks. Raises ``InputError`` where the path jumps or stands
    still."""
    ends = _ends(path)
    result = {0: Stop(False, ends[0][0].is_moving), len(ends): Stop(ends[-1][1].is_moving, False)}
    for k, (before, after) in enumerate(_joins(path), start=1):
        at, h = f"at {float(path.breaks[k]):.10g}", path.lengths[k - 1]
        places = [(float(p(h)), float(q(ZERO))) for p, q in zip(path.pieces[k - 1], path.pieces[k], strict=True)]
        if any(abs(x - y) > SMOOTH * max(1.0, abs(x)) for x, y in places):
            raise InputError(f"path: expected a continuous one, found a jump {at}")
        turns = after.turns_from(before)
        if turns or not (before.is_moving and after.is_moving):
            result[k] = Stop(before.is_moving, after.is_moving, not turns)
    return result


@dataclass(frozen=True)
class _Direction:
    """q' at a place: its size, its direction (where it is 0, that of the places next to it)."""

    speed: float
    is_moving: bool
    unit: Any

    def turns_from(self, other: _Direction) -> bool:
        """Whether the direction jumps."""
        return float(np.linalg.norm(other.unit - self.unit)) > SMOOTH

    @staticmethod
    def of(row: Row, at: Fraction, inwards: Fraction, size: float) -> _Direction:
        """``inwards``: towards the other end of the piece; ``size``: of q' on the piece."""
        value = np.array([float(p(at)) for p in row])
        speed = hypot(*value)
        is_moving = speed > SMOOTH * size
        if not is_moving or not size:
            near = [p(at + inwards / NEAR) for p in row]
            largest = max(map(abs, near))
            if not largest:
                raise InputError("path: expected one that moves everywhere, found a piece that is one point")
            value = np.array([float(x / largest) for x in near])
        return _Direction(speed, is_moving, value / hypot(*value))


def _zeros(row: Row, h: Fraction) -> list[Fraction]:
    """Numbers next to the places inside at which all derivatives are 0."""
    for p in row:
        signs = {(c > 0) - (c < 0) for c in bs.from_power([c * h**k for k, c in enumerate(p.coefficients())])}
        if signs in ({1}, {-1}):
            return []
    total = sum((p * p for p in row), RationalPoly.of([]))
    return [sum(root.interval(BITS), ZERO) / 2 for root in total.roots(ZERO, h)]


@dataclass(frozen=True)
class Grid:
    """The path as intervals, one after the other."""

    path: Trajectory
    stops: Mapping[int, Stop]
    intervals: tuple[Interval, ...]

    @staticmethod
    def of(path: Trajectory) -> Grid:
        """The first grid: equal parts, and halves of halves beside stops, where the speed is like a square root."""
        stops, listed = stops_of(path), list[Interval]()
        count = max(FEWEST, -(-FIRST // len(path.pieces)))
        for k, length in enumerate(path.lengths):
            shares = {Fraction(j, count) for j in range(count + 1)}
            shares |= {Fraction(1, count << j) for j in range(1, HALVINGS)} if k in stops else set()
            shares |= {1 - Fraction(1, count << j) for j in range(1, HALVINGS)} if k + 1 in stops else set()
            ends = sorted(shares)
            listed += [Interval(k, a * length, (b - a) * length) for a, b in pairwise(ends)]
        return Grid(path, stops, tuple(listed))

    def refined(self, parts: Sequence[int]) -> Grid:
        """With each interval in so many equal parts."""
        listed = list[Interval]()
        for cut, count in zip(self.intervals, parts, strict=True):
            length = cut.length / count
            listed += [Interval(cut.piece, cut.low + j * length, length) for j in range(count)]
        return Grid(self.path, self.stops, tuple(listed))

    @cached_property
    def begins(self) -> Any:
        """The number of the node at the beginning of each interval; its end is the next one. A stop inside the path is
        two nodes, one for each side."""
        fresh = [k > 0 and cut.low == 0 and cut.piece in self.stops for k, cut in enumerate(self.intervals)]
        return np.arange(len(fresh)) + np.cumsum(fresh)

    @property
    def nodes(self) -> int:
        """How many there are."""
        return int(self.begins[-1]) + 2

    @cached_property
    def resting(self) -> list[int]:
        """The nodes at which ds/dt is 0."""
        listed = []
        for cut, node in zip(self.intervals, self.begins.tolist(), strict=True):
            if cut.low == 0 and cut.piece in self.stops and self.stops[cut.piece].after:
                listed.append(node)
            if (stop := self.stops.get(cut.piece + 1)) and stop.before and self.is_last(cut):
                listed.append(node + 1)
        return listed

    def is_last(self, cut: Interval) -> bool:
        """Whether it ends its piece."""
        return cut.low + cut.length == self.path.lengths[cut.piece]

    @cached_property
    def arrays(self) -> tuple[Any, Any, Any]:
        """In floats: the lengths (K,), and the Bernstein coefficients of q' and q'' on each interval, (K, axes, n)."""
        degree = max(2, *(p.degree for row in self.path.pieces for p in row))
        zeros = [0.0] * (degree + 1)
        powers = np.array([[[*p.floats(), *zeros][: degree + 1] for p in row] for row in self.path.pieces])
        pieces = [cut.piece for cut in self.intervals]
        low, h = (np.array([float(getattr(cut, name)) for cut in self.intervals]) for name in ("low", "length"))
        first = _bernstein(powers[..., 1:] * np.arange(1, degree + 1), pieces, low, h)
        second = _bernstein(powers[..., 2:] * np.arange(1, degree) * np.arange(2, degree + 1), pieces, low, h)
        if not (np.all(np.isfinite(first)) and np.all(np.isfinite(second)) and np.all(h > 0)):
            raise Unable("the path has numbers that floating point cannot hold")
        return h, first, second


def _bernstein(powers: Any, pieces: list[int], low: Any, h: Any) -> Any:
    """The coefficients on the intervals of polynomials that are given by powers (pieces, axes, n + 1)."""
    n = powers.shape[-1] - 1
    chosen = powers[pieces]
    with np.errstate(all="ignore"):
        moved = [
            h[:, None] ** j * sum(comb(k, j) * chosen[..., k] * low[:, None] ** (k - j) for k in range(j, n + 1))
            for j in range(n + 1)
        ]
    weights = np.array([[comb(i, k) / comb(n, k) for k in range(n + 1)] for i in range(n + 1)])
    return np.stack(moved, axis=-1) @ weights.T
