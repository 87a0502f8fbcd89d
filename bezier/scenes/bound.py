"""How short no path of a scene is: a bound from below for the length, over all ways through the free cells.

The obstacles are taken as polytopes within them, the workspace as one around it, which only makes paths shorter.
THEOREM. Let the convex cells C_1, ..., C_n cover what is free then, let paths go from cell to cell through the doors,
let every door d have an affine function f_d, and start and goal numbers. Where for all doors d and e (or start and
goal) of a cell f_e(y) - f_d(x) <= |y - x| + h for x in d, y in e, every path from start to goal has at least the length
f_goal - f_start - n h. PROOF. Some shortest path visits each cell at most once, since cells are convex; between its
doors the sum telescopes. Where some g with |g| <= 1 has f_e(y) - f_d(x) <= g . (y - x) + h at all pairs of corners,
this holds for all x and y. The sentence of a cell says that there are such g for its doors; the kernel checks it by
them. That the cells cover is said in sentences, too; the doors are those of ``FreeCells``, made again by who checks.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import permutations, product
from math import ceil, hypot, lcm

from bezier.curves.enclosure import root_below
from bezier.curves.scalar import dot, subtract
from bezier.scenes.cells import Cell, FreeCells, Point
from bezier.scenes.conic import Conic
from bezier.scenes.scene import Scene
from bezier.scenes.sentences import covering
from bezier.scenes.solid import directions
from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, exists
from qe.formula.syntax import Formula, Relation
from qe.options import Budget
from qe.proof.certificate import Certificate

DIGITS, SHORTER, MOST_ROWS = 2**32, 1 - 2.0**-26, 25_000
Level = tuple[Point, Fraction]
"""The affine function n . x + c of a door."""
Key = tuple[int, int]
START, GOAL = -1, -2


@dataclass(frozen=True, slots=True)
class LengthBound:
    """``levels``: of every door, by the numbers of its cells; of start and goal by the cell and START or GOAL."""

    scene: Scene
    fine: int
    levels: tuple[tuple[Key, Level], ...]
    slack: Fraction
    value: Fraction
    """What no path is shorter than."""

    def sentences(self, budget: Budget) -> tuple[Fraction, dict[str, Formula]]:
        """The bound, and what is to be proved for it: a sentence for each cell; nothing for the straight line."""
        if not self.levels:
            away = subtract(self.scene.goal, self.scene.start)
            return root_below(Fraction(dot(away, away)), 40), {}
        (around, walls, free), known = relaxed(self.scene, self.fine, budget), dict(self.levels)
        rows = {f"length in cell {i}": _matrix(pairs, known, self.slack) for i, pairs in _pairs(self.scene, free)}
        ends = [_value(known[key], p) for key, p in _ends(self.scene, free)]
        quantified = {k: exists(_names(matrix), matrix) for k, matrix in rows.items()}
        cover = dict(covering(self.scene, around, walls, free.cells))
        return ends[1] - ends[0] - len(free.cells) * self.slack, cover | quantified


def relaxed(scene: Scene, fine: int, budget: Budget) -> tuple[Cell, list[Cell], FreeCells]:
    """A polytope around the workspace, polytopes within the obstacles, the cells of the one outside of the others."""
    normals = directions(scene.dimension, fine)
    inner = [body.cell() if body.is_polytope else body.inside(normals) for body in scene.solids]
    sides = [side for part in scene.domain for side in part.around(normals)]
    domain = Cell.within(scene.low, scene.high, sides)
    assert domain is not None
    walls = [cell for cell in inner if cell is not None]
    return domain, walls, FreeCells.of(domain, walls, budget)


def least_length(scene: Scene, fine: int, budget: Budget) -> tuple[LengthBound, list[tuple[str, Certificate]]]:
    """A bound that floating point proposes, with the proofs of its sentences; the length of the straight line where
    there are too many cells or nothing better was proposed."""
    away = subtract(scene.goal, scene.start)
    least = root_below(Fraction(dot(away, away)), 40)
    straight = LengthBound(scene, fine, (), Fraction(0), least), list[tuple[str, Certificate]]()
    _, _, free = relaxed(scene, fine, budget)
    size, program = scene.dimension, Conic()
    cells = list(_pairs(scene, free))
    if sum(len(xs.corners) * len(ys.corners) for _, pairs in cells for (_, xs), (_, ys) in pairs) > MOST_ROWS:
        return straight
    columns = {key: program.columns(size + 1) for _, pairs in cells for pair in pairs for key, _ in pair}
    slopes = {}
    for i, pairs in cells:
        for (a, xs), (b, ys) in pairs:
            slope = slopes[i, a, b] = program.columns(size)
            program.cone([([], 1.0), *(([(k, 1.0)], 0.0) for k in slope)])
            for x in xs.floats:
                for y in ys.floats:
                    along = [(k, q - p) for k, p, q in zip(slope, x, y, strict=True)]
                    ends = [
                        (k, s * c)
                        for cols, s, p in ((columns[a], 1, x), (columns[b], -1, y))
                        for k, c in zip(cols, (*p, 1.0), strict=True)
                    ]
                    program.at_least(along + ends, 0.0)
    for (key, point), sign in zip(_ends(scene, free), (1.0, -1.0), strict=True):
        program.add_cost([(k, sign * c) for k, c in zip(columns[key], (*map(float, point), 1.0), strict=True)])
    answer = program.solved()
    if answer is None:
        return straight

    def numbers(columns: Sequence[int], share: float = SHORTER) -> Point:
        return tuple(Fraction(round(answer[k] * share * DIGITS), DIGITS) for k in columns)

    levels: dict[Key, Level] = {key: (numbers(cols[:-1]), numbers(cols)[-1]) for key, cols in columns.items()}
    values = {key: numbers(cols, SHORTER / max(1.0, hypot(*(answer[k] for k in cols)))) for key, cols in slopes.items()}
    missing = (
        _value(levels[b], y) - _value(levels[a], x) - Fraction(dot(values[i, a, b], subtract(y, x)))
        for i, pairs in cells
        for (a, xs), (b, ys) in pairs
        for x, y in product(xs.corners, ys.corners)
    )
    slack = Fraction(max(0, ceil(max(missing) * DIGITS)), DIGITS)
    first, last = (_value(levels[key], p) for key, p in _ends(scene, free))
    value = last - first - len(free.cells) * slack
    if value <= least:
        return straight
    bound, proofs = LengthBound(scene, fine, tuple(levels.items()), slack, value), []
    for i, pairs in cells:
        matrix = _matrix(pairs, levels, slack)
        place = [c for (a, _), (b, _) in pairs for c in values[i, a, b]]
        proofs.append((f"length in cell {i}", Certificate.witness(matrix, _names(matrix), place)))
    return bound, proofs


Door = tuple[Key, Cell]


def _pairs(scene: Scene, free: FreeCells) -> Iterator[tuple[int, list[tuple[Door, Door]]]]:
    """For each cell the ordered pairs of its doors, start and goal among them."""
    ends = dict(_ends(scene, free))
    for i in range(len(free.cells)):
        doors: list[Door] = [((min(i, j), max(i, j)), door) for j, door in free.doors[i].items()]
        doors += [(key, Cell.box(p, p)) for key, p in ends.items() if key[0] == i]
        if len(doors) > 1:
            yield i, [(a, b) for a, b in permutations(doors, 2) if a[0][1] != GOAL and b[0][1] != START]


def _ends(scene: Scene, free: FreeCells) -> list[tuple[Key, Point]]:
    result = []
    for point, name in ((scene.start, START), (scene.goal, GOAL)):
        cell = free.holding(point)
        if cell is None:
            raise CertificateRejected("length", "start or goal is in no cell")
        result.append(((cell, name), point))
    return result


def _value(level: Level, point: Point) -> Fraction:
    return Fraction(dot(level[0], point)) + level[1]


def _names(matrix: Formula) -> tuple[str, ...]:
    return matrix.ring.names if matrix.ring is not None else ()


def _matrix(pairs: Sequence[tuple[Door, Door]], levels: dict[Key, Level], slack: Fraction) -> Formula:
    """That the slopes of all pairs of doors have length 1 at most, and do."""
    size = len(pairs[0][0][1].corners[0])
    ring = Ring.of([f"g{k}_{axis}" for k in range(len(pairs)) for axis in range(size)])
    conditions = []
    for k, ((a, xs), (b, ys)) in enumerate(pairs):
        g = [ring.var(f"g{k}_{axis}") for axis in range(size)]
        conditions.append(atom(sum((c * c for c in g[1:]), g[0] * g[0]) - 1, Relation.LE))
        for x in xs.corners:
            for y in ys.corners:
                most = _value(levels[b], y) - _value(levels[a], x) - slack
                along = [q - p for p, q in zip(x, y, strict=True)]
                whole = lcm(most.denominator, *(c.denominator for c in along))
                total = ring.constant(-int(most * whole))
                for c, letter in zip(along, g, strict=True):
                    total = total + int(c * whole) * letter
                conditions.append(atom(total, Relation.GE))
    return conj(conditions)
