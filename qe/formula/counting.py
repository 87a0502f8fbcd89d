"""Root atoms by counting roots: an equivalent first-order formula that compares polynomials with 0 only.

Where the polynomial has no parameters its roots are numbers, and nothing is counted: between the nearest conjugates of
a number its minimal polynomial changes its sign there and nowhere else.

THEOREM. Let r be the k-th smallest of the distinct real roots of p in x, p not identically zero there. Then x > r iff
at least k roots are < x, and x >= r iff at least k roots are <= x; x < r and x <= r are the negations of these among
the points over which p has at least k roots. From the largest root down (k < 0) the same holds with > for <.
At least m roots with a property: there are t_1 < ... < t_m that are roots with it. No name is bound twice for one atom.
"""

from __future__ import annotations

from itertools import pairwise

from qe.exact.algebraic import irreducible_roots, real_roots
from qe.exact.nearby import rational_between
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, convert, disj, exists, neg
from qe.formula.syntax import FALSE, TRUE, Atomic, Formula, Relation, RootAtom
from qe.formula.traverse import atoms, has_root_atoms, map_atoms


def without_root_atoms(formula: Formula) -> Formula:
    """An equivalent formula without root atoms, with quantifiers in their place; its ring has the new names last."""
    if not has_root_atoms(formula):
        return formula
    root_atoms = [a for a in atoms(formula) if isinstance(a, RootAtom)]
    ring = root_atoms[0].poly.ring
    most = 3 * max(abs(a.k) for a in root_atoms)
    free = (name for k in range(ring.size + most) if (name := f"t_{k}") not in ring.index)
    roots = [name for name, _ in zip(free, range(most), strict=False)]
    extended = Ring.of((*ring.names, *roots))

    def counted(leaf: Atomic) -> Formula:
        return counted_roots(leaf, roots) if isinstance(leaf, RootAtom) else leaf

    return map_atoms(convert(formula, extended), counted)


def counted_roots(root: RootAtom, names: list[str]) -> Formula:
    """The root atom by numbers of roots; ``names``: at most three for each root that is counted."""
    poly, ring = root.poly, root.poly.ring
    if len(poly.variables) == 1:
        return _compared_with_number(root)
    x, count, spare = ring.index[root.variable], abs(root.k), [ring.index[n] for n in names]

    def at_least(relation: Relation | None) -> Formula:
        roots = [spare.pop(0) for _ in range(count)]
        return _at_least(poly, x, roots, relation)

    strictly, weakly = (Relation.LT, Relation.LE) if root.k > 0 else (Relation.GT, Relation.GE)
    if root.relation in (strictly.flipped, weakly.flipped):  # x lies beyond the root, or on it
        truth = at_least(root.relation.flipped)
    elif root.relation is Relation.EQ:
        truth = conj((at_least(weakly), neg(at_least(strictly))))
    else:
        missed = strictly if root.relation is weakly else weakly
        truth = conj((at_least(None), neg(at_least(missed))))
        if root.relation is Relation.NE:
            truth = disj((at_least(strictly), truth))
    return conj((truth, disj(atom(c, Relation.NE) for c in poly.coefficients(x))))


def _compared_with_number(root: RootAtom) -> Formula:
    """The comparison with a root of a polynomial in its variable alone; FALSE where there are too few."""
    x, relation = root.poly.ring.var(root.variable), root.relation
    roots = real_roots(root.poly.to_univariate(root.poly.level))
    if abs(root.k) > len(roots):
        return FALSE
    number = roots[root.k - 1 if root.k > 0 else root.k]
    conjugates, j = irreducible_roots(number.poly), number.index
    rising = sum((c * x**e for e, c in enumerate(number.minimal_polynomial)), x.ring.constant(0))
    if (len(conjugates) - j) % 2 == 0:  # negative just above the number
        rising = -rising
    lowest = [] if j == 0 else [rational_between(conjugates[j - 1], number)]
    highest = [] if j == len(conjugates) - 1 else [rational_between(number, conjugates[j + 1])]
    above = [atom(x * q.denominator - q.numerator, Relation.GT) for q in lowest]
    below = [atom(x * q.denominator - q.numerator, Relation.LT) for q in highest]
    same = atom(rising, relation)
    if relation is Relation.EQ:
        return conj((*above, *below, same))
    if relation is Relation.NE:
        return disj((*map(neg, above), *map(neg, below), same))
    near, far = (below, above) if relation in (Relation.LT, Relation.LE) else (above, below)
    return disj((*map(neg, far), conj((*near, same))))


def _at_least(poly: Poly, x: int, roots: list[int], relation: Relation | None) -> Formula:
    """That ``poly`` has so many ascending roots t in place of x, all with ``t relation x`` if one is given."""
    ring = poly.ring
    values = [ring.gen(t) for t in roots]
    ordered = [atom(s - t, Relation.LT) for s, t in pairwise(values)]
    zeros = [atom(poly.compose({x: t}), Relation.EQ) for t in values]
    sides = [TRUE if relation is None else atom(t - ring.gen(x), relation) for t in values]
    return exists([ring.names[t] for t in roots], conj((*zeros, *ordered, *sides)))
