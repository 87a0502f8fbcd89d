"""Optima that are guessed, and then proved: a bound that holds everywhere, and a point that attains it.

THEOREM (Karush 1939; Kuhn, Tucker 1951). Where a function is least on the set of equations e = 0 and inequalities
h >= 0, and the gradients of those that vanish there are linearly independent, its gradient is a combination of them.

Points that meet this are found with many digits, from several starts, by least squares (Levenberg 1944, Marquardt
1963), and recognised as algebraic. Nothing is concluded from that: the best of them is an optimum where no point has a
better value, which a sentence says, and where it has this one.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from contextlib import suppress
from math import isinf
from typing import Any

from qe.elimination.samples import bounds
from qe.errors import BudgetExceeded, Unable
from qe.exact.groebner import Limits
from qe.exact.near_zeros import STEPS, NearZeros, Point, value
from qe.exact.number import ExactPoint, Number, Values, simplest
from qe.exact.polynomial_system import LIMITS, solve_system
from qe.exact.ring import Poly, Ring
from qe.formula.build import conj
from qe.formula.syntax import Atom, Relation
from qe.formula.traverse import conjuncts
from qe.optimization.values import Goal
from qe.options import Budget
from qe.rules.lift import holds_at

MOST_VARIABLES, STARTS, FIRST_STEPS, LONGEST, LONGEST_OF_POINT = 8, 16, 4, 4, 3
"""Variables of a problem, points to start from (all ones, drawn ones), steps from each with fixed variables, how far
the schedule of digits is followed for values and for coordinates."""

SEARCH_WORK = 60_000
"""Units of work for the points; those that are known by then have to do."""

ROUGH, SAME = 64, 1e-9
"""Bits that a point needs to count, and what is as good as 0."""


def guess(sign: int, goal: Goal, budget: Budget) -> tuple[Number, Values] | None:
    """What may be the least (``sign`` 1) or greatest (-1) value of the objective, and a point that has it, exactly:
    none where its coordinates are not recognised; None where nothing is found."""
    system = _stationary(goal)
    if system is None:
        return None

    limits = [budget.part(SEARCH_WORK)]

    def spend(units: int) -> None:
        limits[0].spend(units)
        limits[0].check("a guess")

    zeros, points = NearZeros.of(system[0], spend), list[Point]()
    try:
        points.extend(_stationary_points(zeros, system, len(goal.variables)))
    except BudgetExceeded:
        budget.check("a guess")
    limits[0] = budget
    if not points:
        return None
    least = min(float(point[0]) * sign for point in points) + SAME
    best = next(point for point in points if float(point[0]) * sign <= least)
    optimum = zeros.coordinate(0, best, LONGEST)
    if optimum is None:
        return None
    place = {goal.value: optimum}
    for i, name in enumerate(goal.variables, 1):
        coordinate = zeros.coordinate(i, best, LONGEST_OF_POINT)
        if coordinate is None:
            return optimum, {}
        place[name] = coordinate
    there = holds_at(conj((goal.graph, goal.conditions)), place)
    return optimum, {name: place[name] for name in goal.variables} if there else {}


def stationary_points(goal: Goal, optimum: Number, limits: Limits = LIMITS) -> tuple[ExactPoint, ...]:
    """The points that meet the theorem and have this value, ascending, where the system has finitely many solutions;
    else none. Of a polynomial without conditions they are all (Fermat)."""
    found, points = _stationary(goal), list[ExactPoint]()
    with suppress(Unable):
        for zero in solve_system(found[0], variables=range(1 + len(goal.variables)), limits=limits) if found else ():
            value, *place = (simplest(zero.values[name].to_algebraic()) for name in (goal.value, *goal.variables))
            point = ExactPoint(zip(goal.variables, place, strict=True))
            if value == optimum and holds_at(goal.conditions, point):
                points.append(point)
    return tuple(sorted(points, key=lambda point: tuple(point.values())))


def _stationary_points(zeros: NearZeros, system: tuple[list[Poly], list[Atom]], variables: int) -> Iterator[Point]:
    """What is found from several starts, each as soon as it is known."""
    (first, *_), sides = system
    box, rng = bounds(conj(s for s in sides if s.poly.total_degree == 1), first.ring.size), random.Random(0)
    for k in range(STARTS):
        drawn = [(low, high, rng.gauss(0, 1)) for low, high in box]
        start: Sequence[Any] = [min(x if isinf(low) else low + abs(x), high) for low, high, x in drawn]
        if k % 2 == 0:
            start, _ = zeros.near(
                start if k else [1.0] * len(box), ROUGH, range(1, 1 + variables), FIRST_STEPS if k else STEPS
            )
        point, is_zero = zeros.near(start, ROUGH)
        if is_zero and all(_holds(side, point) for side in sides):
            yield point


def _stationary(goal: Goal) -> tuple[list[Poly], list[Atom]] | None:
    """The equations of a point that meets the theorem, its value first, and the conditions that no equation says."""
    parts = conjuncts(conj((goal.graph, goal.conditions)))
    atoms = [part for part in parts if isinstance(part, Atom)]
    if len(atoms) < len(parts) or not 0 < len(goal.variables) <= MOST_VARIABLES:
        return None
    bound, size = [a for a in atoms if not a.relation.is_strict and a.relation is not Relation.NE], len(goal.variables)
    ring = Ring.of((goal.value, *goal.variables, *(f"multiplier {k}" for k in range(len(bound)))))
    weighed = [(ring.gen(k), a.poly.convert(ring), a.relation) for k, a in enumerate(bound, size + 1)]
    lagrange = sum((w * p for w, p, _ in weighed), -ring.gen(0))
    zeros = [p if relation is Relation.EQ else p * w for w, p, relation in weighed]
    polys = [*zeros, *map(lagrange.derivative, range(size + 1))]
    return polys, [Atom(a.poly.convert(ring), a.relation) for a in atoms if a.relation is not Relation.EQ]


def _holds(side: Atom, point: Point) -> bool:
    """Whether a condition holds at a point, if what is small is 0."""
    left = float(value(side.poly.sparse_terms(), point))
    return ((left > SAME) - (left < -SAME)) in side.relation.signs
