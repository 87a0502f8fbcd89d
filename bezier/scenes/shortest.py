"""A short chain of Bézier curves through the free cells: floating point proposes, rounded points are proved elsewhere.

The way through the cells is a shortest one over the corners and centres of the doors (Dijkstra). In each of its cells
lies one curve, whose control points the cell holds, and so the curve; joins are as smooth as asked. Its control
polygons are as short as can be, with a small part for the squares of second differences, which keeps the speed from
changing suddenly.

Cubic curves with two continuous derivatives are a uniform spline, three to a cell: with three equal control points of
the spline in each door it stays in the cells, so there is always one.
"""

from __future__ import annotations

import heapq
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import pairwise, product
from math import dist

from bezier.conic import Conic
from bezier.curves.scalar import dot
from bezier.scenes.cells import Cell, FreeCells, Point, Side
from bezier.scenes.scene import Scene
from bezier.scenes.sentences import Curve

EVENNESS, SAMPLES = 0.005, 4
"""The part of the squares of second differences in the cost, over the width of the workspace."""
DIGITS, INWARDS = 2**24, 1e-6
DIFFERENCES = ((1,), (-1, 1), (1, -2, 1))
_Door = tuple[int, int]
_Node = tuple[int, tuple[float, ...]]


def chains(
    scene: Scene, domain: Cell, free: FreeCells, degree: int, continuity: int
) -> Iterator[tuple[Curve, ...] | None]:
    """Curves from start to goal with rational control points, each in a free cell, but for rounding errors; None where
    the cells are too narrow for floating point. First those along a shortest way; then by ways that do without a door
    of one before, of the shortest chain first."""
    waiting, seen = [(0.0, tuple[_Door, ...]())], set[tuple[int, ...]]()
    while waiting:
        _, shut = heapq.heappop(waiting)
        cells = corridor(scene, free, shut)
        if cells is None or cells in seen:
            continue
        seen.add(cells)
        held = [free.cells[i] for i in cells for _ in range(1 if degree >= 2 * continuity else 3)]
        proposed = _proposed(scene, set(domain.sides), held, degree, continuity)
        rounded = _rounded if degree >= 2 * continuity else _spline
        yield None if proposed is None else rounded(scene, proposed, continuity)
        length = sum(dist(p, q) for points in proposed or () for p, q in pairwise(points))
        for door in pairwise(cells):
            heapq.heappush(waiting, (length, (*shut, door)))


def corridor(scene: Scene, free: FreeCells, shut: Sequence[_Door] = ()) -> tuple[int, ...] | None:
    """The cells of a shortest way over corners and centres of doors, but those that are ``shut``."""
    first, last = free.holding(scene.start), free.holding(scene.goal)
    if first is None or last is None:
        return None
    samples = [
        {j: _samples(door) for j, door in doors.items() if (i, j) not in shut} for i, doors in enumerate(free.doors)
    ]
    start, goal = tuple(map(float, scene.start)), tuple(map(float, scene.goal))
    # a node is a cell, and the point where it is entered
    best: dict[_Node, tuple[float, _Node | None]] = {(first, start): (0.0, None)}
    waiting = [(dist(start, goal), 0.0, first, start)]
    while waiting:
        _, far, cell, at = heapq.heappop(waiting)
        if far > best[cell, at][0]:
            continue
        if cell == last and at == goal:
            return _cells(best, best[cell, at][1])
        steps = [(j, p) for j, points in samples[cell].items() for p in points]
        for step in (*steps, (last, goal)) if cell == last else steps:
            reach = far + dist(at, step[1])
            if step not in best or reach < best[step][0]:
                best[step] = reach, (cell, at)
                heapq.heappush(waiting, (reach + dist(step[1], goal), reach, *step))
    return None


def _samples(door: Cell) -> list[tuple[float, ...]]:
    """The centre of a door, its corners, and points between."""
    middle = tuple(sum(c) / len(door.floats) for c in zip(*door.floats, strict=True))
    shares = [k / SAMPLES for k in range(1, SAMPLES + 1)]
    ways = [[(a, b - a) for a, b in zip(middle, corner, strict=True)] for corner in door.floats]
    return [middle, *(tuple(a + s * step for a, step in way) for way in ways for s in shares)]


def _cells(best: dict[_Node, tuple[float, _Node | None]], node: _Node | None) -> tuple[int, ...]:
    return () if node is None else (*_cells(best, best[node][1]), node[0])


def _proposed(
    scene: Scene, rim: set[Side], cells: Sequence[Cell], degree: int, continuity: int
) -> list[list[list[float]]] | None:
    """Control points by cell, as the solver finds them, a little away from the rim of the workspace."""
    size, program = scene.dimension, Conic()
    columns = [[program.variables((size,)).tolist() for _ in range(degree + 1)] for _ in cells]
    wide = float(max(b - a for a, b in zip(scene.low, scene.high, strict=True)))
    for point, at in ((scene.start, columns[0][0]), (scene.goal, columns[-1][-1])):
        for k, c in zip(at, point, strict=True):
            program.equal([(k, 1.0)], float(c))
    for one, other in pairwise(columns):
        for order in range(min(continuity, degree) + 1):
            for axis in range(size):
                ahead = [(other[k][axis], float(s)) for k, s in enumerate(DIFFERENCES[order])]
                behind = [(one[degree - order + k][axis], -float(s)) for k, s in enumerate(DIFFERENCES[order])]
                program.equal([*ahead, *behind], 0.0)
    for cell, points in zip(cells, columns, strict=True):
        for side, at in product(cell.sides, points):
            if at is not columns[0][0] and at is not columns[-1][-1]:
                away = INWARDS * wide * max(abs(float(x)) for x in side[0]) if side in rim else 0.0
                program.at_least([(k, -float(x)) for k, x in zip(at, side[0], strict=True)], away - float(side[1]))
        for a, b in pairwise(points):
            (leg,) = program.variables((1,)).tolist()
            program.cone([([(leg, 1.0)], 0.0), *(([(j, 1.0), (k, -1.0)], 0.0) for j, k in zip(a, b, strict=True))])
            program.add_cost([(leg, 1.0)])
        share = (EVENNESS / wide) ** 0.5
        for three in zip(points, points[1:], points[2:], strict=False):
            for i, j, k in zip(*three, strict=True):
                program.add_square([(i, share), (j, -2 * share), (k, share)])
    answer = program.solved()
    return None if answer is None else [[[answer[k] for k in at] for at in points] for points in columns]


def _rounded(scene: Scene, proposed: list[list[list[float]]], continuity: int) -> tuple[Curve, ...]:
    """Rational points, the first ones of each curve by those of the curve before it."""
    unit = max(b - a for a, b in zip(scene.low, scene.high, strict=True)) / DIGITS
    curves = list[Curve]()
    for number, points in enumerate(proposed):
        exact = [tuple(round(Fraction(c) / unit) * unit for c in p) for p in points]
        if curves:
            exact[: continuity + 1] = list(_continued(curves[-1]))[: continuity + 1]
        else:
            exact[0] = scene.start
        if number == len(proposed) - 1:
            exact[-1] = scene.goal
        curves.append(tuple(exact))
    return tuple(curves)


def _spline(scene: Scene, proposed: list[list[list[float]]], _: int) -> tuple[Curve, ...]:
    """A uniform cubic spline by rational control points (de Boor's), as Bézier curves; so rounding does not add up."""
    unit = max(b - a for a, b in zip(scene.low, scene.high, strict=True)) / DIGITS
    inner = [[2 * b - c for b, c in zip(p[1], p[2], strict=True)] for p in proposed]
    inner.append([2 * c - b for b, c in zip(proposed[-1][1], proposed[-1][2], strict=True)])
    exact = [tuple(round(Fraction(c) / unit) * unit for c in p) for p in inner]
    threes = (scene.start, *exact[:2]), (scene.goal, *exact[:-3:-1])
    first, last = (tuple(6 * e - 4 * a - b for e, a, b in zip(*three, strict=True)) for three in threes)
    exact = [first, *exact, last]
    rows = ((1, 4, 1, 0), (0, 4, 2, 0), (0, 2, 4, 0), (0, 1, 4, 1))
    fours = zip(exact, exact[1:], exact[2:], exact[3:], strict=False)
    return tuple(
        tuple(tuple(Fraction(dot(row, axis), 6) for axis in zip(*four, strict=True)) for row in rows) for four in fours
    )


def _continued(curve: Curve) -> Iterator[Point]:
    """The first control points of a curve that goes on with the same derivatives."""
    last = curve[::-1]
    yield last[0]
    yield tuple(2 * a - b for a, b in zip(last[0], last[1], strict=True))
    if len(last) > 2:
        yield tuple(4 * a - 4 * b + c for a, b, c in zip(*last[:3], strict=True))
