"""Polynomials in place of a variable, by the checker's own arithmetic."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from qe.certify.limits import check_power, check_value
from qe.certify.step import Claim
from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj, exists, forall, neg
from qe.formula.syntax import And, Atom, Constant, Exists, ForAll, Formula, Not, Or

Change = Callable[[Atom], Formula]


def mapped(formula: Formula, change: Change, names: frozenset[str], claim: Claim) -> Formula:
    """The formula with its atoms changed. Refused: a quantifier that binds one of ``names``, and root atoms."""
    match formula:
        case Constant():
            return formula
        case Atom():
            return change(formula)
        case And(args) | Or(args):
            return (conj if isinstance(formula, And) else disj)(mapped(a, change, names, claim) for a in args)
        case Not(arg):
            return neg(mapped(arg, change, names, claim))
        case Exists(variables, body) | ForAll(variables, body):
            if names & set(variables):
                raise claim.fail("a quantifier inside binds a variable of the substitution")
            quantify = exists if isinstance(formula, Exists) else forall
            return quantify(variables, mapped(body, change, names, claim))
    raise claim.fail("no substitution into root atoms")


def at_number(formula: Formula, x: int, value: Fraction, claim: Claim) -> Formula:
    """The formula with a number for variable ``x``."""

    def change(given: Atom) -> Formula:
        if not given.poly.degree(x):
            return given
        check_value(given.poly, x, value)
        return atom(given.poly.at_rational(x, value), given.relation)

    return mapped(formula, change, frozenset((claim.ring.names[x],)), claim)


def quotient(poly: Poly, x: int, top: Poly, bottom: Poly) -> Poly:
    """bottom^d * poly with x = top/bottom, where d is the degree of the polynomial in x."""
    parts = poly.coefficients(x)
    check_power(top, len(parts) - 1)
    check_power(bottom, len(parts) - 1)
    result = poly.ring.constant(0)
    for power, part in enumerate(parts):
        result = result + part * top**power * bottom ** (len(parts) - 1 - power)
    return result
