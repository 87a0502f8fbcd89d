"""Convex inequalities of an answer without interior points: the equations of its affine hull in their place."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import lcm

from qe.elimination.protocol import Context
from qe.exact.quadratic_form import Number, echelon
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj
from qe.formula.features import length
from qe.formula.syntax import FALSE, And, Atom, Formula, Relation
from qe.rules.linear import Pivot, substitute
from qe.simplifier.simplify import simplify

MOST_CURVED = 3
"""Variables of conditions that are not linear."""


def may_lack_interior(formula: Formula) -> bool:
    """Whether the formula has several weak inequalities and nothing else: linear ones, more than variables, or some of
    degree two in so few variables that what follows is proved."""
    if not isinstance(formula, And):
        return False
    weak, variables = (Relation.LE, Relation.GE), len(formula.free)
    degrees = {a.poly.total_degree if isinstance(a, Atom) and a.relation in weak else 3 for a in formula.args}
    return max(degrees) < 3 and (variables <= MOST_CURVED if 2 in degrees else len(formula.args) > variables)


def affine_hull_first(formula: Formula, context: Context, start: object = None) -> Formula:
    """The equations of the affine hull, solved, and the inequalities that are left on it."""
    from qe.convex.facial_reduction import implied_equations
    from qe.convex.system import NotConvex

    ring = formula.ring
    if ring is None or not may_lack_interior(formula):
        return formula
    equations: list[Poly] = []
    rest = formula
    while True:
        try:
            more = implied_equations(rest, budget=context.budget)
        except NotConvex:  # equations are all that is left
            break
        if more is None:
            return context.log.step("simplification", formula, FALSE)
        if not more:
            break
        equations = _solved([*equations, *more], ring)
        rest = simplify(_at(equations, rest), watch=context.budget.check)
    shorter = conj((*(atom(e, Relation.EQ) for e in equations), rest))
    if length(shorter)[::-1] >= length(formula)[::-1]:
        return formula
    return context.log.step("simplification", formula, shorter)


def _solved(equations: list[Poly], ring: Ring) -> list[Poly]:
    """The same linear equations, each with a variable that the others do not have."""
    variables, nowhere = range(len(ring.names)), [0] * len(ring.names)
    rows = [
        [*(e.coefficients(i)[-1].constant_value() if e.degree(i) else 0 for i in variables), e.evaluate(nowhere)]
        for e in equations
    ]
    return [_linear(row, ring) for row in echelon(rows)[0]]


def _linear(row: Sequence[Number], ring: Ring) -> Poly:
    """The polynomial with these coefficients and this constant, last, without denominators."""
    scale = lcm(*(Fraction(c).denominator for c in row))
    *factors, constant = (int(scale * c) for c in row)
    return sum((c * ring.gen(i) for i, c in enumerate(factors) if c), ring.constant(constant))


def _at(equations: list[Poly], formula: Formula) -> Formula:
    """The formula with the first variable of each equation substituted."""
    for equation in equations:
        i = equation.variables[0]
        constant, lead = equation.coefficients(i)
        sign = 1 if lead.constant_value() > 0 else -1
        formula = substitute(formula, Pivot(0, i, lead, constant, sign, False)) or formula
    return formula
