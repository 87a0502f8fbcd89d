"""Exact global optima without convexity: the values by elimination, the least of them, the points that have it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction

from qe.decomposition.decompose import decompose
from qe.decomposition.pieces import merge
from qe.elimination.protocol import witness_of
from qe.engine.run import solve
from qe.errors import BudgetExceeded, Unable
from qe.exact.algebraic import RealAlgebraic
from qe.exact.groebner import Limits
from qe.exact.number import Values, optimum_in_latex, point_text, simplest
from qe.exact.radicals import radical_text
from qe.exact.ring import Poly, Ring
from qe.formula.block import Block
from qe.formula.build import atom, conj, convert, disj, exists, neg
from qe.formula.syntax import FALSE, TRUE, Constant, Formula, Relation
from qe.optimization.finite import listed
from qe.optimization.values import Goal, Members, first_answer, new_name, with_proof
from qe.options import Budget, Options
from qe.proof.answer import Answer, Guarantee
from qe.proof.certificate import Certificate
from qe.proof.multipliers import OptimumStatus
from qe.services import SymPyForm

Number = Fraction | RealAlgebraic

SHOWN = 8
"""So many points stand in the short forms."""

LEVEL_WORK = 2_000
"""Units of work for finding the factor of an irrational value's polynomial that holds its points."""

FIRST_WORK, GUESS_WORK, BOUND_WORK = 5_000, 100_000, 20_000
"""Units of work for the values before an optimum is guessed, for the guess, and for its proof."""

FEW = Limits(elements=100, terms=500, bits=5_000, modular=True)
"""Of a Gröbner basis for a point that elimination does not find."""

POINT = "point"
"""The label of the certificate of a point."""


@dataclass(frozen=True, slots=True, repr=False)
class GlobalOptimum(SymPyForm):
    """The answer to an optimisation problem that need not be convex.

    OPTIMAL: ``value`` is the exact minimum or maximum where ``attained``; otherwise it is the infimum or supremum,
    and no point has it. ``point``: one point that has it, empty where none does. ``minimisers``: holds at exactly
    the points that have it (``qe.region`` of it describes them); quantifiers of the constraints stand in it.
    ``points``: all of them, ascending, where they are finitely many and that is seen with little work; else empty.
    INFEASIBLE: no point meets the constraints; UNBOUNDED: there is no bound. For both ``value`` and
    ``attained`` are None. ``values``: a formula of ``variable``, the values that are taken; where the optimum was
    guessed, those that are no better. ``certificate``: a bundle that proves the values, the least of them, and the
    point, or that no value is better, and the point; None where the elimination had no certificate.
    ``answer``: how the values were found, or that none is better. ``guarantee``: CHECKED where ``check`` was asked for
    and separate code accepted the certificate; otherwise ``reason`` says why not.
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
    points: tuple[Mapping[str, Number], ...] = ()

    @property
    def unchecked_steps(self) -> tuple[str, ...]:
        """With ``check``: steps of the elimination that no checker accepted, and "point" where that is not proved."""
        members = self.certificate.payload if self.certificate is not None else ()
        shown = isinstance(members, tuple) and any(member.label == POINT for member in members)
        return (*self.answer.unchecked_steps, *([POINT] if self.point and not shown else []))

    def __repr__(self) -> str:
        if not self.is_optimal:
            return f"GlobalOptimum({self.status.value})"
        value = radical_text(self.value)
        if self.value is not None and "root(" in value.replace("sqrt(", ""):
            value += f" ≈ {float(self.value):.6g}"
        if self.attained is False:
            return f"GlobalOptimum({value}, not attained)"
        shown = self.points if 0 < len(self.points) <= SHOWN else [self.point]
        more = f", {len(self.points)} points in all" if self.points else ", for example"
        places = (point_text({name: radical_text(x) for name, x in point.items()}) for point in shown)
        return f"GlobalOptimum({value} at {' or '.join(places)}{'' if shown is self.points else more})"

    def _repr_latex_(self) -> str:
        points = self.points if len(self.points) <= SHOWN else ()
        return optimum_in_latex(self.status.value, self.value, points or ([self.point] if self.attained else []))

    @property
    def is_optimal(self) -> bool:
        """Whether the optimum is attained, and known exactly."""
        return self.status is OptimumStatus.OPTIMAL


def best(sign: int, goal: Goal, *, budget: Budget | None = None, check: bool = False) -> GlobalOptimum:
    """The minimum (``sign`` 1) or maximum (-1) of the objective where the conditions hold (they may have quantifiers).

    Raises ``Unable`` (``BudgetExceeded`` at a limit) where elimination does.
    """
    limits = budget or Budget()
    try:
        outcome, answer = first_answer(goal.taken, limits.part(FIRST_WORK), check=check)
    except Unable:
        limits.check("an optimum")
        found = _guessed(sign, goal, limits, check=check)
        if found is not None:
            return found
        outcome, answer = first_answer(goal.taken, limits, check=check)
    optimum, members = _least(sign, goal, answer, limits)
    return with_proof(optimum, goal.taken, outcome, "values", members, limits, check=check)


def _guessed(sign: int, goal: Goal, limits: Budget, *, check: bool) -> GlobalOptimum | None:
    """An optimum that was guessed, as no point has a better value, and one has this; None where one of the three
    fails."""
    from qe.optimization.guess import guess

    try:
        guessed = guess(sign, goal, limits.part(GUESS_WORK))
        if guessed is None:
            return None
        value, point = guessed
        better = _beyond(sign, goal, value, limits)
        question = exists((goal.value, *goal.variables), conj((goal.conditions, goal.graph, better)))
        outcome, answer = first_answer(question, limits.part(BOUND_WORK), check=check)
        if answer.formula != FALSE:
            return None
        optimum = attained_by(goal, value, neg(better), answer, limits, point)
    except Unable:
        limits.check("a guess")
        return None
    return with_proof(optimum, question, outcome, "bound", _proof_of(goal, optimum), limits, check=check)


def _beyond(sign: int, goal: Goal, value: Number, limits: Budget) -> Formula:
    """That the objective's value is less (``sign`` 1) or greater (-1) than a number."""
    number = new_name(goal.ring.names)
    ring = Ring.of((number, goal.value))
    side = atom((ring.var(goal.value) - ring.var(number)) * sign, Relation.LT)
    below = exists((number,), conj((side, *number_conditions(ring, number, value))))
    return convert(solve(below, Options(), limits).formula, goal.ring)


def _least(sign: int, goal: Goal, answer: Answer, limits: Budget) -> tuple[GlobalOptimum, Members]:
    """The optimum by the values that are taken, and what proves it beside the proof of these."""
    taken = answer.formula
    assert taken is not None
    if isinstance(taken, Constant):
        return _without(OptimumStatus.UNBOUNDED if taken.value else OptimumStatus.INFEASIBLE, goal, answer), []
    table = decompose(taken, (goal.value,), ("",), budget=limits).table
    pieces = merge(table, budget=limits)
    least = ("least", Certificate.cells(table))
    if not pieces:
        return _without(OptimumStatus.INFEASIBLE, goal, answer), [least]
    end, attained = pieces[0].ranges[0].end(lower=True) if sign > 0 else pieces[-1].ranges[0].end(lower=False)
    if end is None:
        return _without(OptimumStatus.UNBOUNDED, goal, answer), [least]
    assert end.value is not None
    value = simplest(end.value)
    if not attained:
        bare = _without(OptimumStatus.OPTIMAL, goal, answer)
        return replace(bare, value=value, attained=False), [least]
    optimum = attained_by(goal, value, taken, answer, limits)
    return optimum, [least, *_proof_of(goal, optimum)]


def attained_by(
    goal: Goal, value: Number, taken: Formula, answer: Answer, limits: Budget, known: Values | None = None
) -> GlobalOptimum:
    """The optimum with the points that have it, of which one may be ``known``."""
    from qe.optimization.guess import stationary_points

    points = stationary_points(goal, value) if goal.polynomial and goal.conditions == TRUE else ()
    having = level_set(goal, value, limits)
    point = dict(points[0]) if points else known or point_of(goal, value, limits)
    points, optimal = points or listed(having, goal.variables, limits), OptimumStatus.OPTIMAL
    return GlobalOptimum(optimal, value, True, point, having, taken, goal.value, answer, points=points)


def point_of(goal: Goal, value: Number, budget: Budget) -> Values:
    """A point with this value, which is the least or greatest one. Raises ``Unable`` where none is found."""
    from qe.optimization.guess import stationary_points

    place = exists((goal.value, *goal.parameters, *goal.variables), _place(goal, value))
    if (known := solve(place, Options(), budget).witness) is None:
        known = next(iter(stationary_points(goal, value, FEW)), None)
    if known is None:
        raise Unable("the least value was found, but no point that has it")
    return {name: known.get(name, Fraction(0)) for name in goal.variables}


def _without(status: OptimumStatus, goal: Goal, answer: Answer) -> GlobalOptimum:
    assert answer.formula is not None
    return GlobalOptimum(status, None, None, {}, FALSE, answer.formula, goal.value, answer)


def _proof_of(goal: Goal, optimum: GlobalOptimum) -> Members:
    """A certificate of the point; none where the constraints have quantifiers."""
    assert optimum.value is not None
    problem = Block.of(exists((goal.value, *goal.variables), _place(goal, optimum.value)))
    if problem is None or not problem.is_flat:
        return []
    known = {**optimum.point, goal.value: optimum.value}
    return [(POINT, witness_of(problem, {name: known.get(name, Fraction(0)) for name in problem.variables}))]


def _place(goal: Goal, value: Number) -> Formula:
    """The constraints, the equation of the value, and which number the value is."""
    return conj((goal.conditions, goal.graph, *number_conditions(goal.ring, goal.value, value)))


def number_conditions(ring: Ring, name: str, value: Number) -> list[Formula]:
    """That a variable is this number: the only root of its minimal polynomial between two rational numbers."""
    root, between = _being(ring.var(name), 1, value)
    return [atom(root, Relation.EQ), *between]


def _being(top: Poly, bottom: int, value: Number) -> tuple[Poly, list[Formula]]:
    """A polynomial that vanishes where top/bottom is this number, and bounds between which it does so there only."""
    if isinstance(value, Fraction):
        return top * value.denominator - value.numerator * bottom, []
    root, power = top.ring.constant(0), 1
    for c in reversed(value.minimal_polynomial):
        root, power = root * top + c * power, power * bottom
    ends = zip(value.interval(), (Relation.GE, Relation.LE), strict=True)
    return root, [atom(top * end.denominator - end.numerator * bottom, side) for end, side in ends]


def level_set(goal: Goal, value: Number, budget: Budget) -> Formula:
    """Where the constraints hold and the objective has the value, without a name for the value.

    An irrational value is the only root of its minimal polynomial between two rational numbers, so the objective has
    it exactly where it is a root of that polynomial and lies between them. Raises ``Unable`` where the name of another
    objective's value is not eliminated.
    """
    if goal.polynomial is None:
        having = exists((goal.value, *goal.parameters), _place(goal, value))
        return solve(having, Options(), budget).formula
    ring = Ring.of(tuple(name for name in goal.ring.names if name != goal.value))
    (objective, scale), conditions = goal.polynomial, convert(goal.conditions, ring)
    root, between = _being(objective.convert(ring) * scale.numerator, scale.denominator, value)
    if not between:
        return conj((conditions, atom(root, Relation.EQ)))
    return disj(_on_factor(factor, conditions, conj(between), budget) for factor, _ in root.factors()[1])


def _on_factor(factor: Poly, conditions: Formula, between: Formula, budget: Budget) -> Formula:
    """Where a factor vanishes and the conditions and bounds hold; the bounds are left out where they follow.

    A minimum is a double root of f - v, so the minimal polynomial of v, taken at f, has a square factor, and the other
    factors belong to other values.
    """
    zeros, names = conj((conditions, atom(factor, Relation.EQ))), factor.ring.names
    whole = conj((zeros, between))
    try:
        part = budget.part(LEVEL_WORK)
        if solve(exists(names, whole), Options(), part).formula == FALSE:
            return FALSE
        return zeros if solve(exists(names, conj((zeros, neg(between)))), Options(), part).formula == FALSE else whole
    except Unable as error:
        if isinstance(error, BudgetExceeded):
            budget.check("the points of an optimum")
        return whole
