"""The topology of sets on a line and in the plane, exactly: closure, interior and connected components.

THEOREM. Cells of a decomposition are connected. Over an interval I of the first variable the roots of the factors are
continuous functions; each has a limit, finite or not, at an end a of I, and a finite limit is a root over a of the same
factor (it does not vanish on the whole line over a, being irreducible in two variables). So the closure of a cell
between two such functions meets the line over a in the closed interval between their limits, whose ends are
sections there: the closure of a cell is a union of cells. A union of cells has as many components as the graph in which
two cells are joined if one meets the closure of the other, for the unions of separate parts of that graph are
separated sets (Munkres, Topology, section 23).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

from qe.decomposition.decompose import Tactics, decompose
from qe.decomposition.formulas import construct
from qe.decomposition.interval import Number
from qe.decomposition.sampled_cells import child, root_place
from qe.exact.algebraic import real_roots
from qe.exact.fibre_stack import isolate_over
from qe.exact.nearby import rational_between
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.formula.syntax import Formula
from qe.options import Budget
from qe.proof.cells import Cell, CellTable, Stack

DIMENSIONS = 2
"""In more variables the closure of a cell need not be a union of cells; for components see ``qe.regions.spatial``."""

WHOLE = Tactics(constraints=False, partial=False, open_only=False, whole_free=True)

Place = tuple[int, ...]
"""A cell by its positions in the stacks, from the first variable on."""

Choice = Callable[["Cells"], frozenset[Place]]


def formula_of(formula: Formula, order: tuple[str, ...], chosen: Choice, budget: Budget) -> Formula:
    """A formula of the union of the cells that are ``chosen`` of a decomposition for ``formula``.

    ``chosen`` must mean the same set for every decomposition. Raises ``BudgetExceeded``.
    """

    def table(levels: frozenset[int]) -> CellTable:
        cells = Cells.of(formula, order, budget, levels)
        return marked(cells.table, chosen(cells))

    return construct(table(frozenset()), table)[0]


def components(formula: Formula, order: tuple[str, ...], budget: Budget) -> list[Formula]:
    """Formulas of the connected components, by their first cells. Raises ``BudgetExceeded``."""
    count = len(Cells.of(formula, order, budget).components())
    if count < 2:
        return [formula] * count
    return [formula_of(formula, order, lambda c, k=k: c.components()[k], budget) for k in range(count)]  # type: ignore[misc]


def marked(table: CellTable, places: frozenset[Place]) -> CellTable:
    """The table with these cells true and all others false."""
    size = len(table.order)

    def mark(cell: Cell, place: Place) -> Cell:
        if cell.stack is None:
            return replace(cell, truth=place + (0,) * (size - len(place)) in places)
        cells = tuple(mark(below, (*place, k)) for k, below in enumerate(cell.stack.cells))
        return replace(cell, stack=replace(cell.stack, cells=cells))

    return replace(table, root=mark(table.root, ()))


@dataclass(frozen=True, slots=True)
class Cells:
    """All cells of a full decomposition for one or two variables, and which lie in the closure of which."""

    table: CellTable
    truth: Mapping[Place, bool]
    frontier: Mapping[Place, frozenset[Place]]

    @staticmethod
    def of(formula: Formula, order: tuple[str, ...], budget: Budget, levels: frozenset[int] = frozenset()) -> Cells:
        """The cells for a quantifier-free formula. Raises ``BudgetExceeded``."""
        table = decompose(formula, order, ("",) * len(order), budget=budget, thom_levels=levels, tactics=WHOLE).table
        truth = dict(truths(table.root, (), len(order)))
        return Cells(table, truth, frontiers(table, len(order), budget))

    def closure(self) -> frozenset[Place]:
        """The cells of the closure of the set."""
        own = self._own(True)
        return own.union(*(self.frontier[cell] for cell in own))

    def interior(self) -> frozenset[Place]:
        """The cells of the interior: those outside the closure of the complement."""
        rest = self._own(False)
        return frozenset(self.truth) - rest.union(*(self.frontier[cell] for cell in rest))

    def boundary(self) -> frozenset[Place]:
        """The cells of the closure outside the interior."""
        return self.closure() - self.interior()

    def components(self) -> list[frozenset[Place]]:
        """The cells of each connected component of the set; the components by their first cells.

        A finer decomposition gives the same components in the same order.
        """
        own = self._own(True)
        return connected_parts(own, {(cell, other) for cell in own for other in self.frontier[cell] & own})

    def _own(self, truth: bool) -> frozenset[Place]:
        return frozenset(place for place, value in self.truth.items() if value is truth)


def truths(cell: Cell, place: Place, size: int) -> Iterator[tuple[Place, bool]]:
    """All cells with their truth; one without a stack stands for the line, or the plane, over it."""
    if cell.stack is None:
        yield place + (0,) * (size - len(place)), cell.truth is True
        return
    for k, below in enumerate(cell.stack.cells):
        yield from truths(below, (*place, k), size)


def connected_parts(cells: frozenset[Place], pairs: set[tuple[Place, Place]]) -> list[frozenset[Place]]:
    """The parts of a graph, by their first cells. ``pairs``: its edges."""
    joined: dict[Place, list[Place]] = {cell: [] for cell in cells}
    for cell, other in pairs:
        joined[cell].append(other)
        joined[other].append(cell)
    left, parts = set(cells), []
    for start in sorted(cells):
        if start not in left:
            continue
        part, waiting = {start}, [start]
        while waiting:
            new = set(joined[waiting.pop()]) - part
            part |= new
            waiting += new
        left -= part
        parts.append(frozenset(part))
    return parts


def frontiers(table: CellTable, size: int, budget: Budget) -> dict[Place, frozenset[Place]]:
    """For every cell of the line or the plane of the first ``size`` variables the others in its closure."""
    sections = len(stack_at(table, ()).sections)
    base = {k: _beside(k, sections) for k in range(2 * sections + 1)}
    if size == 1:
        return {(k,): frozenset((j,) for j in near) for k, near in base.items()}
    closures: dict[Place, frozenset[Place]] = {}
    for k, near in base.items():
        budget.check("closures of cells", k)
        heights = len(stack_at(table, (k,)).sections)
        over = {j: _limits(table, k, j) for j in near}
        for t in range(2 * heights + 1):
            cells = {(k, u) for u in _beside(t, heights)}
            for j, limits in over.items():
                last = 2 * len(stack_at(table, (j,)).sections)
                low, high = (limits[t // 2],) * 2 if t % 2 else ends_of(limits, t // 2, last)
                cells |= {(j, u) for u in range(max(low, 0), min(high, last) + 1)}
            closures[(k, t)] = frozenset(cells)
    return closures


def _beside(k: int, sections: int) -> list[int]:
    """The sections beside a sector, both positions in one stack; none beside a section."""
    return [] if k % 2 else [j for j in (k - 1, k + 1) if 0 < j < 2 * sections]


def ends_of(limits: list[int], sector: int, last: int) -> tuple[int, int]:
    """The limits of both ends of a sector; ``last``: the highest position where they are."""
    return limits[sector - 1] if sector else -1, limits[sector] if sector < len(limits) else last + 1


def stack_at(table: CellTable, place: Place) -> Stack:
    """The stack over a cell; where there is none, one without sections."""
    cell = table.root
    for position in place:
        cell = cell if cell.stack is None else cell.stack.cells[position]
    return cell.stack or Stack((), (Fraction(0),), (), (cell,))


def _limits(table: CellTable, sector: int, section: int) -> list[int]:
    """Where the sections over a sector of the line end over a section beside it, as positions in the stack there.

    -1 below and 2m+1 above all of its 2m+1 cells: no finite limit. Over the section the rational samples of
    ``sectors`` lie between the roots; no root crosses them on the way from x to the section, where x is
    nearer to it than any other root of a factor at a sample.
    """
    place = child(table, root_place(table), section)
    end = place.point.number(0)
    beyond = stack_at(table, ()).sectors[sector // 2]
    samples = stack_at(table, (section,)).sectors
    factors = table.factors[1]
    x = nearer(end, beyond, [f.at_rational(1, y) for f in factors for y in samples])
    stack = isolate_over(Point.of(Ring.of(table.order), [x]), factors)
    roots = [stack.sample(2 * k + 1).number(1) for k in range(len(stack.sections))]
    return [2 * sum(y < root for y in samples) - 1 for root in roots]


def nearer(end: Number, beyond: Fraction, polys: Iterable[Poly]) -> Fraction:
    """A rational number between ``end`` and ``beyond``, with no root of a polynomial between it and ``end``."""
    near: Number = beyond
    up = end < beyond
    for poly in dict.fromkeys(polys):
        if poly.is_constant:
            continue
        for root in real_roots(poly.to_univariate(0)):
            if (end < root and root < near) if up else (near < root and root < end):
                near = root
    return rational_between(end, near) if up else rational_between(near, end)
