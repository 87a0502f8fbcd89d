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

from bezier.retiming.grid import SMOOTH, Grid
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
    """The best ones between each two stops, or places where q'' jumps; ``speeds``: ds/dt at the nodes of the grid."""
    path, result = grid.path, list[Speeding]()
    size = max(p.degree + 1 for row in path.pieces for p in row)
    table = np.array([[[*p.floats(), *[0.0] * size][:size] for p in row] for row in path.pieces])
    places = np.array([float(path.breaks[cut.piece] + cut.low) for cut in grid.intervals])
    second = np.polynomial.polynomial.polyder(table, 2, axis=2)
    powers = np.array([float(h) for h in path.lengths])[:, None] ** np.arange(second.shape[2])
    ends = np.einsum("kan,kn->ka", second, powers)
    jumps = np.abs(second[1:, :, 0] - ends[:-1]).max(1, initial=0) > SMOOTH * np.abs(ends).max()
    for low, high in pairwise(path.breaks[k] for k in sorted({*grid.stops, *(np.flatnonzero(jumps) + 1).tolist()})):
        inside = (places >= float(low)) & (places < float(high))
        v = np.array([0.0, *speeds[grid.begins[inside][1:]], 0.0])
        t = np.cumsum([0.0, *(2 * np.diff([*places[inside], float(high)]) / (v[1:] + v[:-1]))])
        x = np.linspace(0, 1, FEWEST + 1)
        listed = [(x * (1 - x) * (1 - 2 * x), t[-1] / FEWEST), *(_averaged(t, v, share * t[-1]) for share in WINDOWS)]
        rated = [(h * _slower(path, table, float(low), float(high), a, h, limits), a) for a, h in listed]
        seconds, a = min(rated, key=lambda pair: pair[0] * len(pair[1]))
        result.append((low, high, a, seconds))
    return result


def _averaged(t: Any, v: Any, window: float) -> tuple[Any, float]:
    count = int(np.clip(6 * (t[-1] + window) / window, FEWEST, MOST))
    times = np.linspace(-window / 2, t[-1] + window / 2, count + 1)
    after, before = (np.interp(times + side * window / 2, t, v, 0.0, 0.0) for side in (1, -1))
    return after - before, float(times[1] - times[0])


def _slower(path: Trajectory, table: Any, low: float, high: float, a: Any, h: float, limits: Sequence[Limit]) -> float:
    """By how much slower all limits are kept, as far as differences of samples show; ``table``: of the path."""
    numbers, step = np.arange(len(a)), h / FINE
    s = np.cumsum(np.cumsum(np.interp(np.linspace(0, numbers[-1], FINE * numbers[-1] + 1), numbers, a)))
    breaks, at = np.array([float(b) for b in path.breaks]), low + (high - low) / s[-1] * s
    k = np.clip(np.searchsorted(breaks, at, side="right") - 1, 0, len(table) - 1)
    places, worst = np.einsum("kan,kn->ka", table[k], (at - breaks[k])[:, None] ** np.arange(table.shape[-1])), 0.0
    for limit in (limit for limit in limits if limit.order):
        x = np.diff(places, limit.order, axis=0) / step**limit.order
        size = np.linalg.norm(x, axis=1) if limit.axis is None else np.abs(x[:, limit.axis])
        worst = max(worst, float(size.max() / float(limit.high)) ** (1 / limit.order))
    return worst


def steps_of(low: Fraction, high: Fraction, accelerations: Any, seconds: float, slower: Fraction) -> Iterator[Step]:
    """The exact steps of a ``Speeding``, which lead just to the end and leave no speed there: in whole numbers, of the
    acceleration in units that make the way right."""
    h, count, states = short(seconds * slower), len(accelerations), [(0, 0)]
    a = [round(x * LARGEST / abs(accelerations).max()) for x in accelerations.tolist()]
    for k in range(abs(sum(a))):  # rounding errors, one in each of the middle ones
        a[count // 4 + k % (count // 2)] -= 1 if sum(a) > 0 else -1
    for one, other in pairwise(a):
        v, s = states[-1]
        states.append((v + one + other, s + 3 * v + 2 * one + other))
    unit = (high - low) / states[-1][1]
    for (v, s), (one, other) in zip(states, pairwise(a), strict=False):
        powers = (low / unit + s, 3 * v, 3 * one, other - one)
        yield Step(RationalPoly.of([unit * c / h**k for k, c in enumerate(powers)]), h)
