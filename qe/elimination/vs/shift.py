"""Degree shift: a variable whose exponents share a divisor."""

from __future__ import annotations

from math import gcd

from qe.exact.ring import Poly
from qe.formula.build import atom, conj
from qe.formula.syntax import Atom, Formula, Relation, RootAtom
from qe.formula.traverse import atoms, map_atoms


def common_exponent(formula: Formula, x: int) -> int:
    """The greatest k such that every exponent of variable x in every atom is a multiple of k; 0 without x."""
    k = 0
    for found in atoms(formula):
        if found.poly.degree(x):
            if isinstance(found, RootAtom):
                return 1
            for power, coefficient in enumerate(found.poly.coefficients(x)):
                if coefficient:
                    k = gcd(k, power)
            if k == 1:
                return 1
    return k


def shifted(conjuncts: tuple[Formula, ...], x: int, k: int, *, strict: bool) -> tuple[Formula, ...]:
    """The conjuncts with x^k renamed to x, in the same order, and x >= 0 added at the end if k is even.

    THEOREM. (exists x. F(x^k)) iff (exists x. F(x) and x >= 0) for even k, iff (exists x. F(x)) for odd k; a
    solution y of the right side lifts to the real k-th root of y (Dolzmann, Sturm & Weispfenning 1998, section 4).
    ``strict``: the solutions in x form an open set; then x = 0 is never the only one, and x > 0 is added instead.
    """
    ring = next(atoms(conj(conjuncts))).poly.ring

    def lower(found: Atom | RootAtom) -> Formula:
        if isinstance(found, RootAtom) or not found.poly.degree(x):
            return found
        return atom(_deflated(found.poly, x, k), found.relation)

    changed = tuple(map_atoms(part, lower) for part in conjuncts)
    return changed if k % 2 else (*changed, Atom(ring.gen(x), Relation.GT if strict else Relation.GE))


def _deflated(p: Poly, x: int, k: int) -> Poly:
    total, gen = p.ring.constant(0), p.ring.gen(x)
    for c in reversed(p.coefficients(x)[::k]):
        total = total * gen + c
    return total
