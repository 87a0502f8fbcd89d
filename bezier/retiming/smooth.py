"""Motions with bounded jerk: the fastest one without that limit, averaged over a window of time.

Where v is the speed of a motion, zero before and after it, the mean of v over a window of w seconds is the speed of one
that goes as far in w seconds more, and its acceleration (v(t + w/2) - v(t - w/2)) / w is continuous. Taken at equal
times, and linear between, that makes s a cubic polynomial of the time on each step. Floating point picks the window
between two stops, or the quintic law, and how much slower the motion has to be; what is kept is decided elsewhere.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np

from bezier.retiming.grid import Grid
from bezier.retiming.law import Step, short
from bezier.trajectories.limits import Limit
from bezier.trajectories.piecewise import Trajectory
from qe.exact.rational_poly import RationalPoly

WINDOWS = np.geomspace(0.01, 4, 40)
"""Of the mean, as parts of the time of the motion."""
FEWEST, MOST, FINE, LARGEST = 48, 128, 8, 2**24
"""Steps between two stops; times in one at which floating point looks; of accelerations in whole numbers."""
Speeding = tuple[Fraction, Fraction, Any, float]
"""From where to where, accelerations at equal times up to a factor, and the time between these."""


def speedings(grid: Grid, speeds: Any, limits: Sequence[Limit]) -> list[Speeding]:
    """The best ones between each two stops; ``speeds``: ds/dt at the nodes of the grid."""
    path, result = grid.path, list[Speeding]()
    size = max(4, *(p.degree + 1 for row in path.pieces for p in row))
    table = np.array([[[*p.floats(), *[0.0] * size][:size] for p in row] for row in path.pieces])
    places = np.array([float(path.breaks[cut.piece] + cut.low) for cut in grid.intervals])
    for low, high in pairwise(path.breaks[k] for k in sorted(grid.stops)):
        inside = (places >= float(low)) & (places < float(high))
        v = np.array([0.0, *speeds[grid.begins[inside][1:]], 0.0])
        t = np.cumsum([0.0, *(2 * np.diff([*places[inside], float(high)]) / (v[1:] + v[:-1]))])
        x = np.linspace(0, 1, FEWEST + 1)
        listed = [(x * (1 - x) * (1 - 2 * x), t[-1] / FEWEST), *(_averaged(t, v, share * t[-1]) for share in WINDOWS)]
        rated = [(h * _slower(path, table, (float(low), float(high)), a, h, limits), a) for a, h in listed]
        seconds, a = min(rated, key=lambda pair: pair[0] * len(pair[1]))
        result.append((low, high, a, seconds))
    return result


def _averaged(t: Any, v: Any, window: float) -> tuple[Any, float]:
    count = int(np.clip(6 * (t[-1] + window) / window, FEWEST, MOST))
    times = np.linspace(-window / 2, t[-1] + window / 2, count + 1)
    after, before = (np.interp(times + side * window / 2, t, v, 0.0, 0.0) for side in (1, -1))
    return after - before, float(times[1] - times[0])


def _slower(
    path: Trajectory, table: Any, ends: tuple[float, float], a: Any, h: float, limits: Sequence[Limit]
) -> float:
    """By how much slower all limits are kept, as far as samples show; ``table``: the coefficients of the path."""
    tau, jerk = np.linspace(0, h, FINE, endpoint=False), np.diff(a)[:, None] / h
    v = np.cumsum([0.0, *(h * (a[1:] + a[:-1]) / 2)])[:-1]
    s = np.cumsum([0.0, *(h * v + h * h * (2 * a[:-1] + a[1:]) / 6)])
    laws = (
        s[:-1, None] + v[:, None] * tau + a[:-1, None] * tau**2 / 2 + jerk * tau**3 / 6,
        v[:, None] + a[:-1, None] * tau + jerk * tau**2 / 2,
        a[:-1, None] + jerk * tau,
        jerk + 0 * tau,
    )
    gone, rate, growth, turn = (((ends[1] - ends[0]) / s[-1] * law).reshape(-1, 1) for law in laws)
    breaks, at = np.array([float(b) for b in path.breaks]), ends[0] + gone[:, 0]
    k = np.clip(np.searchsorted(breaks, at, side="right") - 1, 0, len(table) - 1)
    powers = (at - breaks[k])[:, None] ** np.arange(table.shape[-1])
    slopes = (np.polynomial.polynomial.polyder(table, order, axis=2)[k] for order in (1, 2, 3))
    first, second, third = (np.einsum("kan,kn->ka", p, powers[:, : p.shape[2]]) for p in slopes)
    third = third * rate**3 + 3 * second * rate * growth + first * turn
    moved = (first * rate, second * rate**2 + first * growth, third)
    worst = 0.0
    for limit in limits:
        for x in moved[limit.order - 1 : limit.order]:
            size = np.linalg.norm(x, axis=1) if limit.axis is None else np.abs(x[:, limit.axis])
            worst = max(worst, float(size.max() / float(limit.high)) ** (1 / limit.order))
    return worst


def smooth(speeding: Sequence[Speeding], slower: Fraction) -> tuple[Step, ...]:
    """The exact motion: it leads just to the end, and leaves no speed there."""
    return tuple(step for part in speeding for step in _steps(*part, slower))


def _steps(low: Fraction, high: Fraction, accelerations: Any, seconds: float, slower: Fraction) -> Iterator[Step]:
    """In whole numbers: of the acceleration in units that make the way right."""
    h, count = short(seconds * slower), len(accelerations)
    a = [round(x * LARGEST / abs(accelerations).max()) for x in accelerations.tolist()]
    for k in range(abs(sum(a))):  # rounding errors, one in each of the middle ones
        a[count // 4 + k % (count // 2)] -= 1 if sum(a) > 0 else -1
    v = s = 0
    for one, other in pairwise(a):
        v, s = v + one + other, s + 3 * v + 2 * one + other
    unit, s, v = (high - low) / s, 0, 0
    for one, other in pairwise(a):
        powers = (low / unit + s, 3 * v, 3 * one, other - one)
        yield Step(RationalPoly.of([unit * c / h**k for k, c in enumerate(powers)]), h)
        v, s = v + one + other, s + 3 * v + 2 * one + other
