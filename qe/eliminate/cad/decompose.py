"""A prenex formula to a cell table: order, projection, lifting; Lazard where Brown–McCallum does not apply."""

from __future__ import annotations

from dataclasses import dataclass

from qe.eliminate.cad.equational import constraint_factors
from qe.eliminate.cad.lift import Lifter, sector_levels
from qe.eliminate.cad.matrix import compile_matrix, strengthened
from qe.eliminate.cad.projection import factor_lists
from qe.errors import NotWellOriented
from qe.evidence.cells import CellTable
from qe.exact.ring import Ring
from qe.exact.sample import Point
from qe.formula.build import convert
from qe.formula.syntax import Formula
from qe.formula.traverse import polynomials
from qe.options import Budget, Projection


@dataclass(frozen=True, slots=True)
class Decomposition:
    """The table and what it cost.

    ``restricted``: an equational constraint restricted the first projection, which the checker has no theorem for.
    """

    table: CellTable
    cells: int
    stacks: int
    factors: int
    nullified: bool
    restricted: bool


def decompose(
    matrix: Formula,
    order: tuple[str, ...],
    quantifiers: tuple[str, ...],
    *,
    budget: Budget,
    projection: Projection = Projection.BROWN_MCCALLUM,
    separated: frozenset[int] = frozenset(),
) -> Decomposition:
    """The cell table of Q_k x_k … Q_n x_n. matrix over the variables ``order`` (free ones first).

    Where the projection asked for meets a nullified factor that its theorem does not allow, the work is redone
    with Lazard projection and Lazard evaluation together. ``separated``: see ``factor_lists``.
    Raises ``BudgetExceeded``.
    """
    ring = Ring.of(order)
    matrix = convert(matrix, ring)
    try:
        return _attempt(matrix, order, quantifiers, budget, projection, ring, separated, nullified=False)
    except NotWellOriented:
        return _attempt(matrix, order, quantifiers, budget, Projection.LAZARD, ring, separated, nullified=True)


def _attempt(
    matrix: Formula,
    order: tuple[str, ...],
    quantifiers: tuple[str, ...],
    budget: Budget,
    projection: Projection,
    ring: Ring,
    separated: frozenset[int],
    *,
    nullified: bool,
) -> Decomposition:
    top = len(order) - 1
    constraint = None
    if projection is Projection.BROWN_MCCALLUM and quantifiers[top]:
        constraint = constraint_factors(matrix, top)
    # under a constraint the discriminants that strengthening brings in are not projection factors anyway
    strong = matrix if constraint else strengthened(matrix)
    levels = factor_lists(polynomials(strong), len(order), projection, budget, separated, constraint)
    places = {f: (k, j) for k, level in enumerate(levels) for j, f in enumerate(level)}
    lifter = Lifter(levels, quantifiers, projection, budget, sector_levels(matrix, quantifiers))
    root = lifter.run(Point(ring), compile_matrix(strong, places))
    table = CellTable(order, quantifiers, matrix, projection, levels, root)
    restricted = constraint is not None and set(levels[top]) != constraint
    return Decomposition(table, lifter.cells, lifter.stacks, sum(map(len, levels)), nullified, restricted)
