"""Obstacles in the plane that separate start and goal: decided completely, by where two of them meet.

The union of closed convex bodies, with what is outside the workspace, separates two points exactly if a closed curve in
it goes around one of them but not around the other, mod 2 (Alexander duality). Every closed curve in a union of convex
bodies is, up to deformation within it, a walk from body to body through common points (nerve theorem). Whether a walk
goes around just one of two points is the parity of its crossings with the segment between them. So it is a question
about a graph: the bodies, their common points, and the outside, which is one node since all of it hangs together
without crossing the segment.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

from bezier.curves.scalar import subtract
from bezier.scenes.cells import Point
from bezier.scenes.scene import Scene
from bezier.scenes.solid import Solid, beyond_ball, beyond_side, common_point
from qe.extras import wanted


@dataclass(frozen=True, slots=True)
class Wall:
    """A segment in obstacles and outside the workspace; ``bodies``: those that it is in, as numbers."""

    start: Point
    end: Point
    bodies: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class _Meeting:
    """Two nodes with a common point; ``outwards``: the way on from it, where the second is the outside."""

    nodes: tuple[int, int]
    point: Point
    is_odd: bool
    outwards: Point | None = None


def barrier(scene: Scene) -> tuple[Wall, ...]:
    """Segments that separate start and goal, as few bodies as can be; none where nothing separates them."""
    with wanted():
        import networkx as nx

    # a node of the graph is a body, and whether an odd number of crossings led there
    graph: nx.Graph[tuple[int, bool]] = nx.Graph()
    for meeting in _meetings(scene):
        i, j = meeting.nodes
        for side in (False, True):
            graph.add_edge((i, side), (j, side != meeting.is_odd), meeting=meeting)
    walks = list[list[tuple[int, bool]]]()
    for i in sorted({i for i, _ in graph}):
        if nx.has_path(graph, (i, False), (i, True)):
            walks.append(list(nx.shortest_path(graph, (i, False), (i, True))))
    if not walks:
        return ()
    shortest: list[tuple[int, bool]] = min(walks, key=len)
    steps = ((one[0], graph.edges[one, other]["meeting"]) for one, other in pairwise(shortest))
    return tuple(_walls(scene, list(steps)))


def longer(scene: Scene, walls: tuple[Wall, ...]) -> tuple[Wall, ...]:
    """Walls that follow each other in one body as one, where that is seen to be in it and crosses as often, mod 2."""
    ends, kept = (scene.start, scene.goal), list(walls[:1])
    for wall in walls[1:]:
        last, both = kept[-1], replace(kept[-1], end=wall.end)
        crossings = sum(_crosses((w.start, w.end), ends) for w in (last, wall, both))
        is_one = (last.bodies, last.end) == (wall.bodies, wall.start) and last.start != wall.end and not crossings % 2
        if is_one and any(scene.bodies[i].holds(both.start, both.end) for i in wall.bodies):
            kept[-1] = both
        else:
            kept.append(wall)
    return tuple(kept)


def outside_points(scene: Scene, body: Solid) -> Iterator[tuple[Point, Point]]:
    """Points of a body on the boundary of the workspace or beyond it, with a direction that leads away."""
    for part in scene.domain:
        if part.is_polytope:
            for side in part.sides:
                if (point := beyond_side(body, side)) is not None:
                    yield point, side[0]
        else:
            yield from ((p, subtract(p, part.corners[0])) for p in beyond_ball(body, part))


def _meetings(scene: Scene) -> Iterator[_Meeting]:
    bodies, ends = scene.solids, (scene.start, scene.goal)
    outside, boxes = len(bodies), [body.low_high() for body in bodies]
    for i, one in enumerate(bodies):
        for j in range(i):
            if any(a > d or c > b for a, b, c, d in zip(*boxes[i], *boxes[j], strict=True)):
                continue
            if (point := common_point(one, bodies[j])) is not None:
                is_odd = _crosses((one.centre, point), ends) != _crosses((point, bodies[j].centre), ends)
                yield _Meeting((i, j), point, is_odd)
        for point, outwards in outside_points(scene, one):
            yield _Meeting((i, outside), point, _crosses((one.centre, point), ends), outwards)


def _crosses(one: tuple[Point, Point], other: tuple[Point, Point]) -> bool:
    """Whether the first segment crosses the second, which has no end on it; a point on its line counts as above."""
    above = [_turn(*other, p) >= 0 for p in one]
    return above[0] != above[1] and (_turn(*one, other[0]) > 0) != (_turn(*one, other[1]) > 0)


def _turn(a: Point, b: Point, p: Point) -> Fraction:
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])


def _walls(scene: Scene, walk: list[tuple[int, _Meeting]]) -> Iterator[Wall]:
    """Of a closed walk: the nodes, each with the next meeting."""
    outside = len(scene.solids)
    for k, (node, after) in enumerate(walk):
        _, meeting = walk[k - 1]
        if node != outside:
            touched = {n for m in (meeting, after) for n in m.nodes} - {outside, node}
            bodies = (node, *sorted(touched)) if scene.solids[node].is_open else (node,)
            if meeting.point != after.point:
                yield Wall(meeting.point, after.point, bodies)
        else:
            for passage in (meeting, after):
                assert passage.outwards is not None
                yield Wall(passage.point, _far(scene, passage.point, passage.outwards), passage.nodes[:1])


def _far(scene: Scene, point: Point, outwards: Point) -> Point:
    """A point on a ray that is outside of the box around the workspace."""
    share = Fraction(1)
    while True:
        end = tuple(p + share * d for p, d in zip(point, outwards, strict=True))
        if not all(a <= c <= b for a, c, b in zip(scene.low, end, scene.high, strict=True)):
            return end
        share *= 2
