"""Meshes, and polygons that need not be convex, as unions of convex bodies: cut along their own planes, exactly.

The surface is a list of facets, triangles in space and segments in the plane, from which what is inside is to the back.
A box around it is cut by planes of facets until no facet goes through the inside of a cell. THEOREM. Where cells cover
the box, none has a point of the surface in its interior, and each has in it one point around which the surface goes
once (a piece) or not at all (a cell beside), the pieces are exactly what is inside the surface, with the surface.
PROOF. How often the surface goes around a point does not change in the interior of a cell, which is connected; what is
in no piece is in the closed cells beside, and near it nothing else. The first two conditions are sentences for the
kernel (``bezier.scenes.sentences``), the third is counted along a ray, exactly, by ``Surface.check``.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from io import BytesIO
from operator import mul
from pathlib import Path

from bezier.curves.scalar import dot, subtract
from bezier.input.toml_table import read_bytes
from bezier.proofs.square_roots import cross
from bezier.scenes.cells import Cell, Point, Side, opposite, primitive
from qe.errors import CertificateRejected, InputError
from qe.extras import wanted

MOST_BYTES, MOST_FACETS, MOST_CELLS, CANDIDATES = 10_000_000, 1_000, 400, 24
UNREADABLE = (
    ValueError,
    LookupError,
    TypeError,
    AttributeError,
    ArithmeticError,
    AssertionError,
    ImportError,
    RuntimeError,
)
"""What trimesh raises for a file that is no mesh; an import error where it would guess the coding of its text."""
RAYS = tuple((Fraction(97), Fraction(31 * k + 5), Fraction(17 * k * k - 59)) for k in range(40))
"""Directions in which crossings are counted; one that meets the rim of a facet says nothing."""


def facet(corners: Sequence[Point]) -> Cell | None:
    """A simplex by its corners, in space counterclockwise as seen from outside: its first side is its plane, with the
    normal outwards, the second the opposite one. None where the corners are on a line, or one point."""
    along = subtract(corners[1], corners[0])
    normal = (along[1], -along[0]) if len(corners) == 2 else cross(along, subtract(corners[2], corners[0]))
    if not any(normal):
        return None
    plane, rim = primitive((normal, Fraction(dot(normal, corners[0])))), list[Side]()
    for a, b in zip(corners, (*corners[1:], corners[0]), strict=True):
        out = subtract(b, a) if len(corners) == 2 else cross(subtract(b, a), normal)
        rim.append(primitive((out, Fraction(dot(out, b)))))
    return Cell.of((plane, opposite(plane), *rim), corners, is_flat=True)


@dataclass(frozen=True, slots=True)
class Surface:
    """A closed surface, ``solids``, whose cores are what is inside, and the cells ``beside`` them in a box around."""

    name: str
    facets: tuple[Cell, ...]
    around: Cell
    cores: tuple[Cell, ...]
    beside: tuple[Cell, ...]

    @staticmethod
    def of(name: str, simplices: Sequence[Sequence[Point]]) -> Surface:
        """Raises ``InputError`` where it is not a closed surface that does not meet itself, or has too many parts."""
        facets = [*_facets(name, simplices)]
        _refuse_open(name, facets)
        _refuse_crossed(name, facets)
        axes = [*zip(*(p for part in facets for p in part.corners), strict=True)]
        around = Cell.box(tuple(min(c) - 1 for c in axes), tuple(max(c) + 1 for c in axes))
        sorted_cells: dict[int, list[Cell]] = {0: [], 1: []}
        for cell in _cut(name, around, facets):
            count = winding(facets, cell.centre)
            if count not in (0, 1):
                why = "inside out" if count < 0 else "one part of it around another, both with the same side outwards"
                raise InputError(f"{name}: expected a surface with its outer side outwards, found {why}")
            sorted_cells[count].append(cell)
        return Surface(name, tuple(facets), around, *(tuple(_merged(around, sorted_cells[k])) for k in (1, 0)))

    def check(self) -> None:
        """Whether it is closed, and goes once around each piece and not around the cells beside.
        Raises ``CertificateRejected``."""
        try:
            _refuse_open(self.name, self.facets)
        except InputError as error:
            raise CertificateRejected(self.name, str(error)) from None
        for cells, count in ((self.cores, 1), (self.beside, 0)):
            for cell in cells:
                if cell.is_flat or any(_goes_through(part, cell) for part in self.facets):
                    raise CertificateRejected(self.name, "the surface goes through the inside of a cell")
                if winding(self.facets, cell.centre) != count:
                    raise CertificateRejected(self.name, "a cell is on the wrong side of the surface")


# --- reading -------------------------------------------------------------------------------------------
def load_mesh(file: Path, scale: Fraction, shift: Point) -> list[tuple[Point, ...]]:
    """The triangles of an STL, OBJ or PLY file, their coordinates the numbers that its floats are, times a factor, and
    moved. Raises ``InputError``; ``Unable`` without trimesh."""
    kind = file.suffix.lower().lstrip(".")
    if kind not in ("stl", "obj", "ply"):
        raise InputError(f"mesh {file}: expected a file whose name ends in .stl, .obj or .ply")
    data = read_bytes(file, MOST_BYTES)
    with wanted():
        import trimesh
    try:
        mesh = trimesh.load_mesh(BytesIO(data), file_type=kind, process=False)
        rows = mesh.vertices[mesh.faces].tolist()
    except UNREADABLE:
        raise InputError(f"mesh {file}: expected a mesh as .{kind} files have it, found none") from None
    if not rows:
        raise InputError(f"mesh {file}: expected triangles, found none")
    if len(rows) > MOST_FACETS:
        raise InputError(f"mesh {file}: expected at most {MOST_FACETS} triangles, found {len(rows)}")
    try:
        exact = [[[Fraction(c) for c in p] for p in row] for row in rows]
    except (ValueError, OverflowError):
        raise InputError(f"mesh {file}: expected finite coordinates") from None
    return [tuple(tuple(scale * c + s for c, s in zip(p, shift, strict=True)) for p in row) for row in exact]


def around_polygons(outlines: Sequence[Sequence[Point]]) -> list[tuple[Point, Point]]:
    """The sides of a polygon, the first outline, with holes, the others, given in either direction."""
    result = list[tuple[Point, Point]]()
    for k, points in enumerate(outlines):
        pairs = [*zip(points, (*points[1:], points[0]), strict=True)]
        area = sum(a[0] * b[1] - a[1] * b[0] for a, b in pairs)
        result += pairs if (area > 0) == (k == 0) else [(b, a) for a, b in pairs]
    return result


def _facets(name: str, simplices: Sequence[Sequence[Point]]) -> Iterator[Cell]:
    for k, corners in enumerate(simplices, start=1):
        one = facet(corners)
        if one is None:
            raise InputError(f"{name}: {_kind(corners)} {k} is flat: {_text(corners)}")
        yield one


def _refuse_open(name: str, facets: Sequence[Cell]) -> None:
    """Each edge (in the plane: each corner) belongs to two facets, for which it runs in opposite directions."""
    signs: dict[tuple[Point, ...], list[int]] = {}
    for part in facets:
        for end, sign in _ends(part.corners):
            signs.setdefault(end, []).append(sign)
    for end, found in signs.items():
        kind = _kind(facets[0].corners)
        edge = f"{'edge' if kind == 'triangle' else 'corner'} {_text(end)} belongs to"
        if len(found) != 2:
            raise InputError(f"{name}: not closed ({edge} {len(found)} {kind}{'s' * (len(found) > 1)})")
        if sum(found):
            raise InputError(f"{name}: not oriented ({edge} two {kind}s for which it runs in the same direction)")


def _ends(corners: Sequence[Point]) -> Iterator[tuple[tuple[Point, ...], int]]:
    for a, b in zip(corners, (*corners[1:], corners[0]), strict=True):
        if len(corners) == 2:
            yield (a,), 1 if a == corners[0] else -1
        else:
            yield ((a, b), 1) if a < b else ((b, a), -1)


def _refuse_crossed(name: str, facets: Sequence[Cell]) -> None:
    """No two facets have more in common than corners and the edge between these."""
    boxes = [tuple((min(c), max(c)) for c in zip(*part.corners, strict=True)) for part in facets]
    order, open_ones = sorted(range(len(facets)), key=lambda i: boxes[i][0]), list[int]()
    for i in order:
        open_ones = [j for j in open_ones if boxes[j][0][1] >= boxes[i][0][0]]
        for j in open_ones:
            if all(a <= d and c <= b for (a, b), (c, d) in zip(boxes[i], boxes[j], strict=True)):
                points, shared = facets[i].corners, {*facets[i].corners} & {*facets[j].corners}
                for side in facets[j].sides:
                    points = behind(points, side)
                if not {*points} <= shared or len(shared) == len(facets[i].corners):
                    a, b = sorted((i + 1, j + 1))
                    raise InputError(f"{name}: self-intersecting: {_kind(facets[i].corners)}s {a} and {b}")
        open_ones.append(i)


def _kind(corners: Sequence[Point]) -> str:
    return "side" if len(corners) == 2 else "triangle"


def _text(points: Sequence[Point]) -> str:
    return " - ".join("(" + ", ".join(f"{float(c):.6g}" for c in p) + ")" for p in points)


# --- cells ---------------------------------------------------------------------------------------------
def behind(points: Sequence[Point], side: Side) -> tuple[Point, ...]:
    """The part of a convex polygon, or of a segment, that is on a side."""
    values, result = _levels(points, side), list[Point]()
    for k, (p, a) in enumerate(zip(points, values, strict=True)):
        q, b = points[k - 1], values[k - 1]
        if a * b < 0:
            result.append(tuple(x + a / (a - b) * (y - x) for x, y in zip(p, q, strict=True)))
        if a <= 0:
            result.append(p)
    return tuple(result)


def _levels(points: Sequence[Point], side: Side) -> list[Fraction]:
    return [Fraction(dot(side[0], p)) - side[1] for p in points]


def _cut(name: str, around: Cell, facets: Sequence[Cell]) -> Iterator[Cell]:
    """The cells of the box, until no facet goes through the inside of one."""
    waiting, count = [(around, [(part.sides[0], part) for part in facets])], 1
    while waiting:
        cell, parts = waiting.pop()
        if not parts:
            yield cell
            continue
        side, count = _least_cutting(parts), count + 1
        if count > MOST_CELLS:
            raise InputError(f"{name}: expected a surface that {MOST_CELLS} convex cells do for, found one with more")
        cuts = [(own, part.cut(side)) for own, part in parts if any(part.signs(side))]
        for k, half in enumerate(cell.cut(side)):
            assert half is not None
            waiting.append((half, [(own, part) for own, halves in cuts if (part := halves[k]) is not None]))


def _least_cutting(parts: Sequence[tuple[Side, Cell]]) -> Side:
    """Of some of the planes of facets one that cuts few others, and leaves as few as can be on its larger side."""
    planes = [*dict.fromkeys(plane for plane, _ in parts)]
    best, least = planes[0], None
    for plane in planes[:: max(1, len(planes) // CANDIDATES)]:
        normal, level = tuple(map(float, plane[0])), float(plane[1])
        near = 1e-9 * (abs(level) + sum(map(abs, normal)))
        cuts, sides = 0, [0, 0]
        for _, part in parts:
            heights = [sum(map(mul, normal, p)) - level for p in part.floats]
            below, above = min(heights) < -near, max(heights) > near
            cuts, sides = cuts + (below and above), [sides[0] + below, sides[1] + above]
        cost = 8 * cuts + (max(sides) if min(sides) else 0)
        if least is None or cost < least:
            best, least = plane, cost
    return best


def _goes_through(facet: Cell, cell: Cell) -> bool:
    """Whether a facet has a point in the interior: what is left of it on all sides is not in the plane of one side."""
    if any(min(facet.signs(side)) >= 0 for side in cell.sides) or not {-1, 1} <= {*cell.signs(facet.sides[0])}:
        return False
    points = facet.corners
    for side in cell.sides:
        points = behind(points, side)
        if not points or not any(_levels(points, side)):
            return False
    return True


def winding(facets: Sequence[Cell], point: Point) -> int:
    """How often a surface goes around a point that is not on it: crossings of a ray outwards less those inwards."""
    for ray in RAYS:
        crossings = [_crossing(part, point, ray[: len(point)]) for part in facets]
        if None not in crossings:
            return sum(c for c in crossings if c)
    raise CertificateRejected("surface", "every ray meets the rim of a facet")


def _crossing(facet: Cell, point: Point, ray: Point) -> int | None:
    """1 where a ray leaves through a facet, -1 where it enters, 0 where it does not meet it, None where it grazes."""
    normal, level = facet.sides[0]
    ahead, rate = level - Fraction(dot(normal, point)), Fraction(dot(normal, ray))
    if not rate:
        return None
    if ahead * rate <= 0:
        return 0
    share = ahead / rate
    at = tuple(p + share * r for p, r in zip(point, ray, strict=True))
    is_on_rim = False
    for side in facet.sides[2:]:
        (over,) = _levels((at,), side)
        if over > 0:
            return 0
        is_on_rim = is_on_rim or not over
    return None if is_on_rim else 1 if rate > 0 else -1


def _merged(around: Cell, cells: Sequence[Cell]) -> list[Cell]:
    """As few cells as two at a time can be put together to convex ones: where all sides of both but the common one
    hold both, they are the parts of one polytope on the two sides of that."""
    result, waiting = list[Cell](), list(cells)
    while waiting:
        one = waiting.pop()
        for k, other in enumerate(result):
            sides = _joint(one, other)
            if sides is not None:
                whole = Cell.within(around.corners[0], around.corners[-1], sides)
                assert whole is not None
                waiting.append(whole)
                del result[k]
                break
        else:
            result.append(one)
    return result


def _joint(one: Cell, other: Cell) -> list[Side] | None:
    """The sides of two cells together, where that is convex."""
    for side in {*one.sides} & {*map(opposite, other.sides)}:
        rest = [s for s in one.sides if s != side], [s for s in other.sides if s != opposite(side)]
        if all(max(b.signs(s)) <= 0 for ss, b in zip(rest, (other, one), strict=True) for s in ss):
            return [*dict.fromkeys((*rest[0], *rest[1]))]
    return None
