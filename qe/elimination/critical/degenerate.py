"""Universal blocks whose truth set has no interior points: it is empty, or lies on a hyperplane of parameter space."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from qe.convex.facial_reduction import implied_equations
from qe.convex.optimum import decide
from qe.convex.system import NotConvex
from qe.elimination.critical.universal import necessary_conditions
from qe.errors import Unable
from qe.formula.build import atom, conj, convert, exists
from qe.formula.syntax import FALSE, ForAll, Formula, Relation
from qe.options import Budget
from qe.proof.step import Nested, Step
from qe.rules.linear import put_in


@dataclass(frozen=True, slots=True)
class Thin:
    """``formula`` is the block's; ``evidence``: what shows it (see ``qe.proving.thin``)."""

    formula: Formula
    evidence: Mapping[str, object]


def thin_universal(formula: ForAll, negated: Formula, parameters: Sequence[str], budget: Budget) -> Thin | None:
    """The formula of a universal block, where necessary conditions at a few values of its variable contradict each
    other or imply a linear equation of the parameters; None elsewhere.

    The block is then equivalent to that equation together with the block with a parameter substituted, which stays
    quantified.
    """
    found = necessary_conditions(formula.variables, negated, parameters)
    if found is None:
        return None
    conditions, values = found
    evidence: dict[str, object] = {"variable": formula.variables[0], "values": list(values), "equation": None}
    try:
        implied = None if conditions == FALSE else implied_equations(conditions, budget=budget)
        if not implied:
            parts = [_contradiction(conditions, budget)]
            return Thin(FALSE, {**evidence, "parts": parts}) if implied is None else None
        equation = implied[0]
        sides = [_contradiction(conj((conditions, atom(equation, r))), budget) for r in (Relation.LT, Relation.GT)]
    except NotConvex:
        return None
    i = equation.variables[0]
    rest = put_in(convert(formula, equation.ring), i, equation)
    if rest is None:
        return None
    ring = formula.ring or equation.ring
    whole = conj(convert(part, ring) for part in (atom(equation, Relation.EQ), rest))
    return Thin(whole, {**evidence, "equation": [equation.ring.names[i], equation], "parts": sides})


def _contradiction(conditions: Formula, budget: Budget) -> Nested:
    """That conditions have no common solution, with multipliers that show it where there are some."""
    sentence = exists(conditions.free, conditions)
    if sentence == FALSE:
        return Nested(sentence, (), FALSE)
    evidence: dict[str, object] = {}
    try:
        found = decide(conditions, budget=budget)
        evidence = {"proof": {"certificate": found.certificate}} if found.values is None else {}
    except Unable:
        budget.check("multipliers")
    return Nested(sentence, (Step("convex", sentence, FALSE, evidence=evidence),), FALSE)
