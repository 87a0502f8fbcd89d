"""Polynomials in place of a variable, by the checker's own arithmetic."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from qe.exact.ring import Poly
from qe.formula.syntax import Atom, Atomic, Formula
from qe.formula.traverse import map_atoms
from qe.kernel.limits import check_power
from qe.kernel.step import Claim

Change = Callable[[Atom], Formula]


def mapped(formula: Formula, change: Change, about: Iterable[Poly], claim: Claim) -> Formula:
    """The formula with its atoms changed. ``about``: the polynomials of which the change makes use, those for which it
    puts others in included; so no quantifier inside may bind a variable of one of them. Refused: root atoms.
    """
    seen = {claim.ring.names[i] for p in about for i in p.variables}
    if not formula.bound.isdisjoint(seen):
        raise claim.fail(f"a quantifier inside binds {min(formula.bound & seen)}, a variable of the substitution")

    def image(found: Atomic) -> Formula:
        if not isinstance(found, Atom):
            raise claim.fail("no substitution into root atoms")
        changed = change(found)
        if not formula.bound.isdisjoint({*changed.free} - {*found.free}):
            raise claim.fail("a substitution brings in a variable that a quantifier inside binds")
        return changed

    return map_atoms(formula, image)


def quotient(poly: Poly, x: int, top: Poly, bottom: Poly) -> Poly:
    """bottom^d * poly with x = top/bottom, where d is the degree of the polynomial in x."""
    parts = poly.coefficients(x)
    check_power(top, len(parts) - 1)
    check_power(bottom, len(parts) - 1)
    value, scale = poly.ring.constant(0), poly.ring.constant(1)
    for part in reversed(parts):
        value, scale = part * scale + value * top, scale * bottom
    return value
