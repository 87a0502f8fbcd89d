"""Reading balls and half-spaces back out of a quantifier-free answer, for pictures and tables.

The engine's answer is a formula about Q1. Where it is a conjunction of spheres and planes, each atom is a
``Condition``; anything else is reported as not recognised, and the picture is then left out, never guessed.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from bezier.curves.workspace import Ball, Condition, HalfSpace
from qe.exact.quadratic_form import Quadratic, quadratic
from qe.exact.ring import Ring
from qe.formula.syntax import Atom, Constant, Formula, Relation
from qe.formula.traverse import conjuncts


def as_conditions(formula: Formula, variables: Sequence[str]) -> tuple[Condition, ...] | None:
    """The conditions whose intersection the formula describes (up to strictness), or None."""
    if isinstance(formula, Constant):
        return () if formula.value else None
    found = [_condition(part, variables) for part in conjuncts(formula)]
    return None if any(c is None for c in found) else tuple(c for c in found if c is not None)


def _condition(part: Formula, variables: Sequence[str]) -> Condition | None:
    if not isinstance(part, Atom) or part.relation not in (Relation.LE, Relation.LT, Relation.GE, Relation.GT):
        return None
    poly = part.poly if part.relation in (Relation.GE, Relation.GT) else -part.poly
    if any(poly.ring.names[i] not in variables for i in poly.variables):
        return None
    form = quadratic(poly.convert(Ring.of(variables)), range(len(variables)))
    return None if form is None else _set_of(form)


def _set_of(form: Quadratic) -> Condition | None:
    """The set where the form is at least 0 as a half-space, or as a ball, for lead*|p - c|^2/2 + d."""
    if form.is_linear:
        return HalfSpace(form.gradient, form.constant)
    lead = form.hessian[0][0]
    sphere = tuple(tuple(lead * (i == j) for j in range(form.size)) for i in range(form.size))
    if lead >= 0 or form.hessian != sphere:
        return None
    centre = tuple(-c / lead for c in form.gradient)
    return Ball(centre, sum((c * c for c in centre), Fraction(0)) - 2 * form.constant / lead)
