"""Exact global optima without convexity: the values by elimination, the least of them, the points that have it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction

from qe.cad.decompose import decompose
from qe.cells.pieces import merge
from qe.elimination.protocol import Problem
from qe.engine.run import solve
from qe.errors import Unable
from qe.exact.algebraic import RealAlgebraic
from qe.exact.number import Values, point_text
from qe.exact.polynomial_system import solve_system
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, convert, exists
from qe.formula.syntax import FALSE, TRUE, Constant, Formula, Relation
from qe.optimization.values import Goal
from qe.options import Budget, Options
from qe.proof.answer import Answer, Guarantee
from qe.proof.certificate import Certificate
from qe.proof.multipliers import OptimumStatus

Number = Fraction | RealAlgebraic
Members = list[tuple[str, Certificate]]

POINT = "point"
"""The label of the certificate of a point."""


@dataclass(frozen=True, slots=True, repr=False)
class GlobalOptimum:
    """The answer to an optimisation problem that need not be convex.

    OPTIMAL: ``value`` is the exact minimum or maximum where ``attained``; otherwise it is the infimum or supremum,
    and no point has it. ``point``: one point that has it, empty where none does. ``minimisers``: holds at exactly
    the points that have it (``qe.region`` of it lists or describes them); quantifiers of the constraints stand in
    it. INFEASIBLE: no point meets the constraints; UNBOUNDED: there is no bound. For both ``value`` and
    ``attained`` are None. ``values``: a formula of ``variable``, the values that are taken (of the negative, for a
    maximum). ``certificate``: a bundle that proves them, the least of them, and the point; None where the
    elimination had no certificate. ``answer``: how the values were found. ``guarantee``: CHECKED where ``check`` was
    asked for and separate code accepted the certificate; otherwise ``reason`` says why not.
    """

    status: OptimumStatus
    value: Number | None
    attained: bool | None
    point: Mapping[str, Number]
    minimisers: Formula
    values: Formula
    variable: str
    answer: Answer = field(repr=False)
    certificate: Certificate | None = None
    guarantee: Guarantee = Guarantee.DERIVED
    reason: str = ""

    @property
    def unchecked_steps(self) -> tuple[str, ...]:
        """With ``check``: steps of the elimination that no checker accepted, and "point" where that is not proved."""
        members = self.certificate.payload if self.certificate is not None else ()
        shown = isinstance(members, tuple) and any(member.label == POINT for member in members)
        return (*self.answer.unchecked_steps, *([POINT] if self.point and not shown else []))

    def __repr__(self) -> str:
        if not self.is_optimal:
            return f"GlobalOptimum({self.status.value})"
        return f"GlobalOptimum({self.value}{f' at {point_text(self.point)}' if self.point else ', not attained'})"

    @property
    def is_optimal(self) -> bool:
        return self.status is OptimumStatus.OPTIMAL


def minimize_globally(
    objective: Poly,
    constraints: Formula,
    *,
    scale: Fraction | int = 1,
    budget: Budget | None = None,
    check: bool = False,
) -> GlobalOptimum:
    """The minimum of ``scale * objective`` where ``constraints`` hold (they may have quantifiers).

    Raises ``Unable`` (``BudgetExceeded`` at a limit) where elimination does.
    """
    limits = budget or Budget()
    goal = Goal.of(objective, Fraction(scale), constraints)
    taken, answer = goal.values(limits, check=check)
    members = [] if answer.certificate is None else [("values", answer.certificate)]
    if isinstance(taken, Constant):
        return _without(OptimumStatus.UNBOUNDED if taken.value else OptimumStatus.INFEASIBLE, goal, answer, members)
    table = decompose(taken, (goal.value,), ("",), budget=limits).table
    pieces = merge(table, budget=limits)
    members += [("least", Certificate.cells(table))] if members else []
    if not pieces:
        return _without(OptimumStatus.INFEASIBLE, goal, answer, members)
    least = pieces[0].ranges[0]
    if least.lower is None:
        return _without(OptimumStatus.UNBOUNDED, goal, answer, members)
    assert least.lower.value is not None
    value = _plain(least.lower.value)
    point: Values = {}
    if least.lower_closed:
        known, place = _stationary(goal, value), exists((goal.value, *goal.variables), _place(goal, value))
        if known is None:
            found = solve(place, Options(progress=limits.listener), limits)
            if found.witness is None:
                raise Unable("the least value was found, but no point that has it")
            known = found.witness
        members += _proof_of(place, {**known, goal.value: value}) if members else []
        point = {name: known.get(name, Fraction(0)) for name in goal.variables}
    return GlobalOptimum(
        status=OptimumStatus.OPTIMAL,
        value=value,
        attained=least.lower_closed,
        point=point,
        minimisers=_level_set(goal, value) if least.lower_closed else FALSE,
        values=taken,
        variable=goal.value,
        answer=answer,
        certificate=Certificate.bundle(members) if members else None,
    )


def best(
    sign: int,
    objective: Poly,
    constraints: Formula,
    *,
    scale: Fraction | int = 1,
    budget: Budget | None = None,
    check: bool = False,
) -> GlobalOptimum:
    """The minimum (``sign`` 1), or the maximum (-1): minus the minimum of the negative."""
    found = minimize_globally(objective, constraints, scale=sign * Fraction(scale), budget=budget, check=check)
    return found if sign > 0 or found.value is None else replace(found, value=-found.value)


def _without(status: OptimumStatus, goal: Goal, answer: Answer, members: Members) -> GlobalOptimum:
    assert answer.formula is not None
    proof = Certificate.bundle(members) if members else None
    return GlobalOptimum(status, None, None, {}, FALSE, answer.formula, goal.value, answer, proof)


def _proof_of(place: Formula, known: Values) -> Members:
    """A certificate of the point; none where the constraints have quantifiers."""
    problem = Problem.of(place)
    if problem is None or not problem.is_flat:
        return []
    return [(POINT, problem.witnessed({name: known.get(name, Fraction(0)) for name in problem.variables}))]


def _plain(value: RealAlgebraic) -> Number:
    return value.as_fraction() if value.is_rational else value


def _stationary(goal: Goal, value: Number) -> Values | None:
    """Without constraints: a point with this least value among the zeros of the gradient, where they are finitely many.

    A point where a polynomial is least on all of space is a zero of its gradient (Fermat).
    """
    if goal.conditions is not TRUE or not goal.variables:
        return None
    ring = goal.objective.ring
    slopes = [goal.objective.derivative(ring.index[name]) for name in goal.variables]
    try:
        zeros = solve_system([*slopes, goal.equation], variables=[ring.index[goal.value]])
    except Unable:
        return None
    for zero in zeros:
        if zero.values[goal.value] == value:
            return {name: _plain(zero.values[name].to_algebraic()) for name in goal.variables}
    return None


def _place(goal: Goal, value: Number) -> Formula:
    """The constraints, the equation of the value, and which number the value is."""
    number = goal.objective.ring.var(goal.value)
    if isinstance(value, Fraction):
        known = [atom(number * value.denominator - value.numerator, Relation.EQ)]
    else:
        low, high = value.interval()
        ring = Ring.of((goal.value,))
        minimal = ring.from_terms({(k,): c for k, c in enumerate(value.minimal_polynomial) if c})
        known = [
            atom(minimal.convert(number.ring), Relation.EQ),
            atom(number * low.denominator - low.numerator, Relation.GE),
            atom(number * high.denominator - high.numerator, Relation.LE),
        ]
    return conj((goal.conditions, atom(goal.equation, Relation.EQ), *known))


def _level_set(goal: Goal, value: Number) -> Formula:
    """Where the constraints hold and the objective has the value, without a name for the value.

    An irrational value is the only root of its minimal polynomial between two rational numbers, so the objective has
    it exactly where it is a root of that polynomial and lies between them.
    """
    ring = Ring.of(tuple(name for name in goal.objective.ring.names if name != goal.value))
    objective, conditions = goal.objective.convert(ring), convert(goal.conditions, ring)
    if isinstance(value, Fraction):
        wanted = value / goal.scale
        return conj((conditions, atom(objective * wanted.denominator - wanted.numerator, Relation.EQ)))
    scaled, bottom = objective * goal.scale.numerator, goal.scale.denominator
    low, high = value.interval()
    root, power = ring.constant(0), 1
    for c in reversed(value.minimal_polynomial):
        root, power = root * scaled + c * power, power * bottom
    between = (
        atom(scaled * low.denominator - low.numerator * bottom, Relation.GE),
        atom(scaled * high.denominator - high.numerator * bottom, Relation.LE),
    )
    return conj((conditions, atom(root, Relation.EQ), *between))
