"""How short no path of a scene is: a bound from below for the length, over all ways through the free cells.

The obstacles are taken as polytopes within them, the workspace as one around it, which only makes paths shorter.
THEOREM. Let convex cells C_1, ..., C_n, one with the start, have doors: convex parts of a side of C_i in a C_j beyond
it. Let every point on a side of a cell be in one of its doors, in a polytope within an obstacle, or on the rim of the
polytope around. Let every door d have an affine function f_d, and start and goal numbers. Where for all doors d and e
(or start and goal) of a cell f_e(y) - f_d(x) <= |y - x| + h for x in d, y in e, every path from start to goal has at
least the length f_goal - f_start - n h. PROOF. A path is as long, up to any small number, as one of segments that
begins inside the cell of the start, meets the planes of all sides at single points, no two of them at once, and keeps
away from the rim, since what is free is open. Where that leaves a cell for the last time it is in a door, and then in
the cell beyond. So it visits cells at most once, and ends in one with the goal; between doors the sum telescopes. Where
some g with |g| <= 1 has f_e(y) - f_d(x) <= g . (y - x) + h at all pairs of corners, this holds for all x and y.

Sentences say that there are such g for each cell, and that sides are in doors and walls; where one of these has all
corners of a side, that is seen at once.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import permutations, product
from math import ceil, hypot, lcm

from bezier.conic import Conic
from bezier.curves.enclosure import root_below
from bezier.curves.scalar import dot, subtract
from bezier.input import stored
from bezier.scenes.cells import Cell, FreeCells, Point, Side, common_side
from bezier.scenes.scene import Scene
from bezier.scenes.sentences import coordinates, enclosing, every, of_sides
from bezier.scenes.solid import directions
from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, disj, exists, neg
from qe.formula.syntax import Formula, Relation
from qe.options import Budget
from qe.proof.certificate import Certificate

DIGITS, SHORTER, MOST_ROWS = 2**32, 1 - 2.0**-26, 25_000
Level = tuple[Point, Fraction]
"""The affine function n . x + c of a door."""
Key = tuple[int, int]
START, GOAL = (-1, -1), (-2, -2)
LENGTH = "length in cell"
"""How labels of the bound begin."""


@dataclass(frozen=True)
class LengthBound:
    """``levels``: of every door, by the numbers of its cells; of START and GOAL. Without them: the straight line."""

    scene: Scene
    levels: tuple[tuple[Key, Level], ...] = ()
    slack: Fraction = Fraction(0)

    @property
    def value(self) -> Fraction:
        """What no path is shorter than. Raises ``CertificateRejected``."""
        return self._said[0]

    @property
    def sentences(self) -> dict[str, Formula]:
        """What is to be proved for it: a sentence for each cell. Raises ``CertificateRejected``."""
        return self._said[1]

    @cached_property
    def _said(self) -> tuple[Fraction, dict[str, Formula]]:
        if not self.levels:
            away = subtract(self.scene.goal, self.scene.start)
            return root_below(Fraction(dot(away, away)), 40), {}
        (around, walls, free), known = relaxed(self.scene, Budget()), dict(self.levels)
        cells = dict(_pairs(self.scene, free))
        keys = {START, GOAL, *(key for pairs in cells.values() for pair in pairs for key, _ in pair)}
        if free.holding(self.scene.start) is None or not keys <= known.keys():
            raise CertificateRejected("length", "start or goal is in no cell, or a door without a function")
        rows = {_label(i, pairs, known, self.slack): _matrix(pairs, known, self.slack) for i, pairs in cells.items()}
        first, last = (_value(known[key], p) for key, p in _ends(self.scene))
        quantified = {k: exists(_names(matrix), matrix) for k, matrix in rows.items()}
        said = dict(enclosing(self.scene, around, walls)) | dict(_exits(self.scene, around, walls, free))
        return last - first - len(free.cells) * self.slack, said | quantified

    @staticmethod
    def read(scene: Scene, labels: Sequence[str]) -> LengthBound | None:
        """What the labels of a certificate state; None where none does. Raises ``CertificateRejected``."""
        texts = [label.partition(": ")[2] for label in labels if label.startswith(LENGTH)]
        levels, slack = dict[Key, Level](), Fraction(0)
        for text in texts:
            first, *rows = (stored.row(part, LENGTH) for part in text.split("; "))
            if len(first) != 1 or any(len(row) != 3 + scene.dimension for row in rows):
                raise CertificateRejected(LENGTH, "expected a number, then of each door its cells and a function")
            slack, levels = first[0], levels | {(int(a), int(b)): (tuple(n), c) for a, b, *n, c in rows}
        return LengthBound(scene, tuple(levels.items()), slack) if texts else None


def relaxed(scene: Scene, budget: Budget) -> tuple[Cell, list[Cell], FreeCells]:
    """A polytope around the workspace, polytopes within the obstacles, the cells of the one outside of the others."""
    normals = directions(scene.dimension, 2 if scene.dimension == 2 else 0)
    inner = [body.inside(normals) for body in scene.solids]
    sides = [side for part in scene.domain for side in part.around(normals)]
    domain = Cell.within(scene.low, scene.high, sides)
    assert domain is not None
    walls = [cell for cell in inner if cell is not None]
    return domain, walls, FreeCells.of(domain, walls, budget)


def least_length(scene: Scene, budget: Budget) -> tuple[LengthBound, list[tuple[str, Certificate]]]:
    """A bound that floating point proposes, with the proofs of its sentences; the length of the straight line where
    there are too many cells or nothing better was proposed."""
    away = subtract(scene.goal, scene.start)
    least = root_below(Fraction(dot(away, away)), 40)
    straight = LengthBound(scene), list[tuple[str, Certificate]]()
    _, _, free = relaxed(scene, budget)
    size, program = scene.dimension, Conic()
    cells = list(_pairs(scene, free))
    if sum(len(xs.corners) * len(ys.corners) for _, pairs in cells for (_, xs), (_, ys) in pairs) > MOST_ROWS:
        return straight
    columns = {key: program.variables((size + 1,)).tolist() for _, pairs in cells for pair in pairs for key, _ in pair}
    slopes = {}
    for i, pairs in cells:
        for (a, xs), (b, ys) in pairs:
            slope = slopes[i, a, b] = program.variables((size,)).tolist()
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
    if any(key not in columns for key, _ in _ends(scene)):
        return straight
    for (key, point), sign in zip(_ends(scene), (1.0, -1.0), strict=True):
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
    first, last = (_value(levels[key], p) for key, p in _ends(scene))
    value = last - first - len(free.cells) * slack
    if value <= least:
        return straight
    bound, proofs = LengthBound(scene, tuple(levels.items()), slack), []
    for i, pairs in cells:
        matrix = _matrix(pairs, levels, slack)
        place = [c for (a, _), (b, _) in pairs for c in values[i, a, b]]
        proofs.append((_label(i, pairs, levels, slack), Certificate.witness(matrix, _names(matrix), place)))
    return bound, proofs


Door = tuple[Key, Cell]


def _pairs(scene: Scene, free: FreeCells) -> Iterator[tuple[int, list[tuple[Door, Door]]]]:
    """For each cell the ordered pairs of its doors, start and goal among them."""
    for i, cell in enumerate(free.cells):
        doors: list[Door] = [((min(i, j), max(i, j)), door) for j, door in free.doors[i].items()]
        doors += [(key, Cell.box(p, p)) for key, p in _ends(scene) if cell.contains(p)]
        if len(doors) > 1:
            yield i, [(a, b) for a, b in permutations(doors, 2) if a[0] != GOAL and b[0] != START]


def _ends(scene: Scene) -> tuple[tuple[Key, Point], tuple[Key, Point]]:
    return (START, scene.start), (GOAL, scene.goal)


def _exits(scene: Scene, around: Cell, walls: Sequence[Cell], free: FreeCells) -> Iterator[tuple[str, Formula]]:
    """That every point on a side of a cell is in a door to a cell beyond it, or in a wall, or on the rim."""
    at = coordinates(scene)
    for i, cell in enumerate(free.cells):
        for k, side in enumerate(cell.sides):
            face = cell.face(k)
            ends = [door for j, door in free.doors[i].items() if _leads(side, door, free.cells[j])] + [*walls]
            on_rim = 1 not in around.signs(side)
            if on_rim or any(all(map(end.contains, face.corners)) for end in ends):
                continue
            near = [set(end.sides).difference(face.sides) for end in ends if common_side(cell, k, end) is not None]
            ways = disj(of_sides(sorted(sides), at) for sides in near)
            yield f"cell {i} is left by doors, side {k}", every(at, disj((neg(of_sides(face.sides, at)), ways)))


def _leads(side: Side, door: Cell, other: Cell) -> bool:
    """Whether a door on this side of a cell is in the other cell, and this beyond the side."""
    return not any(door.signs(side)) and -1 not in other.signs(side) and all(map(other.contains, door.corners))


def _value(level: Level, point: Point) -> Fraction:
    return Fraction(dot(level[0], point)) + level[1]


def _label(i: int, pairs: Sequence[tuple[Door, Door]], levels: dict[Key, Level], slack: Fraction) -> str:
    """What is said of a cell, with the functions of its doors."""
    keys = dict.fromkeys(key for pair in pairs for key, _ in pair)
    rows = (" ".join(map(str, (*key, *levels[key][0], levels[key][1]))) for key in keys)
    return f"{LENGTH} {i}: {'; '.join((str(slack), *rows))}"


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
