"""Numerical proposals for convex quadratic problems: a primal-dual interior point method in floats.

Nothing computed here is ever believed: the numbers only say which exact system to solve and where its
solution lies; what comes out is proved or discarded. Plain Python on purpose: the problems have at most a
few dozen unknowns, and importing a numerical library costs more than solving them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from qe.errors import Unable
from qe.exact.quadratic_form import Quadratic

STEPS, DAMPED_STEPS, PATIENCE, PROGRESS = 60, 90, 14, 0.9
"""Most steps of the fast and of the robust way; how many in a row may leave the residual above so much of the best."""

CONVERGED, AS_FAR_AS_FLOATS_GO = 1e-8, 1e-14
"""The residual from which the robust way is not tried, and that at which nothing is left to gain."""

DAMPED_CENTRING, DECREASE, SHORTER, SHORTEST = 0.2, 0.01, 0.6, 1e-6
"""The robust way: its centring, the share of the decrease that a step promises and has to give (Armijo), the factor by
which it is shortened until it does, and where that ends."""

SMALLEST_PIVOT, LARGEST_STEP, POSITIVE = 1e-300, 1e300, 1e-40
"""What floats can divide by and move by; the least slack or multiplier. No number of this file decides an answer: a
proposal that is bad costs the exact methods that come after it."""

Row = list[float]


@dataclass(frozen=True, slots=True)
class FloatQuadratic:
    """x^T H x / 2 + b.x + c in floats, with the non-zero entries of H as (i, j, value)."""

    hessian: tuple[tuple[int, int, float], ...]
    gradient: tuple[float, ...]
    constant: float

    def value_and_slope(self, x: Sequence[float]) -> tuple[float, Row]:
        """The value and the gradient at x."""
        slope = [0.0] * len(x)
        for i, j, h in self.hessian:
            slope[i] += h * x[j]
        value = self.constant
        for i, xi in enumerate(x):
            value += xi * (slope[i] / 2 + self.gradient[i])
            slope[i] += self.gradient[i]
        return value, slope


class OutOfFloats(Unable, OverflowError):
    """Numbers that no float holds: those who have another way catch it, for the others the method is unable."""


def to_float(q: Quadratic, scale: float = 1.0) -> FloatQuadratic:
    """The quadratic polynomial times ``scale``, in floats. Raises ``Unable`` for numbers that no float holds."""
    try:
        entries = tuple((i, j, float(h) * scale) for i, row in enumerate(q.hessian) for j, h in enumerate(row) if h)
        return FloatQuadratic(entries, tuple(float(b) * scale for b in q.gradient), float(q.constant) * scale)
    except OverflowError:
        raise OutOfFloats("a number is too large to be proposed to the numerical method") from None


def natural_scale(q: Quadratic) -> float:
    """The reciprocal of the largest coefficient, so that constraints of different units compare."""
    largest = max([abs(b) for b in q.gradient] + [abs(h) for row in q.hessian for h in row] + [0])
    try:
        return 1 / float(largest) if largest else 1.0
    except (OverflowError, ZeroDivisionError):
        raise OutOfFloats("a coefficient is out of the range of the numerical method") from None


@dataclass(frozen=True, slots=True)
class Proposal:
    """A point, multipliers and slacks; ``residual`` is how far the optimality conditions are from holding."""

    point: tuple[float, ...]
    multipliers: tuple[float, ...]
    slacks: tuple[float, ...]
    residual: float


def solve_floats(rows: Sequence[Row], rhs: Sequence[float]) -> Row | None:
    """Gaussian elimination with row pivoting; None when a pivot vanishes."""
    work = [[*row, b] for row, b in zip(rows, rhs, strict=True)]
    n = len(work)
    for k in range(n):
        best = max(range(k, n), key=lambda r: abs(work[r][k]))
        if abs(work[best][k]) < SMALLEST_PIVOT:
            return None
        work[k], work[best] = work[best], work[k]
        lead = work[k]
        for r in range(k + 1, n):
            row = work[r]
            factor = row[k] / lead[k]
            if factor:
                for j in range(k + 1, n + 1):
                    row[j] -= factor * lead[j]
    x = [0.0] * n
    for k in range(n - 1, -1, -1):
        row = work[k]
        x[k] = (row[n] - sum(row[j] * x[j] for j in range(k + 1, n))) / row[k]
    return x


def interior_point(objective: Quadratic, constraints: Sequence[Quadratic], start: Sequence[float]) -> Proposal:
    """Minimise a convex quadratic polynomial subject to convex quadratic polynomials <= 0 (approximately).

    Infeasible-start primal-dual Newton steps (Boyd–Vandenberghe, section 11.7), first with Mehrotra's choice of the
    centring (Mehrotra 1992), which is fast; if that does not converge, again with fixed centring and a line search on
    the residuals, which is robust. Multipliers are those of the constraints as given (unscaled). Coefficients too
    large or too small for floats give a proposal of infinite residual.
    """
    try:
        scales = [natural_scale(g) for g in constraints]
        unit = natural_scale(objective)
        f = to_float(objective, unit)
        g = [to_float(q, s) for q, s in zip(constraints, scales, strict=True)]
    except (OverflowError, ZeroDivisionError):
        nothing = (0.0,) * len(constraints)
        return Proposal(tuple(start), nothing, nothing, math.inf)
    x, dual, slack, residual = _iterate(f, g, start, False)
    if residual > CONVERGED:
        again = _iterate(f, g, start, True)
        if again[-1] < residual:
            x, dual, slack, residual = again
    scaled = tuple(u * s / unit for u, s in zip(dual, scales, strict=True))
    return Proposal(tuple(x), scaled, tuple(s / k for s, k in zip(slack, scales, strict=True)), residual)


def _iterate(
    f: FloatQuadratic, g: Sequence[FloatQuadratic], start: Sequence[float], damped: bool
) -> tuple[Row, Row, Row, float]:
    """(point, multipliers, slacks, residual) of the best iterate."""
    x = list(start)
    values = [q.value_and_slope(x)[0] for q in g]
    slack = [max(1.0, -2 * v) if v > -0.5 else -v for v in values]
    dual = [1.0] * len(g)
    best, stalled = _state(f, g, x, slack, dual)[-1], 0
    kept = (x, dual, slack, best)
    for _ in range(DAMPED_STEPS if damped else STEPS):
        step = _newton_step(f, g, x, slack, dual, damped)
        if step is None:
            break
        x, slack, dual = step
        residual = _state(f, g, x, slack, dual)[-1]
        if residual < PROGRESS * best:
            best, stalled, kept = residual, 0, (x, dual, slack, residual)
        else:
            stalled += 1
        if best < AS_FAR_AS_FLOATS_GO or stalled > PATIENCE:
            break
    return kept


_State = tuple[Row, list[Row], Row, float]


def _state(f: FloatQuadratic, g: Sequence[FloatQuadratic], x: Row, slack: Row, dual: Row) -> _State:
    """(dual residual, constraint gradients, primal residual, a norm of all residuals)."""
    _, residual = f.value_and_slope(x)
    residual = list(residual)
    size = 1.0 + max((abs(r) for r in residual), default=0.0)
    jacobian, primal = [], []
    for q, s, u in zip(g, slack, dual, strict=True):
        value, slope = q.value_and_slope(x)
        jacobian.append(slope)
        primal.append(value + s)
        if u:
            for j, d in enumerate(slope):
                residual[j] += u * d
    gap = max((u * s for u, s in zip(dual, slack, strict=True)), default=0.0)
    norm = max([abs(r) for r in residual] + [abs(r) for r in primal] + [gap]) / size
    return residual, jacobian, primal, norm


@dataclass(frozen=True, slots=True)
class _Linearised:
    """Newton's equations at one iterate, reduced to those for the point."""

    matrix: list[Row]
    residual: Row
    jacobian: list[Row]
    primal: Row
    slack: Row
    dual: Row

    @classmethod
    def at(cls, f: FloatQuadratic, g: Sequence[FloatQuadratic], x: Row, slack: Row, dual: Row) -> _Linearised:
        n = len(x)
        residual, jacobian, primal, _ = _state(f, g, x, slack, dual)
        matrix = [[0.0] * n for _ in range(n)]
        for i, j, h in f.hessian:
            matrix[i][j] += h
        for q, slope, s, u in zip(g, jacobian, slack, dual, strict=True):
            for i, j, h in q.hessian:
                matrix[i][j] += u * h
            weight = u / s
            for i, a in enumerate(slope):
                if a:
                    row, factor = matrix[i], weight * a
                    for j, b in enumerate(slope):
                        row[j] += factor * b
        bump = 1e-13 * max((matrix[i][i] for i in range(n)), default=1.0) + 1e-300
        for i in range(n):
            matrix[i][i] += bump
        return cls(matrix, residual, jacobian, primal, slack, dual)

    def direction(self, centre: Sequence[float]) -> tuple[Row, Row, Row] | None:
        """Steps of point, slacks, multipliers that lower each product of a slack and its multiplier by ``centre``."""
        rhs = [-r for r in self.residual]
        extra = [(u * p - c) / s for u, p, c, s in zip(self.dual, self.primal, centre, self.slack, strict=True)]
        for slope, e in zip(self.jacobian, extra, strict=True):
            for i, a in enumerate(slope):
                rhs[i] -= a * e
        dx = solve_floats(self.matrix, rhs)
        if dx is None or not all(abs(d) < LARGEST_STEP for d in dx):
            return None
        moved = [sum(a * d for a, d in zip(slope, dx, strict=True)) for slope in self.jacobian]
        ds = [-p - t for p, t in zip(self.primal, moved, strict=True)]
        du = [e + u * t / s for e, u, t, s in zip(extra, self.dual, moved, self.slack, strict=True)]
        return dx, ds, du


def _newton_step(
    f: FloatQuadratic, g: Sequence[FloatQuadratic], x: Row, slack: Row, dual: Row, damped: bool
) -> tuple[Row, Row, Row] | None:
    m = len(g)
    equations = _Linearised.at(f, g, x, slack, dual)
    mean = sum(u * s for u, s in zip(dual, slack, strict=True)) / m if m else 0.0
    if not m:
        straight = equations.direction([])
        return None if straight is None else ([v + d for v, d in zip(x, straight[0], strict=True)], [], [])
    products = [u * s for u, s in zip(dual, slack, strict=True)]
    if damped:
        sigma = DAMPED_CENTRING
        chosen = equations.direction([p - sigma * mean for p in products])
    else:
        plain = equations.direction(products)
        if plain is None:
            return None
        _, ds, du = plain
        a, b = _longest(slack, ds, 1.0), _longest(dual, du, 1.0)
        reached = sum((u + b * e) * (s + a * d) for u, e, s, d in zip(dual, du, slack, ds, strict=True)) / m
        sigma = min(1.0, max(0.0, reached / mean)) ** 3 if mean else 0.0
        chosen = (
            equations.direction([p + c * e - sigma * mean for p, c, e in zip(products, ds, du, strict=True)]) or plain
        )
    if chosen is None:
        return None
    dx, ds, du = chosen
    near = 0.7 if damped else min(0.99, max(0.8, 1.0 - mean))
    t = min(_longest(slack, ds, near), _longest(dual, du, near))
    here = _merit(f, g, (x, slack, dual), sigma * mean)
    while True:
        moved_to = (_moved(x, dx, t), _positive(_moved(slack, ds, t)), _positive(_moved(dual, du, t)))
        if not damped or t < SHORTEST or _merit(f, g, moved_to, sigma * mean) <= (1 - DECREASE * t) * here:
            return moved_to
        t *= SHORTER


def _moved(values: Row, steps: Row, t: float) -> Row:
    return [v + t * d for v, d in zip(values, steps, strict=True)]


def _positive(values: Row) -> Row:
    return [max(v, POSITIVE) for v in values]


def _merit(f: FloatQuadratic, g: Sequence[FloatQuadratic], at: tuple[Row, Row, Row], centre: float) -> float:
    """Euclidean norm of all residuals of the perturbed optimality conditions, products aimed at ``centre``."""
    x, slack, dual = at
    residual, _, primal, _ = _state(f, g, x, slack, dual)
    gaps = [u * s - centre for u, s in zip(dual, slack, strict=True)]
    return float(sum(v * v for part in (residual, primal, gaps) for v in part) ** 0.5)


def _longest(values: Sequence[float], steps: Sequence[float], fraction: float) -> float:
    """The largest step <= 1 that keeps values + step positive, times ``fraction`` at the boundary."""
    best = 1.0
    for v, d in zip(values, steps, strict=True):
        if d < 0 and v + best * d <= 0:
            best = -fraction * v / d
        elif d < 0 and fraction < 1 and v + best * d < (1 - fraction) * v:
            best = min(best, -fraction * v / d)
    return best
