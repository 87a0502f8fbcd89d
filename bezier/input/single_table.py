"""The table [single] of a problem file: the degree, and the interval and heights unless the via points say them.

The via points of the paper are (a, h_y, h_z) and (b, h_y, h_z). Either they are given, and [single] says at most the
degree; or ``a``, ``b`` and ``height_y`` or ``height_z`` are, and the via points follow. A coordinate without a height
is equally spaced from start to goal; given via points have none where they are on that straight way. ``p`` and ``q``
may be stated; they have to be the ones that a and b give.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from bezier.curves.scalar import Vector
from bezier.input.task import MAX_DEGREE, Axis, Task, least_degree, task
from bezier.input.toml_table import Table
from qe.errors import InputError

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
    found = table.inner("single")
    found.only(KEYS)
    return found


def stated_via(table: Table, start: Vector, goal: Vector) -> Via | None:
    """The via points that [single] states, or None when it states no interval."""
    single = single_table(table)
    if not set(single.values) & {"a", "b", "height_y", "height_z"}:
        return None
    if "via" in table.values:
        raise table.error("via", "no via points beside a, b and heights in [single]", "both")
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
    ends, interval = (_exact(start[0]), _exact(goal[0])), (_exact(via[0][0]), _exact(via[1][0]))
    stated_degree = _whole(single, "degree", USUAL_DEGREE)
    try:
        degree = stated_degree if "degree" in single.values else least_degree(ends, interval, USUAL_DEGREE)
        found = task(degree, ends, interval, axes)
    except InputError as error:
        key = "degree" if "degree" in single.values else "a" if states_via else "via"
        raise (single if key != "via" else table).error(
            key, "an interval, a degree and heights that fit together", str(error)
        ) from None
    for key, value in (("p", found.p), ("q", found.q)):
        if key in single.values and _whole(single, key, value) != value:
            raise single.error(key, f"{value}, which follows from a and b", str(single.number(key)))
    stated = {"degree": str(degree), "p": str(found.p), "q": str(found.q)}
    if states_via:
        stated |= {"a": str(interval[0]), "b": str(interval[1])}
        stated |= {f"height_{axis.name}": str(axis.height) for axis in found.raised}
    return SingleCurve(found, stated)


def _axis(single: Table, i: int, start: Vector, goal: Vector) -> Axis:
    key = f"height_{AXES[i]}"
    return Axis(AXES[i], _exact(start[i]), _exact(goal[i]), single.positive(key) if key in single.values else None)


def _via_axis(table: Table, i: int, start: Vector, via: Via, goal: Vector) -> Axis:
    """The axis with the height of both via points, or without one where they are on the way from start to goal."""
    name, heights = AXES[i], (_exact(via[0][i]), _exact(via[1][i]))
    axis = Axis(name, _exact(start[i]), _exact(goal[i]), None)
    if heights[0] == heights[1] > 0:
        return replace(axis, height=heights[0])
    rise, length = axis.goal - axis.start, _exact(goal[0] - start[0])
    if any(
        (h - axis.start) * length != _exact(point[0] - start[0]) * rise for point, h in zip(via, heights, strict=True)
    ):
        expected = f"two points with the same {name} above zero, or with {name} as on the way to the goal"
        raise table.error("via", expected, f"{name} = {heights[0]} and {heights[1]}")
    return axis


def _exact(value: Any) -> Fraction:
    """A coordinate of a problem file, which is rational."""
    return Fraction(value)


def _whole(single: Table, key: str, default: int) -> int:
    value = single.number(key, Fraction(default))
    if value.denominator != 1 or not 0 <= value <= MAX_DEGREE:
        raise single.error(key, f"a whole number from 0 to {MAX_DEGREE}", str(value))
    return int(value)
