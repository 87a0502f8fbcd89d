"""What formulas leave free: cells in them, cells clear of them, and the rest, halved where a way may lead through it.

The ways through cells that are not decided are looked for with as few of these as can be (soft subdivision search:
Wang, Chiang, Yap, "On soft predicates in subdivision motion planning", 2015). A way in the open is found after finitely
many steps, and so is what separates where cells in the formulas fill it; only where that touches, or has no inside, no
cell is small enough. Nothing here is believed: sentences speak of the formulas themselves.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import comb

from bezier.obstacles.obstacle import Constraint
from bezier.scenes.cells import Cell, FreeCells, Point, Side
from bezier.scenes.outlines import outlines
from bezier.scenes.scene import Scene, of_sides
from bezier.scenes.solid import ZERO
from qe.errors import Unable
from qe.options import Budget

SMALLEST, MOST_CELLS, ONE = Fraction(1, 2**24), 1_500, Fraction(1)


@dataclass(frozen=True, slots=True)
class Decomposed:
    """``free`` cells of a polytope ``domain`` in the workspace; the scene ``within`` it has bodies that are in formulas
    in their place, and ``numbers`` says in which body of the scene each of its bodies is."""

    domain: Cell
    free: FreeCells
    within: Scene
    numbers: tuple[int, ...]


def decomposed(scene: Scene, fine: int, budget: Budget, even: Fraction = ONE) -> Decomposed:
    """By polytopes around convex bodies, and by ever smaller cells, those that are wider than the part ``even`` of the
    workspace wherever they are. Raises ``Unable`` where these do not tell."""
    domain, around = outlines(scene, fine)
    if not scene.formulas:
        return Decomposed(domain, FreeCells.of(domain, around, budget), scene, tuple(range(len(scene.bodies))))
    # mixed: cells that are not decided, each with what convex bodies leave of it
    inner, free, mixed = list[tuple[Cell, int]](), list[Cell](), list[tuple[Cell, tuple[Cell, ...]]]()
    waiting, wide = [Cell.box(scene.low, scene.high)], max(b - a for a, b in zip(scene.low, scene.high, strict=True))
    for side in _planes(scene):
        waiting = [part for cell in waiting for part in cell.cut(side) if part is not None]
    while waiting:
        for cell in waiting:
            budget.check("cells of the scene")
            owner, part = _owner(scene, cell), cell.part(domain.sides)
            if owner is not None and owner >= 0:
                inner.append((cell, owner))
            elif part is not None:
                cells = FreeCells.of(part, around, budget).cells
                if owner is None:
                    mixed.append((cell, cells))
                else:
                    free += cells
        split = {k for k, (cell, _) in enumerate(mixed) if _width(cell) > even * wide}
        split = split or _between(scene, free, [cells for _, cells in mixed], around)
        waiting = [half for k in sorted(split) for half in _parts(mixed[k][0])]
        mixed = [entry for k, entry in enumerate(mixed) if k not in split]
        if len(mixed) + len(waiting) > MOST_CELLS or any(_width(cell) < SMALLEST * wide for cell in waiting):
            raise Unable("undecided: a path along the boundary of a formula may exist, which small cells do not decide")
    solids = tuple(of_sides(scene.formulas[owner].name, cell.corners, cell.sides, ZERO) for cell, owner in inner)
    numbers = *range(len(scene.solids)), *(len(scene.solids) + owner for _, owner in inner)
    within = replace(scene, formulas=(), holes=(*scene.holes, *solids))
    return Decomposed(domain, FreeCells.linked(free, around), within, numbers)


def _planes(scene: Scene) -> Iterator[Side]:
    """Of the linear conditions."""
    conditions = (c for body in scene.formulas for piece in body.pieces for c in piece)
    for c in dict.fromkeys(c for c in conditions if c.degree == 1):
        terms = dict(c.terms)
        normal = tuple(terms.get(tuple(int(i == k) for i in range(3)), ZERO) for k in range(3))
        yield normal[: scene.dimension], -terms.get((0, 0, 0), ZERO)


def _between(scene: Scene, free: Sequence[Cell], mixed: Sequence[Sequence[Cell]], walls: Sequence[Cell]) -> set[int]:
    """The numbers of mixed cells that ways from start to goal lead through, none twice; none where a way is free."""
    owners = {len(free) + n: k for n, k in enumerate(k for k, cells in enumerate(mixed) for _ in cells)}
    graph = FreeCells.linked((*free, *(cell for cells in mixed for cell in cells)), walls)
    start, goal, split = graph.holding(scene.start), graph.holding(scene.goal), set[int]()
    while start is not None and goal is not None and goal in (before := graph.reached(start, owners)):
        met = {i for i in graph.way(before, goal) if i in owners}
        if not met:
            return set()
        split |= {owners[i] for i in met}
        gone = met - {start, goal}
        if not gone:
            break
        graph = replace(graph, doors=tuple({j: d for j, d in doors.items() if j not in gone} for doors in graph.doors))
    return split


def _parts(cell: Cell) -> list[Cell]:
    """The cell halved across each axis."""
    parts = [cell]
    for axis, (low, high) in enumerate(zip(*_ends(cell), strict=True)):
        side = tuple(Fraction(k == axis) for k in range(len(cell.corners[0]))), (low + high) / 2
        parts = [half for part in parts for half in part.cut(side) if half is not None]
    return parts


def _ends(cell: Cell) -> tuple[Point, Point]:
    axes = list(zip(*cell.corners, strict=True))
    return tuple(map(min, axes)), tuple(map(max, axes))


def _width(cell: Cell) -> Fraction:
    return max(b - a for a, b in zip(*_ends(cell), strict=True))


def _owner(scene: Scene, cell: Cell) -> int | None:
    """The number of a formula that a cell is in; -1 where it is clear of all, None where that is not seen."""
    is_clear = True
    for k, body in enumerate(scene.formulas):
        for piece in body.pieces:
            spans = [(c, *_span(c, cell)) for c in piece]
            if all(c.holds(low) for c, low, _ in spans):
                return k
            is_clear = is_clear and any(not c.holds(high) for c, _, high in spans)
    return -1 if is_clear else None


def _span(condition: Constraint, cell: Cell) -> tuple[Fraction, Fraction]:
    """Numbers below and above a polynomial on a cell: the values at the corners where it is linear, or else of its
    Taylor form about the centre of the box around."""
    if condition.degree < 2:
        values = [condition.value((*p, ZERO)[:3]) for p in cell.corners]
        return min(values), max(values)
    terms = dict(condition.terms)
    for axis, (a, b) in enumerate(zip(*_ends(cell), strict=True)):
        middle, half, moved = (a + b) / 2, (b - a) / 2, dict[tuple[int, ...], Fraction]()
        for powers, c in terms.items():
            n = powers[axis]
            for k in range(n + 1):
                key = (*powers[:axis], k, *powers[axis + 1 :])
                moved[key] = moved.get(key, ZERO) + c * comb(n, k) * middle ** (n - k) * half**k
        terms = moved
    centre = terms.pop((0, 0, 0), ZERO)
    even = {powers for powers in terms if not any(n % 2 for n in powers)}
    below = sum((min(c, ZERO) if powers in even else -abs(c) for powers, c in terms.items()), centre)
    return below, sum((max(c, ZERO) if powers in even else abs(c) for powers, c in terms.items()), centre)
