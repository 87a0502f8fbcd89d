"""Arms from TOML (``name``, ``convention``, ``[[row]]`` tables), the arms that are shipped, and paths for arms
(``[[curve]]`` tables of control points in mm, or of points that a natural cubic spline passes through)."""

from __future__ import annotations

import re
from collections.abc import Sequence
from fractions import Fraction
from functools import cache
from importlib.resources import files
from pathlib import Path

import qe
from bezier.arm.choices import MOST_RADIANS
from bezier.arm.model import EXPECTED, Angle, Arm, Convention, Joint, JointKind, Row, read_angle
from bezier.curves.curve import Bezier
from bezier.curves.scalar import Vector, add, scale, subtract
from bezier.input.numbers import MAX_CHARACTERS, NotANumber, describe, parse, shorten
from bezier.input.toml_table import Table, read_text
from qe.errors import InputError
from qe.exact.algebraic import RealAlgebraic
from qe.exact.quadratic_form import echelon

MAX_ROWS = 24
SUFFIX = ".toml"
ALIASES = {"ev3": "ev3-120"}
_OF_JOINTS = ("kind", "limits", "max_velocity", "max_acceleration")


def shipped() -> tuple[str, ...]:
    """The names of the arms that come with the package."""
    folder = files("bezier.arm").joinpath("data")
    return tuple(sorted(item.name.removesuffix(SUFFIX) for item in folder.iterdir() if item.name.endswith(SUFFIX)))


def load_arm(name: str) -> Arm:
    """The arm of a shipped name, or of a file in TOML or URDF. Raises ``InputError``."""
    name = ALIASES.get(name, name)
    if name in shipped():
        return _shipped(name)
    if name.endswith(SUFFIX):
        return read_arm(read_text(Path(name)), name)
    if ".urdf" in name:
        from bezier.arm.urdf import load_urdf

        return load_urdf(name)
    known = ", ".join(shipped())
    raise InputError(f"arm: expected a file {SUFFIX} or .urdf, or one of {known}, found {shorten(repr(name), 80)}")


@cache
def _shipped(name: str) -> Arm:
    text = files("bezier.arm").joinpath("data", name + SUFFIX).read_text(encoding="utf-8")
    return read_arm(text, name + SUFFIX)


def read_arm(text: str, source: str = "<arm>") -> Arm:
    """The arm that TOML text describes. Raises ``InputError`` with file, line, key, what was expected and found."""
    table = Table.parse(text, source)
    table.only(("name", "convention", "reference", "row"))
    rows = tuple(_row(entry) for entry in table.tables("row"))
    if not 1 <= len(rows) <= MAX_ROWS:
        raise table.error("row", f"1 to {MAX_ROWS} tables [[row]]", str(len(rows)))
    names = [row.joint.name for row in rows if row.joint is not None]
    if not names:
        raise table.error("row", "a row with a joint", "none")
    if len(set(names)) != len(names):
        raise table.error("row", "different names of joints", ", ".join(names))
    convention = table.choice("convention", Convention)
    return Arm(_text(table, "name", source), convention, rows, _text(table, "reference", ""))


def _row(entry: Table) -> Row:
    entry.only(("a", "alpha", "d", "theta", "joint", *_OF_JOINTS))

    joint = _joint(entry) if "joint" in entry.values else None
    for key in _OF_JOINTS:
        if joint is None and key in entry.values:
            raise entry.error(key, "this key in a row with a joint", "none there")

    lengths = {key: entry.number(key, Fraction(0)) for key in ("a", "d")}
    return Row(lengths["a"], _angle(entry, "alpha"), lengths["d"], _angle(entry, "theta"), joint)


def _joint(entry: Table) -> Joint:
    kind = entry.choice("kind", JointKind, JointKind.REVOLUTE)
    name = entry.values["joint"]
    if not isinstance(name, str) or not name.isidentifier():
        raise entry.error("joint", "a name such as theta1", describe(name))
    velocity, acceleration = (entry.positive(k) if k in entry.values else None for k in _OF_JOINTS[2:])
    raw = entry.values.get("limits")
    if raw is None:
        return Joint(name, kind, None, velocity, acceleration)
    if not isinstance(raw, list) or len(raw) != 2:
        raise entry.error("limits", "the least and the greatest value", describe(raw))
    inner = Table({f"limits[{i}]": value for i, value in enumerate(raw)}, entry.source, entry.lines, entry.prefix)
    low, high = (inner.number(f"limits[{i}]") for i in range(2))
    if kind is JointKind.REVOLUTE and max(abs(low), abs(high)) > MOST_RADIANS:
        expected = f"rad, at most {MOST_RADIANS} (four full turns)"
        raise entry.error("limits", expected, f"{low} and {high}, which may be degrees")
    if low >= high:
        raise entry.error("limits", "a least value below the greatest", f"{low} and {high}")
    return Joint(name, kind, (low, high), velocity, acceleration)


def _angle(entry: Table, key: str) -> Angle:
    try:
        return read_angle(entry.values.get(key, 0))
    except NotANumber as error:
        raise entry.error(key, EXPECTED, str(error)) from None


def _text(table: Table, key: str, default: str) -> str:
    value = table.values.get(key, default)
    if not isinstance(value, str):
        raise table.error(key, "a text", describe(value))
    return value


MOST_POINTS = 40


def load_route(path: Path) -> dict[str, Bezier]:
    """The curves of a file by name, in order. Raises ``InputError``."""
    return read_route(read_text(path), str(path))


def read_route(text: str, source: str = "<path>") -> dict[str, Bezier]:
    """The curves that TOML text describes. Raises ``InputError``."""
    table = Table.parse(text, source)
    table.only(("curve",))
    result = curves_of(table)
    if not result:
        raise table.error("curve", "tables [[curve]]", "none")
    return result


def curves_of(table: Table, least: int = 2) -> dict[str, Bezier]:
    """The curves of a table by name, of so many points at least. Raises ``InputError``."""
    result: dict[str, Bezier] = {}
    for i, entry in enumerate(table.tables("curve")):
        entry.only(("points", "name", "spline"))
        name = entry.values.get("name", f"curve {i + 1}")
        if not isinstance(name, str) or not name or name in result:
            raise entry.error("name", "a name of its own for each curve", describe(name))
        is_spline = entry.values.get("spline", False)
        if not isinstance(is_spline, bool):
            raise entry.error("spline", "true or false", describe(is_spline))
        points = _points(entry, 2 if is_spline else least)
        spans = natural_spline(points) if is_spline else [Bezier.of(points)]
        result |= {name if len(spans) == 1 else f"{name}, span {k}": c for k, c in enumerate(spans, start=1)}
    return result


def _points(entry: Table, least: int) -> list[Vector]:
    raw = entry.required("points", "a list of points")
    if not isinstance(raw, list) or not least <= len(raw) <= MOST_POINTS:
        raise entry.error("points", f"{least} to {MOST_POINTS} points", describe(raw))
    return [entry.as_point(f"points[{i}]", p) for i, p in enumerate(raw)]


def natural_spline(points: Sequence[Vector]) -> list[Bezier]:
    """The natural cubic spline through the points, with equal steps of the parameter, as one Bézier curve for each
    span.

    With slopes m_i: m_{i-1} + 4 m_i + m_{i+1} = 3 (p_{i+1} - p_{i-1}) inside, 2 m_0 + m_1 = 3 (p_1 - p_0) and likewise
    at the end (C. de Boor, A Practical Guide to Splines, chapter IV). Exact.
    """
    n, third = len(points), Fraction(1, 3)
    right = [scale(3, subtract(points[min(i + 1, n - 1)], points[max(i - 1, 0)])) for i in range(n)]
    matrix = [[(abs(i - j) == 1) + (4 - 2 * (i in (0, n - 1))) * (i == j) for j in range(n)] for i in range(n)]
    work, _ = echelon([[*map(Fraction, row), *r] for row, r in zip(matrix, right, strict=True)])
    slopes = [tuple(row[n:]) for row in work]
    return [
        Bezier((p, add(p, scale(third, u)), subtract(q, scale(third, v)), q))
        for p, q, u, v in zip(points, points[1:], slopes, slopes[1:], strict=False)
    ]


Exact = Fraction | RealAlgebraic

EXACT = 'an exact number such as 3/4, 0.75 or "44*sqrt(2) + 120"'
MOST_ROOTS = 4
_NUMBER = r"(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"


def read_exact(text: str) -> Exact:
    """The number that the text stands for, also with the minus sign of printed pages. Raises ``InputError``."""
    text = text.replace("−", "-")
    try:
        return parse(text)
    except NotANumber as error:
        if "sqrt" not in text or len(text) > MAX_CHARACTERS:
            raise InputError(f"expected {EXACT}, found {error}") from None
    refused = InputError(f'expected {EXACT}, found "{shorten(text)}"')
    if text.count("sqrt") > MOST_ROOTS:
        raise InputError(f"expected at most {MOST_ROOTS} square roots in a number, found {text.count('sqrt')}")
    if "**" in text or not re.fullmatch(rf"(?:sqrt\(|{_NUMBER}|[\s()+*/-])*", text):
        raise refused
    try:
        for number in re.findall(_NUMBER, text):
            parse(number)
        result = qe.find_instance(f"x = {text}")
    except (NotANumber, InputError) as error:
        raise InputError(f"{refused}: {re.sub('^<text>:[0-9:]* ', '', str(error))}") from None
    if result is None:
        raise InputError(f"{refused}, which divides by zero or has the root of a negative number")
    return result["x"]
