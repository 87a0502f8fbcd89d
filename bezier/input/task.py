"""What Method 1 is given: degree, interval and heights, with the indices p and q of the paper's problem (4).

The table [single] of a problem file: the degree, and the interval and heights unless the via points say them.

The via points of the paper are (a, h_y, h_z) and (b, h_y, h_z). Either they are given, and [single] says at most the
degree; or ``a``, ``b`` and ``height_y`` or ``height_z`` are, and the via points follow. A coordinate without a height
is equally spaced from start to goal; given via points have none where they are on that straight way. ``p`` and ``q``
may be stated; they have to be the ones that a and b give.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

from bezier.curves.scalar import Vector, exactly
from bezier.input.toml_table import Table
from qe.errors import InputError

MAX_DEGREE = 64

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
        result = index_pair(self.degree, self.x_ends, self.interval)
        if (self.p, self.q) != result:
            given = f"where the interval gives p = {result[0]} and q = {result[1]}"
            raise InputError(f"p = {self.p} and q = {self.q} {given}")
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
    return f"no q > p, since no control point has its x between a = {a} and b = {b} (but at {low} and {high})"


KEYS = ("degree", "a", "b", "height_y", "height_z", "p", "q")
AXES = "xyz"
USUAL_DEGREE = 6
"""The degree without ``degree`` is this, or the least one beyond it that the interval allows."""

Via = tuple[Vector, Vector]


@dataclass(frozen=True, slots=True)
class SingleCurve:
    """Method 1 in a problem: the task, and what [single] states, for writing the problem again."""

    task: Task
    stated: Mapping[str, str]

    @property
    def states_via(self) -> bool:
        """Whether the via points follow from the table."""
        return "a" in self.stated


def single_table(table: Table) -> Table:
    """The table [single], empty when it is missing. Raises ``InputError`` for unknown keys."""
    result = table.inner("single")
    result.only(KEYS)
    return result


def stated_via(table: Table, start: Vector, goal: Vector) -> Via | None:
    """The via points that [single] states, or None when it states no interval."""
    single = single_table(table)
    if not set(single.values) & {"a", "b", "height_y", "height_z"}:
        return None
    if "via" in table.values:
        raise table.error("via", "no via points together with a, b and heights in [single]", "both")
    a, b = single.number("a"), single.number("b")
    axes = [_axis(single, i, start, goal) for i in (1, 2)]

    def at(x: Fraction) -> Vector:
        share = (x - start[0]) / (goal[0] - start[0])
        straight = (axis.start + share * (axis.goal - axis.start) for axis in axes)
        return (x, *(s if axis.height is None else axis.height for s, axis in zip(straight, axes, strict=True)))

    if goal[0] == start[0]:
        raise table.error("goal", "a goal beyond the start in x", f"x = {goal[0]} at both")
    return at(a), at(b)


def read_single(table: Table, start: Vector, via: Via, goal: Vector) -> SingleCurve:
    """The task of Method 1 in this problem."""
    single = single_table(table)
    states_via = "a" in single.values
    if states_via:
        axes = [_axis(single, i, start, goal) for i in (1, 2)]
    else:
        axes = [_via_axis(table, i, start, via, goal) for i in (1, 2)]
    ends, interval = (exactly(start[0]), exactly(goal[0])), (exactly(via[0][0]), exactly(via[1][0]))
    stated_degree = single.whole("degree", USUAL_DEGREE, range(MAX_DEGREE + 1))
    try:
        degree = stated_degree if "degree" in single.values else least_degree(ends, interval, USUAL_DEGREE)
        result = task(degree, ends, interval, axes)
    except InputError as error:
        key = "degree" if "degree" in single.values else "a" if states_via else "via"
        raise (single if key != "via" else table).error(
            key, "an interval, a degree and heights that fit together", str(error)
        ) from None
    for key, value in (("p", result.p), ("q", result.q)):
        if key in single.values and single.whole(key, value, range(MAX_DEGREE + 1)) != value:
            raise single.error(key, f"{value}, which follows from a and b", str(single.number(key)))
    stated = {"degree": str(degree), "p": str(result.p), "q": str(result.q)}
    if states_via:
        stated |= {"a": str(interval[0]), "b": str(interval[1])}
        stated |= {f"height_{axis.name}": str(axis.height) for axis in result.raised}
    return SingleCurve(result, stated)


def _axis(single: Table, i: int, start: Vector, goal: Vector) -> Axis:
    key = f"height_{AXES[i]}"
    return Axis(AXES[i], exactly(start[i]), exactly(goal[i]), single.positive(key) if key in single.values else None)


def _via_axis(table: Table, i: int, start: Vector, via: Via, goal: Vector) -> Axis:
    """The axis with the height of both via points, or without one where they are on the way from start to goal."""
    name, heights = AXES[i], (exactly(via[0][i]), exactly(via[1][i]))
    axis = Axis(name, exactly(start[i]), exactly(goal[i]), None)
    if heights[0] == heights[1] > 0:
        return replace(axis, height=heights[0])
    rise, length = axis.goal - axis.start, exactly(goal[0] - start[0])
    if any(
        (h - axis.start) * length != exactly(point[0] - start[0]) * rise for point, h in zip(via, heights, strict=True)
    ):
        expected = f"two points with the same {name} above zero, or with {name} as on the way to the goal"
        raise table.error("via", expected, f"{name} = {heights[0]} and {heights[1]}")
    return axis
