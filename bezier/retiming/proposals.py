"""What floating point proposes (clarabel, extra ``squares``): speeds at the nodes of a grid, and the multipliers of the
bound from below. Nothing of it is believed.

With b = (ds/dt)^2 the limits are linear in b and b' (or cones), and the time, the integral of b^(-1/2), is convex
(Verscheure et al., "Time-optimal path tracking for robots: a convex optimization approach", IEEE TAC 2009). Here b is
linear on each interval, and limits are asked of Bernstein coefficients, so that they hold between the nodes, too. The
second problem is the dual one of ``bezier.retiming.bound``. Its last condition u^3 <= 2 S is two cones: u^2 <= z and
z^2 <= 2 S u.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import comb
from typing import Any

from bezier.conic import Conic
from bezier.retiming.grid import Bounds, Grid
from qe.errors import Unable
from qe.extras import wanted

with wanted():
    import numpy as np

TOLERANCE = 1e-9
LARGEST = 1e6
"""Of (ds/dt)^2, in proportion to what is usual: it has no limit where q' and q'' are 0."""
START, END = np.array([1.0, 0.0]), np.array([0.0, 1.0])
"""Bernstein coefficients of what is 1 at one end of an interval and 0 at the other."""


@dataclass(frozen=True, slots=True)
class Proposal:
    """``squares``: (ds/dt)^2 at the nodes. Of the bound: ``axes`` and ``norm`` (K, 2, d), the multipliers of the
    accelerations at both ends of each interval; ``speeds`` (K, d + 1), of the velocities and their norm; ``rates``
    (K, 2), u at both ends. ``gaps`` (K,): what each interval adds to ``duration`` - ``bound``."""

    squares: Any
    axes: Any
    norm: Any
    speeds: Any
    rates: Any
    gaps: Any
    duration: float
    bound: float


def proposal(grid: Grid, bounds: Bounds) -> Proposal:
    """Speeds and multipliers. Computed for a path of length 1 that takes about 1."""
    h, first, second = grid.arrays
    span = float(h.sum())
    moved = np.abs(first).mean(-1) * h[:, None]
    unit = _usual_time(moved.sum(0), bounds)
    scaled = h / span, first * span, second * span**2
    rate = (span / unit) ** 2
    squares = _fastest(grid, scaled, bounds, unit)
    axes, norm, speeds, rates = _multipliers(grid, scaled, bounds, unit, squares)
    times = _durations(grid, scaled[0], squares)
    gaps, bound = _gaps(grid, scaled, bounds, unit, squares, times, (axes, norm, speeds, rates))
    back = unit**3 / span
    return Proposal(
        squares * rate,
        axes * back,
        norm * back,
        speeds * back,
        rates * (unit / span),
        gaps * unit,
        times.sum() * unit,
        bound * unit,
    )


def _solved(program: Conic) -> Any:
    values = program.solved()
    if values is None:
        raise Unable("clarabel proposes nothing for this path and these limits")
    return np.array(values)


def _durations(grid: Grid, h: Any, squares: Any) -> Any:
    roots = np.sqrt(squares)
    return 2 * h / (roots[grid.begins] + roots[grid.begins + 1])


def _shares(grid: Grid, h: Any) -> Any:
    """Half of the lengths of the intervals that meet at each node."""
    result = np.zeros(grid.nodes)
    for j in (0, 1):
        np.add.at(result, grid.begins + j, h / 2)
    return result


def _usual_time(moved: Any, bounds: Bounds) -> float:
    """Roughly how long it takes."""
    listed = [2 * np.sqrt(np.linalg.norm(moved) / float(bounds.acceleration_norm or np.inf))]
    listed += [2 * np.sqrt(x / float(a)) for x, a in zip(moved, bounds.acceleration or (), strict=False)]
    listed += [x / float(v) for x, v in zip(moved, bounds.velocity or (), strict=False)]
    return float(max(*listed, np.linalg.norm(moved) / float(bounds.velocity_norm or np.inf)))


def _times(a: Any, b: Any) -> Any:
    """The product in Bernstein form, along the last axis."""
    m, n = a.shape[-1] - 1, b.shape[-1] - 1
    result = np.zeros((*np.broadcast_shapes(a.shape[:-1], b.shape[:-1]), m + n + 1))
    for i in range(m + 1):
        for j in range(n + 1):
            result[..., i + j] += comb(m, i) * comb(n, j) / comb(m + n, i + j) * a[..., i] * b[..., j]
    return result


def _raised(a: Any, degree: int) -> Any:
    return _times(a, np.ones(degree - a.shape[-1] + 2)) if degree > a.shape[-1] - 1 else a


def _numbers(values: Sequence[Any]) -> Any:
    return np.array([float(x) for x in values])


def _fastest(grid: Grid, arrays: tuple[Any, Any, Any], bounds: Bounds, unit: float) -> Any:
    """(ds/dt)^2 at the nodes. What is maximised is their sum: where each condition joins neighbours with different
    signs, the largest values at all nodes are reached together (as in Pham, Pham, "TOPP-RA", IEEE T-RO 2018)."""
    h, first, second = arrays
    nodes, begins = grid.nodes, grid.begins
    weights = _shares(grid, h)
    program = Conic(TOLERANCE)
    every = program.variables((nodes,), -weights / weights.max())
    pair = begins[:, None, None], begins[:, None, None] + 1
    slope = first / (2 * h[:, None, None])
    ends = _times(second, START) - slope, _times(second, END) + slope  # acceleration: the factors of b at both ends
    if bounds.acceleration is not None:
        highest = (_numbers(bounds.acceleration) * unit**2)[:, None]
        for sign in (1, -1):
            program.block([(at, sign * end / highest) for at, end in zip(pair, ends, strict=True)], 1.0)
    speeds = []
    if bounds.velocity is not None:
        speeds.append(_times(first, first) / (_numbers(bounds.velocity)[:, None] * unit) ** 2)
    if bounds.velocity_norm is not None:
        speeds.append(_times(first, first).sum(1, keepdims=True) / (float(bounds.velocity_norm) * unit) ** 2)
    for square in speeds:
        program.block([(at, _times(square, share)) for at, share in zip(pair, (START, END), strict=True)], 1.0)
    if bounds.acceleration_norm is not None:
        most = float(bounds.acceleration_norm) * unit**2
        rows = [np.insert(end.transpose(0, 2, 1) / most, 0, 0.0, axis=2) for end in ends]
        right = np.zeros(rows[0].shape)
        right[..., 0] = 1.0
        program.block([(at, row) for at, row in zip(pair, rows, strict=True)], right, right.shape[-1])
    program.block([(every, 1 / LARGEST)], np.ones(nodes))
    program.block([(every, -1.0)], np.zeros(nodes))
    if grid.resting:
        program.block([(every[grid.resting], 1.0)], np.zeros(len(grid.resting)), -1)
    result = np.maximum(_solved(program), 1e-12)
    result[grid.resting] = 0.0
    return result


def _multipliers(
    grid: Grid, arrays: tuple[Any, Any, Any], bounds: Bounds, unit: float, squares: Any
) -> tuple[Any, Any, Any, Any]:
    """The dual problem; variables are scaled so that each counts in seconds."""
    h, first, second = arrays
    count, d = first.shape[:2]
    nodes, begins, weight = grid.nodes, grid.begins, _shares(grid, h)
    usual = _durations(grid, h, squares) / h
    degree = max(4, 2 * (first.shape[-1] - 1))
    slope = first / h[:, None, None]
    ends = [_raised(_times(second, START) + slope, degree) / 2, _raised(_times(second, END) - slope, degree) / 2]
    square = _raised(_times(first, first), degree)
    program, entries, solved = Conic(TOLERANCE), list[tuple[Any, Any]](), list[Any]()

    def force(size: Any, sign: int, cost: float) -> Any:
        """Multipliers of accelerations (nodes, d), each in units of ``size``."""
        at = program.variables((nodes, d), cost)
        for j in (0, 1):
            scale = sign / (weight[begins + j][:, None] * size)
            entries.extend((at[begins + j, i][:, None], ends[j][:, i] * scale[:, i, None]) for i in range(d))
        return at

    def speed(part: Any, high: Any) -> Any:
        """Multipliers of velocities, (K,), of a square in Bernstein form."""
        at, price = program.variables((count,), 1.0), (float(high) * unit) ** 2 * h[:, None]
        entries.append((at[:, None], part / price))
        solved.append((at, price[:, 0]))
        return at

    signed = []
    if bounds.acceleration is not None:
        high = _numbers(bounds.acceleration) * unit**2
        signed += [force(high, 1, 1.0), force(high, -1, 1.0)]
    norm = float(bounds.acceleration_norm or 0) * unit**2
    vectors = force(np.full(d, norm), 1, 0.0) if norm else None
    speeds = [speed(square[:, i], v) for i, v in enumerate(bounds.velocity or ())]
    total = [speed(square.sum(1), bounds.velocity_norm)] if bounds.velocity_norm else []
    low, middle = program.variables((count, 2)), program.variables((count, 2))
    rate = program.variables((count, 2), -0.75 * (h * usual)[:, None])
    shares = np.arange(degree + 1) / degree
    scaled = [(columns, -values / (usual**3 / 2)[:, None]) for columns, values in entries]
    ramps = [(low[:, :1], 1 - shares), (low[:, 1:], shares)]
    program.block([*scaled, *ramps], np.zeros((count, degree + 1)))
    for at in (*signed, *speeds, *total):
        program.block([(at, -1.0)], np.zeros(at.shape))
    if vectors is not None:
        rows = np.concatenate([program.variables((nodes, 1), 1.0), vectors], axis=1)
        program.block([(rows, -1.0)], np.zeros(rows.shape), d + 1)
    program.product(middle.ravel(), None, rate.ravel())
    program.product(low.ravel(), rate.ravel(), middle.ravel())
    x = _solved(program)

    def both_ends(values: Any, high: Any) -> Any:
        forces = values / (weight[:, None] * high)
        return np.stack([forces[begins], forces[begins + 1]], axis=1)

    axes = both_ends(x[signed[0]] - x[signed[1]], high) if signed else np.zeros((count, 2, d))
    vector = np.zeros((count, 2, d)) if vectors is None else both_ends(x[vectors], norm)
    velocities = np.zeros((count, d + 1))
    for i, (at, price) in enumerate(solved, start=0 if speeds else d):
        velocities[:, i] = np.maximum(x[at] / price, 0)
    return axes, vector, velocities, np.maximum(x[rate] * usual[:, None], 0)


def _gaps(
    grid: Grid,
    arrays: tuple[Any, Any, Any],
    bounds: Bounds,
    unit: float,
    squares: Any,
    times: Any,
    given: tuple[Any, ...],
) -> tuple[Any, float]:
    """What each interval adds to the gap between both sides, and the bound. No part is negative."""
    h, first, _ = arrays
    axes, norm, speeds, rates = given
    force = (np.abs(axes) @ (_numbers(bounds.acceleration or [0] * first.shape[1]) * unit**2)).sum(1) * h / 2
    force += np.linalg.norm(norm, axis=2).sum(1) * float(bounds.acceleration_norm or 0) * unit**2 * h / 2
    highs = [*(bounds.velocity or [0] * first.shape[1]), bounds.velocity_norm or 0]
    cost = force + speeds @ (_numbers(highs) * unit) ** 2 * h
    value = 0.75 * h * rates.sum(1) - cost
    impulses = [((axes + norm)[:, j] * first[:, :, -j]).sum(1) * squares[grid.begins + j] / 2 for j in (0, 1)]
    return times - value - impulses[1] + impulses[0], float(value.sum())
