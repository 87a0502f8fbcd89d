"""Planning problems: four points, a workspace and a method, read exactly from a TOML file."""

from __future__ import annotations

import itertools
import re
import tomllib
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from pathlib import Path

from bezier.numbers import NUMBER, Literal, NotANumber, describe, read, read_squared
from bezier.scalar import Vector, dot, is_zero, same
from bezier.workspace import Workspace, WorkspaceKind, root_text
from qe.errors import InputError

MAX_BYTES = 1_000_000
DIMENSION = 3


class PlanMethod(Enum):
    """The paper's methods: formula (8), formula (7) and the single curve of section 4.1."""

    QUADRATIC = "quadratic"
    CUBIC = "cubic"
    SINGLE = "single"


@dataclass(frozen=True, slots=True)
class Problem:
    """A planning problem. All coordinates and the radius are in one unit of length (millimetres in the paper).

    ``via``: the two points Q0 and R0 between which the obstacle is avoided. ``radius_is_auto``: the radius is
    the paper's maximum of the four norms. ``notes``: remarks for the reader about the input.
    """

    method: PlanMethod
    workspace: Workspace
    start: Vector
    via: tuple[Vector, Vector]
    goal: Vector
    radius_is_auto: bool
    notes: tuple[str, ...] = ()
    source: str = "<problem>"

    @property
    def named_points(self) -> dict[str, Vector]:
        """The four given points by their names in the file."""
        return {"start": self.start, "via[0]": self.via[0], "via[1]": self.via[1], "goal": self.goal}


class _Reader:
    """One TOML table with its source, for messages that name file, line and key."""

    def __init__(self, text: str, source: str) -> None:
        self.source, self.lines = source, text.splitlines()
        try:
            self.table = tomllib.loads(text, parse_float=Literal)
        except tomllib.TOMLDecodeError as error:
            raise InputError(self._syntax(str(error))) from None
        except (ValueError, RecursionError) as error:
            raise InputError(f"{source}: expected a TOML file, found: {' '.join(str(error).split())}") from None

    def _syntax(self, message: str) -> str:
        place = re.search(r"\(at (?:line (\d+), column (\d+)|end of document)\)", message)
        body = re.sub(r"\s*\(at .*\)", "", message)
        line = place[1] if place and place[1] else str(len(self.lines))
        column = f":{place[2]}" if place and place[2] else ""
        return f"{self.source}:{line}{column}: expected a TOML file, found a syntax error: {body}"

    def error(self, key: str, expected: str, found: str, hint: str = "") -> InputError:
        """The one line that every bad input gets."""
        name = re.escape(key.split("[")[0])
        pattern = re.compile(rf"""\s*\[*\s*["']?{name}["']?\s*[=.\]]""")
        line = next((f":{i}" for i, text in enumerate(self.lines, start=1) if pattern.match(text)), "")
        return InputError(f"{self.source}{line}: {key}: expected {expected}, found {found}{hint}")

    def choice(self, key: str, choices: type[Enum], default: Enum) -> Enum:
        """A word out of an enumeration."""
        raw = self.table.get(key, default.value)
        words = [str(member.value) for member in choices]
        if not isinstance(raw, str) or raw not in words:
            raise self.error(key, " or ".join(f'"{word}"' for word in words), describe(raw))
        return choices(raw)

    def required(self, key: str, expected: str) -> object:
        """A value that must be there."""
        if key not in self.table:
            raise InputError(f"{self.source}: {key}: expected {expected}, found no such key")
        return self.table[key]

    def point(self, key: str, raw: object) -> Vector:
        """A point of three exact numbers."""
        if not isinstance(raw, list) or len(raw) != DIMENSION:
            raise self.error(key, f"a point of {DIMENSION} numbers", describe(raw))
        values = []
        for i, entry in enumerate(raw):
            try:
                values.append(read(entry))
            except NotANumber as error:
                raise self.error(f"{key}[{i}]", NUMBER, str(error)) from None
        return tuple(values)


_KEYS = ("method", "workspace", "start", "via", "goal", "radius")


def read_problem(text: str, source: str = "<problem>") -> Problem:
    """Read a problem from TOML text. Raises ``InputError`` with file, line, key, what was expected and found."""
    reader = _Reader(text, source)
    for key in reader.table:
        if key not in _KEYS:
            raise reader.error(key, f"one of the keys {', '.join(_KEYS)}", f'the unknown key "{key}"')
    method = PlanMethod(reader.choice("method", PlanMethod, PlanMethod.QUADRATIC))
    kind = WorkspaceKind(reader.choice("workspace", WorkspaceKind, WorkspaceKind.BALL))
    expected = f"a point of {DIMENSION} numbers"
    start = reader.point("start", reader.required("start", expected))
    raw_via = reader.required("via", f"two points of {DIMENSION} numbers")
    if not isinstance(raw_via, list) or len(raw_via) != 2 or not all(isinstance(p, list) for p in raw_via):
        raise reader.error("via", f"two points of {DIMENSION} numbers", describe(raw_via))
    via = reader.point("via[0]", raw_via[0]), reader.point("via[1]", raw_via[1])
    goal = reader.point("goal", reader.required("goal", expected))
    raw_radius = reader.table.get("radius", "auto")
    auto = raw_radius == "auto"
    points = {"start": start, "via[0]": via[0], "via[1]": via[1], "goal": goal}
    _check_distinct(reader, points)
    squared = max(dot(p, p) for p in points.values()) if auto else _radius(reader, raw_radius)
    workspace = Workspace(kind, squared, DIMENSION)
    _check_inside(reader, points, workspace)
    return Problem(method, workspace, start, via, goal, auto, _notes(points, via), source)


def load_problem(path: Path) -> Problem:
    """Read a problem file. Raises ``InputError`` also when the file cannot be read."""
    try:
        data = path.read_bytes()
        if len(data) > MAX_BYTES:
            raise InputError(f"{path}: expected a problem of at most {MAX_BYTES} bytes, found {len(data)}")
        text = data.decode("utf-8-sig")
    except OSError as error:
        raise InputError(f"{path}: expected a readable file, found: {error.strerror or error}") from None
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: expected UTF-8 text, found byte {data[error.start]:#04x} at {error.start}") from None
    return read_problem(text, str(path))


def _radius(reader: _Reader, raw: object) -> Fraction:
    expected = 'a positive number, "sqrt(27)" or "auto"'
    try:
        squared = read_squared(raw)
    except NotANumber as error:
        raise reader.error("radius", expected, str(error)) from None
    if squared == 0:
        raise reader.error("radius", expected, "zero")
    return squared


def _check_distinct(reader: _Reader, points: dict[str, Vector]) -> None:
    names = list(points)
    for first, second in itertools.pairwise(names):
        if same(points[first], points[second]):
            text = ", ".join(map(str, points[first]))
            raise reader.error(second, f"a point other than {first}", f"the same point ({text})")


def _check_inside(reader: _Reader, points: dict[str, Vector], workspace: Workspace) -> None:
    for name, point in points.items():
        if workspace.ball.margin(point) < 0:
            needed = root_text(dot(point, point))
            raise reader.error("radius", f"at least {needed}, the norm of {name}", workspace.radius_text)
        if workspace.kind is WorkspaceKind.HEMISPHERE and workspace.floor.margin(point) < 0:
            raise reader.error(name, "a point with z >= 0 in the hemisphere", f"z = {point[-1]}")


def _notes(points: dict[str, Vector], via: tuple[Vector, Vector]) -> tuple[str, ...]:
    notes = []
    different = [axis for axis, a, b in zip("xyz", *via, strict=True) if axis != "x" and not is_zero(a - b)]
    if different:
        notes.append(f"the via points differ in {' and '.join(different)}; the paper assumes equal y and z")
    for name, point in points.items():
        if all(map(is_zero, point)):
            notes.append(f"{name} is the origin, where the paper's arm cannot put its end effector")
    return tuple(notes)
