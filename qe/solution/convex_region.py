"""Convex regions without a decomposition: membership, fibres and bounds by exact convex optimisation."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from qe.eliminate.cad.decompose import decompose
from qe.errors import InputError, Unable
from qe.evidence.cells import CellTable
from qe.exact.algebraic import RealAlgebraic
from qe.exact.field import FieldElement
from qe.exact.ring import Ring
from qe.formula.build import convert, exists
from qe.formula.evaluate import substituted
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, Exists, Formula
from qe.formula.traverse import free_variables
from qe.options import Budget
from qe.solution.interval import Interval, Number
from qe.solution.optimum import OptimumStatus, maximize, minimize
from qe.solution.optimum_problem import NotConvex, read_problem
from qe.solution.region import Region, checked_order, is_true
from qe.solution.walk import coordinates, leaves

TABLE_VARIABLES = 2
"""Up to this many variables the decomposition is used for questions that optimisation does not answer."""


@dataclass(frozen=True, slots=True)
class Shadow:
    """``exists hidden. conditions``: a conjunction of convex quadratic conditions, over a ring of all variables.

    ``formula()`` eliminates the hidden variables.
    """

    conditions: Formula
    hidden: tuple[str, ...]
    formula: Callable[[], Formula]


def shadow_of(formula: Formula, eliminate: Callable[[Formula], Formula]) -> Shadow | None:
    """The formula as a shadow of a convex set, None where it is not seen to be one (decided exactly)."""
    body, hidden = (formula.body, formula.variables) if isinstance(formula, Exists) else (formula, ())
    body = nnf(body)
    try:
        read_problem(Ring.of(()).constant(0), body)
    except NotConvex:
        return None
    return Shadow(body, hidden, lambda: eliminate(formula))


class ConvexRegion(Region):
    """The set of points that convex quadratic conditions allow, perhaps together with values of hidden variables.

    ``contains``, ``fibre``, ``bounds`` and ``is_empty`` are answered by exact convex optimisation, in any number of
    variables, and bounds carry certificates. ``formula`` (where variables are hidden) and ``table``, which all the
    other questions rest on, are only computed when they are asked for.
    """

    __slots__ = ("_budget", "_shadow")

    def __init__(self, shadow: Shadow, order: tuple[str, ...] | None, *, budget: Budget) -> None:
        free = free_variables(exists(shadow.hidden, shadow.conditions))
        super().__init__(None, None, checked_order(free, order))
        ring = Ring.of((*self.order, *shadow.hidden))
        self._shadow = Shadow(convert(shadow.conditions, ring), shadow.hidden, shadow.formula)
        self._budget = budget

    @property
    def formula(self) -> Formula:
        """The defining quantifier-free formula; computed when first asked for."""
        if self._formula is None:
            found = self._shadow.formula() if self._shadow.hidden else self._shadow.conditions
            self._formula = nnf(convert(found, Ring.of(self.order)))
        return self._formula

    @property
    def table(self) -> CellTable:
        """The decomposition of the space of ``order``; computed when first asked for."""
        if self._table is None:
            done = decompose(self.formula, self.order, ("",) * len(self.order), budget=self._budget)
            self._table = done.table
        return self._table

    @property
    def is_empty(self) -> bool:
        return self._somewhere(self._shadow.conditions) is None

    def sample_points(self) -> list[dict[str, Number]]:
        """Exact points: in up to two variables a rational one in every true cell of full dimension (in every true cell
        if there is none of full dimension), otherwise one point in all."""
        if len(self.order) <= TABLE_VARIABLES:
            inner = [p for p in leaves(self.table, is_true) if p.dimension == p.depth]
            return [coordinates(self.table, p) for p in inner] if inner else super().sample_points()
        point = self._somewhere(self._shadow.conditions)
        return [] if point is None else [{name: point.get(name, Fraction(0)) for name in self.order}]

    def _holds(self, values: list[Number]) -> bool:
        if self._formula is not None or not self._shadow.hidden:
            return super()._holds(values)
        rational = _rationals(values)
        if rational is None:
            if len(self.order) > TABLE_VARIABLES:
                raise Unable("membership of an algebraic point needs the hidden variables to be eliminated")
            return super()._holds(values)
        return self._somewhere(self._under(rational)) is not None

    def _under(self, values: list[Fraction]) -> Formula:
        return substituted(self._shadow.conditions, dict(zip(self.order, values, strict=False)))

    def _somewhere(self, conditions: Formula) -> dict[str, Number] | None:
        """A point that satisfies the conditions, None if there is none."""
        if conditions in (TRUE, FALSE):
            return {} if conditions == TRUE else None
        nothing = Ring.of((*self.order, *self._shadow.hidden)).constant(0)
        found = minimize(nothing, conditions, budget=self._budget)
        if found.status is OptimumStatus.INFEASIBLE:
            return None
        strictly = found.evidence.inner_point if found.attained is False else tuple(found.point.values())
        return {name: _number(value) for name, value in zip(found.point, strictly, strict=True)}

    def bounds(self, variable: str) -> Interval:
        """The exact infimum and supremum of a variable, whether they are attained, and the certificates of both."""
        if variable not in self.order:
            raise InputError(f"variable: one of {', '.join(self.order)} expected, {variable} found")
        if variable not in self._bounds:
            found = self._range(variable, self._shadow.conditions)
            if found is None:
                raise InputError("an empty region has no bounds")
            self._bounds[variable] = found
        return self._bounds[variable]

    def _fibre(self, values: list[Number]) -> list[Interval]:
        rational = _rationals(values)
        if rational is None:
            if len(self.order) > TABLE_VARIABLES:
                raise Unable("fibre: rational values expected; take them inside the interval")
            return super()._fibre(values)
        found = self._range(self.order[len(values)], self._under(rational))
        return [] if found is None else [found]

    def _range(self, variable: str, conditions: Formula) -> Interval | None:
        """The interval of a variable under convex conditions, None if they contradict each other."""
        if conditions == FALSE:
            return None
        objective = Ring.of((*self.order, *self._shadow.hidden)).var(variable)
        low = minimize(objective, conditions, budget=self._budget)
        if low.status is OptimumStatus.INFEASIBLE:
            return None
        high = maximize(objective, conditions, budget=self._budget)
        return Interval(
            None if low.value is None else _number(low.value),
            None if high.value is None else _number(high.value),
            low.attained is True,
            high.attained is True,
            (low.certificate, high.certificate),
        )

    def __repr__(self) -> str:
        hidden = f"exists {', '.join(self._shadow.hidden)}. " if self._shadow.hidden else ""
        return f"Region({', '.join(self.order)}: {hidden}{self._shadow.conditions})"


def _rationals(values: list[Number]) -> list[Fraction] | None:
    """The values as fractions, None if one is irrational."""
    found = []
    for value in values:
        if isinstance(value, RealAlgebraic):
            if not value.is_rational:
                return None
            value = value.as_fraction()
        found.append(value)
    return found


def _number(value: Fraction | FieldElement) -> Number:
    if isinstance(value, FieldElement):
        return value.as_fraction() if value.is_rational else value.to_algebraic()
    return value
