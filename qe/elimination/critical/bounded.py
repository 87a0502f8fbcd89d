"""Whether the fibres of a system are bounded, locally uniformly in the parameters: the theorem's side condition."""

from __future__ import annotations

from fractions import Fraction

from qe.convex.system import is_convex
from qe.elimination.critical.system import System
from qe.exact.parametric_form import parametric_form
from qe.exact.quadratic_form import Definiteness, definiteness
from qe.exact.ring import Poly
from qe.proof.multipliers import FormRelation


def has_bounded_fibres(system: System) -> bool:
    """A sufficient criterion, decided exactly.

    Variables whose absolute value has a bound that is a continuous function of the parameters are collected:
    (1) a condition in parameters, collected variables and one more variable y whose leading coefficient in y is a
    constant bounds y above or below (both for even degree and for equations); variables in which an inequality f <= 0
    is linear and that are bounded on the side where f is small do not count; (2) if among all conditions that are
    convex quadratic in the quantified variables with constant Hessian those Hessians add up to one that is positive
    definite in the remaining variables, then their sum bounds these.
    """
    bounded: set[int] = set()
    sides: set[tuple[int, int]] = set()
    rules = [(c.poly, c.relation is FormRelation.EQ) for c in system.conditions]
    known = -1
    while known < len(sides):
        known = len(sides)
        for poly, equation in rules:
            unsettled = {i for i in poly.variables if i >= system.free and i not in bounded}
            helpful = set() if equation else {i for i in unsettled if (i, -_slope(poly, i)) in sides}
            for i in unsettled:
                if unsettled - helpful <= {i}:
                    sides |= {(i, side) for side in _sides(poly, i, equation)}
        bounded = {i for i, side in sides if (i, -side) in sides}
    rest = [i for i in system.bound if i not in bounded]
    return not rest or _definite_sum(system, rest)


def _slope(poly: Poly, i: int) -> int:
    """The sign of the constant coefficient of a variable of degree one; 0 if it is not such a variable."""
    if poly.degree(i) != 1 or not poly.leading(i).is_constant:
        return 0
    return 1 if poly.leading(i).constant_value() > 0 else -1


def _sides(poly: Poly, i: int, equation: bool) -> tuple[int, ...]:
    """On which sides ``poly <= 0`` (or = 0) bounds variable i: 1 above, -1 below."""
    lead = poly.leading(i)
    if not lead.is_constant:
        return ()
    if equation:
        return 1, -1
    positive = lead.constant_value() > 0
    if poly.degree(i) % 2 == 0:
        return (1, -1) if positive else ()
    return (1,) if positive else (-1,)


def _definite_sum(system: System, rest: list[int]) -> bool:
    place = [i - system.free for i in rest]
    hessians = []
    for condition in system.conditions:
        form = parametric_form(condition.poly, system.bound)
        if form is not None and is_convex(form.hessian, FormRelation.LE):
            hessians.append(form.hessian)
    if not hessians:
        return False
    total = [[sum((h[i][j] for h in hessians), Fraction(0)) for j in place] for i in place]
    return definiteness(total) is Definiteness.POSITIVE_DEFINITE
