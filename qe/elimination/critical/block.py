"""``exists y. body`` by critical values: where the answer can change, and whether it does (see ``boundary``)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from qe.convex.violation import proposed
from qe.decomposition.operators.brown_mccallum import BROWN_MCCALLUM
from qe.decomposition.operators.operator import Operator
from qe.decomposition.projection import factor_lists
from qe.decomposition.refined import refined
from qe.elimination.critical.boundary import critical_hypersurfaces
from qe.elimination.critical.bounded import has_bounded_fibres
from qe.elimination.critical.fibres import Fibres, Spared
from qe.elimination.critical.open_cells import OpenCells
from qe.elimination.critical.system import System, systems
from qe.elimination.critical.table import Shape, TableBuilder, Truth
from qe.errors import Unable
from qe.exact.nearby import nearby
from qe.exact.quadratic_form import quadratic
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.exact.watch import Watch
from qe.formula.build import convert
from qe.formula.syntax import TRUE, Formula
from qe.options import Budget
from qe.proof.cells import CellTable

Refine = Callable[[frozenset[int], frozenset[Poly]], CellTable]


@dataclass(frozen=True, slots=True)
class Tabulated:
    """A truth set as a table over the parameters, all of them free; its matrix is left to the caller.

    ``refine(levels, planes)``: the same set in a table with further polynomials, whose factor lists of these levels are
    closed under differentiation.
    ``unsettled``: the truth set may also hold points where one of these polynomials vanishes and the table says false.
    """

    table: CellTable
    refine: Refine
    unsettled: frozenset[Poly]


@dataclass(frozen=True, slots=True)
class Disjunct:
    """One disjunct of the body and where it can be satisfied; ``found`` is a truth value when nothing is free."""

    body: Formula
    found: Tabulated | bool
    stats: dict[str, object]


def eliminate_block(
    variables: Sequence[str], body: Formula, parameters: Sequence[str], *, budget: Budget
) -> list[Disjunct]:
    """The disjuncts of ``exists variables. body``, each with its truth set; the block is true where one of them is.

    ``body``: quantifier-free and positive, in ``variables`` and ``parameters`` (whose order is that of the tables).
    Raises ``Unable`` when the fibres of a disjunct are not seen to be bounded, or its critical points do not give
    hypersurfaces; ``BudgetExceeded`` at a limit.
    """
    ring = Ring.of((*parameters, *variables))
    parts = systems(convert(body, ring), ring, len(parameters))
    for system in parts:
        if not has_bounded_fibres(system):
            raise Unable("critical-value elimination: the quantified variables are not seen to be bounded")
    return [_eliminated(system, budget) for system in parts]


def _eliminated(system: System, budget: Budget) -> Disjunct:
    fibres = Fibres(system, budget)
    stats: dict[str, object] = {"decided": fibres.decided}
    if not system.free:
        return Disjunct(system.formula, fibres.hold_at(()), stats)
    run = Run(system, fibres, budget, stats)
    body = run.convex() if system.is_convex and system.is_closed else None
    return Disjunct(system.formula, run.general() if body is None else body, stats)


@dataclass(frozen=True, slots=True)
class Run:
    """The work on one truth set over the parameters of ``system``."""

    system: System
    fibres: Fibres | Spared
    budget: Budget
    stats: dict[str, object]

    def general(self) -> Tabulated:
        """Any truth set: cells off the hypersurfaces by rational points next to them, single points exactly."""
        boundary = critical_hypersurfaces(self.system, thin_parts=True, budget=self.budget)
        self.stats["hypersurfaces"] = len(boundary)

        def truth(point: Point, vanishing: frozenset[Poly]) -> bool:
            if point.algebraic and not vanishing:
                return self.fibres.hold_at(nearby(point, tuple(boundary), vanishing, None))
            return self.fibres.hold_over(point)

        shape = Shape.CLOSED if self.system.is_closed else Shape.OPEN if self.system.is_open else Shape.ANY
        return self._tabulated(boundary, shape, truth)

    def convex(self) -> Tabulated | None:
        """A closed convex truth set, if it has interior points."""
        surfaces = critical_hypersurfaces(self.system, thin_parts=False, budget=self.budget)
        return self.body(surfaces, self._hint())

    def body(self, surfaces: frozenset[Poly], hint: tuple[Fraction, ...]) -> Tabulated | None:
        """The closed convex truth set with its boundary in the zeros of ``surfaces``, if it has interior points.

        A point p on a boundary polynomial belongs to such a set T iff the segment from p to an interior point c
        begins in it: then all of (p, c] is interior (Rockafellar 1970, Theorem 6.1), and otherwise p has a
        neighbourhood outside.
        """
        origin = Point(self.system.ring, watch=Watch(self.budget.check, self.budget.spend))
        levels = factor_lists(surfaces, self.system.free, BROWN_MCCALLUM, self.budget)
        cells = OpenCells(levels, self.fibres.hold_at, self.budget, hint)
        cells.explore(origin)
        boundary = frozenset(cells.walls() | {f for f in surfaces if f.level < self.system.free - 1})
        self.stats.update({"hypersurfaces": len(surfaces), "cells decided": cells.decided, "boundary": len(boundary)})
        if not cells.inside:
            return None
        centre = cells.inside[len(cells.inside) // 2]

        def truth(point: Point, vanishing: frozenset[Poly]) -> bool:
            if not vanishing and not point.algebraic:
                return self.fibres.hold_over(point)
            return self.fibres.hold_at(nearby(point, tuple(boundary), vanishing, centre))

        return self._tabulated(boundary, Shape.CONVEX, truth)

    def _hint(self) -> tuple[Fraction, ...]:
        """A point of the truth set, if one is proposed; the origin otherwise."""
        size = self.system.ring.size
        conditions = self.system.without_parameters().conditions
        forms = [form for c in conditions if (form := quadratic(c.poly, range(size))) is not None]
        witness, _ = proposed(forms)
        return (witness or (Fraction(0),) * size)[: self.system.free]

    def _tabulated(self, boundary: frozenset[Poly], shape: Shape, truth: Truth) -> Tabulated:
        """The table for the boundary polynomials, closed under projection, with the truth of every cell."""
        size = self.system.free
        if shape is Shape.CONVEX and size > 2 and not has_bounded_fibres(self.system.without_parameters()):
            shape = Shape.CLOSED  # the theorem of ``Shape.CONVEX`` then has only been proved in the plane

        def attempt(
            closed: frozenset[int], planes: frozenset[Poly], operator: Operator
        ) -> tuple[CellTable, frozenset[Poly], Operator]:
            levels = factor_lists(
                boundary.union(f.convert(self.system.ring) for f in planes), size, operator, self.budget, closed
            )
            known = Shape.CLOSED if shape is Shape.CONVEX and size > 2 and operator.evaluates else shape
            builder = TableBuilder(levels, operator, boundary, known, truth, self.budget)
            root = builder.run(Point(self.system.ring, watch=Watch(self.budget.check, self.budget.spend)))
            outer = Ring.of(self.system.ring.names[:size])
            factors = tuple(tuple(f.convert(outer) for f in level) for level in levels)
            table = CellTable(outer.names, ("",) * size, TRUE, operator.proof, factors, root)
            return table, frozenset(builder.unsettled), operator

        def refine(levels: frozenset[int], planes: frozenset[Poly]) -> CellTable:
            finer = refined(first, operator, levels, self.budget, planes)
            return finer or BROWN_MCCALLUM.applied(lambda operator: attempt(levels, planes, operator))[0]

        first, unsettled, operator = BROWN_MCCALLUM.applied(
            lambda operator: attempt(frozenset(), frozenset(), operator)
        )
        return Tabulated(first, refine, unsettled)
