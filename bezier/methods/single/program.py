"""Method 1, one Bézier curve of degree n, as printed (Hatakeyama, Terui and Mikawa, SCSS 2024, 4.1).

The x-coordinates are equally spaced; the y- and z-coordinates of the inner control points solve problem (4), each
coordinate for itself: P(t_a) = P(t_b) = h, start <= the first p, h <= the next up to q, goal <= the others, and the sum
over p+1..q is smallest. (4) does not say that the curve stays above h between, nor that it stays in the workspace:
``dips`` and ``bezier.curves.containment`` find out, ``bezier.methods.single.closed`` repairs it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise
from math import comb

from bezier.curves import bernstein as bs
from bezier.curves.curve import Bezier
from bezier.curves.nonnegative import Negative, decide
from bezier.methods.single.simplex import Contradiction, Duals, LinearOptimum, LinearProgram, Row, solve
from qe.errors import InputError

MAX_DEGREE = 64
TIE_BREAK = (
    "among the minima of the sum the one whose largest |coordinate| is least, then the lexicographically smallest"
)
"""The paper leaves the choice open. The maximum norm keeps the choice a linear problem and the numbers rational."""

Values = tuple[Fraction, ...]


@dataclass(frozen=True, slots=True)
class Axis:
    """One coordinate of the curve: its values at start and goal, and the height h to keep, or None for none.

    Without a height the coordinates of the control points are equally spaced, as in x.
    """

    name: str
    start: Fraction
    goal: Fraction
    height: Fraction | None


@dataclass(frozen=True, slots=True)
class Task:
    """What Method 1 is given: the degree n, x_0 and x_n, the interval [a, b] in x, and the axes y and z.

    Invariants: x_0 < x_n, 2 <= n <= ``MAX_DEGREE``, a positive height on at least one axis, and the index condition
    x_p < a <= x_{p+1} <= x_q <= b < x_{q+1} with 1 <= p < q+1 <= n. ``task`` finds p and q.
    """

    degree: int
    x_ends: tuple[Fraction, Fraction]
    interval: tuple[Fraction, Fraction]
    axes: tuple[Axis, ...]
    p: int
    q: int

    def __post_init__(self) -> None:
        found = index_pair(self.degree, self.x_ends, self.interval)
        if (self.p, self.q) != found:
            raise InputError(
                f"p = {self.p} and q = {self.q} where the interval gives p = {found[0]} and q = {found[1]}"
            )
        if not self.raised or any(axis.height is not None and axis.height <= 0 for axis in self.axes):
            raise InputError("no positive height for y or z")

    @property
    def raised(self) -> tuple[Axis, ...]:
        """The axes with a height, whose control points are to be found."""
        return tuple(axis for axis in self.axes if axis.height is not None)

    @property
    def abscissae(self) -> Values:
        """x_0, ..., x_n."""
        return equally_spaced(self.degree, *self.x_ends)

    @property
    def times(self) -> tuple[Fraction, Fraction]:
        """t_a and t_b by (3): t = (x - x_0) / (x_n - x_0)."""
        low, high = self.x_ends
        a, b = ((x - low) / (high - low) for x in self.interval)
        return a, b

    @property
    def middle(self) -> range:
        """The indices p+1, ..., q that the sum runs over."""
        return range(self.p + 1, self.q + 1)

    def lower_bound(self, axis: Axis, i: int) -> Fraction:
        """The bound of (4) on coordinate i: start up to p, the height up to q, goal from there."""
        height = axis.start if axis.height is None else axis.height
        return axis.start if i <= self.p else height if i <= self.q else axis.goal


def equally_spaced(degree: int, first: Fraction, last: Fraction) -> Values:
    """((n-i) first + i last) / n for i = 0..n: the coordinates that make P linear in t, equation (2)."""
    return tuple(((degree - i) * first + i * last) / degree for i in range(degree + 1))


def task(
    degree: int, x_ends: tuple[Fraction, Fraction], interval: tuple[Fraction, Fraction], axes: Sequence[Axis]
) -> Task:
    """The task with p and q found from the interval. Raises ``InputError`` with the reason where there are none."""
    return Task(degree, x_ends, interval, tuple(axes), *index_pair(degree, x_ends, interval))


def index_pair(degree: int, x_ends: tuple[Fraction, Fraction], interval: tuple[Fraction, Fraction]) -> tuple[int, int]:
    """p and q with x_p < a <= x_{p+1} <= x_q <= b < x_{q+1} and 1 <= p < q+1 <= n; ``InputError`` says why not."""
    (low, high), (a, b) = x_ends, interval
    if not low < high:
        raise InputError(f"a goal that is not beyond the start in x: x_0 = {low} and x_n = {high}")
    if not low < a < b < high:
        raise InputError(f"not x_0 < a < b < x_n: {low}, {a}, {b}, {high}")
    if not 2 <= degree <= MAX_DEGREE:
        raise InputError(f"degree {degree}, which is not from 2 to {MAX_DEGREE}")
    found = _indices(degree, x_ends, interval)
    if found is None:
        reason = _refusal(equally_spaced(degree, *x_ends), interval)
        raise InputError(f"degree {degree}: {reason}; the least degree that works is {least_degree(x_ends, interval)}")
    return found


def least_degree(x_ends: tuple[Fraction, Fraction], interval: tuple[Fraction, Fraction], least: int = 2) -> int:
    """The least degree from ``least`` on that has p and q; ``MAX_DEGREE`` when none has."""
    works = (n for n in range(least, MAX_DEGREE) if _indices(n, x_ends, interval))
    return next(works, MAX_DEGREE)


def _indices(
    degree: int, x_ends: tuple[Fraction, Fraction], interval: tuple[Fraction, Fraction]
) -> tuple[int, int] | None:
    xs = equally_spaced(degree, *x_ends)
    p = sum(x < interval[0] for x in xs) - 1
    q = sum(x <= interval[1] for x in xs) - 1
    return (p, q) if 1 <= p < q < degree else None


def _refusal(xs: Values, interval: tuple[Fraction, Fraction]) -> str:
    a, b = interval
    if a <= xs[1]:
        return f"no p >= 1, since a = {a} is not beyond x_1 = {xs[1]}"
    low, high = next((u, v) for u, v in pairwise(xs) if u < a <= v)
    return f"no q > p, since no control point has its x between a = {a} and b = {b} (x = {low} and {high} are beside)"


# --- the linear problem ------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Chosen:
    """Problem (4) of one axis with its answer: ``outcome`` for ``program`` and ``objective``, with the dual proof.

    ``values``: all coordinates from start to goal, by the ``TIE_BREAK``; None when (4) has no solution.
    """

    axis: Axis
    program: LinearProgram
    objective: Values
    outcome: LinearOptimum | Contradiction

    @property
    def values(self) -> Values | None:
        """All n+1 coordinates."""
        if isinstance(self.outcome, Contradiction):
            return None
        return (self.axis.start, *self.outcome.point, self.axis.goal)


def weights_at(degree: int, t: Fraction) -> Values:
    """C(n,i) t^i (1-t)^(n-i) for i = 0..n: P(t) is the sum of these times P_i."""
    return tuple(comb(degree, i) * t**i * (1 - t) ** (degree - i) for i in range(degree + 1))


def variables(given: Task, axis: Axis) -> tuple[str, ...]:
    """The names y1, ..., y(n-1)."""
    return tuple(f"{axis.name}{i}" for i in range(1, given.degree))


def program(given: Task, axis: Axis) -> LinearProgram:
    """The constraints of (4) for one raised axis."""
    rows = []
    for t in given.times:
        first, *inner, last = weights_at(given.degree, t)
        bound = Fraction(axis.height or 0) - first * axis.start - last * axis.goal
        rows.append(Row(tuple(inner), bound, equation=True))
    lower = tuple(given.lower_bound(axis, i) for i in range(1, given.degree))
    return LinearProgram(variables(given, axis), lower, tuple(rows))


def objective(given: Task) -> Values:
    """The coefficients of the sum over p+1..q on the inner coordinates of one axis."""
    return tuple(Fraction(int(i in given.middle)) for i in range(1, given.degree))


def choose(given: Task, axis: Axis) -> Chosen:
    """Solve (4) exactly for one raised axis, with the ``TIE_BREAK``."""
    base, cost = program(given, axis), objective(given)
    size = len(cost)
    unit = [tuple(Fraction(int(i == j)) for i in range(size + 1)) for j in range(size + 1)]
    signed = [(side, j) for side in (1, -1) for j in range(size) if side > 0 or base.lower[j] < 0]
    at_most = [Row((*(side * v for v in unit[j][:-1]), Fraction(-1)), Fraction(0)) for side, j in signed]
    wider = LinearProgram(
        (*base.names, f"{axis.name}max"),
        (*base.lower, Fraction(0)),
        (*(Row((*row.coefficients, Fraction(0)), row.bound, row.equation) for row in base.rows), *at_most),
    )
    outcome = solve(wider, [(*cost, Fraction(0)), unit[-1], *unit[:-1]])
    duals = Duals(outcome.duals.rows[: len(base.rows)], outcome.duals.bounds[:size])
    if isinstance(outcome, Contradiction):
        return Chosen(axis, base, cost, Contradiction(duals))
    return Chosen(axis, base, cost, replace(outcome, point=outcome.point[:size], duals=duals))


def lowest(given: Task, axis: Axis, t: Fraction) -> Values | None:
    """Among the solutions of (4) with the least sum one that is lowest at ``t``: what (4) allows just as well."""
    height = weights_at(given.degree, t)[1:-1]
    outcome = solve(program(given, axis), [objective(given), height])
    return None if isinstance(outcome, Contradiction) else (axis.start, *outcome.point, axis.goal)


def curve(given: Task, values: Mapping[str, Values]) -> Bezier:
    """The curve with these coordinates of the raised axes; the other axes are equally spaced."""
    columns = [values.get(axis.name, equally_spaced(given.degree, axis.start, axis.goal)) for axis in given.axes]
    return Bezier(tuple(zip(given.abscissae, *columns, strict=True)))


@dataclass(frozen=True, slots=True)
class Dip:
    """The curve is below the height of ``axis`` at the parameter ``t`` in (t_a, t_b): a hole of (4)."""

    axis: Axis
    t: Fraction
    value: Fraction


def dips(given: Task, path: Bezier) -> tuple[Dip, ...]:
    """One proved dip for each raised axis that has any: complete, by ``bezier.curves.nonnegative``."""
    found = []
    low, high = given.times
    for axis in given.raised:
        height = Fraction(axis.height or 0)
        margin = bs.restrict(path.coordinate(1 + given.axes.index(axis)), low, high)
        outcome = decide([c - height for c in margin])
        if isinstance(outcome, Negative):
            found.append(Dip(axis, low + outcome.t * (high - low), outcome.value + height))
    return tuple(found)
