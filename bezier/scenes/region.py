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
from functools import partial
from itertools import groupby
from math import ceil
from typing import Any

import qe
from bezier.curves.scalar import (
    UNITS,
    Terms,
    dot,
    ends_of,
    terms_about,
    terms_between,
    terms_product,
    terms_scaled,
    terms_sum,
)
from bezier.obstacles.obstacle import Constraint
from bezier.scenes.barrier import Wall
from bezier.scenes.cells import Cell, FreeCells, Point, Side
from bezier.scenes.outlines import outlines
from bezier.scenes.scene import Scene, of_sides
from bezier.scenes.sentences import NAMES, along, cell_of, coordinates, taken
from bezier.scenes.solid import ZERO, Solid, directions, short_between
from qe.errors import Unable
from qe.exact.field import FieldElement
from qe.exact.polynomial_system import solve_system
from qe.exact.ring import Poly
from qe.formula.syntax import Atom
from qe.options import Budget

WAYS = (1, 0), (0, 1), (1, 1), (1, -1), (2, 1), (1, 2), (2, -1), (1, -2)
"""Across lines through places where formulas touch."""
TURNS = 16384
"""Of entries of normals that are rounded, the largest."""
STEPS, NEARLY = 401, 1e-9
"""Of a ray; what a condition that is nearly kept may be off by, as a part of its terms."""
SURE = 1e-12
"""What floating point may be wrong by, as a part of the terms that are added."""
SMALLEST, SMALL, MOST_CELLS, ONE = Fraction(1, 2**24), Fraction(1, 200), 600, Fraction(1)
"""Of cells, as parts of the workspace; from SMALL on places are looked for where formulas touch."""
LENGTHS = Fraction(1, 16), Fraction(1, 256), Fraction(1, 4096)
"""Of bridges, as parts of the workspace."""


@dataclass(frozen=True, slots=True)
class Decomposed:
    """``free`` cells of a polytope ``domain`` in the workspace; the scene ``within`` it has bodies that are in formulas
    in their place, and ``numbers`` says in which bodies of the scene each of its bodies is."""

    domain: Cell
    free: FreeCells
    within: Scene
    numbers: tuple[tuple[int, ...], ...]


def decomposed(scene: Scene, fine: int, budget: Budget, even: Fraction = ONE) -> Decomposed:
    """By polytopes around convex bodies, and by ever smaller cells, those that are wider than the part ``even`` of the
    workspace wherever they are. Raises ``Unable`` where these do not tell."""
    domain, around = outlines(scene, fine)
    if not scene.formulas:
        same = tuple((i,) for i in range(len(scene.bodies)))
        return Decomposed(domain, FreeCells.of(domain, around, budget), scene, same)
    bridges: list[Wall] | None = None if scene.dimension == 2 else []

    def left_of(cell: Cell) -> tuple[Cell, ...]:
        part = cell.part(domain.sides)
        return () if part is None else FreeCells.of(part, around, budget).cells

    # mixed: cells that are not decided, each with what convex bodies and bridges leave of it
    inner, free, mixed = list[tuple[Cell, tuple[int, ...]]](), list[Cell](), list[tuple[Cell, tuple[Cell, ...]]]()
    waiting, wide = [Cell.box(scene.low, scene.high)], max(b - a for a, b in zip(scene.low, scene.high, strict=True))
    for terms in (dict(c.terms) for c in scene.conditions if c.degree == 1):
        side = tuple(terms.get(key, ZERO) for key in UNITS[: scene.dimension]), -terms.get((0, 0, 0), ZERO)
        waiting = [part for cell in waiting for part in cell.cut(side) if part is not None]
    while waiting:
        for cell in waiting:
            budget.check("cells of the scene")
            owners = _owners(scene, cell)
            if owners is None:
                mixed.append((cell, left_of(cell)))
            elif owners:
                inner.append((cell, owners))
            else:
                free += left_of(cell)
        if bridges is None and any(_width(cell) < SMALL * wide for cell in waiting):
            bridges = list(bridges_of(scene, budget))
            around = (*around, *map(cell_of, bridges))
            mixed = [(cell, left_of(cell)) for cell, _ in mixed]
        split = {k for k, (cell, _) in enumerate(mixed) if _width(cell) > even * wide}
        split = split or _between(scene, free, [cells for _, cells in mixed], around)
        waiting = [half for k in sorted(split) for half in _parts(scene, mixed[k][0])]
        mixed = [entry for k, entry in enumerate(mixed) if k not in split]
        if len(mixed) + len(waiting) > MOST_CELLS or any(_width(cell) < SMALLEST * wide for cell in waiting):
            raise Unable("undecided: a path along the boundary of a formula may exist, which small cells do not decide")
    solids = tuple(of_sides(scene.formulas[k].name, cell.corners, cell.sides, ZERO) for cell, (k, *_) in inner)
    bridges = bridges or []
    solids += tuple(Solid("bridge", (b.start, b.end), cell_of(b).sides, ZERO, ()) for b in bridges)
    count = len(scene.solids)
    numbers = (
        *((i,) for i in range(count)),
        *(tuple(count + k for k in owners) for _, owners in inner),
        *(b.bodies for b in bridges),
    )
    within = replace(scene, formulas=(), holes=(*scene.holes, *solids))
    return Decomposed(domain, FreeCells.linked(free, around), within, numbers)


# --- what is seen ---------------------------------------------------------------------------------------
def seen_from(scene: Scene, point: Point) -> tuple[Constraint, ...]:
    """Polynomials of formulas, positive at a point, with the zeros that rays from there first meet in the way; none
    where such a ray meets another zero of them before. Floating point, which decides nothing."""
    import numpy as np

    signed = dict.fromkeys(replace(c, strict=False) for same in scene.conditions for c in (same, same.negated))
    listed = [c for c in signed if c.value((*point, ZERO)[:3]) > 0]
    wide = float(sum(b - a for a, b in zip(scene.low, scene.high, strict=True)))
    start, shares = np.array([*map(float, point), 0.0][:3]), np.linspace(0.0, 1.0, STEPS)
    hit, rays = set[int](), list[list[tuple[float, int, bool]]]()
    for ray in directions(scene.dimension, 4 if scene.dimension == 2 else 3):
        unit = np.array([*map(float, ray), 0.0][:3])
        away, zeros = wide * unit / np.linalg.norm(unit), list[tuple[float, int, bool]]()
        for i, c in enumerate(listed):
            values = _roughly(c, start[:, None] + away[:, None] * shares)[0]
            for k in np.flatnonzero((np.broadcast_to(values, shares.shape) <= 0)[1:])[:1]:
                low, high = shares[k], shares[k + 1]
                for _ in range(50):
                    middle = (low + high) / 2
                    low, high = (middle, high) if _roughly(c, start + away * middle)[0] > 0 else (low, middle)
                zeros.append((high, i, _is_nearly_in(scene, start + away * high)))
        rays.append(sorted(zeros))
        hit |= {next((i for _, i, is_taken in rays[-1] if is_taken), -1)}
    first = (next((is_taken for _, i, is_taken in zeros if i in hit), True) for zeros in rays)
    return tuple(listed[i] for i in sorted(hit - {-1})) if all(first) else ()


def _roughly(condition: Constraint, place: Any) -> tuple[Any, Any]:
    """The value at points, and the sum of the sizes of the terms."""
    terms = [float(x) * place[0] ** i * place[1] ** j * place[2] ** k for (i, j, k), x in condition.terms]
    return sum(terms), sum(map(abs, terms))


def _is_nearly_in(scene: Scene, place: Any) -> bool:
    """Whether a point is in the way, or nearly."""
    near = float(max(b - a for a, b in zip(scene.low, scene.high, strict=True))) / 1000  # next to the zeros of x, too

    def holds(condition: Constraint) -> bool:
        return bool(_roughly(condition, place)[0] >= -NEARLY * _roughly(condition, abs(place) + near)[1])

    return any(all(map(holds, piece)) for body in scene.bodies for piece in body.pieces) or not all(
        holds(c) for part in scene.domain for piece in part.pieces for c in piece
    )


# --- where formulas touch ------------------------------------------------------------------------------
def bridges_of(scene: Scene, budget: Budget) -> Iterator[Wall]:
    """Segments in bodies through places in the plane where formulas touch something or have a corner, which cells do
    not fill: from rational ones into the bodies. One with coordinates in Q(sqrt(d)) lies on one line that is rational,
    with its conjugate, and along that on both sides of it."""
    wide, count = max(b - a for a, b in zip(scene.low, scene.high, strict=True)), len(scene.solids)
    for place in _touching(scene, budget):
        if all(value.is_rational for value in place):
            point = tuple(value.as_fraction() for value in place)
            for i, body in enumerate(scene.formulas, start=count):
                yield from (Wall(point, end, (i,)) for end in _into(body, point, wide))
        elif place[0].field.degree == 2:
            yield from _across(scene, place, wide)


def lines_through(scene: Scene, budget: Budget) -> Iterator[Constraint]:
    """Polynomials with rational coefficients that are zero on a line through an irrational place where formulas touch,
    and on parallel ones."""
    for place in _touching(scene, budget):
        for way in () if all(value.is_rational for value in place) else WAYS:
            level, total, power = place[0] * way[0] + place[1] * way[1], Terms(), Terms({(0, 0, 0): Fraction(1)})
            for c in level.minimal_polynomial:
                total = terms_sum(total, terms_scaled(c, power))
                power = terms_product(power, {(1, 0, 0): Fraction(way[0]), (0, 1, 0): Fraction(way[1])})
            yield Constraint.of(total)


def _touching(scene: Scene, budget: Budget) -> Iterator[tuple[FieldElement, ...]]:
    """The common points of two boundaries, one of a formula, and the singular ones of that, in the workspace."""
    at, seen = coordinates(scene), set[tuple[Fraction, ...]]()
    curves, others = (
        list(dict.fromkeys(f for body in bodies for piece in body.pieces for c in piece for f in _factors(c, at)))
        for bodies in (scene.formulas, (*scene.solids, *scene.domain))
    )
    systems: list[tuple[Poly, ...]] = [(p, q) for i, p in enumerate(curves) for q in (*curves[:i], *others) if p != q]
    systems += [(p, p.derivative(0), p.derivative(1)) for p in curves if p.total_degree > 1]
    for system in systems:
        budget.check("places where formulas touch")
        try:
            zeros = solve_system(system)
        except Unable:  # a common curve, or too many
            continue
        for place in (tuple(zero.values[name] for name in NAMES[:2]) for zero in zeros):
            low, high = (tuple(Fraction(ends[k]) for ends in (v.interval(40) for v in place)) for k in (0, 1))
            ends = zip(scene.low, low, high, scene.high, strict=True)
            if low not in seen and all(a <= d and c <= b for a, c, d, b in ends):
                seen.add(low)
                yield place


def _factors(condition: Constraint, at: Sequence[Poly]) -> list[Poly]:
    said = condition.formula(at)
    return [f for f, _ in said.poly.factors()[1]] if isinstance(said, Atom) else []


def _into(body: Solid, point: Point, wide: Fraction) -> list[Point]:
    """Ends of segments in a body that begin at a point of it: one in each range of directions, as long as they can."""
    for share in LENGTHS:
        ends = [tuple(p + wide * share * d for p, d in zip(point, way, strict=True)) for way in directions(2, 4)]
        held = [body.holds(point, end) for end in ends] if body.contains(point) else []
        if any(held):
            first = next((k for k in range(len(held)) if held[k] and not held[k - 1]), 0)
            turned = groupby((k % len(held) for k in range(first, first + len(held))), key=held.__getitem__)
            runs = [list(run) for is_held, run in turned if is_held]
            return [ends[run[len(run) // 2]] for run in runs]
    return []


def _across(scene: Scene, place: Sequence[FieldElement], wide: Fraction) -> Iterator[Wall]:
    """A segment with a point between its ends whose coordinates are quadratic, if it is in the way."""
    near = Fraction(sum(place[0].field.theta.interval(40))) / 2
    rows = [(*value.coefficients, ZERO)[:2] for value in place]
    for share in LENGTHS:
        step = wide * share / max(abs(row[1]) for row in rows)
        middle = near.limit_denominator(ceil(4 / step))
        start, end = (tuple(a + b * (middle + side * step) for a, b in rows) for side in (-1, 1))
        bodies = tuple(i for i, body in enumerate(scene.bodies) if body.contains(start) or body.contains(end))
        said = along((start, end), partial(taken, scene, [scene.bodies[i] for i in bodies]))
        if bodies and qe.eliminate(said, timeout=1.0, process=False).truth:
            yield Wall(start, end, bodies)
            return


def _between(scene: Scene, free: Sequence[Cell], mixed: Sequence[Sequence[Cell]], walls: Sequence[Cell]) -> set[int]:
    """The numbers of mixed cells that ways from start to goal lead through, none twice; none where a way is free."""
    owners = {len(free) + n: k for n, k in enumerate(k for k, cells in enumerate(mixed) for _ in cells)}
    graph = FreeCells.linked((*free, *(cell for cells in mixed for cell in cells)), walls)
    start, goal, split = graph.holding(scene.start), graph.holding(scene.goal), set[int]()
    while start is not None and goal is not None and goal in (before := graph.reached(start, owners)):
        hit = {i for i in graph.way(before, goal) if i in owners}
        if not hit:
            return set()
        split |= {owners[i] for i in hit}
        gone = hit - {start, goal}
        if not gone:
            break
        graph = replace(graph, doors=tuple({j: d for j, d in doors.items() if j not in gone} for doors in graph.doors))
    return split


def _parts(scene: Scene, cell: Cell) -> list[Cell]:
    """The cell cut in halves, and these again: in the plane along the curve of a condition that is open there, if that
    is nearly straight, so that cells lie along narrow passages; or else across the longest side. Along a line that just
    touches the cell it is cut once: such cuts alone would not end."""
    parts = [cell]
    for share in (-1, 1):
        parts = [half for part in parts for half in part.cut(_cut_through(scene, part, share)) if half is not None]
    return parts


def _cut_through(scene: Scene, cell: Cell, share: int) -> Side:
    """Found in floating point, which decides nothing about cells. ``share``: -1 where lines may just touch it."""
    low, high = ends_of(cell.floats)
    sizes, least = [b - a for a, b in zip(low, high, strict=True)], 1.0
    normal = tuple(Fraction(k == sizes.index(max(sizes))) for k in range(len(sizes)))
    for c in scene.conditions if len(sizes) == 2 else ():
        try:
            slopes, values, rest = terms_about({powers: float(x) for powers, x in c.terms}, cell.floats)
        except OverflowError:
            continue
        bent, change = sum(map(abs, rest.values())), max(values) - min(values)
        away = bent + NEARLY * change if bent else share * NEARLY * change
        if min(values) + away < 0 < max(values) - away and bent < least * change:
            normal, least = tuple(Fraction(round(s / max(map(abs, slopes)) * TURNS)) for s in slopes), bent / change
    levels = [Fraction(dot(normal, p)) for p in cell.corners]
    first, last = min(levels), max(levels)
    return normal, short_between((first * 9 + last * 7) / 16, (first * 7 + last * 9) / 16)


def _width(cell: Cell) -> Fraction:
    result: Fraction = max(b - a for a, b in zip(*ends_of(cell.corners), strict=True))
    return result


def _owners(scene: Scene, cell: Cell) -> tuple[int, ...] | None:
    """The numbers of formulas that a cell is in: one, or two that differ in one condition, which is reversed; none
    where it is clear of all, None where that is not seen."""
    is_clear, nearly = True, dict[Constraint, int]()
    for k, body in enumerate(scene.formulas):
        for piece in () if body.margin and _is_far(body, cell) else body.pieces:
            spans = [(c, *_span(c, cell)) for c in piece]
            lacking = [c for c, low, _ in spans if not c.holds(low)]
            if not lacking:
                return (k,)
            is_clear = is_clear and any(not c.holds(high) for c, _, high in spans)
            if len(lacking) == 1:
                reverse = replace(lacking[0].negated, strict=False)
                if reverse in nearly:
                    return nearly[reverse], k
                nearly[lacking[0]] = k
    return () if is_clear else None


def _is_far(body: Solid, cell: Cell) -> bool:
    """Whether a box around a cell, wider by the margin, is seen to be clear of a formula without that."""
    low, high = ends_of(cell.corners)
    box = Cell.box(tuple(c - body.margin for c in low), tuple(c + body.margin for c in high))
    return all(any(not c.holds(_span(c, box)[1]) for c in piece) for piece in body.core)


def _span(condition: Constraint, cell: Cell) -> tuple[Fraction, Fraction]:
    """Numbers below and above a polynomial on a cell: those of its linear part at the corners, and of the rest. In
    floating point where their signs are clear."""
    if condition.degree < 2:
        exact = [condition.value((*p, ZERO)[:3]) for p in cell.corners]
        return min(exact), max(exact)
    far = max(1.0, *(abs(c) for p in cell.floats for c in p))
    try:
        rough = {powers: float(c) for powers, c in condition.terms}
        error = SURE * sum(abs(c) * far ** sum(powers) for powers, c in rough.items())
        low, high = terms_between(rough, cell.floats)
        if min(abs(low), abs(high)) > error:
            return Fraction(low), Fraction(high)
    except OverflowError:
        pass
    return terms_between(dict(condition.terms), cell.corners)
