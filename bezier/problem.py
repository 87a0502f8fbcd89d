"""Planning problems: four points, a workspace, a method and further wishes, read exactly from a TOML file."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from pathlib import Path
from typing import Any

from bezier.curves.scalar import Vector, dot, exactly, is_zero, same
from bezier.curves.workspace import HalfSpace, Workspace, WorkspaceKind
from bezier.input.numbers import describe, shorten
from bezier.input.task import SingleCurve, Via, read_single, stated_via
from bezier.input.toml_table import LARGEST, POINT, Table, read_text
from bezier.motion.motion import Timing, read_timing
from bezier.obstacles.obstacle import Obstacle, PointInside, inside
from bezier.obstacles.reader import read_obstacles, via_at_thirds, via_over
from bezier.paths.heights import AXES, Strip
from qe.errors import InputError
from qe.exact.radicals import root_text


class PlanMethod(Enum):
    """The paper's methods: formula (8), formula (7) and the single curve of section 4.1."""

    QUADRATIC = "quadratic"
    CUBIC = "cubic"
    SINGLE = "single"


INNER = {PlanMethod.QUADRATIC: ("P1", "Q1", "R1"), PlanMethod.CUBIC: ("P1", "P2", "Q1", "Q2", "R1", "R2")}
"""The control points that a method has to find, in the order in which its formula bounds them."""


@dataclass(frozen=True, slots=True)
class PointCondition:
    """A half-space that some inner control points have to lie in: one ``[[half_space]]``."""

    half_space: HalfSpace
    points: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Problem:
    """A planning problem. All coordinates and the radius are in one unit of length (millimetres in the paper)."""

    method: PlanMethod
    workspace: Workspace
    start: Vector
    via: tuple[Vector, Vector]
    """The two points Q0 and R0 between which the obstacle is avoided."""
    goal: Vector
    radius_is_auto: bool
    """The radius is the paper's maximum of the four norms."""
    notes: tuple[str, ...] = ()
    """Remarks for the reader about the input."""
    source: str = "<problem>"
    half_spaces: tuple[PointCondition, ...] = ()
    """Further conditions on control points."""
    ratio: Fraction = Fraction(1)
    """The duration of the outer spans, the middle one taking 1."""
    join_speed: Fraction = Fraction(0)
    """The least speed at the joins that is asked for, 0 for none."""
    obstacles: tuple[Obstacle, ...] = ()
    """What the whole path has to stay clear of."""
    above: tuple[PointCondition, ...] = ()
    """What follows from them for control points."""
    timing: Timing | None = None
    """What is asked of the motion in time."""
    single: SingleCurve | None = None
    """What Method 1 is given, None for the other methods."""
    arm: str | None = None
    """The arm that has to follow the path."""

    def __repr__(self) -> str:
        return f"Problem({self.method.value}, {self.source}, {len(self.obstacles)} obstacles)"

    @property
    def point_conditions(self) -> tuple[PointCondition, ...]:
        """The half-spaces for control points: those given and those above the top of an obstacle."""
        return self.half_spaces + self.above

    @property
    def named_points(self) -> dict[str, Vector]:
        """The four given points by their names in the file."""
        return {"start": self.start, "via[0]": self.via[0], "via[1]": self.via[1], "goal": self.goal}

    @property
    def strip(self) -> Strip | None:
        """The height condition, None without a positive height (``bezier.paths.heights``)."""
        if self.single is not None:
            task = self.single.task
            return Strip(*task.interval, {axis.name: Fraction(axis.height or 0) for axis in task.raised})
        first, second = self.via
        kept = {axis: min(exactly(first[i]), exactly(second[i])) for axis, i in AXES.items() if axis != "x"}
        kept = {axis: height for axis, height in kept.items() if height > 0}
        low, high = sorted((exactly(first[0]), exactly(second[0])))
        return Strip(low, high, kept) if kept else None


def ends_inside(problem: Problem) -> tuple[PointInside, ...]:
    """The start and the goal with the obstacles that they lie in: then no path exists."""
    return inside({"start": problem.start, "goal": problem.goal}, problem.obstacles)


_POINTS = ("start", "via", "goal")
_WISHES = ("half_space", "ratio", "join_speed", "obstacle", "timing", "single", "arm")
_KEYS = ("method", "workspace", *_POINTS, "radius", *_WISHES)


def read_problem(text: str, source: str = "<problem>") -> Problem:
    """Read a problem from TOML text. Raises ``InputError`` with file, line, key, what was expected and found."""
    return new_problem(Table.parse(text, source))


def new_problem(table: Table) -> Problem:
    """The problem of a table that a person wrote: there a via point in an obstacle is a mistake, which ``InputError``
    names. Via points that the planner chooses may be in one; then it tries others."""
    problem = problem_of(table)
    if "via" in table.values and problem.method in INNER and not ends_inside(problem):
        via = {name: point for name, point in problem.named_points.items() if name.startswith("via")}
        for item in inside(via, problem.obstacles):
            place = ", ".join(map(str, item.place))
            raise table.error(
                item.name, "a point clear of all obstacles", f"({place}), which lies in {item.obstacle.name}"
            )
    return problem


def problem_of(table: Table) -> Problem:
    """The problem that a table of keys and values describes."""
    table.only(_KEYS)
    method = table.choice("method", PlanMethod, PlanMethod.QUADRATIC)
    kind = table.choice("workspace", WorkspaceKind, WorkspaceKind.BALL)
    if kind is WorkspaceKind.REACHABLE and "arm" not in table.values:
        raise table.error("workspace", "an arm with the true reachable set as workspace", "no arm")
    start, goal, obstacles = table.point("start"), table.point("goal"), read_obstacles(table)
    via = stated_via(table, start, goal) or _via(table, start, goal, obstacles)
    auto = table.values.get("radius", "auto") == "auto"
    points = {"start": start, "via[0]": via[0], "via[1]": via[1], "goal": goal}
    _check_distinct(table, points)
    for name, point in points.items():
        if any(abs(exactly(c)) > LARGEST for c in point):  # of via points that were computed
            raise table.error(name, "coordinates of at most 10^50", "a larger one")
    expected = 'a positive number, "sqrt(27)" or "auto"'
    workspace = Workspace(kind, max(dot(p, p) for p in points.values()) if auto else table.squared("radius", expected))
    _check_inside(table, points, workspace, is_computed=not {"via", "single"} & {*table.values})
    return Problem(
        method=method,
        workspace=workspace,
        start=start,
        via=via,
        goal=goal,
        radius_is_auto=auto,
        notes=_notes(points, via),
        source=table.source,
        half_spaces=_half_spaces(table, method),
        ratio=_for_cubic(table, method, "ratio", Fraction(1)),
        join_speed=_for_cubic(table, method, "join_speed", Fraction(0)),
        obstacles=obstacles,
        above=_above(table, method, obstacles),
        timing=read_timing(table),
        single=_single(table, method, start, via, goal),
        arm=_arm(table),
    )


def load_problem(path: Path) -> Problem:
    """Read a problem file. Raises ``InputError`` also when the file cannot be read."""
    return read_problem(read_text(path), str(path))


def _via(table: Table, start: Vector, goal: Vector, obstacles: tuple[Obstacle, ...]) -> tuple[Vector, Vector]:
    """The via points given, or those over the obstacles (``bezier.obstacles.reader``); where no path exists, any."""
    expected = "two points of 3 numbers"
    if "via" not in table.values and obstacles:
        if inside({"start": start, "goal": goal}, obstacles):
            return via_at_thirds(start, goal)
        try:
            return via_over(start, goal, obstacles)
        except InputError as error:
            raise table.error("obstacle", "obstacles that via points can be found for", str(error)) from None
    raw = table.required("via", expected)
    if not isinstance(raw, list) or len(raw) != 2 or not all(isinstance(p, list) for p in raw):
        raise table.error("via", expected, describe(raw))
    return table.as_point("via[0]", raw[0]), table.as_point("via[1]", raw[1])


def _half_spaces(table: Table, method: PlanMethod) -> tuple[PointCondition, ...]:
    """``[[half_space]]``: normal . p >= offset for the control points named."""
    result = []
    for i, entry in enumerate(table.tables("half_space")):
        if method not in INNER:
            raise table.error("half_space", "no such key with this method", "a table")
        entry.only(("normal", "offset", "points"))
        normal, offset = entry.point("normal"), entry.number("offset")
        if all(map(is_zero, normal)):
            raise entry.error("normal", f"{POINT}, not all zero", "the zero vector")
        points = entry.words("points", INNER[method], "control points")
        result.append(PointCondition(HalfSpace(normal, -offset, f"half_space[{i}]"), points))
    return tuple(result)


def _above(table: Table, method: PlanMethod, obstacles: tuple[Obstacle, ...]) -> tuple[PointCondition, ...]:
    """``above`` of an obstacle: the control points named lie at the height of its top or higher."""
    result = []
    for entry, obstacle in zip(table.tables("obstacle"), obstacles, strict=True):
        if "above" in entry.values:
            if obstacle.top is None:
                raise entry.error("above", "this key for an obstacle with a top", "one without")
            points = entry.words("above", INNER.get(method, ()), "control points")
            up = (Fraction(0), Fraction(0), Fraction(1))
            result.append(PointCondition(HalfSpace(up, -obstacle.top, f"above {obstacle.name}"), points))
    return tuple(result)


def _for_cubic(table: Table, method: PlanMethod, key: str, default: Fraction) -> Fraction:
    """A positive number that only the cubic method knows."""
    if key in table.values and method is not PlanMethod.CUBIC:
        raise table.error(key, 'this key with method = "cubic" only', f'method = "{method.value}"')
    return table.positive(key) if key in table.values else default


def _single(table: Table, method: PlanMethod, start: Vector, via: Via, goal: Vector) -> SingleCurve | None:
    """What Method 1 is given: the table [single], which other methods do not know."""
    if method is PlanMethod.SINGLE:
        return read_single(table, start, via, goal)
    if "single" in table.values:
        raise table.error("single", 'this table with method = "single" only', f'method = "{method.value}"')
    return None


def _arm(table: Table) -> str | None:
    """The name of an arm, which the planner knows."""
    name = table.values.get("arm")
    if name is not None and (not isinstance(name, str) or not name):
        raise table.error("arm", "the name of an arm", describe(name))
    return name


def _check_distinct(table: Table, points: Mapping[str, Vector]) -> None:
    for first, second in itertools.pairwise(points):
        if same(points[first], points[second]):
            text = ", ".join(map(str, points[first]))
            raise table.error(second, f"a point other than {first}", f"the same point ({text})")


def _check_inside(table: Table, points: Mapping[str, Vector], workspace: Workspace, *, is_computed: bool) -> None:
    for name, point in points.items():
        if is_computed and name.startswith("via") and workspace.ball.margin(point) < 0:
            over = ", ".join(shorten(str(c)) for c in point)
            found = f"none; one over the obstacles, ({over}), is outside"
            raise table.error("via", "two points in the workspace", found)
        if workspace.ball.margin(point) < 0:
            needed, given = dot(point, point), workspace.radius_squared
            raise table.error("radius", f"at least {_root(needed)}, the norm of {name}", _root(given))
        if workspace.kind is WorkspaceKind.HEMISPHERE and workspace.floor.margin(point) < 0:
            raise table.error(name, "a point with z >= 0 in the hemisphere", f"z = {point[-1]}")


def _root(square: Fraction) -> str:
    """A square root, with a decimal beside it unless it is an integer."""
    text = root_text(square)
    return text if text.isdigit() else f"{shorten(text)} (about {float(square) ** 0.5:.8g})"


def _notes(points: Mapping[str, Vector], via: tuple[Vector, Vector]) -> tuple[str, ...]:
    notes = []
    different = [axis for axis, a, b in zip("xyz", *via, strict=True) if axis != "x" and not is_zero(a - b)]
    if different:
        notes.append(f"the via points differ in {' and '.join(different)}; the paper assumes equal y and z")
    for name, point in points.items():
        if all(map(is_zero, point)):
            notes.append(f"{name} is the origin, where the paper's arm cannot put its end effector")
    return tuple(notes)


def to_json(problem: Problem) -> dict[str, Any]:
    """The problem in exact numbers, with the keys of the TOML file, the radius by its square."""
    data: dict[str, Any] = {
        "method": problem.method.value,
        "workspace": problem.workspace.kind.value,
        "radius_squared": str(problem.workspace.radius_squared),
        "start": _texts(problem.start),
        "goal": _texts(problem.goal),
    }
    if problem.single is None or not problem.single.states_via:
        data["via"] = [_texts(p) for p in problem.via]
    if problem.single is not None:
        data["single"] = dict(problem.single.stated)
    if problem.half_spaces:
        data["half_space"] = [
            {
                "normal": _texts(item.half_space.normal),
                "offset": str(-item.half_space.offset),
                "points": list(item.points),
            }
            for item in problem.half_spaces
        ]
    if problem.obstacles:
        data["obstacle"] = [dict(item.stated) for item in problem.obstacles]
    if problem.timing is not None:
        data["timing"] = problem.timing.to_json()
    if problem.arm is not None:
        data["arm"] = problem.arm
    if problem.ratio != 1:
        data["ratio"] = str(problem.ratio)
    if problem.join_speed:
        data["join_speed"] = str(problem.join_speed)
    return data


def from_json(stored: Mapping[str, Any], source: str) -> Problem:
    """The problem that ``to_json`` wrote. Raises ``InputError`` like ``read_problem``."""
    values = {key: value for key, value in stored.items() if key != "radius_squared"}
    squared = Table(stored, source).positive("radius_squared")
    return problem_of(Table({**values, "radius": f"sqrt({squared})"}, source))


def _texts(point: Vector) -> list[str]:
    return [str(c) for c in point]
