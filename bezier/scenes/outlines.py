"""Polytopes around the obstacles of a scene, and one in its workspace, that keep apart what is apart.

THEOREM (plane). Polygons around the bodies, of which two meet only where their bodies do, that leave out start and goal
and stay in the workspace where their bodies do, separate start and goal exactly if the bodies do. PROOF. What separates
is a matter of which bodies have common points, and of the curves through these, which are in the polygons, too
(``bezier.scenes.barrier``). So passages are never closed, however narrow: between two bodies that do not touch there is
a line.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from bezier.curves.scalar import dot, subtract
from bezier.scenes.barrier import outside_points
from bezier.scenes.cells import Cell, Point, Side
from bezier.scenes.scene import Scene
from bezier.scenes.solid import Solid, between, common_point, directions, point_solid, separators, short_between

MOST_CHORDS = 4_000
WIDER = 4096
"""The polytopes are wider by this part of the workspace, where that closes no passage: their boundaries are free."""


def outlines(scene: Scene, fine: int) -> tuple[Cell, tuple[Cell, ...]]:
    """The workspace, and a polytope around each body as far as it is near the workspace."""
    normals = directions(scene.dimension, fine)
    wide = min(b - a for a, b in zip(scene.low, scene.high, strict=True)) / WIDER
    rim = [side for part in scene.domain for side in rim_of(scene, part, normals)]
    domain = Cell.within(scene.low, scene.high, rim)
    low, high = tuple(c - 1 for c in scene.low), tuple(c + 1 for c in scene.high)
    cells = dict[int, Cell]()
    for i, body in enumerate(scene.solids):
        sides = [(n, c + wide * max(map(abs, n))) for n, c in body.around(normals)]
        if (cell := Cell.within(low, high, sides)) is not None:
            cells[i] = cell
    solids = [*scene.solids, point_solid(scene.start), point_solid(scene.goal)]
    for i in list(cells):
        for j in (*(k for k in cells if k < i), len(solids) - 2, len(solids) - 1):
            other = cells.get(j) or Cell.box(solids[j].corners[0], solids[j].corners[0])
            is_body = j < len(scene.solids)  # start and goal are free, and may be on the boundary of an open body
            pairs = (cells[i], other), (other, cells[i])
            apart = any(min(b.signs(side)) > 0 for a, b in pairs for side in a.sides)
            if apart or (is_body and common_point(solids[i], solids[j]) is not None):
                continue
            strips = separators(solids[i], solids[j]) if not solids[i].tube and not solids[j].tube else None
            for k, side in zip((i, j), strips or (), strict=False):
                if k in cells:
                    cells[k] = cells[k].cut(side)[0] or cells[k]
        for normal, level in rim:
            reach = solids[i].support(normal, 256)
            if reach < level and any(dot(normal, p) >= level for p in cells[i].corners):
                cells[i] = cells[i].cut((normal, short_between(reach, level)))[0] or cells[i]
    assert domain is not None
    return domain, tuple(cells.values())


def rim_of(scene: Scene, part: Solid, normals: Sequence[Point]) -> list[Side]:
    """Sides of a polytope in a part of the workspace; in the plane with all bodies that are inside of it."""
    if part.is_polytope:
        return list(part.sides)
    if scene.dimension == 2:
        return _chords(scene, part, normals)
    inner = part.inside(normals)
    return list(inner.sides) if inner is not None else []


def _chords(scene: Scene, disc: Solid, normals: Sequence[Point]) -> list[Side]:
    """Sides of an inscribed polygon, with so many corners that it has in it what is inside of the disc."""
    one = Scene((disc,), (), (), scene.start, scene.goal, scene.low, scene.high)
    within = [body for body in scene.solids if not any(True for _ in outside_points(one, body))]
    ends = [point_solid(scene.start), point_solid(scene.goal)]
    centre, radius = disc.corners[0], disc.radius
    on = [subtract(p.corners[0], centre) for p in ends]
    given = {tuple(c / radius for c in d) for d in on if dot(d, d) == radius**2}
    # around the circle: by the half plane, then by the first coordinate
    is_upper = {u: u[1] > 0 or (u[1] == 0 and u[0] > 0) for u in {*normals, *given}}
    ring = sorted(is_upper, key=lambda u: (0, -u[0]) if is_upper[u] else (1, u[0]))
    sides, waiting = list[Side](), list(zip(ring, ring[1:] + ring[:1], strict=True))[::-1]
    while waiting and len(sides) < MOST_CHORDS:
        u, v = waiting.pop()
        normal = v[1] - u[1], u[0] - v[0]
        level = Fraction(dot(normal, centre)) + radius * Fraction(dot(normal, u))
        if any(body.support(normal, 256) >= level for body in within) or any(e.support(normal) > level for e in ends):
            middle = between(u, v)
            waiting += [(middle, v), (u, middle)]
        else:
            sides.append((normal, level))
    return sides
