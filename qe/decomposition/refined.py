"""The space of the free variables by more factors, with the truth values of a table that was made before.

THEOREM. Where the factors of a decomposition of the free variables contain those of another, each of its cells lies in
one of the other's, and over it the sections of the fewer factors are some of the sections of the more, in their order.
So what is true on the larger cell is true there, and nothing has to be lifted above the free variables again.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from itertools import chain

from qe.decomposition.operators.operator import Operator
from qe.decomposition.projection import factor_lists
from qe.decomposition.stack import stack_over
from qe.errors import NotWellOriented
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.exact.watch import Watch
from qe.options import Budget
from qe.proof.cells import Cell, CellTable, Stack


def refined(
    table: CellTable, operator: Operator, levels: frozenset[int], budget: Budget, more: Iterable[Poly] = ()
) -> CellTable | None:
    """A table of free variables alone, with the derivatives of the factors of these levels, and ``more``: it says where
    the formula is true, and is no proof of that. None where a level is restricted by an equational constraint or a
    factor nullified: the whole is to be decomposed again. Raises ``BudgetExceeded``.
    """
    if any(table.constraints):
        return None
    lists = factor_lists(chain(more, *table.factors), table.free, operator, budget, levels)

    def inner(point: Point, cell: Cell) -> Cell:
        if cell.stack is None:
            return cell
        factors, known = lists[point.depth], table.factors[point.depth]
        used = tuple(range(len(factors)))
        fine = stack_over(point, factors, used, lazard=operator.evaluates)
        if fine.nullified and levels:  # derivatives may not tell the sections of its Lazard evaluation apart
            raise NotWellOriented("a factor is nullified")
        if fine.nullified:
            operator.check_nullified(point.depth, point.depth)
        budget.spend(len(fine.texts))
        budget.check("lift")
        old, place, cells = {factors.index(known[j]) for j in cell.stack.used}, 0, []
        for position, signs in enumerate(fine.texts):
            on_old = position % 2 == 1 and not old.isdisjoint(fine.sections[position // 2])
            below = cell.stack.cells[place + on_old]
            cells.append(replace(below if below.stack is None else inner(fine.sample(position), below), signs=signs))
            place += 2 * on_old
        return replace(cell, stack=Stack(used, fine.sectors, fine.sections, tuple(cells)))

    try:
        root = inner(Point(Ring.of(table.order), watch=Watch(budget.check, budget.spend)), table.root)
    except NotWellOriented:
        return None
    return replace(table, factors=lists, root=root)
