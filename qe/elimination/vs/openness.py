"""Blocks whose solution set is open: conditions of measure zero need not be followed."""

from __future__ import annotations

from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import Atom, Formula, Relation, RootAtom
from qe.formula.traverse import atoms, map_atoms

_STRICT = {Relation.LE: Relation.LT, Relation.GE: Relation.GT}


def is_open(formula: Formula, block: frozenset[int]) -> bool:
    """Whether every atom that contains a variable of the block is strict (<, >, /=).

    Then, for all values of the other variables, the solutions in the block variables form an open set (the
    formula is positive: negations stand only before root atoms, which must be free of the block).
    """
    for found in atoms(formula):
        if isinstance(found, RootAtom):
            if found.poly.ring.index[found.variable] in block or block & set(found.poly.variables):
                return False
        elif not found.relation.is_strict and block & set(found.poly.variables):
            return False
    return True


def thinned(formula: Formula, block: frozenset[int]) -> Formula:
    """The formula with p = 0 replaced by "p vanishes identically in the block", p <= 0 by that or p < 0.

    THEOREM. Let T = union of the solution sets of formulas F1, ..., Fm (in the block variables y, parameters
    fixed) be open, and F1', ..., Fm' their thinned forms. Then (exists y. some Fi) iff (exists y. some Fi').
    Proof. Fi' implies Fi. A point of T outside all Fi' lies on the zero set of a polynomial that does not vanish
    identically; finitely many such sets contain no nonempty open set.
    """

    def thin(found: Atom | RootAtom) -> Formula:
        if isinstance(found, RootAtom) or found.relation.is_strict:
            return found
        inside = block & set(found.poly.variables)
        if not inside:
            return found
        nothing = conj(atom(c, Relation.EQ) for c in _coefficients(found.poly, inside))
        if found.relation is Relation.EQ:
            return nothing
        return disj((Atom(found.poly, _STRICT[found.relation]), nothing))

    return map_atoms(formula, thin)


def _coefficients(p: Poly, block: frozenset[int]) -> list[Poly]:
    """The nonzero coefficients of p as a polynomial in the variables of the block."""
    parts = [p]
    for i in block:
        parts = [c for part in parts for c in part.coefficients(i) if c]
    return parts
