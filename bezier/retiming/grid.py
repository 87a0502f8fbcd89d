"""A path q(s) cut into intervals, its derivatives there, and the places where every motion along it has to stop."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from math import comb
from typing import Any

import numpy as np

from bezier.trajectories.limits import Limit
from bezier.trajectories.piecewise import Row, Trajectory
from qe.errors import InputError, Unable
from qe.exact.rational_poly import RationalPoly

SMOOTH = 1e-9
"""The share of q' by which it may jump where the path counts as smooth: joins of floats."""
HALVINGS = 10
"""Of the first interval beside a stop."""
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
    def of(limits: Sequence[Limit]) -> Bounds:
        """Raises ``InputError`` for jerk, and where nothing limits the acceleration."""
        if any(limit.order > 2 for limit in limits):
            raise InputError("retime: expected limits of velocity and acceleration, found one of jerk")
        axes = [tuple(x.high for x in limits if (x.order, x.axis is None) == (k, False)) or None for k in (1, 2)]
        norms = [next((x.high for x in limits if (x.order, x.axis) == (k, None)), None) for k in (1, 2)]
        if axes[1] is None and norms[1] is None:
            raise InputError("retime: expected a limit acceleration or acceleration_norm, found neither")
        return Bounds(axes[0], norms[0], axes[1], norms[1])


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


def corners(path: Trajectory) -> frozenset[int]:
    """The breaks at which a motion stops: both ends, and where the direction jumps. Raises ``InputError`` where the
    path jumps, stands still, or changes the speed of its parameter."""
    result = {0, len(path.pieces)}
    slopes = path.derivative(1)
    if any(all(p.degree < 0 for p in row) for row in slopes):
        raise InputError("path: expected one that moves everywhere, found a piece that is one point")
    for k, (before, after) in enumerate(pairwise(slopes)):
        h = path.lengths[k]
        size = max(float(abs(p(h) - q(Fraction(0)))) for p, q in zip(path.pieces[k], path.pieces[k + 1], strict=True))
        if size > SMOOTH * max(1.0, max(float(abs(p(h))) for p in path.pieces[k])):
            raise InputError(f"path: expected a continuous one, found a jump at {float(path.breaks[k + 1]):.10g}")
        a = np.array([float(p(h)) for p in before])
        b = np.array([float(p(Fraction(0))) for p in after])
        long, other = np.linalg.norm(a), np.linalg.norm(b)
        if np.linalg.norm(a - b) <= SMOOTH * max(long, other):
            continue
        if not (long and other) or np.linalg.norm(a / long - b / other) <= SMOOTH:
            place = f"at {float(path.breaks[k + 1]):.10g}"
            raise InputError(f"path: expected one smooth parameter, found a jump of its speed {place}")
        result.add(k + 1)
    return frozenset(result)


@dataclass(frozen=True)
class Grid:
    """The path as intervals, one after the other; ``stops``: breaks of the path."""

    path: Trajectory
    stops: frozenset[int]
    intervals: tuple[Interval, ...]

    @staticmethod
    def of(path: Trajectory) -> Grid:
        """The first grid: equal parts, and halves of halves beside stops, where the speed is like a square root."""
        stops, listed = corners(path), list[Interval]()
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
    def places(self) -> Any:
        """The parameters of the nodes, in floats."""
        begins = [float(self.path.breaks[cut.piece] + cut.low) for cut in self.intervals]
        return np.array([*begins, float(self.path.breaks[-1])])

    @cached_property
    def stopping(self) -> list[int]:
        """The nodes at which a motion stops: node k is the beginning of interval k, the last one the end."""
        begins = [k for k, cut in enumerate(self.intervals) if cut.low == 0 and cut.piece in self.stops]
        return [*begins, len(self.intervals)]

    @cached_property
    def arrays(self) -> tuple[Any, Any, Any]:
        """In floats: the lengths (K,), and the Bernstein coefficients of q' and q'' on each interval, (K, axes, n)."""
        degree = max(2, *(p.degree for row in self.path.pieces for p in row))
        powers = np.array([[_padded(p, degree) for p in row] for row in self.path.pieces])
        pieces = [cut.piece for cut in self.intervals]
        low, h = (np.array([float(getattr(cut, name)) for cut in self.intervals]) for name in ("low", "length"))
        first = _bernstein(powers[..., 1:] * np.arange(1, degree + 1), pieces, low, h)
        second = _bernstein(powers[..., 2:] * np.arange(1, degree) * np.arange(2, degree + 1), pieces, low, h)
        if not (np.all(np.isfinite(first)) and np.all(np.isfinite(second)) and np.all(h > 0)):
            raise Unable("the path has numbers that floating point cannot hold")
        return h, first, second


def _padded(p: RationalPoly, degree: int) -> list[float]:
    return [*p.floats(), *[0.0] * (degree - max(p.degree, -1))][: degree + 1]


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
