"""Universal blocks whose truth set has no interior points: it is empty, or lies on a hyperplane of parameter space."""

from __future__ import annotations

from collections.abc import Sequence

from qe.convex.facial_reduction import implied_equations
from qe.convex.system import NotConvex
from qe.elimination.critical import necessary_conditions
from qe.formula.build import atom, conj, convert
from qe.formula.syntax import FALSE, ForAll, Formula, Relation
from qe.options import Budget
from qe.rules.linear import Pivot, substitute


def thin_universal(formula: ForAll, negated: Formula, parameters: Sequence[str], budget: Budget) -> Formula | None:
    """The formula of a universal block, where necessary conditions at a few values of its variable contradict each
    other or imply a linear equation of the parameters; None elsewhere.

    The block is then equivalent to that equation together with the block with a parameter put in, which stays
    quantified.
    """
    conditions = necessary_conditions(formula.variables, negated, parameters)
    if conditions is None or conditions == FALSE:
        return conditions
    try:
        implied = implied_equations(conditions, budget=budget)
    except NotConvex:
        return None
    if not implied:
        return FALSE if implied is None else None
    equation = implied[0]
    i = equation.variables[0]
    constant, lead = equation.coefficients(i)
    pivot = Pivot(0, i, lead, constant, 1 if lead.constant_value() > 0 else -1, False)
    rest = substitute(convert(formula, equation.ring), pivot)
    if rest is None:
        return None
    ring = formula.ring or equation.ring
    return conj(convert(part, ring) for part in (atom(equation, Relation.EQ), rest))
