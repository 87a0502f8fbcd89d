"""``[[obstacle]]`` tables: exact obstacles from a problem file, and one clear line for everything that is none.

docs/obstacles.md has the keys of each kind, and the rule for via points where a problem names only obstacles.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any

import qe
from bezier.curves.scalar import Vector, add, dot, exactly, scale, subtract
from bezier.input.numbers import Literal, NotANumber, describe, read, shorten
from bezier.input.toml_table import POINT, Table
from bezier.obstacles.bodies import Body, Box, Cylinder, HalfSpaceBody, Rounded
from bezier.obstacles.obstacle import Constraint, Obstacle, ObstacleKind, Piece, from_body
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
from qe.errors import InputError, Unable
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, convert, exists
from qe.formula.normal import nnf, rename, rename_apart
from qe.formula.syntax import And, Atom, Constant, Formula, Or, Relation
from qe.io.text import read as read_formula
from qe.simplifier.factors import atom_under
from qe.simplifier.facts import NOTHING, factor_list

LIFT = Fraction(1, 10)


def via_over(
    start: Vector, goal: Vector, obstacles: Sequence[Obstacle], lift: Fraction = LIFT
) -> tuple[Vector, Vector]:
    """The two via points. Raises ``InputError`` when the start or the goal lies below or above a box in the way."""
    along = subtract(goal, start)
    boxes = [o.box for o in obstacles if o.box is not None and _shadow(start, along, o.box) is not None]
    if not boxes:
        return via_at_thirds(start, goal)
    spans = [span for box in boxes if (span := _shadow(start, along, box)) is not None]
    first, last = min(s for s, _ in spans), max(s for _, s in spans)
    if first <= 0 or last >= 1 or first == last:
        raise InputError("an obstacle above, below or around the start or the goal; give via points")
    low, high = max(((box[0][2], box[1][2]) for box in boxes), key=lambda ends: ends[1])
    height = high + lift * (high - low)
    q0, r0 = add(start, scale(first, along)), add(start, scale(last, along))
    return (*q0[:2], height), (*r0[:2], height)


def via_at_thirds(start: Vector, goal: Vector) -> tuple[Vector, Vector]:
    """The points at a third and two thirds of the way."""
    along = subtract(goal, start)
    return add(start, scale(Fraction(1, 3), along)), add(start, scale(Fraction(2, 3), along))


def _shadow(start: Vector, along: Vector, box: Box) -> tuple[Fraction, Fraction] | None:
    """The part [a, b] of [0, 1] in which start + s along, seen from above, lies in the box; None when it never does."""
    low, high = Fraction(0), Fraction(1)
    for i in range(2):
        begin, step = exactly(start[i]), exactly(along[i])
        if not step:
            if not box[0][i] <= begin <= box[1][i]:
                return None
            continue
        ends = sorted(((box[0][i] - begin) / step, (box[1][i] - begin) / step))
        low, high = max(low, ends[0]), min(high, ends[1])
    return (low, high) if low <= high else None


NAMES = ("x", "y", "z")
SPACE = Ring.of(NAMES)
MAX_PIECES = 200
ELIMINATION_SECONDS = 20.0
Constraints = tuple[Constraint, ...]


def formula_pieces(table: Table, margin: Fraction) -> tuple[tuple[Piece, ...], Any]:
    """The pieces of the obstacle ``formula = "..."``, of all points within ``margin`` of it. Raises ``InputError``
    naming the key.

    Quantifiers, also those of the margin, are eliminated first (the answer is the second result, None without any);
    then the disjunctive normal form gives the pieces.
    """
    raw = table.required("formula", "a formula in x, y, z")
    if not isinstance(raw, str):
        raise table.error("formula", "a formula in x, y, z", describe(raw))
    try:
        formula = read_formula(raw, source="formula")
    except InputError as error:
        raise table.error("formula", "a formula in x, y, z", str(error)) from None
    others = [name for name in formula.free if name not in NAMES]
    if others:
        raise table.error("formula", "no free variables but x, y, z", shorten(", ".join(others)))
    formula = _within(formula, margin) if margin and formula.free else formula
    try:
        answer: Any = None
        if not formula.is_quantifier_free:
            answer = qe.eliminate(formula, timeout=ELIMINATION_SECONDS)
            if answer.formula is None:
                raise Unable(answer.reason or "its quantifiers were not eliminated")
        pieces = _pieces(nnf(formula if answer is None else answer.formula))
    except (InputError, Unable) as error:
        wanted = "a formula that can be used" + (f" with the margin {margin}" if margin else "")
        raise table.error("formula", wanted, str(error)) from None
    if not pieces:
        raise table.error("formula", "a set that is not empty", "one that no point satisfies")
    return tuple(Piece(piece) for piece in pieces), answer


def _within(formula: Formula, margin: Fraction) -> Formula:
    """That some point where a formula holds is at most ``margin`` away. It has the same coordinates along axes of which
    the formula says nothing."""
    names = {name: f"{name}_near" for name in NAMES if name in formula.free}
    moved = rename(rename_apart(formula, names.values()), names)
    ring = Ring.of(dict.fromkeys((*names, *(moved.ring.names if moved.ring else ()))))
    away = sum(((ring.var(a) - ring.var(b)) ** 2 for a, b in names.items()), ring.constant(0))
    near = atom(away * margin.denominator**2 - margin.numerator**2, Relation.LE)
    return exists(names.values(), conj((convert(moved, ring), near)))


def _pieces(formula: Formula) -> list[Constraints]:
    """The disjunctive normal form; at most ``MAX_PIECES`` conjunctions."""
    match formula:
        case Constant(value):
            return [()] if value else []
        case Atom():  # p^2 * q <= 0 says that p = 0 or q <= 0: then signs change at boundaries
            made = atom_under(formula.poly, formula.relation, NOTHING)
            return _of_atom(made) if isinstance(made, Atom) else _pieces(made)
        case Or(args):
            result = [piece for arg in args for piece in _pieces(arg)]
        case And(args):
            result = [()]
            for arg in args:
                pairs = itertools.product(result, _pieces(arg))
                result = list(dict.fromkeys(tuple(dict.fromkeys((*a, *b))) for a, b in pairs))
                _check_number(result)
        case _:
            raise InputError("root expressions cannot be part of an obstacle")
    _check_number(result)
    return result


def _check_number(pieces: list[Constraints]) -> None:
    if len(pieces) > MAX_PIECES:
        raise InputError(f"the formula has more than {MAX_PIECES} pieces")


def _of_atom(atom: Atom) -> list[Constraints]:
    up = dict(atom.poly.convert(SPACE).terms())
    down = {e: -c for e, c in up.items()}
    match atom.relation:
        case Relation.GE | Relation.GT:
            return [(Constraint.of(up, atom.relation is Relation.GT),)]
        case Relation.LE | Relation.LT:
            return [(Constraint.of(down, atom.relation is Relation.LT),)]
        case Relation.EQ:
            factors = [(dict(f.terms()), dict((-f).terms())) for f, _ in factor_list(atom.poly.convert(SPACE))]
            return [(Constraint.of(f), Constraint.of(minus)) for f, minus in factors]
    return [(Constraint.of(up, True),), (Constraint.of(down, True),)]


COMMON = ("kind", "name", "margin", "above")
MAX_OBSTACLES = 200
LONGEST_NAME = 100


def read_obstacles(table: Table) -> tuple[Obstacle, ...]:
    """All ``[[obstacle]]`` tables. Raises ``InputError`` naming file, line and key."""
    entries = table.tables("obstacle")
    if len(entries) > MAX_OBSTACLES:
        raise table.error("obstacle", f"at most {MAX_OBSTACLES} obstacles", str(len(entries)))
    result = [_obstacle(entry, i) for i, entry in enumerate(entries)]
    names = [item.name for item in result]
    for i, name in enumerate(names):
        if name in names[:i]:
            raise entries[i].error("name", "a name of its own for each obstacle", f'"{name}" again')
    return tuple(result)


def _obstacle(table: Table, index: int) -> Obstacle:
    kind = table.choice("kind", ObstacleKind)
    keys, build = _KINDS[kind]
    table.only((*COMMON, *keys))
    name = table.values.get("name", f"{kind.value} {index + 1}")
    if not isinstance(name, str) or not name.strip() or not name.isprintable() or len(name) > LONGEST_NAME:
        raise table.error("name", f"a name on one line, of at most {LONGEST_NAME} characters", describe(name))
    margin = table.not_negative("margin")
    if build is None:
        pieces, elimination = formula_pieces(table, margin)
        return Obstacle(name, kind, pieces, None, None, margin, _stated(table.values), elimination)
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
    return [table.as_point(f"{key}[{i}]", row, size) for i, row in enumerate(raw)]


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
KEYS_OF = {kind: keys for kind, (keys, _) in _KINDS.items()}
"""The keys of each kind, but for those that all have."""
