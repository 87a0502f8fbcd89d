"""Deciding the block over one point of the parameters: known witnesses and weights first, then exactly."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from qe.convex.strict import feasible
from qe.convex.system import is_convex
from qe.convex.violation import proposed
from qe.decomposition.over_point import over_point
from qe.elimination.critical.system import System
from qe.errors import Unable
from qe.exact.nearby import rational_values
from qe.exact.parametric_form import ParametricForm, parametric_form
from qe.exact.quadratic_form import Quadratic, combine, solve_linear
from qe.exact.sample import Point
from qe.options import Budget
from qe.proof.multipliers import FormRelation

Values = tuple[Fraction, ...]


class Fibres:
    """The fibres of one system, with what has been learnt about them.

    Over a rational point a system that is convex in the quantified variables is first compared with the ``witnesses``
    and ``separations`` of earlier points, by rational arithmetic. What they leave open is decided exactly.
    """

    def __init__(self, system: System, budget: Budget) -> None:
        self.system, self.budget = system, budget
        self.witnesses: list[Values] = []
        self.separations: list[Separation] = []
        self.decided: dict[str, int] = {}
        self._truths: dict[Values, bool] = {}

    @cached_property
    def _forms(self) -> list[ParametricForm] | None:
        """The conditions as forms if every fibre over every point is convex, else None."""
        forms = []
        for condition in self.system.conditions:
            form = parametric_form(condition.poly, self.system.bound)
            if form is None or not is_convex(form.hessian, condition.relation):
                return None
            forms.append(form)
        return forms

    @cached_property
    def _decide(self) -> Callable[[Point], bool]:
        return over_point(self.system.inner, self.system.ring.names, self.system.free, budget=self.budget)

    def hold_at(self, parameters: Values) -> bool:
        """Whether the block is true over a rational point; remembered."""
        stored = self._truths.get(parameters)
        if stored is None:
            stored = self._truths[parameters] = self._hold_at(parameters)
        return stored

    def _hold_at(self, parameters: Values) -> bool:
        values = (*parameters, *(Fraction(0) for _ in self.system.bound))
        if not all(guard.relation.holds(guard.poly.sign_at(values)) for guard in self.system.guards):
            return False
        if not self.system.conditions:
            return True
        if self._forms is None:
            return self._exactly(Point.of(self.system.ring, parameters))
        forms = [form.at(parameters) for form in self._forms]
        known = self._known(forms)
        return self._convex(forms, parameters) if known is None else known

    def hold_over(self, point: Point) -> bool:
        """Whether the block is true over any point, exactly; slow where coordinates are algebraic."""
        if not point.algebraic:
            return self.hold_at(rational_values(point))
        if not all(g.relation.holds(point.sign(g.poly)) for g in self.system.guards):
            return False
        return self._exactly(point) if self.system.conditions else True

    def _exactly(self, point: Point) -> bool:
        self._count("decomposition")
        return self._decide(point)

    def _count(self, how: str) -> None:
        self.decided[how] = self.decided.get(how, 0) + 1

    # --- convex fibres over rational points -----------------------------------------------------
    @property
    def _relations(self) -> list[FormRelation]:
        return [c.relation for c in self.system.conditions]

    def _known(self, forms: Sequence[Quadratic]) -> bool | None:
        for k, witness in enumerate(self.witnesses):
            if self._solves(witness, forms):
                self.witnesses.insert(0, self.witnesses.pop(k))  # neighbours ask for the same again
                self._count("known")
                return True
        for k, separation in enumerate(self.separations):
            if separation.excludes(forms):
                self.separations.insert(0, self.separations.pop(k))
                self._count("known")
                return False
        return None

    def _solves(self, witness: Values, forms: Sequence[Quadratic]) -> bool:
        for form, relation in zip(forms, self._relations, strict=True):
            value = form.value(witness)
            if value > 0 or (value == 0 and relation is FormRelation.LT) or (value and relation is FormRelation.EQ):
                return False
        return True

    def _convex(self, forms: Sequence[Quadratic], parameters: Values) -> bool:
        if FormRelation.EQ not in self._relations:
            witness, weights = proposed(forms)
            if witness is not None and self._solves(witness, forms):
                self.witnesses.insert(0, witness)
                self._count("proposed")
                return True
            separation = None if weights is None else Separation.of(weights, forms)
            if separation is not None and separation.excludes(forms):
                self.separations.insert(0, separation)
                self._count("proposed")
                return False
        try:
            found = feasible(forms, self._relations, budget=self.budget)
            self._count("optimisation")
            return found
        except Unable:
            return self._exactly(Point.of(self.system.ring, parameters))


@dataclass(frozen=True, slots=True)
class Spared:
    """The points over which none of several blocks is true."""

    parts: tuple[Fibres, ...]

    def hold_at(self, parameters: Values) -> bool:
        """Whether a rational point belongs to them."""
        return not any(part.hold_at(parameters) for part in self.parts)

    def hold_over(self, point: Point) -> bool:
        """Whether any point belongs to them."""
        return not any(part.hold_over(point) for part in self.parts)


@dataclass(frozen=True, slots=True)
class Separation:
    """Weights w_i >= 0 of the conditions whose sum has, over every point, the constant Hessian H of full rank.

    If sum w_i g_i = y^T H y / 2 + b.y + c has the minimum c - b.H^-1.b / 2 > 0, the fibre is empty.
    """

    weights: Values
    inverse: tuple[Values, ...]

    @staticmethod
    def of(weights: Values, forms: Sequence[Quadratic]) -> Separation | None:
        """The separation with these weights, None where some are negative or the Hessian is singular."""
        total = combine(weights, forms)
        size = total.size
        units = [[Fraction(i == j) for j in range(size)] for i in range(size)]
        columns = [solve_linear(total.hessian, unit, size) for unit in units]
        if any(w < 0 for w in weights) or any(c is None or c.free for c in columns):
            return None
        return Separation(weights, tuple(tuple(c.particular) for c in columns if c is not None))

    def excludes(self, forms: Sequence[Quadratic]) -> bool:
        """Whether the weighted sum is positive everywhere."""
        total = combine(self.weights, forms)
        lowest = [-sum((v * g for v, g in zip(row, total.gradient, strict=True)), Fraction(0)) for row in self.inverse]
        return bool(total.value(lowest) > 0)
