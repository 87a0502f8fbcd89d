"""The points that have an optimum, one by one, where they are finitely many."""

from __future__ import annotations

from collections.abc import Sequence

from qe.decomposition.decompose import decompose
from qe.decomposition.sampled_cells import coordinates, leaves
from qe.engine.run import solve
from qe.errors import Unable
from qe.exact.number import ExactPoint, simplest
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.formula.syntax import Constant, Formula
from qe.options import Budget, Options

MOST_WORK = 1_000
"""Units of work (cells) that the list of the points may take."""

MOST_POINTS = 100
"""A longer list tells less than the formula."""


def listed(formula: Formula, variables: Sequence[str], budget: Budget) -> tuple[ExactPoint, ...]:
    """All points of a set, ascending; empty where they are infinitely many, more than ``MOST_POINTS``, or where
    telling is more work than ``MOST_WORK``.

    A set is finite iff all of its cells are points, that is sections at every level (Collins 1975).
    """
    if not set(variables) <= set(formula.free):
        return ()
    ring, part = Ring.of(tuple(variables)), budget.part(MOST_WORK)
    try:
        if not formula.is_quantifier_free:
            formula = solve(formula, Options(), part).formula
        if isinstance(formula, Constant):
            return ()
        table = decompose(convert(formula, ring), ring.names, ("",) * len(variables), budget=part).table
    except Unable:
        budget.check("points")
        return ()
    points: list[ExactPoint] = []
    for place in leaves(table, lambda cell: cell.truth is True):
        if place.depth < len(variables) or any(k % 2 == 0 for k in place.path) or len(points) == MOST_POINTS:
            return ()
        values = coordinates(table, place)
        points.append(ExactPoint({name: simplest(values[name]) for name in variables}))
    return tuple(points)
