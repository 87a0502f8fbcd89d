"""Where an optimum with parameters is attained: the points, as functions of the parameters.

Let W(p, v) be the values v that are taken at the parameters p, and let the least (or greatest) ones that are attained
be roots of polynomials q(p, v) that are not zero for every v. THEOREM. In a decomposition for W, q and E(p, x): x in S
and q(p, f(x)) = 0 for a q that is not zero at p for every v, with the variables in the order p, v, x, let C be a cell
of (p, x) where E holds, over a cell of p. The real roots of these q are continuous functions over the cell of p and
nowhere meet, and f is continuous, so f(x) is the same one of them all over C: either all points of C have the optimum
or none does. Likewise the same root is the optimum all over the cell of p. So one sample of each cell tells.

For an objective that is no polynomial the graph v = f(x) is one of the conditions that the decomposition is for, and
its cells of (p, v, x) are cells of the graph.
"""

from __future__ import annotations

from dataclasses import replace
from enum import Enum
from fractions import Fraction

from qe.decomposition.decompose import decompose
from qe.decomposition.formulas import construct
from qe.decomposition.matrix import Node, compile_matrix, specialise
from qe.decomposition.sampled_cells import Place, child, rational, root_place
from qe.engine.run import solve
from qe.errors import BudgetExceeded, Unable
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.formula.build import atom, conj, convert, disj, exists, forall, implies
from qe.formula.evaluate import truth_under
from qe.formula.syntax import FALSE, TRUE, Formula, Relation
from qe.io.substitution import over_one_ring, substitute
from qe.io.surface import Name
from qe.optimization.values import Goal, new_name
from qe.options import Budget, Options
from qe.proof.cells import Cell, CellTable

MOST_WORK = 6_000
"""Units of work (cells) that the description of the points may take."""
_EXACT = 10  # units for the value of the objective at one sample


def minimisers(goal: Goal, taken: Formula, table: CellTable, sign: int, budget: Budget) -> Formula:
    """A formula of the parameters and the points at which the least (``sign`` 1) or greatest value (-1) is attained.

    ``taken``: the values that are; ``table``: its cells over the parameters and the value. The formula has a quantifier
    where the signs of the table's polynomials do not tell the ends.
    """

    def refined(levels: frozenset[int]) -> CellTable:
        raise Unable("the signs do not decide which value is the end")

    try:
        end = construct(ends(table, sign, End.ATTAINED), refined)[0]
    except Unable:
        other = new_name(goal.ring.names)
        others = substitute(taken, {goal.value: Name(other, -1)})
        ring = Ring.of((*goal.ring.names, other))
        beyond = (ring.var(goal.value) - ring.var(other)) * sign
        others, bound = over_one_ring(others, atom(beyond, Relation.LE))
        end = forall((other,), implies(others, bound))
    parts = over_one_ring(goal.conditions, goal.graph, end)
    having = exists((goal.value,), conj(parts))
    return solve(having, Options(), budget).formula if end.is_quantifier_free else having


def points(goal: Goal, taken: Formula, roots: list[Poly], sign: int, budget: Budget) -> CellTable | None:
    """The cells of the points that have the optimum, over the parameters, the value and the variables.

    ``roots``: polynomials in the parameters and the value; every attained optimum is a root of one that is not zero for
    every value. None where the cells are more work than ``MOST_WORK``.
    """
    roots_of = disj(_is_root(q.convert(goal.ring), goal.ring.names.index(goal.value), budget) for q in roots)
    having = exists((goal.value,), conj((goal.conditions, goal.graph, roots_of)))
    part = budget.part(MOST_WORK)
    try:
        place = solve(having, Options(), part).formula
        order = (*goal.parameters, goal.value, *goal.variables)
        ring = Ring.of(order)
        values, roots_of, place, graph = (convert(f, ring) for f in (taken, roots_of, place, goal.graph))
        known = (values, roots_of, place) if goal.polynomial is not None else (values, roots_of, place, graph)
        table = decompose(conj(known), order, ("",) * len(order), budget=part).table
        return replace(table, root=_Labels(table, goal.value, values, graph, sign, part).of(root_place(table)))
    except Unable as error:
        if isinstance(error, BudgetExceeded):
            budget.check("minimisers")
        return None


def _is_root(q: Poly, variable: int, budget: Budget) -> Formula:
    """That q is zero, and not for every value of the variable."""
    coefficients = [c for c in q.coefficients(variable) if c]
    names = [q.ring.names[i] for i in q.variables]
    vanishes = exists(names, conj(atom(c, Relation.EQ) for c in coefficients))
    somewhere = solve(vanishes, Options(), budget).formula != FALSE
    nonzero = disj(atom(c, Relation.NE) for c in coefficients) if somewhere else TRUE
    return conj((atom(q, Relation.EQ), nonzero))


class End(Enum):
    """What an optimum is."""

    ATTAINED = "attained"
    APPROACHED = "approached"
    UNBOUNDED = "unbounded"


def ends(table: CellTable, sign: int, wanted: End) -> CellTable:
    """Over the cells of the parameters where the least (or greatest) value is as wanted: true there alone, or at all
    values where it is unbounded. ``table``: the values that are taken."""

    def of(cell: Cell, level: int) -> Cell:
        if cell.stack is None:
            return replace(cell, truth=cell.truth is True and wanted is End.UNBOUNDED)
        cells = cell.stack.cells
        if level:
            cells = tuple(of(c, level - 1) for c in cells)
        else:
            taken = next((k for k, c in enumerate(cells[::sign]) if c.truth), None)
            kind = End.UNBOUNDED if not taken else End.ATTAINED if taken % 2 else End.APPROACHED
            end = None if taken is None or kind is not wanted else taken - (kind is End.APPROACHED)
            true = (end is not None and (k == end or kind is End.UNBOUNDED) for k in range(len(cells)))
            cells = tuple(replace(c, truth=t) for c, t in zip(cells[::sign], true, strict=True))[::sign]
        return replace(cell, stack=replace(cell.stack, cells=cells))

    return replace(table, root=of(table.root, len(table.order) - 1))


class _Labels:
    """The cells of a decomposition with the truth of "the optimum is attained here".

    ``values``: which values are taken, whose polynomials are among the factors; ``graph``: that of the objective.
    """

    def __init__(
        self, table: CellTable, value: str, values: Formula, graph: Formula, sign: int, budget: Budget
    ) -> None:
        self.table, self.value, self.graph, self.sign, self.budget = table, value, graph, sign, budget
        places = {f: (k, j) for k, level in enumerate(table.factors) for j, f in enumerate(level)}
        self.values = compile_matrix(values, places)

    def of(self, place: Place, values: Node | None = None) -> Cell:
        """The cell with its truth, and those above it. ``values``: what the signs below say of which are taken."""
        self.budget.check("minimisers")
        cell, known = place.cell, self.values if values is None else values
        if cell.stack is None:
            return replace(cell, truth=bool(cell.truth) and self.has_value(place))
        above = [specialise(known, place.depth, cell.stack.signs_of(c)) for c in cell.stack.cells]
        wanted = [c.truth is not False or c.stack is not None for c in cell.stack.cells]
        if self.table.order[place.depth] == self.value:
            taken = [k for k, node in enumerate(above) if node is True]
            end = taken[0 if self.sign > 0 else -1] if taken else None  # where it is a sector, no root of q is there
            wanted = [k == end for k in range(len(above))]
        cells = [
            self.of(child(self.table, place, k), above[k]) if wanted[k] else Cell(below.signs, False)
            for k, below in enumerate(cell.stack.cells)
        ]
        return replace(cell, stack=replace(cell.stack, cells=tuple(cells)))

    def has_value(self, place: Place) -> bool:
        """Whether the objective has the value, at the sample of a cell."""
        self.budget.spend(_EXACT)
        point: Point = place.point
        for _ in range(place.depth, len(self.table.order)):
            point = point.extend(rational(Fraction(0)))
        return bool(truth_under(self.graph, point.sign))
