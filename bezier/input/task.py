"""What Method 1 is given: degree, interval and heights, with the indices p and q of the paper's problem (4)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

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
