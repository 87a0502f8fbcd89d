"""Whether a trajectory keeps its limits at all times, by how much not, and the least slowing down that repairs it.

A limit is about one derivative p of one axis, or about the sum of the squares of all axes: sup p <= L. The supremum
on a piece is at an end or at a root of p'. Which pieces may hold it is told by the Bernstein coefficients (a
polynomial on an interval lies between the least and the largest; Farouki, CAGD 2012, section 3), computed in floats
with the bound of their rounding error; what is left is exact.

Slowed down by k, velocity is 1/k, acceleration 1/k^2, jerk 1/k^3 of what it was; positions stay.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cached_property, partial
from math import ceil, comb
from typing import Any

import numpy as np

from bezier.curves import bernstein as bs
from bezier.curves.nonnegative import Negative, decide
from bezier.curves.scalar import described
from bezier.trajectories.piecewise import QUANTITIES, Jump, Trajectory
from qe.exact.algebraic import RealAlgebraic
from qe.exact.number import whole_root
from qe.exact.rational_poly import RationalPoly

BITS = 128
"""Accuracy of the values at irrational times."""
TICK = 10**7
"""A factor of slowing down is rounded up to a multiple of 1/TICK."""
ZERO = Fraction(0)


@dataclass(frozen=True, slots=True)
class Limit:
    """|p| <= high for a derivative of an axis; low <= p <= high for a position. Without an axis: the Euclidean norm."""

    order: int
    axis: int | None
    high: Fraction
    low: Fraction | None = None

    def words(self, names: Sequence[str]) -> str:
        """What is limited."""
        return QUANTITIES[self.order] + (" (norm)" if self.axis is None else f" of {names[self.axis]}")

    @property
    def power(self) -> int:
        """Of the limit, in what is compared: norms are compared by their squares."""
        return 2 if self.axis is None else 1

    @property
    def sides(self) -> tuple[tuple[int, Fraction], ...]:
        """(sign, bound): sign * p <= bound."""
        if self.axis is None:
            return ((1, self.high**2),)
        return ((1, self.high), (-1, self.high if self.low is None else -self.low))


@dataclass(frozen=True, slots=True)
class Peak:
    """Where sign * p is largest: at the time ``breaks[piece] + at``; the largest value lies in ``value``."""

    piece: int
    sign: int
    at: RealAlgebraic
    value: tuple[Fraction, Fraction]


@dataclass(frozen=True, slots=True)
class Outcome:
    """Of one limit: kept at all times or not, decided exactly, and the peak; for a norm its value is the square."""

    limit: Limit
    peak: Peak
    is_kept: bool

    def time(self, trajectory: Trajectory) -> RealAlgebraic:
        """The exact time of the peak."""
        start = trajectory.breaks[self.peak.piece]
        value: RealAlgebraic = self.peak.at + start
        return value

    @property
    def value(self) -> float:
        """The signed value of p at the peak, or the norm."""
        middle = float(sum(self.peak.value) / 2)
        return middle**0.5 if self.limit.axis is None else self.peak.sign * middle

    @property
    def bound(self) -> Fraction:
        """What sign * p has to stay below."""
        return dict(self.limit.sides)[self.peak.sign]

    @property
    def excess(self) -> float:
        """How far beyond its limit, as a part of it; for positions in their unit."""
        bound = float(self.limit.high) if self.limit.axis is None else float(self.bound)
        beyond = (self.value if self.limit.axis is None else self.peak.sign * self.value) - bound
        return beyond / bound if self.limit.order and bound else beyond

    @property
    def factor(self) -> Fraction | None:
        """A factor of slowing down that repairs this limit, at most 2/TICK above the least; None where none does."""
        if self.is_kept:
            return Fraction(1)
        if not self.limit.order or not self.bound:
            return None
        ratio, power = self.peak.value[1] / self.bound, self.limit.order * self.limit.power
        return max(Fraction(1), Fraction(1 + whole_root(ceil(ratio * TICK**power) - 1, power), TICK))


@dataclass(frozen=True)
class Verdict:
    """All limits of a trajectory, and the jumps by which its derivatives are not continuous."""

    trajectory: Trajectory
    outcomes: tuple[Outcome, ...]
    jumps: tuple[Jump, ...]
    tolerance: Fraction

    @property
    def breaking(self) -> tuple[Jump, ...]:
        """Jumps above the tolerance of what has to be continuous: positions, and all below a limited derivative."""
        highest = max((o.limit.order for o in self.outcomes), default=0)
        return tuple(j for j in self.jumps if j.order < max(highest, 1) and j.size > self.tolerance)

    @property
    def is_kept(self) -> bool:
        """Whether everything holds at all times."""
        return not self.breaking and all(o.is_kept for o in self.outcomes)

    @cached_property
    def worst(self) -> Outcome | None:
        """The limit that is broken most."""
        broken = [o for o in self.outcomes if not o.is_kept]
        return max(broken, key=lambda o: (o.factor is None, o.excess), default=None)

    @cached_property
    def factor(self) -> Fraction | None:
        """A proved factor of slowing down that repairs all, within 1e-6 of the least; None where slower is no help."""
        factors = [o.factor for o in self.outcomes]
        if self.breaking or None in factors:
            return None
        return max((f for f in factors if f is not None), default=Fraction(1))


def decided(trajectory: Trajectory, limits: Sequence[Limit], tolerance: Fraction) -> Verdict:
    """Everything about these limits, exactly."""
    rows, jumps = trajectory.pieces, list[Jump | None]()
    for order in range(max(1, *(limit.order for limit in limits)) if limits else 1):
        rows = tuple(tuple(p.derivative() for p in row) for row in rows) if order else rows
        jumps.append(trajectory.jump(order, rows))
    axes = {axis for limit in limits if (axis := limit.axis) is not None}
    tables: dict[int | None, Any] = {axis: _floats([row[axis] for row in trajectory.pieces]) for axis in axes}
    outcomes = tuple(_outcome(limit, trajectory, tables.get(limit.axis)) for limit in limits)
    return Verdict(trajectory, outcomes, tuple(j for j in jumps if j), tolerance)


def limited(trajectory: Trajectory, limit: Limit, piece: int) -> RationalPoly:
    """What a limit compares on a piece: a derivative of its axis, or the sum of the squares of all axes."""
    row = trajectory.pieces[piece] if limit.axis is None else (trajectory.pieces[piece][limit.axis],)
    for _ in range(limit.order):
        row = tuple(p.derivative() for p in row)
    return row[0] if limit.axis is not None else sum((p * p for p in row), RationalPoly.of([]))


def _outcome(limit: Limit, trajectory: Trajectory, axis: Any) -> Outcome:
    """``axis``: the coefficients of its axis in floats, where it has one."""
    lengths, poly = trajectory.lengths, cache(partial(limited, trajectory, limit))
    if axis is None:
        table = _floats([poly(i) for i in range(len(lengths))])
    else:
        table = np.polynomial.polynomial.polyder(axis, limit.order, axis=1)
    low, high = _ranges(table, lengths)
    peaks, kept = list[Peak](), True
    for sign, bound in limit.sides:
        tops = high if sign > 0 else -low
        peak = _peak(sign, tops, poly, lengths)
        peaks.append(peak)
        if peak.value[0] > bound:
            kept = False
        elif peak.value[1] > bound:  # so close that only an exact decision tells
            near = [i for i, top in enumerate(tops.tolist()) if not top < bound]
            kept = kept and all(is_below(poly(i), lengths[i], sign, bound) for i in near)
    over = [p.value[0] - bound for p, (_, bound) in zip(peaks, limit.sides, strict=True)]
    return Outcome(limit, peaks[over.index(max(over))], kept)


def is_below(p: RationalPoly, length: Fraction, sign: int, bound: Fraction) -> bool:
    """Whether sign * p <= bound on [0, length]."""
    scaled = [-sign * c * length**k for k, c in enumerate(p.coefficients())] or [ZERO]
    scaled[0] += bound
    return not isinstance(decide(bs.from_power(scaled)), Negative)


def _floats(polys: Sequence[RationalPoly]) -> Any:
    """Their coefficients, the constant ones first, (n, degree + 1)."""
    listed = [p.floats() for p in polys]
    table = np.zeros((len(listed), max(1, *map(len, listed))))
    for row, values in zip(table, listed, strict=True):
        row[: len(values)] = values
    return table


def _ranges(table: Any, lengths: Sequence[Fraction]) -> tuple[Any, Any]:
    """Numbers below and above each polynomial, given by its coefficients, on its interval.

    A coefficient c_k h^k has a relative error of at most (k + 4) u in floats, u = 2^-53; a Bernstein coefficient of a
    polynomial of degree n is a sum of n + 1 of them with weights in [0, 1] (Higham, "Accuracy and Stability of
    Numerical Algorithms", section 3.1). Beyond usual sizes nothing is said.
    """
    degree = table.shape[1] - 1
    h = np.array([float(length) for length in lengths])
    weights = np.array([[comb(i, k) / comb(degree, k) for k in range(degree + 1)] for i in range(degree + 1)])
    with np.errstate(all="ignore"):
        scaled = table * h[:, None] ** np.arange(degree + 1)
        values = scaled @ weights.T
        size = np.abs(scaled).sum(axis=1)
        error = size * (4 * degree + 20) * 2.0**-53 + 1e-200
        usual = (h < 1e6) & (h > 1e-6) & np.isfinite(size) & (size < 1e100) & (degree <= 15)
        return np.where(usual, values.min(axis=1) - error, -np.inf), np.where(usual, values.max(axis=1) + error, np.inf)


def _peak(sign: int, tops: Any, poly: Callable[[int], RationalPoly], lengths: Sequence[Fraction]) -> Peak:
    """Where sign * p may be largest. Pieces in the order of what they may reach, until the rest cannot reach it."""
    best: Peak | None = None
    for i in np.argsort(-tops, kind="stable").tolist():
        if best is not None and tops[i] < best.value[0]:
            break
        for at, value in _extremes(poly(i), lengths[i], sign):
            if best is None or value[1] > best.value[1]:
                best = Peak(i, sign, at, value)
    assert best is not None
    return best


def _extremes(
    p: RationalPoly, length: Fraction, sign: int
) -> Iterator[tuple[RealAlgebraic, tuple[Fraction, Fraction]]]:
    """The ends and the roots of the derivative, each with an enclosure of sign * p there."""
    for end in (ZERO, length):
        value = sign * p(end)
        yield RealAlgebraic.rational(end), (value, value)
    slope = p.derivative()
    if slope.degree < 1:  # monotone
        return
    signs = {c > 0 for c in bs.from_power([c * length**k for k, c in enumerate(slope.coefficients())]) if c}
    if len(signs) < 2:  # monotone
        return
    steepest = sum(abs(c) * length**k for k, c in enumerate(slope.coefficients()))
    for root in slope.roots(ZERO, length):
        low, high = root.interval(BITS)
        value, error = sign * p((low + high) / 2), steepest * (high - low)
        yield root, (value - error, value + error)


# --- words --------------------------------------------------------------------------------------------------
def to_json(verdict: Verdict) -> dict[str, Any]:
    """Everything about limits, with exact numbers."""
    names, factor = verdict.trajectory.names, verdict.factor
    return {
        "status": "solved",
        "kept": verdict.is_kept,
        "limits": [_stated(o, verdict.trajectory) for o in verdict.outcomes],
        "jumps": [
            {"of": QUANTITIES[j.order], "axis": names[j.axis], "time": described(j.time), "size": described(j.size)}
            for j in verdict.jumps
        ],
        "broken by jumps": bool(verdict.breaking),
        "slower by": None if factor is None else described(factor),
    }


def _stated(outcome: Outcome, trajectory: Trajectory) -> dict[str, Any]:
    limit, time = outcome.limit, outcome.time(trajectory)
    return {
        "of": limit.words(trajectory.names),
        "limit": [str(limit.high)] if limit.low is None else [str(limit.low), str(limit.high)],
        "kept": outcome.is_kept,
        "worst": outcome.value,
        "time": {"exact": str(time), "decimal": f"{float(time):.12g}"},
    }


def in_words(verdict: Verdict) -> list[str]:
    """A line for each limit, and what follows."""
    trajectory, names = verdict.trajectory, verdict.trajectory.names
    span = f"from t = {_decimal(trajectory.breaks[0])} to {_decimal(trajectory.breaks[-1])}"
    count, axes = len(trajectory.pieces), "1 axis" if len(names) == 1 else f"{len(names)} axes"
    lines = [f"{count} piece{'s' * (count > 1)}, {axes}, {span}"]
    for o in verdict.outcomes:
        state = "kept for all t, largest" if o.is_kept else "EXCEEDED, worst"
        lines.append(f"{o.limit.words(names)}: {state} {o.value:.10g} at t = {float(o.time(trajectory)):.10g}")
    for j in verdict.jumps:
        wrong = "NOT CONTINUOUS, a jump" if j in verdict.breaking else "joins with a difference"
        place = f"({names[j.axis]} at t = {_decimal(j.time)})"
        lines.append(f"{QUANTITIES[j.order]}: {wrong} of at most {_decimal(j.size)} {place}")
    if verdict.is_kept:
        return [*lines, "all limits are kept for all t"] if verdict.outcomes else lines
    if worst := verdict.worst:
        when = f"{float(worst.time(trajectory)):.12g}"
        lines.append(f"refuted: {worst.limit.words(names)} is {worst.value:.10g} at t = {when}")
    if verdict.factor is None:
        return [*lines, "going slower does not repair it"]
    return [*lines, f"{verdict.factor} = {_decimal(verdict.factor)} times as slow, all limits are kept for all t"]


def _decimal(value: Fraction) -> str:
    return f"{float(value):.10g}"
