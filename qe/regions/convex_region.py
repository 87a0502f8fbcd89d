"""Convex regions without a decomposition: membership, fibres and bounds by exact convex optimisation."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from typing import TypeVar

from qe.convex.optimum import OptimumStatus, decide, exact, maximize, minimize
from qe.convex.system import NotConvex, read_system
from qe.decomposition.decompose import decompose
from qe.decomposition.interval import Interval, Number
from qe.decomposition.sampled_cells import any_true, leaves
from qe.errors import BudgetExceeded, InputError, Unable
from qe.exact.algebraic import RealAlgebraic
from qe.exact.number import simplest
from qe.exact.ring import Ring
from qe.formula.build import convert, exists
from qe.formula.evaluate import substituted
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, Exists, Formula
from qe.options import Budget
from qe.processes.limits import Limits
from qe.proof.cells import CellTable
from qe.regions.region import NONE, Region, checked_order, is_true

TABLE_VARIABLES = 2
"""Up to this many variables the decomposition is used for questions that optimisation does not answer."""

T = TypeVar("T")
Eliminate = Callable[[Formula, Budget], Formula]


@dataclass(frozen=True, slots=True)
class Shadow:
    """``exists hidden. conditions``: a conjunction of convex quadratic conditions, over a ring of all variables.

    ``whole``: the formula itself; ``eliminate(whole, budget)`` removes its hidden variables.
    """

    conditions: Formula
    hidden: tuple[str, ...]
    whole: Formula
    eliminate: Eliminate


def shadow_of(formula: Formula, eliminate: Eliminate) -> Shadow | None:
    """The formula as a shadow of a convex set, None where it is not seen to be one (decided exactly)."""
    body, hidden = (formula.body, formula.variables) if isinstance(formula, Exists) else (formula, ())
    body = nnf(body)
    try:
        read_system(body)
    except NotConvex:
        return None
    return Shadow(body, hidden, formula, eliminate)


class ConvexRegion(Region):
    """The set of points that convex quadratic conditions allow, perhaps together with values of hidden variables.

    ``contains``, ``fibre``, ``bounds`` and ``is_empty`` are answered by exact convex optimisation, in any number of
    variables, and bounds carry certificates. ``formula`` (where variables are hidden) and ``table``, which all the
    other questions rest on, are only computed when they are asked for.
    """

    __slots__ = ("_shadow",)

    is_optimised: bool = True

    def __init__(self, shadow: Shadow, order: tuple[str, ...] | None, *, limits: Limits = NONE) -> None:
        free = exists(shadow.hidden, shadow.conditions).free
        super().__init__(None, None, checked_order(free, order), limits)
        ring = Ring.of((*self.order, *shadow.hidden))
        self._shadow = replace(shadow, conditions=convert(shadow.conditions, ring))

    @property
    def formula(self) -> Formula:
        """The defining quantifier-free formula; computed when first asked for."""
        if self._formula is None:
            self._formula = self._asked(self._eliminated, at_once=True)
        return self._formula

    @property
    def condition(self) -> Formula:
        """The convex conditions, behind existential quantifiers where variables are hidden."""
        return exists(self._shadow.hidden, self._shadow.conditions)

    def _eliminated(self) -> Formula:
        shadow = self._shadow
        formula = shadow.eliminate(shadow.whole, self._current()) if shadow.hidden else shadow.conditions
        return nnf(convert(formula, Ring.of(self.order)))

    @property
    def table(self) -> CellTable:
        """The decomposition of the space of ``order``; computed when first asked for."""
        if self._table is None:
            self._table = self._asked(self._decomposed, at_once=True)
        return self._table

    def _decomposed(self) -> CellTable:
        return decompose(self.formula, self.order, ("",) * len(self.order), budget=self._current()).table

    @property
    def is_empty(self) -> bool:
        """Whether the region has no point."""
        return self._asked(self._nowhere)

    def _nowhere(self) -> bool:
        return self._or_by_table(
            lambda: self._somewhere(self._shadow.conditions) is None, lambda: not any_true(self.table.root)
        )

    def sample_points(self, *, timeout: float | None = None) -> list[dict[str, Number]]:
        """Exact points: in up to two variables a rational one in every true cell of full dimension (in every true cell
        if there is none of full dimension), otherwise one point in all."""
        return self._asked(self._samples, timeout, at_once=True)

    def _samples(self) -> list[dict[str, Number]]:
        if len(self.order) <= TABLE_VARIABLES:
            inner = [p for p in leaves(self.table, is_true) if p.dimension == p.depth]
            return self._points_of(inner) if inner else super()._samples()
        point = self._somewhere(self._shadow.conditions)
        return [] if point is None else [{name: point.get(name, Fraction(0)) for name in self.order}]

    def _holds(self, values: list[Number]) -> bool:
        if not self._shadow.hidden:
            return super()._holds(values)
        small = len(self.order) <= TABLE_VARIABLES
        if small and self._formula is not None:  # in more variables the answer could depend on what was read before
            return super()._holds(values)
        given = dict(zip(self.order, map(simplest, values), strict=True))
        irrational = [name for name, value in given.items() if isinstance(value, RealAlgebraic)]
        by_table = partial(super()._holds, values)
        if not irrational:
            return self._or_by_table(lambda: self._somewhere(self._under(given)) is not None, by_table)
        if len(irrational) == 1:
            value = given.pop(irrational[0])
            allowed = partial(self._range, irrational[0], self._under(given))
            return self._or_by_table(lambda: (within := allowed()) is not None and value in within, by_table)
        if not small:
            raise Unable("membership: at most one irrational coordinate expected; qe.region(region.formula) takes more")
        return by_table()

    def _under(self, given: Mapping[str, Number]) -> Formula:
        """The conditions with rational values substituted."""
        return substituted(self._shadow.conditions, {n: v for n, v in given.items() if isinstance(v, Fraction)})

    def _somewhere(self, conditions: Formula) -> dict[str, Number] | None:
        """A point that satisfies the conditions, None if there is none."""
        if conditions in (TRUE, FALSE):
            return {} if conditions == TRUE else None
        values = decide(conditions, budget=self._current()).values
        return None if values is None else dict(values)

    def _bounded(self, variable: str) -> Interval:
        optimised = partial(self._range, variable, self._shadow.conditions)
        interval = self._or_by_table(optimised, partial(super()._bounded, variable))
        if interval is None:
            raise InputError("an empty region has no bounds")
        return interval

    def _fibre(self, values: list[Number]) -> list[Interval]:
        given = dict(zip(self.order, map(simplest, values), strict=False))
        if any(isinstance(value, RealAlgebraic) for value in given.values()):
            if len(self.order) > TABLE_VARIABLES:
                raise Unable("fibre: rational values expected; take them inside the interval")
            return super()._fibre(values)
        allowed = partial(self._range, self.order[len(values)], self._under(given))
        by_table = partial(super()._fibre, values)
        return self._or_by_table(lambda: [one] if (one := allowed()) is not None else [], by_table)

    def _or_by_table(self, work: Callable[[], T], by_table: Callable[[], T]) -> T:
        """The answer by optimisation; where that could not prove one, and variables are few, the decomposition's."""
        try:
            return work()
        except Unable as error:
            if len(self.order) > TABLE_VARIABLES or isinstance(error, BudgetExceeded):
                raise
            return by_table()

    def _range(self, variable: str, conditions: Formula) -> Interval | None:
        """The interval of a variable under convex conditions, None if they contradict each other."""
        if conditions == FALSE:
            return None
        objective = Ring.of((*self.order, *self._shadow.hidden)).var(variable)
        low = minimize(objective, conditions, budget=self._current())
        if low.status is OptimumStatus.INFEASIBLE:
            return None
        high = maximize(objective, conditions, budget=self._current())
        return Interval(
            None if low.value is None else exact(low.value),
            None if high.value is None else exact(high.value),
            low.attained is True,
            high.attained is True,
            (low.certificate, high.certificate),
        )

    def __repr__(self) -> str:
        hidden = f"exists {', '.join(self._shadow.hidden)}. " if self._shadow.hidden else ""
        return f"Region({', '.join(self.order)}: {hidden}{self._shadow.conditions})"
