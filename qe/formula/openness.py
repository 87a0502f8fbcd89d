"""Open truth sets: what may be left out because it has no interior.

THEOREM (openness). Let every atom of a positive formula F that contains a variable of the block be <, > or /=. Then for
all values of the other variables the solutions in the block form an open set: polynomials are continuous, and finite
unions and intersections of open sets are open. Dually, with <=, >= and = the solutions form a closed set.

THEOREM (measure). A nonempty open set is not inside the union of finitely many zero sets of polynomials that are not
the zero polynomial. So inside an open set a condition of that kind can be met and an equation cannot be relied on.
"""

from __future__ import annotations

from collections.abc import Collection

from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import And, Atom, Atomic, Constant, Formula, Or, Relation
from qe.formula.traverse import atoms, map_atoms

_STRICT = {Relation.LE: Relation.LT, Relation.GE: Relation.GT}


def is_open(formula: Formula, block: Collection[int]) -> bool:
    """Whether the syntax shows that the solutions in the variables ``block`` (indices) form an open set."""
    return _has_shape(formula, frozenset(block), strict=True)


def is_closed(formula: Formula, block: Collection[int]) -> bool:
    """Whether the syntax shows that the solutions in the variables ``block`` (indices) form a closed set."""
    return _has_shape(formula, frozenset(block), strict=False)


def _has_shape(formula: Formula, block: frozenset[int], *, strict: bool) -> bool:
    match formula:
        case Constant():
            return True
        case Atom(poly, relation):
            return relation.is_strict is strict or block.isdisjoint(poly.variables)
        case And(args) | Or(args):
            return all(_has_shape(a, block, strict=strict) for a in args)
    return all(block.isdisjoint(map(a.poly.ring.index.__getitem__, a.free)) for a in atoms(formula))


def somewhere_nonzero(poly: Poly, block: Collection[int]) -> Formula:
    """The condition that the polynomial does not vanish identically in the block: some coefficient is not 0.

    Where F is open in the block, (exists block. F and poly /= 0) iff (exists block. F) and this: see the theorems.
    """
    return disj(atom(c, Relation.NE) for c in poly.coefficients_in(block))


def thinned(formula: Formula, block: Collection[int]) -> Formula:
    """The formula with p = 0 replaced by "p vanishes identically in the block", p <= 0 by that or p < 0.

    THEOREM. Let T = union of the solution sets of formulas F1, ..., Fm (in the block variables y, parameters
    fixed) be open, and F1', ..., Fm' their thinned forms. Then (exists y. some Fi) iff (exists y. some Fi').
    Proof. Fi' implies Fi. A point of T outside all Fi' lies on the zero set of a polynomial that does not vanish
    identically; finitely many such sets contain no nonempty open set.
    """

    def thin(atomic: Atomic) -> Formula:
        if not isinstance(atomic, Atom) or atomic.relation.is_strict or not set(block) & set(atomic.poly.variables):
            return atomic
        nothing = conj(atom(c, Relation.EQ) for c in atomic.poly.coefficients_in(block))
        if atomic.relation is Relation.EQ:
            return nothing
        return disj((Atom(atomic.poly, _STRICT[atomic.relation]), nothing))

    return map_atoms(formula, thin)
