"""Convex cells with rational corners in the plane or in space: cut, found between obstacles, and followed.

A decomposition cuts the domain by the sides of the obstacles, each cell only by those that go through it, until every
cell is within an obstacle or has none inside. Obstacles are closed. Two free cells hang together where a part of a
side, of full dimension in it, belongs to both and no flat obstacle covers it: what meets in less is no passage that is
needed, since an open connected set stays connected without a set of codimension two.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise, product
from math import gcd, lcm

from qe.errors import Unable
from qe.options import Budget

Point = tuple[Fraction, ...]
Side = tuple[Point, Fraction]
"""(n, c): the points p with n . p <= c."""

MOST_CELLS = 20_000
_SURE = 1e-11
"""A sign of a float is believed where it exceeds this share of the terms it is made of."""


def opposite(side: Side) -> Side:
    """The other side of the same plane."""
    return tuple(-x for x in side[0]), -side[1]


def primitive(side: Side) -> Side:
    """The same with coprime whole numbers for the normal."""
    scale = Fraction(lcm(*(x.denominator for x in side[0])), gcd(*(x.numerator for x in side[0])))
    return tuple(x * scale for x in side[0]), side[1] * scale


@dataclass(frozen=True, slots=True)
class Cell:
    """A bounded convex polytope. ``through[i]``: the sides through corner i, as bits. It may be flat (a face of
    another, a point, a segment in the plane): then two of its sides are opposite."""

    sides: tuple[Side, ...]
    corners: tuple[Point, ...]
    through: tuple[int, ...]
    floats: tuple[tuple[float, ...], ...]
    is_flat: bool = False

    @staticmethod
    def of(sides: Sequence[Side], corners: Sequence[Point], *, is_flat: bool = False) -> Cell:
        """The hull of corners, which are all of those of the intersection of the sides."""
        through = [sum(1 << k for k, side in enumerate(sides) if _excess(side, p) == 0) for p in corners]
        return Cell(tuple(sides), tuple(corners), tuple(through), _rounded(corners), is_flat)

    @staticmethod
    def box(low: Point, high: Point) -> Cell:
        """Between two corners, which may be flat; sides of one axis do not follow each other: cuts along these in turn
        leave cells that are not long."""
        size = len(low)
        axes = [tuple(Fraction(i == k) for i in range(size)) for k in range(size)]
        sides = [*zip(axes, high, strict=True), *map(opposite, zip(axes, low, strict=True))]
        corners = list(dict.fromkeys(product(*zip(low, high, strict=True))))
        return Cell.of(sides, corners, is_flat=any(a == b for a, b in zip(low, high, strict=True)))

    @staticmethod
    def within(low: Point, high: Point, sides: Sequence[Side]) -> Cell | None:
        """The part of a box on these sides; None where it has no interior."""
        return Cell.box(low, high).part(sides)

    @property
    def centre(self) -> Point:
        """The mean of the corners, rounded where a shorter number is inside, too."""
        exact = tuple(sum(c) / len(self.corners) for c in zip(*self.corners, strict=True))
        for most in () if self.is_flat else (16, 1024, 2**20):
            near = tuple(c.limit_denominator(most) for c in exact)
            if all(_excess(side, near) < 0 for side in self.sides):
                return near
        return exact

    def contains(self, point: Sequence[Fraction]) -> bool:
        """Whether a point is in it, the boundary included."""
        return all(_excess(side, point) <= 0 for side in self.sides)

    def signs(self, side: Side) -> list[int]:
        """Of n . p - c at every corner."""
        n, c = side
        rough, level = tuple(map(float, n)), float(c)
        result = []
        for point, p in zip(self.floats, self.corners, strict=True):
            terms = [a * b for a, b in zip(rough, point, strict=True)]
            value = sum(terms) - level
            if abs(value) <= _SURE * (sum(map(abs, terms)) + abs(level)) or value != value:
                exact = _excess(side, p)
                result.append((exact > 0) - (exact < 0))
            else:
                result.append(1 if value > 0 else -1)
        return result

    def cut(self, side: Side, signs: Sequence[int] = ()) -> tuple[Cell | None, Cell | None]:
        """Its parts on the side and on the other one; None for a part that is in the plane only."""
        signs = signs or self.signs(side)
        if 1 not in signs:
            return self, None
        if -1 not in signs:
            return None, self
        bit = 1 << len(self.sides)
        through = [mask | bit if s == 0 else mask for mask, s in zip(self.through, signs, strict=True)]
        corners, between = list(self.corners), []
        values = {i: _excess(side, p) for i, p in enumerate(corners)}
        for i, j in self._edges(signs):
            share = values[i] / (values[i] - values[j])
            at = tuple(a + share * (b - a) for a, b in zip(corners[i], corners[j], strict=True))
            between.append((at, self.through[i] & self.through[j] | bit))
        halves = []
        for sign, new in ((-1, side), (1, opposite(side))):
            kept = [(corners[i], through[i]) for i, s in enumerate(signs) if s in (0, sign)] + between
            halves.append(_kept((*self.sides, new), kept, self.is_flat))
        return halves[0], halves[1]

    def part(self, sides: Sequence[Side]) -> Cell | None:
        """What of it is on these sides; None where that has no interior."""
        cell: Cell | None = self
        for side in sides:
            cell = cell and cell.cut(side)[0]
        return cell

    def _edges(self, signs: Sequence[int]) -> Iterator[tuple[int, int]]:
        """Pairs of neighbours on different sides: no other corner lies on all the sides that both lie on."""
        size = len(self.corners[0])
        below, above = ([i for i, s in enumerate(signs) if s == wanted] for wanted in (-1, 1))
        for i, j in product(below, above):
            mask = self.through[i] & self.through[j]
            if mask.bit_count() >= size - 1 and sum(other & mask == mask for other in self.through) == 2:
                yield i, j

    def face(self, k: int) -> Cell:
        """The part of it in the plane of its side k."""
        on = [i for i, mask in enumerate(self.through) if mask >> k & 1]
        bit = 1 << len(self.sides)
        corners = [(self.corners[i], self.through[i] | bit) for i in on]
        return _kept((*self.sides, opposite(self.sides[k])), corners, True)


def _excess(side: Side, point: Sequence[Fraction]) -> Fraction:
    return sum((a * b for a, b in zip(side[0], point, strict=True)), -side[1])


def _rounded(corners: Sequence[Point]) -> tuple[tuple[float, ...], ...]:
    return tuple(tuple(map(float, p)) for p in corners)


def _kept(sides: Sequence[Side], corners: Sequence[tuple[Point, int]], is_flat: bool) -> Cell:
    """Without the sides that touch a full cell in less than a facet, a flat one nowhere."""
    least, points = 1 if is_flat else len(corners[0][0]), tuple(p for p, _ in corners)
    used = [k for k in range(len(sides)) if sum(mask >> k & 1 for _, mask in corners) >= least]
    through = tuple(sum(1 << new for new, k in enumerate(used) if mask >> k & 1) for _, mask in corners)
    return Cell(tuple(sides[k] for k in used), points, through, _rounded(points), is_flat)


# --- decompositions ------------------------------------------------------------------------------------
@dataclass(frozen=True, slots=True)
class FreeCells:
    """The ``cells`` of a domain that have no obstacle inside; ``doors[i]``: for each cell that hangs together with cell
    i the part of a side that both have."""

    cells: tuple[Cell, ...]
    doors: tuple[dict[int, Cell], ...]

    @staticmethod
    def of(domain: Cell, obstacles: Sequence[Cell], budget: Budget) -> FreeCells:
        """Raises ``Unable`` where there are too many."""
        flat = [body.is_flat for body in obstacles]
        waiting, free = [(domain, tuple(range(len(obstacles))))], list[Cell]()
        while waiting:
            cell, ahead = waiting.pop()
            budget.check("cells of the scene")
            halves = None
            while ahead and halves is None:
                halves = _divided(cell, obstacles[ahead[0]], flat[ahead[0]])
                if halves is None:
                    ahead = ahead[1:]
            if halves is None:
                free.append(cell)
            elif halves:
                inner, outer = halves
                waiting += [(inner, ahead), (outer, ahead[1:] if not flat[ahead[0]] else ahead)]
            if len(free) + len(waiting) > MOST_CELLS:
                raise Unable(f"more than {MOST_CELLS} cells")
        return FreeCells.linked(free, obstacles)

    @staticmethod
    def linked(cells: Sequence[Cell], obstacles: Sequence[Cell]) -> FreeCells:
        """Cells with the doors between them that no flat obstacle covers."""
        return FreeCells(tuple(cells), _doors(cells, [body for body in obstacles if body.is_flat]))

    def holding(self, point: Point) -> int | None:
        """The number of a cell with this point."""
        return next((i for i, cell in enumerate(self.cells) if cell.contains(point)), None)

    def reached(self, start: int, costly: Collection[int] = ()) -> dict[int, int]:
        """The cells that hang together with one, each with the one before it; ``costly`` ones as late as can be."""
        before, waiting = {start: start}, deque([start])
        while waiting:
            at = waiting.popleft()
            for other in self.doors[at]:
                if other not in before:
                    before[other] = at
                    (waiting.appendleft if costly and other not in costly else waiting.append)(other)
        return before

    def way(self, before: dict[int, int], goal: int) -> list[int]:
        """The cells from where ``before`` begins to a goal."""
        cells = [goal]
        while before[cells[-1]] != cells[-1]:
            cells.append(before[cells[-1]])
        return cells[::-1]


def _divided(cell: Cell, body: Cell, flat: bool) -> tuple[Cell, Cell] | tuple[()] | None:
    """The parts of a cell on a side of an obstacle and beyond it; none where it is in the obstacle, None where nothing
    of the obstacle is inside the cell (where it is flat: where no side of it goes through the cell)."""
    least = 1 if flat else 0
    crossing = None
    for side in body.sides:
        signs = cell.signs(side)
        if min(signs) >= least:
            return None
        if crossing is None and -1 in signs and 1 in signs:
            crossing = side, signs
    if any(min(body.signs(side)) >= least for side in cell.sides):
        return None
    if crossing is None:
        return None if flat else ()
    inner, outer = cell.cut(*crossing)
    assert inner is not None and outer is not None
    return inner, outer


def _doors(cells: Sequence[Cell], walls: Sequence[Cell]) -> tuple[dict[int, Cell], ...]:
    """The parts of sides that two cells have in common."""
    planes: dict[Side, tuple[list[tuple[int, int]], list[tuple[int, int]]]] = {}
    for i, cell in enumerate(cells):
        for k, side in enumerate(cell.sides):
            plane = primitive(side)
            turned = next(x for x in plane[0] if x) < 0
            planes.setdefault(opposite(plane) if turned else plane, ([], []))[turned].append((i, k))
    doors: tuple[dict[int, Cell], ...] = tuple({} for _ in cells)
    boxes = [[(min(c), max(c)) for c in zip(*cell.floats, strict=True)] for cell in cells]
    for ones, others in planes.values():
        for (i, k), (j, _) in product(ones, others):
            pairs = zip(boxes[i], boxes[j], strict=True)
            if any(a > d + abs(d) * _SURE or c > b + abs(b) * _SURE for (a, b), (c, d) in pairs):
                continue
            door = common_side(cells[i], k, cells[j])
            if door is not None and not any(wall.contains(centre) for centre in [door.centre] for wall in walls):
                doors[i][j] = doors[j][i] = door
    return doors


def common_side(one: Cell, k: int, other: Cell) -> Cell | None:
    """The part of side k of a cell that another one behind it has, too; None where it is no full part of it."""
    part = one.face(k).part(other.sides)
    return part if part is not None and len(set(part.corners)) >= len(one.corners[0]) else None


def points_along(free: FreeCells, cells: Sequence[int], start: Point, goal: Point) -> list[Point]:
    """Corners of a polygonal path from start to goal through the insides of cells and of the doors between them."""
    points = [start, free.cells[cells[0]].centre]
    for i, j in pairwise(cells):
        points += [free.doors[i][j].centre, free.cells[j].centre]
    return [*points, goal]
