"""Polynomials in place of a variable, by the checker's own arithmetic."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from qe.exact.ring import Poly
from qe.formula.build import conj, disj, exists, forall, neg
from qe.formula.syntax import And, Atom, Constant, Exists, ForAll, Formula, Not, Or
from qe.kernel.limits import check_power
from qe.kernel.step import Claim

Change = Callable[[Atom], Formula]


def mapped(formula: Formula, change: Change, about: Iterable[Poly], claim: Claim) -> Formula:
    """The formula with its atoms changed. ``about``: the polynomials of which the change makes use, those for which it
    puts others in included.

    Refused: a quantifier that binds a variable of one of these, as it is another variable there; root atoms; and, below
    a quantifier, a change that brings in a variable which it binds.
    """
    seen = frozenset(claim.ring.names[i] for p in about for i in p.variables)
    if formula.bound & seen:
        raise claim.fail(f"a quantifier inside binds {min(formula.bound & seen)}, a variable of the substitution")
    return _mapped(formula, change, frozenset(), claim)


def _mapped(formula: Formula, change: Change, bound: frozenset[str], claim: Claim) -> Formula:
    match formula:
        case Constant():
            return formula
        case Atom():
            image = change(formula)
            if bound and not bound.isdisjoint({*image.free} - {*formula.free}):
                raise claim.fail("a substitution brings in a variable that a quantifier inside binds")
            return image
        case And(args) | Or(args):
            return (conj if isinstance(formula, And) else disj)(_mapped(a, change, bound, claim) for a in args)
        case Not(arg):
            return neg(_mapped(arg, change, bound, claim))
        case Exists(variables, body) | ForAll(variables, body):
            quantify = exists if isinstance(formula, Exists) else forall
            return quantify(variables, _mapped(body, change, bound.union(variables), claim))
    raise claim.fail("no substitution into root atoms")


def quotient(poly: Poly, x: int, top: Poly, bottom: Poly) -> Poly:
    """bottom^d * poly with x = top/bottom, where d is the degree of the polynomial in x."""
    parts = poly.coefficients(x)
    check_power(top, len(parts) - 1)
    check_power(bottom, len(parts) - 1)
    result = poly.ring.constant(0)
    for power, part in enumerate(parts):
        result = result + part * top**power * bottom ** (len(parts) - 1 - power)
    return result
