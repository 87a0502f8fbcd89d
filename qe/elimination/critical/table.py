"""The cell table of a truth set that is known by an oracle: every cell of every level, for given polynomials."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import Enum
from fractions import Fraction

from qe.decomposition.operators.operator import Operator
from qe.decomposition.projection import Levels
from qe.decomposition.sampled_cells import any_true
from qe.decomposition.stack import stack_over
from qe.elimination.critical.open_cells import true_run
from qe.exact.ring import Poly
from qe.exact.sample import Point
from qe.options import Budget
from qe.proof.cells import Cell, Stack

Truth = Callable[[Point, frozenset[Poly]], bool]
"""The truth at a sample, given the boundary polynomials that vanish there."""


class Shape(Enum):
    """What is known about the truth set next to its boundary polynomials.

    CONVEX: closed and convex with interior points. CLOSED, OPEN: just that.
    """

    CONVEX = "convex"
    CLOSED = "closed"
    OPEN = "open"
    ANY = "any"


@dataclass(slots=True)
class TableBuilder:
    """One run. ``boundary``: polynomials between whose zeros the truth is constant.

    A cell off these zeros is connected, so its sample tells its truth, and so it does for a single point. For a
    CONVEX set it always does: over each base cell the fibre is an interval whose ends depend continuously on the
    base point and lie on sections (in more than two dimensions this takes a bounded set and no nullified polynomial).
    So its true sectors follow one another; where there are some, or the base cell is open, no section is true but those
    next to them (the set is the closure of its interior).
    Otherwise a section of positive dimension is true next to a true sector of a CLOSED set, and false next to a
    false sector of an OPEN one; what remains is ``unsettled``: the cell is listed as false, and a polynomial that
    vanishes there is kept for the caller.
    """

    levels: Levels
    operator: Operator
    boundary: frozenset[Poly]
    shape: Shape
    truth: Truth
    budget: Budget
    cells: int = 0
    unsettled: set[Poly] = field(default_factory=set)
    _near: dict[int, Fraction] = field(default_factory=dict)

    def run(self, origin: Point) -> Cell:
        """The root cell, given the point without coordinates."""
        return self._cell(origin, "", frozenset(), (), 0, None)

    def _cell(
        self,
        point: Point,
        signs: str,
        vanishing: frozenset[Poly],
        around: tuple[Cell, ...],
        dimension: int,
        known: bool | None,
    ) -> Cell:
        """``around``: for a section, the cells of the sectors next to it. ``known``: its truth, if known."""
        level = point.depth
        if level == len(self.levels):
            self.cells += 1
            self.budget.check("cells", self.cells)
            return Cell(signs, self._truth(point, vanishing, dimension, around) if known is None else known)
        factors = self.levels[level]
        used = tuple(range(len(factors)))
        stack = stack_over(point, factors, used, lazard=self.operator.evaluates)
        if stack.nullified:
            self.operator.check_nullified(level, dimension)
        texts = stack.texts
        cells: dict[int, Cell] = {}

        def visit(position: int, known: bool | None, *around: Cell) -> bool:
            zero = frozenset(f for f, c in zip(factors, texts[position], strict=True) if c == "0") & self.boundary
            sample, size = stack.sample(position), dimension + (position % 2 == 0)
            cells[position] = self._cell(sample, texts[position], vanishing | zero, around, size, known)
            return any_true(cells[position])

        convex, full = self.shape is Shape.CONVEX and known is None, level == len(self.levels) - 1
        run = range(0)
        if convex:
            run = true_run(stack.sectors, self._near.get(level, Fraction(0)), lambda k: visit(2 * k, None))
            if run:
                self._near[level] = stack.sectors[run[len(run) // 2]]
        for k in range(len(stack.sectors)):
            if 2 * k not in cells:
                visit(2 * k, (True if full else None) if k in run else False if convex else known)
        for position in range(1, len(texts), 2):
            sides = cells[position - 1], cells[position + 1]
            false = convex and (run or dimension == level) and not any(map(any_true, sides))
            visit(position, False if false else known, *sides)
        complete = tuple(cells[position] for position in range(len(texts)))
        return Cell(signs, None, Stack(used, stack.sectors, stack.sections, complete))

    def _truth(self, point: Point, vanishing: frozenset[Poly], dimension: int, around: tuple[Cell, ...]) -> bool:
        truths = [cell.truth for cell in around]
        if True in truths and self.shape in (Shape.CLOSED, Shape.CONVEX):
            return True
        if False in truths and self.shape is Shape.OPEN:
            return False
        if not vanishing or not dimension or self.shape is Shape.CONVEX:
            return self.truth(point, vanishing)
        if not self.unsettled & vanishing:
            self.unsettled.add(min(vanishing, key=lambda f: (f.total_degree, f.term_count(), f.terms())))
        return False
