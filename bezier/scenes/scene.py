"""A scene: a workspace in the plane or in space, closed obstacles in it, a start and a goal; all rational."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import product
from math import prod
from pathlib import Path
from typing import Any

from bezier.curves.scalar import dot, subtract
from bezier.input import stored
from bezier.input.numbers import describe
from bezier.input.toml_table import Table, read_text
from bezier.obstacles.bodies import Cylinder, HalfSpaceBody, Rounded
from bezier.obstacles.obstacle import Constraint, Obstacle, half_space, pieces_of
from bezier.obstacles.polyhedron import Facet, Polytope, from_sides, point, segment
from bezier.obstacles.reader import KEYS_OF, MAX_PIECES, read_obstacles
from bezier.scenes.cells import Cell, Point, Side
from bezier.scenes.mesh import MOST_FACETS, Surface, around_polygons, load_mesh
from bezier.scenes.solid import ZERO, Solid
from qe.errors import InputError

KEYS = ("domain", "obstacle", "start", "goal", "margin")
NOTES = ("name", "dim")
"""Keys without a meaning here, which files of scenes often have."""
_ALSO = {"disc": "ball", "polygon": "polyhedron", "half_plane": "half_space"}
_PLANE = {
    kind.value: keys[:2] if kind is kind.BOX else keys for kind, keys in KEYS_OF.items() if kind is not kind.CYLINDER
}
"""Kinds of obstacles and their keys."""
_COMMON = ("kind", "name", "margin")


@dataclass(frozen=True, slots=True)
class Scene:
    """``domain``: its intersection is the workspace, but for the open ``holes``. ``obstacles`` are closed, so that
    those that touch leave no passage between them. ``low`` and ``high``: a box around the workspace; one unit.
    ``surfaces``: of the bodies that are no convex ones; their parts are among the obstacles. ``formulas``: obstacles
    given by conditions, and what conditions of the workspace leave out, which is open."""

    domain: tuple[Solid, ...]
    holes: tuple[Solid, ...]
    obstacles: tuple[Solid, ...]
    start: Point
    goal: Point
    low: Point
    high: Point
    surfaces: tuple[Surface, ...] = ()
    formulas: tuple[Solid, ...] = ()

    @property
    def dimension(self) -> int:
        """2 in the plane, 3 in space."""
        return len(self.start)

    @property
    def solids(self) -> tuple[Solid, ...]:
        """The convex bodies in the way: obstacles and holes."""
        return (*self.obstacles, *self.holes)

    @property
    def bodies(self) -> tuple[Solid, ...]:
        """All that is in the way."""
        return (*self.solids, *self.formulas)

    @property
    def conditions(self) -> tuple[Constraint, ...]:
        """Those of formulas, each once."""
        return tuple(dict.fromkeys(c for body in self.formulas for piece in body.pieces for c in piece))

    def blocked_at(self, point: Point) -> str | None:
        """What a point is in the way of: an obstacle, or the end of the domain; None where it is free."""
        held = [body for body in self.bodies if body.contains(point)]
        if not all(part.contains(point) for part in self.domain) or any(body.is_open for body in held):
            return "outside the domain"
        return f"in {held[0].name}" if held else None


def read_scene(table: Table, ends: tuple[Point, Point] | None = None) -> Scene:
    """A scene from a table with ``start``, ``goal``, ``domain`` (one table or a list whose intersection it is),
    ``obstacle``, a list, and ``margin``, which is added to that of every obstacle. ``ends``: start and goal in place of
    those of the table, which then need not have a domain. The kinds of obstacles and workspaces are in docs/scenes.md.
    Raises ``qe.InputError``, naming the key.
    """
    values = {("obstacle" if key == "obstacles" else key): value for key, value in table.values.items()}
    table = replace(table, values={key: value for key, value in values.items() if key not in NOTES})
    table.only(KEYS)
    if ends is None:
        size = len(raw) if isinstance(raw := table.required("start", "a point"), list) else 0
        if size not in (2, 3):
            raise table.error("start", "a point of 2 or 3 numbers", describe(raw))
        start, goal = (table.as_point(key, table.required(key, "a point"), size) for key in ("start", "goal"))
    else:
        (start, goal), size = ends, len(ends[0])
    domain, holes, span = tuple[Solid, ...](), tuple[Solid, ...](), None
    if ends is None or "domain" in table.values:
        domain, holes = _domain(table, size)
        span = _around(table, domain)
    extra, bodies, surfaces = table.not_negative("margin"), list[Solid](), list[Surface]()
    for k, entry in enumerate(table.tables("obstacle"), start=1):
        surface = _surface(entry, k, size)
        if surface is not None:
            surfaces.append(surface)
            margin = entry.not_negative("margin") + extra
            parts = enumerate(surface.cores, start=1)
            bodies += (of_sides(f"{surface.name}, part {i}", c.corners, c.sides, margin) for i, c in parts)
        elif (body := _solid(entry, k, size, extra, None if ends else span)) is not None:
            bodies.append(body)
    formulas = tuple(body for body in (*bodies, *holes) if body.is_formula)
    convex, holes = (tuple(b for b in listed if not b.is_formula) for listed in (bodies, holes))
    return Scene(domain, holes, convex, start, goal, *(span or (start, goal)), tuple(surfaces), formulas)


def load_scene(file: Path) -> Scene:
    """The scene of a file: see ``load_table``. Raises ``qe.InputError``."""
    return read_scene(load_table(file))


def load_table(file: Path) -> Table:
    """The table of a JSON file, or of a TOML file where its name ends so; decimals are exact. Raises ``InputError``."""
    if file.suffix.lower() == ".toml":
        return Table.load(file)
    try:
        given = stored.parsed(read_text(file))
    except (ValueError, RecursionError) as error:
        raise InputError(f"{file}: expected a JSON file, or one whose name ends in .toml, found: {error}") from None
    if not isinstance(given, dict):
        raise InputError(f"{file}: expected an object with domain, obstacle, start and goal, found {describe(given)}")
    return Table(given, str(file))


# --- workspaces ----------------------------------------------------------------------------------------
def _domain(table: Table, size: int) -> tuple[tuple[Solid, ...], tuple[Solid, ...]]:
    raw = table.required("domain", "a table with low and high, or with kind")
    entries = table.tables("domain") if isinstance(raw, list) else (table.inner("domain"),)
    parts, holes = list[Solid](), list[Solid]()
    for entry in entries:
        kind = _kind(entry, "box")
        if kind not in ("box", "ball", "polyhedron", "half_space", "cylinder", "half_ball", "annulus", "formula"):
            raise entry.error("kind", "the kind of a workspace: box, ball, half_ball, polyhedron, ...", describe(kind))
        if "margin" in entry.values:
            raise entry.error("margin", "no margin of a workspace", describe(entry.values["margin"]))
        if kind == "annulus":
            entry.only((*_COMMON, "centre", "inner", "outer", *(("bottom", "top") if size == 3 else ())))
            tube = {k: v for k, v in entry.values.items() if k not in ("inner", "outer")}
            if entry.positive("inner") >= entry.positive("outer"):
                raise entry.error("inner", "a radius below outer", str(entry.number("inner")))
            tube["kind"] = "cylinder" if size == 3 else "ball"
            radii = (entry.number("outer"), entry.number("inner"))
            outer, inner = (_part(replace(entry, values={**tube, "radius": str(r)}), size) for r in radii)
            parts.append(outer)
            opened = tuple(tuple(replace(c, strict=True) for c in piece) for piece in inner.pieces)
            holes.append(replace(inner, name="hole", pieces=opened, is_open=True))
        elif kind == "half_ball":
            whole = _part(replace(entry, values={**entry.values, "kind": "ball"}), size)
            up = tuple(-Fraction(k == size - 1) for k in range(size))
            floor = up, -whole.corners[0][-1]
            parts += [whole, Solid("domain", (), (floor,), ZERO, (_conditions((floor,)),))]
        elif kind == "formula":
            holes.append(_beyond(entry, _part(entry, size)))
        else:
            parts.append(_part(replace(entry, values={**entry.values, "kind": kind}), size))
    return tuple(parts), tuple(holes)


def _beyond(entry: Table, formula: Solid) -> Solid:
    """What a formula leaves out."""
    if prod(map(len, formula.pieces)) > MAX_PIECES:
        raise entry.error("formula", f"a set whose complement has at most {MAX_PIECES} pieces", "one with more")
    pieces = product(*([c.negated for c in piece] for piece in formula.pieces))
    return replace(formula, name="hole", pieces=tuple(pieces), is_open=True)


def _part(entry: Table, size: int) -> Solid:
    solid = _solid(entry, 0, size, ZERO, None)
    if solid is None or (isinstance(solid.body, Cylinder) and not solid.corners):
        raise entry.error("bottom", "bottom and top of a workspace", "a cylinder without end")
    return solid


def _around(table: Table, domain: Sequence[Solid]) -> tuple[Point, Point]:
    """The corners of a box around the workspace."""
    boxes = [part.low_high() for part in domain if part.corners]
    if not boxes:
        raise table.error("domain", "a bounded workspace", "half-spaces and formulas only")
    low = tuple(max(c) for c in zip(*(b[0] for b in boxes), strict=True))
    high = tuple(min(c) for c in zip(*(b[1] for b in boxes), strict=True))
    sides = [side for part in domain if part.is_polytope for side in part.sides]
    whole = Cell.within(low, high, sides) if all(a < b for a, b in zip(low, high, strict=True)) else None
    if whole is None:
        raise table.error("domain", "low < high in each coordinate, a workspace with an inside", "one without")
    axes = list(zip(*whole.corners, strict=True))
    return tuple(map(min, axes)), tuple(map(max, axes))


# --- obstacles -----------------------------------------------------------------------------------------
def _kind(entry: Table, usual: str = "") -> str:
    raw = entry.values.get("kind", usual) if usual else entry.required("kind", "the kind of obstacle")
    return _ALSO.get(raw, raw) if isinstance(raw, str) else describe(raw)


def _surface(entry: Table, k: int, size: int) -> Surface | None:
    """The surface of a mesh, or of a polygon with holes or that is not convex; None for others."""
    name, kind = str(entry.values.get("name", f"obstacle {k}")), entry.values.get("kind")
    if kind == "mesh" and size == 3:
        entry.only((*_COMMON, "file", "scale", "shift"))
        file = entry.required("file", "the name of an STL, OBJ or PLY file")
        if not isinstance(file, str):
            raise entry.error("file", "the name of an STL, OBJ or PLY file", describe(file))
        shift = entry.point("shift") if "shift" in entry.values else (ZERO,) * 3
        triangles = load_mesh(Path(entry.source).parent / file, entry.positive("scale", Fraction(1)), shift)
        return Surface.of(f"mesh {file}", triangles)
    if kind != "polygon" or size != 2 or "vertices" not in entry.values:
        return None
    entry.only((*_COMMON, *_PLANE["polyhedron"], "holes"))
    holes = entry.values.get("holes", [])
    if not isinstance(holes, list):
        raise entry.error("holes", "a list of lists of points", describe(holes))
    outlines = [_outline(entry, "vertices", entry.values["vertices"])]
    outlines += (_outline(entry, f"holes[{i}]", hole) for i, hole in enumerate(holes))
    surface = Surface.of(f"polygon {name}", around_polygons(outlines))
    return None if len(surface.cores) == 1 else surface


def _outline(entry: Table, key: str, raw: object) -> list[Point]:
    if not isinstance(raw, list) or not 3 <= len(raw) <= MOST_FACETS:
        raise entry.error(key, f"3 to {MOST_FACETS} points, one after the other around", describe(raw))
    return [entry.as_point(f"{key}[{i}]", p, 2) for i, p in enumerate(raw)]


def of_sides(name: str, corners: Sequence[Point], sides: Sequence[Side], margin: Fraction) -> Solid:
    """A convex body by all of its corners and sides, with margin: in the plane with a rectangle over each side and a
    disc around each corner."""
    flat = len(corners[0]) == 2
    body = Rounded(_polygon(corners, sides) if flat else from_sides(corners, sides), margin)
    return _of_body(name, corners, sides, margin, body, flat)


def _of_body(
    name: str, corners: Sequence[Point], sides: Sequence[Side], margin: Fraction, body: Rounded, flat: bool
) -> Solid:
    pieces = tuple(_at_level(p.constraints) if flat else p.constraints for p in pieces_of(body))
    return Solid(name, tuple(corners), tuple(sides), margin, pieces, body=body, margin=margin)


def _polygon(corners: Sequence[Point], sides: Sequence[Side]) -> Polytope:
    """A polygon at the height 0, whose sides are its facets."""
    facets = []
    for n, c in sides:
        i, j = (k for k, p in enumerate(corners) if dot(n, p) == c)
        ends = ((subtract(corners[a], corners[b]), corners[a]) for a, b in ((i, j), (j, i)))
        facets.append(Facet((*n, ZERO), c, (i, j), tuple(((*d, ZERO), Fraction(dot(d, p))) for d, p in ends)))
    return Polytope(tuple((*p, ZERO) for p in corners), (), tuple(facets))


def _solid(entry: Table, k: int, size: int, extra: Fraction, span: tuple[Point, Point] | None) -> Solid | None:
    """One obstacle, or a part of the domain; None for a half-space that is beyond the corners ``span`` of a box around
    all that matters. Without these what is unbounded has no corners."""
    margin = entry.number("margin", ZERO) + extra
    name = str(entry.values.get("name", f"{entry.values.get('kind')} {k}"))
    if _kind(entry) == "box" and "low" in entry.values:
        return _box(entry, name, size, margin)
    obstacle = _obstacle(entry, size, extra)
    if (
        size == 2
        and obstacle.body is None
        and any(e[2] for piece in obstacle.pieces for c in piece.constraints for e, _ in c.terms)
    ):
        raise entry.error("formula", "no free variables but x and y", "z")
    pieces = tuple(_at_level(piece.constraints) if size == 2 else piece.constraints for piece in obstacle.pieces)
    match obstacle.body:
        case HalfSpaceBody(normal, offset, radius):
            corners, sides = tuple[Point, ...](), tuple[Side, ...](((normal[:size], offset),))
            if span is not None:
                low, high = (tuple(c + s * (radius + 1) for c in end) for s, end in zip((-1, 1), span, strict=True))
                part = Cell.within(low, high, sides)
                if part is None:
                    return None
                corners, sides = part.corners, part.sides
            return Solid(name, corners, sides, radius, pieces, body=obstacle.body, margin=margin)
        case Cylinder(centre, wide, bottom, top, radius):
            if span is not None:
                bottom = span[0][2] - radius - 1 if bottom is None else bottom
                top = span[1][2] + radius + 1 if top is None else top
            corners = () if bottom is None or top is None else tuple((*centre, h) for h in (bottom, top))
            axis = (ZERO, ZERO, Fraction(1))
            caps = ((axis, corners[1][2]), (tuple(-x for x in axis), -corners[0][2])) if corners else ()
            return Solid(name, corners, caps, radius, pieces, wide, body=obstacle.body, margin=margin)
        case Rounded(core, radius):
            corners = tuple(dict.fromkeys(c[:size] for c in core.corners))
            faces = tuple((f.normal[:size], f.offset) for f in core.facets if any(f.normal[:size]))
            if size == 2 and faces:
                return of_sides(name, corners, faces, margin)
            return Solid(name, corners, faces, radius, pieces, body=obstacle.body, margin=margin)
    bare = obstacle if not margin else _obstacle(replace(entry, values={**entry.values, "margin": "0"}), size, ZERO)
    given = tuple(piece.constraints for piece in bare.pieces)
    if any(c.strict for piece in given for c in piece):
        raise entry.error("formula", "a closed set: conditions with <=, >= and =", "another condition")
    return Solid(name, (), (), ZERO, pieces, margin=margin, core=given)


def _obstacle(entry: Table, size: int, extra: Fraction) -> Obstacle:
    """The obstacle in space; of the plane, where z = 0 its section."""
    kind = _kind(entry)
    values = {("centre" if key == "center" else key): value for key, value in entry.values.items()}
    margin = entry.number("margin", ZERO) + extra
    if size == 2 and kind in ("box", "polyhedron"):  # polygons get it later
        margin = min(margin, ZERO)
    values |= {"kind": kind, "margin": str(margin)}
    if size == 2:
        if kind not in _PLANE:
            raise entry.error("kind", f"one of {', '.join(_PLANE)}", f'"{kind}"')
        replace(entry, values=values).only((*_COMMON, *_PLANE[kind]))
        high = str(Fraction(values["margin"]) + 1)
        values = {key: _raised(replace(entry, values=values), key, value, high) for key, value in values.items()}
    whole = Table({"obstacle": [values]}, entry.source, (), "", entry.names)
    try:
        (obstacle,) = read_obstacles(whole)
    except InputError as error:
        raise InputError(str(error).replace("obstacle[0].", entry.prefix)) from None
    return obstacle


def _raised(entry: Table, key: str, value: Any, high: str) -> Any:
    """A value of a table of the plane as that of a prism around z = 0, or of a ball or capsule there."""
    rows = {"vertices": 2, "half_spaces": 3}
    if key in rows:
        if not isinstance(value, list) or not all(isinstance(row, list) and len(row) == rows[key] for row in value):
            raise entry.error(key, f"a list of rows of {rows[key]} numbers", describe(value))
        if key == "vertices":
            return [[*row, z] for row in value for z in (f"-{high}", high)]
        return [*([a, b, 0, c] for a, b, c in value), [0, 0, 1, high], [0, 0, -1, high]]
    if key in ("centre", "low", "high", "normal", "start", "end"):
        entry.as_point(key, value, 2)
        return [*value, {"low": f"-{high}", "high": high}.get(key, 0)]
    return value


def _box(entry: Table, name: str, size: int, margin: Fraction) -> Solid:
    """A box, which may be flat."""
    entry.only((*_COMMON, "low", "high"))
    low, high = (entry.as_point(key, entry.required(key, "a point"), size) for key in ("low", "high"))
    if not all(a <= b for a, b in zip(low, high, strict=True)):
        raise entry.error("high", "low <= high in each coordinate", f"({', '.join(map(str, high))})")
    cell = Cell.box(low, high)
    if margin < 0:
        raise entry.error("margin", "a number that is not negative", str(margin))
    if not cell.is_flat:
        return of_sides(name, cell.corners, cell.sides, margin)
    if not margin:
        return Solid(name, cell.corners, cell.sides, ZERO, (_conditions(cell.sides),))
    if len(cell.corners) > 2:
        raise entry.error("margin", "no margin of a box without an inside", str(margin))
    ends = [(*c, ZERO)[:3] for c in cell.corners]
    core = point(ends[0]) if len(ends) == 1 else segment(*ends)
    return _of_body(name, cell.corners, (), margin, Rounded(core, margin), size == 2)


def _conditions(sides: Sequence[Side]) -> tuple[Constraint, ...]:
    return tuple(half_space((*n, ZERO)[:3], c) for n, c in sides)


def _at_level(piece: Sequence[Constraint]) -> tuple[Constraint, ...]:
    """The conditions where z = 0."""
    return tuple(replace(c, terms=tuple((e, x) for e, x in c.terms if not e[2])) for c in piece)


def given_scene(given: object, source: str, value: Any) -> Scene:
    """A scene as it is, of a file, or of a mapping, whose values ``value`` makes those of a table."""
    if isinstance(given, Scene):
        return given
    if isinstance(given, str | Path):
        return load_scene(Path(given))
    if not isinstance(given, Mapping):
        raise InputError(f"{source}: expected a mapping or a file, found {describe(given)}")
    return read_scene(Table(value(given, source), source))
