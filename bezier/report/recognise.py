"""Reading balls and half-spaces back out of a quantifier-free answer, for pictures and tables.

The engine's answer is a formula about Q1. Where it is a conjunction of spheres and planes, each atom is a
``Condition``; anything else is reported as not recognised, and the picture is then left out, never guessed.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from bezier.curves.workspace import Ball, Condition, HalfSpace
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
    sign = -1 if part.relation in (Relation.LE, Relation.LT) else 1
    names = part.poly.ring.names
    size = len(variables)
    constant, linear, squares = Fraction(0), [Fraction(0)] * size, [Fraction(0)] * size
    for exponents, coefficient in part.poly.terms():
        used = {names[i]: k for i, k in enumerate(exponents) if k}
        if any(name not in variables for name in used):
            return None
        match tuple(used.values()):
            case ():
                constant = Fraction(sign * coefficient)
            case (1,):
                linear[variables.index(next(iter(used)))] = Fraction(sign * coefficient)
            case (2,):
                squares[variables.index(next(iter(used)))] = Fraction(sign * coefficient)
            case _:
                return None
    return _from_coefficients(constant, linear, squares)


def _from_coefficients(constant: Fraction, linear: Sequence[Fraction], squares: Sequence[Fraction]) -> Condition | None:
    """The set {constant + linear . p + sum squares_i p_i^2 >= 0} as a half-space or a ball."""
    if not any(squares):
        return HalfSpace(tuple(linear), constant)
    lead = squares[0]
    if lead >= 0 or any(s != lead for s in squares):
        return None
    centre = tuple(-c / (2 * lead) for c in linear)
    return Ball(centre, sum((c * c for c in centre), Fraction(0)) - constant / lead)
