"""What is left for the next variable of a region once the first ones have values, read off a cell table."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

from qe.decomposition.interval import Interval, Number
from qe.decomposition.operators.table import OPERATORS
from qe.decomposition.sampled_cells import any_true
from qe.exact.algebraic import RealAlgebraic
from qe.exact.fibre_stack import Isolation, isolate_over
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.options import Budget
from qe.proof.cells import Cell, CellTable


def fibre_of(table: CellTable, values: Sequence[Number], *, budget: Budget) -> list[Interval]:
    """The values of variable number len(values) for which the table's set has a point that begins with ``values``.

    The factors are delineable over every cell, so the stack over the given point has the shape of the table's stack
    over the sample of its cell, and only its roots are computed anew. Disjoint intervals, ascending.
    Raises ``BudgetExceeded``.
    """
    cell, point = table.root, Point(Ring.of(table.order))
    for value in values:
        budget.check("fibre", point.depth)
        if cell.stack is not None:
            position = _position(_stack_over(table, cell, point), value)
            cell = cell.stack.cells[position]
        point = point.extend(value if isinstance(value, RealAlgebraic) else RealAlgebraic.rational(value))
    if cell.stack is None:
        return [Interval(None, None, False, False)] if cell.truth else []
    budget.check("fibre", point.depth)
    isolation = _stack_over(table, cell, point)
    return [_interval(isolation, run) for run in _runs(cell.stack.cells)]


def _stack_over(table: CellTable, cell: Cell, point: Point) -> Isolation:
    assert cell.stack is not None
    factors = tuple(table.factors[point.depth][j] for j in cell.stack.used)
    lazard = OPERATORS[table.projection].evaluates
    return isolate_over(point, factors, lazard=lazard) if point.depth else _first_stack(point.ring, factors, lazard)


@lru_cache(maxsize=32)
def _first_stack(ring: Ring, factors: tuple[Poly, ...], lazard: bool) -> Isolation:
    """The stack that every walk through a table begins with."""
    return isolate_over(Point(ring), factors, lazard=lazard)


def _position(isolation: Isolation, value: Number) -> int:
    """The place of a value in the stack over the point."""
    for k in range(len(isolation.sections)):
        root = _root(isolation, k)
        if value <= root:
            return 2 * k + (value == root)
    return 2 * len(isolation.sections)


def _root(isolation: Isolation, section: int) -> Number:
    return isolation.sample(2 * section + 1).number(isolation.point.depth)


def _runs(cells: Sequence[Cell]) -> list[range]:
    found: list[range] = []
    for position, cell in enumerate(cells):
        if any_true(cell):
            if found and found[-1].stop == position:
                found[-1] = range(found[-1].start, position + 1)
            else:
                found.append(range(position, position + 1))
    return found


def _interval(isolation: Isolation, run: range) -> Interval:
    """From the section at or before the first cell of the run to the one at or after the last."""
    first, last = (run.start - 1) // 2, run[-1] // 2
    lower = None if run.start == 0 else _root(isolation, first)
    upper = None if last == len(isolation.sections) else _root(isolation, last)
    return Interval(lower, upper, run.start % 2 == 1, run[-1] % 2 == 1)
