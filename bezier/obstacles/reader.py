"""``[[obstacle]]`` tables: exact obstacles from a problem file, and one clear line for everything that is none.

Keys of each kind, all with the optional ``name``, ``margin`` (all points within this distance belong to the obstacle
too) and ``above`` (control points that have to lie at the height of its top or higher):

    ball        centre, radius
    box         low, high  |  corner, edges (three orthogonal vectors)
    half_space  normal, offset (the points with normal . p <= offset)
    cylinder    centre (x and y), radius, bottom, top (vertical; without bottom or top it goes on for ever)
    capsule     start, end, radius
    polyhedron  half_spaces ([a, b, c, d] for a x + b y + c z <= d)  |  vertices
    formula     formula (text in x, y, z)
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any

from bezier.curves.scalar import dot
from bezier.input.numbers import Literal, NotANumber, describe, read, shorten
from bezier.input.toml_table import POINT, Table
from bezier.obstacles.bodies import Body, Cylinder, HalfSpaceBody, Rounded
from bezier.obstacles.formula import formula_pieces
from bezier.obstacles.obstacle import Obstacle, ObstacleKind, from_body
from bezier.obstacles.polyhedron import (
    MAX_PARTS,
    Point,
    Polytope,
    from_corners,
    from_half_spaces,
    parallelepiped,
    point,
    segment,
)
from qe.errors import InputError

COMMON = ("kind", "name", "margin", "above")
MAX_OBSTACLES = 200
LONGEST_NAME = 100


def read_obstacles(table: Table) -> tuple[Obstacle, ...]:
    """All ``[[obstacle]]`` tables. Raises ``InputError`` naming file, line and key."""
    entries = table.tables("obstacle")
    if len(entries) > MAX_OBSTACLES:
        raise table.error("obstacle", f"at most {MAX_OBSTACLES} obstacles", str(len(entries)))
    found = [_obstacle(entry, i) for i, entry in enumerate(entries)]
    names = [item.name for item in found]
    for i, name in enumerate(names):
        if name in names[:i]:
            raise entries[i].error("name", "a name of its own for each obstacle", f'"{name}" again')
    return tuple(found)


def _obstacle(table: Table, index: int) -> Obstacle:
    kind = table.choice("kind", ObstacleKind)
    keys, build = _KINDS[kind]
    table.only((*COMMON, *keys))
    name = table.values.get("name", f"{kind.value} {index + 1}")
    if not isinstance(name, str) or not name.strip() or not name.isprintable() or len(name) > LONGEST_NAME:
        raise table.error("name", f"a name on one line, of at most {LONGEST_NAME} characters", describe(name))
    margin = table.number("margin", Fraction(0))
    if margin < 0:
        raise table.error("margin", "a number that is not negative", str(margin))
    if build is None:
        if margin:
            raise table.error("margin", "no margin for a formula (write it into the formula)", shorten(str(margin)))
        pieces, elimination = formula_pieces(table)
        return Obstacle(name, kind, pieces, stated=_stated(table.values), elimination=elimination)
    return from_body(name, kind, build(table, margin), margin, _stated(table.values))


def _stated(value: Any) -> Any:
    """A TOML value with every number written exactly; what is no number stays as it was written."""
    match value:
        case dict():
            return {key: _stated(entry) for key, entry in value.items()}
        case list():
            return [_stated(entry) for entry in value]
        case Literal(text):
            try:
                return str(read(value))
            except NotANumber:
                return text
    return value


def _ball(table: Table, margin: Fraction) -> Body:
    return Rounded(point(table.point("centre")), table.positive("radius") + margin)


def _capsule(table: Table, margin: Fraction) -> Body:
    start, end = table.point("start"), table.point("end")
    if start == end:
        raise table.error("end", "a point other than start", "the same point")
    return Rounded(segment(start, end), table.positive("radius") + margin)


def _box(table: Table, margin: Fraction) -> Body:
    if "corner" in table.values or "edges" in table.values:
        for key in ("low", "high"):
            if key in table.values:
                raise table.error(key, "either low and high, or corner and edges", "both")
        edges = _rows(table, "edges", 3, "three vectors of 3 numbers")
        if len(edges) != 3 or not all(any(e) for e in edges):
            raise table.error("edges", "three vectors other than zero", f"{len(edges)} vectors")
        if any(dot(edges[i], edges[j]) for i, j in ((0, 1), (0, 2), (1, 2))):
            raise table.error("edges", "three orthogonal vectors", "two that are not orthogonal")
        return Rounded(parallelepiped(table.point("corner"), edges), margin)
    low, high = table.point("low"), table.point("high")
    if not all(a < b for a, b in zip(low, high, strict=True)):
        raise table.error("high", "every coordinate above that of low", f"({', '.join(map(str, high))})")
    sides = [tuple(high[i] - low[i] if k == i else Fraction(0) for k in range(3)) for i in range(3)]
    return Rounded(parallelepiped(low, sides), margin)


def _half_space(table: Table, margin: Fraction) -> Body:
    normal = table.point("normal")
    if not any(normal):
        raise table.error("normal", f"{POINT}, not all zero", "the zero vector")
    return HalfSpaceBody(normal, table.number("offset"), margin)


def _cylinder(table: Table, margin: Fraction) -> Body:
    raw = table.required("centre", "the x and y of the axis")
    if not isinstance(raw, list) or len(raw) != 2:
        raise table.error("centre", "the x and y of the axis", describe(raw))
    x, y, _ = table.as_point("centre", [*raw, 0])
    bottom = table.number("bottom") if "bottom" in table.values else None
    top = table.number("top") if "top" in table.values else None
    if bottom is not None and top is not None and bottom >= top:
        raise table.error("top", f"a number above bottom = {shorten(str(bottom))}", shorten(str(top)))
    return Cylinder((x, y), table.positive("radius"), bottom, top, margin)


def _polyhedron(table: Table, margin: Fraction) -> Body:
    if ("half_spaces" in table.values) == ("vertices" in table.values):
        raise table.error("kind", "either half_spaces or vertices for a polyhedron", "both or neither")
    key, size, what, build = (
        ("half_spaces", 4, "a list of [a, b, c, d] for a x + b y + c z <= d", _from_rows)
        if "half_spaces" in table.values
        else ("vertices", 3, "a list of points", from_corners)
    )
    rows = _rows(table, key, size, what)
    try:
        return Rounded(build(rows), margin)
    except InputError as error:
        raise table.error(key, "a bounded polyhedron with interior", str(error)) from None


def _from_rows(rows: list[Point]) -> Polytope:
    for row in rows:
        if not any(row[:3]):
            raise InputError("a half-space with normal zero")
    return from_half_spaces([(row[:3], row[3]) for row in rows])


def _rows(table: Table, key: str, size: int, what: str) -> list[Point]:
    """A list of at most ``MAX_PARTS`` rows of exact numbers."""
    raw = table.required(key, what)
    if not isinstance(raw, list) or not all(isinstance(row, list) and len(row) == size for row in raw):
        raise table.error(key, what, describe(raw))
    if len(raw) > MAX_PARTS:
        raise table.error(key, f"at most {MAX_PARTS} entries", str(len(raw)))
    found = []
    for i, row in enumerate(raw):
        try:
            found.append(tuple(read(entry) for entry in row))
        except NotANumber as error:
            raise table.error(f"{key}[{i}]", f"{size} exact numbers", str(error)) from None
    return found


Reader = Callable[[Table, Fraction], Body] | None
_KINDS: Mapping[ObstacleKind, tuple[tuple[str, ...], Reader]] = {
    ObstacleKind.BALL: (("centre", "radius"), _ball),
    ObstacleKind.BOX: (("low", "high", "corner", "edges"), _box),
    ObstacleKind.HALF_SPACE: (("normal", "offset"), _half_space),
    ObstacleKind.CYLINDER: (("centre", "radius", "bottom", "top"), _cylinder),
    ObstacleKind.CAPSULE: (("start", "end", "radius"), _capsule),
    ObstacleKind.POLYHEDRON: (("half_spaces", "vertices"), _polyhedron),
    ObstacleKind.FORMULA: (("formula",), None),
}
