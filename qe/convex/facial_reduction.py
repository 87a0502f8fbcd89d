"""Linear equations that a convex set without interior points satisfies: one step of facial reduction."""

from __future__ import annotations

from collections.abc import Sequence
from math import lcm

from qe.convex.minimise import equations_of_hull
from qe.convex.system import NotConvex, read_system
from qe.convex.violation import proposed
from qe.errors import InternalError, Unable
from qe.exact.quadratic_form import Quadratic
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom
from qe.formula.syntax import FALSE, Atom, Formula, Relation
from qe.options import Budget
from qe.rules.linear import put_in
from qe.simplifier.simplify import simplify


def on_flat(variables: Sequence[str], body: Formula, *, budget: Budget) -> tuple[list[Formula], Formula] | None:
    """(equations in the parameters, body without the variables that linear equations give): together equivalent to
    the block. None where a convex body has interior points or the equations of its flat are not found."""
    try:
        implied = implied_equations(body, budget=budget)
    except NotConvex:
        return None
    if implied is None:
        return [], FALSE
    outside: list[Formula] = []
    rest, equations = body, [atom(f, Relation.EQ) for f in implied]
    for k in range(len(equations)):
        equation = equations[k]
        if not isinstance(equation, Atom):
            continue
        names = [equation.poly.ring.names[i] for i in equation.poly.variables]
        name = next((n for n in names if n in variables), names[0])
        i = equation.poly.ring.index[name]
        if name not in variables:
            outside.append(equation)
        replaced = [g for f in (rest, *equations[k + 1 :]) if (g := put_in(f, i, equation.poly)) is not None]
        if len(replaced) < len(equations) - k:
            return None
        rest, *equations[k + 1 :] = replaced
    return (outside, simplify(rest, watch=budget.check)) if implied else None


def implied_equations(conditions: Formula, *, budget: Budget) -> list[Poly] | None:
    """Linear polynomials that vanish wherever convex quadratic conditions f_i <= 0 hold; None if they contradict.

    THEOREM (Borwein, Wolkowicz 1981). Let w_i >= 0, not all zero, and L = sum w_i f_i >= 0 everywhere, with equality
    at x. Then f_i = 0 on the whole set for each w_i > 0, and by convexity H_i (z - x) = 0 and f_i(x) + grad f_i(x).(z -
    x) = 0 for its points z. Such w are the multipliers of the least possible violation if that is zero.
    No equations also where the set has interior points, where conditions are strict or equations, and where the numbers
    are irrational. Raises ``NotConvex``.
    """
    ring = conditions.ring
    if ring is None:
        return []
    system = read_system(conditions)
    forms = system.forms
    if not system.is_weak:
        return []
    witness, weights = proposed(forms)
    if weights is not None:
        return None
    try:
        known = [] if witness is not None else equations_of_hull(system, budget)
    except Unable:  # an irrational flat, or numbers beyond the range of floats
        budget.check("optimum: facial reduction")
        known = []
    return [_poly(e, system.names, ring) for e in known if any(e.gradient)]


def _poly(equation: Quadratic, names: Sequence[str], ring: Ring) -> Poly:
    scale = lcm(equation.constant.denominator, *(c.denominator for c in equation.gradient))
    total = ring.constant(int(equation.constant * scale))
    for c, name in zip(equation.gradient, names, strict=True):
        total = total + int(c * scale) * ring.var(name)
    if not total.variables:
        raise InternalError("an equation without variables")
    return total
