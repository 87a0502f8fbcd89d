"""What is said of scenes, as sentences for the kernel: curves are clear, cells and walls cover a workspace."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from functools import partial
from math import comb, lcm

from bezier.curves.scalar import dot, subtract
from bezier.obstacles.obstacle import Constraint, Obstacle, ObstacleKind, Piece, half_space
from bezier.scenes.barrier import Wall
from bezier.scenes.cells import Cell, Point, Side, opposite
from bezier.scenes.scene import Scene
from bezier.scenes.solid import Solid, directions
from qe.errors import CertificateRejected
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, forall, neg
from qe.formula.normal import nnf
from qe.formula.syntax import Formula, Relation

HELD, COVERED = "the workspace is in the polytope around it", "every point of it is in a wall or in a cell"
NAMES = ("x", "y", "z")
Curve = tuple[Point, ...]
"""Control points."""


def covering(
    scene: Scene, around: Cell, walls: Sequence[Cell | Wall], cells: Sequence[Cell]
) -> Iterator[tuple[str, Formula]]:
    """That walls and cells cover a polytope around the workspace, and the walls are in what is not free."""
    at = coordinates(scene)
    covered = disj(of_sides(cell.sides, at) for cell in (*map(cell_of, walls), *cells))
    yield COVERED, every(at, disj((neg(of_sides(around.sides, at)), covered)))
    yield from enclosing(scene, around, walls)


def enclosing(scene: Scene, around: Cell, walls: Sequence[Cell | Wall]) -> Iterator[tuple[str, Formula]]:
    """That the workspace is in the polytope, and the walls are in obstacles or outside the workspace.

    Of a polytope in one convex body that is seen at its corners. Raises ``CertificateRejected``."""
    at = coordinates(scene)
    yield HELD, every(at, disj((neg(conj(inside(part, at) for part in scene.domain)), of_sides(around.sides, at))))
    for k, wall in enumerate(walls, start=1):
        if isinstance(wall, Wall):
            bodies = [scene.bodies[i] for i in wall.bodies]
            yield f"wall {k}", along((wall.start, wall.end), partial(taken, scene, bodies))
        elif not any(_holds_cell(scene, body, wall) for body in scene.solids):
            bodies = [body for body in scene.formulas if body.contains(wall.centre)]
            if not bodies:
                raise CertificateRejected(f"wall {k}", "its corners are not in one body")
            yield f"wall {k}", every(at, disj((neg(of_sides(wall.sides, at)), *(inside(b, at) for b in bodies))))


def _holds_cell(scene: Scene, body: Solid, wall: Cell) -> bool:
    """Whether the points of a box around the workspace that are on the sides of a wall are in a body, which is convex;
    their corners are found again."""
    if body.is_polytope:
        return body.sides == wall.sides
    low, high = (
        tuple(map(pick, zip(*wall.corners, end, strict=True))) for pick, end in ((min, scene.low), (max, scene.high))
    )
    part = Cell.within(low, high, wall.sides)
    return part is not None and all(map(body.contains, part.corners))


def surfaces(scene: Scene) -> Iterator[tuple[str, Formula]]:
    """That the parts of each surface and the cells beside them cover the box around it. What else they have to be is
    counted. Raises ``CertificateRejected``."""
    for surface in scene.surfaces:
        surface.check()
        known = {body.sides for body in scene.obstacles}
        if any(core.sides not in known for core in surface.cores):
            raise CertificateRejected(surface.name, "a part of it is no obstacle of the scene")
        at = coordinates(scene)
        cells = disj(of_sides(cell.sides, at) for cell in (*surface.cores, *surface.beside))
        yield (
            f"{surface.name}: cells cover the box around it",
            every(at, disj((neg(of_sides(surface.around.sides, at)), cells))),
        )


def coordinates(scene: Scene) -> list[Poly]:
    """The coordinates of a point as variables."""
    names = NAMES[: scene.dimension]
    return [Ring.of(names).var(name) for name in names]


def every(at: Sequence[Poly], formula: Formula) -> Formula:
    """That a formula holds for all points."""
    return forall(NAMES[: len(at)], nnf(formula))


def cell_of(wall: Wall | Cell) -> Cell:
    """A wall as a cell, a segment as a flat one."""
    if isinstance(wall, Cell):
        return wall
    (a, b), ahead = (wall.start, wall.end), subtract(wall.end, wall.start)
    across = -ahead[1], ahead[0]
    line, last = (across, Fraction(dot(across, a))), (ahead, Fraction(dot(ahead, b)))
    sides = last, opposite((ahead, Fraction(dot(ahead, a)))), line, opposite(line)
    return Cell.of(sides, (a, b), is_flat=True)


def beyond(scene: Scene) -> list[tuple[Constraint]]:
    """For each condition on the workspace that it does not hold."""
    return [(c.negated,) for part in scene.domain for (known,) in (part.pieces,) for c in known]


def in_the_way(scene: Scene, curves: Sequence[Curve]) -> Iterator[Obstacle]:
    """For each curve all points that are not free, as one obstacle: of every body, and beyond every side of the
    workspace. Of a body with a half-space around it that the control points are beyond, that half-space is taken, once
    it is seen to hold the body."""
    normals = directions(scene.dimension, 1)
    around = [body.around(normals) for body in scene.bodies]
    for curve in curves:
        pieces = list(map(Piece, beyond(scene)))
        for body, sides in zip(scene.bodies, around, strict=True):
            ahead = ((n, c) for n, c in sides if all(dot(n, p) > c for p in curve))
            far = next(filter(body.is_behind, ahead), None)
            wide = [(half_space((*far[0], Fraction(0))[:3], far[1]),)] if far else body.pieces
            pieces += map(Piece, wide)
        yield Obstacle("what is in the way", ObstacleKind.FORMULA, tuple(dict.fromkeys(pieces)))


def taken(scene: Scene, bodies: Sequence[Solid], at: Sequence[Poly], scale: int) -> Formula:
    """That a point is in one of the bodies or outside the workspace."""
    outside = (neg(inside(part, at, scale)) for part in scene.domain)
    return disj((*outside, *(inside(body, at, scale) for body in bodies)))


def along(curve: Curve, said: Callable[[Sequence[Poly], int], Formula]) -> Formula:
    """For all t in [0, 1] what is ``said`` of the point of a curve: its coordinates are polynomials over a number."""
    ring = Ring.of(("t",))
    t = ring.var("t")
    within = conj((atom(t, Relation.GE), atom(t - 1, Relation.LE)))
    scale, degree = lcm(*(c.denominator for p in curve for c in p)), len(curve) - 1
    at = [ring.constant(0)] * len(curve[0])
    for k, point in enumerate(curve):
        weight = t**k * (1 - t) ** (degree - k) * comb(degree, k)
        at = [total + weight * int(c * scale) for total, c in zip(at, point, strict=True)]
    return forall(("t",), nnf(disj((neg(within), said(at, scale)))))


def inside(body: Solid, at: Sequence[Poly], scale: int = 1) -> Formula:
    """That the point with the coordinates ``at`` over ``scale`` is in a body."""
    return disj(conj(c.formula(at, scale) for c in piece) for piece in body.pieces)


def of_sides(sides: Sequence[Side], at: Sequence[Poly]) -> Formula:
    """That a point is on all these sides."""
    return conj(half_space((*n, Fraction(0))[:3], c).formula(at) for n, c in sides)
