"""Root atoms by counting roots: an equivalent first-order formula that compares polynomials with 0 only.

THEOREM. Let r be the k-th smallest of the distinct real roots of p in x, p not identically zero there. Then x > r iff
at least k roots are < x, and x >= r iff at least k roots are <= x; x < r and x <= r are the negations of these among
the points over which p has at least k roots. From the largest root down (k < 0) the same holds with > for <.
At least m roots with a property: there are t_1 < ... < t_m that are roots with it.
"""

from __future__ import annotations

from itertools import pairwise

from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, convert, disj, exists, neg
from qe.formula.syntax import TRUE, Atomic, Formula, Relation, RootAtom
from qe.formula.traverse import atoms, has_root_atoms, map_atoms


def without_root_atoms(formula: Formula) -> Formula:
    """An equivalent formula without root atoms, with quantifiers in their place; its ring has the new names last."""
    if not has_root_atoms(formula):
        return formula
    root_atoms = [a for a in atoms(formula) if isinstance(a, RootAtom)]
    ring = root_atoms[0].poly.ring
    free = (name for k in range(ring.size + max(abs(a.k) for a in root_atoms)) if (name := f"t_{k}") not in ring.index)
    roots = [name for name, _ in zip(free, range(max(abs(a.k) for a in root_atoms)), strict=False)]
    extended = Ring.of((*ring.names, *roots))

    def counted(leaf: Atomic) -> Formula:
        return _counted(leaf, roots[: abs(leaf.k)]) if isinstance(leaf, RootAtom) else leaf

    return map_atoms(convert(formula, extended), counted)


def _counted(atomic: RootAtom, names: list[str]) -> Formula:
    """The root atom by numbers of roots; ``names``: as many as the roots that are counted."""
    poly, ring = atomic.poly, atomic.poly.ring
    x = ring.index[atomic.variable]
    up = atomic.k > 0

    def at_least(relation: Relation | None) -> Formula:
        return _at_least(poly, x, [ring.index[n] for n in names], relation)

    strictly, weakly = (Relation.LT, Relation.LE) if up else (Relation.GT, Relation.GE)
    past, reached = at_least(strictly), at_least(weakly)  # x lies beyond the root; beyond it or on it
    enough = at_least(None)
    before, not_past = conj((enough, neg(reached))), conj((enough, neg(past)))
    truth = {
        strictly.flipped: past,
        weakly.flipped: reached,
        strictly: before,
        weakly: not_past,
        Relation.EQ: conj((reached, neg(past))),
        Relation.NE: disj((past, before)),
    }[atomic.relation]
    return conj((truth, disj(atom(c, Relation.NE) for c in poly.coefficients(x))))


def _at_least(poly: Poly, x: int, roots: list[int], relation: Relation | None) -> Formula:
    """That ``poly`` has so many ascending roots t in place of x, all with ``t relation x`` if one is given."""
    ring = poly.ring
    values = [ring.gen(t) for t in roots]
    ordered = [atom(s - t, Relation.LT) for s, t in pairwise(values)]
    zeros = [atom(poly.compose({x: t}), Relation.EQ) for t in values]
    sides = [TRUE if relation is None else atom(t - ring.gen(x), relation) for t in values]
    return exists([ring.names[t] for t in roots], conj((*zeros, *ordered, *sides)))
