"""Rule "roots counted": comparisons with the k-th root of a polynomial, written with numbers of roots.

THEOREM. Let p, with m roots or more in x, not vanish identically, and let r be its m-th root from below (from above).
Then x is past r iff m roots lie before x, and past r or on it iff m roots lie before x or on it: past is greater, and
before is less (past is less, and before is greater). There are m roots of a kind iff t_1 < ... < t_m are such roots.
So each of the three places of x relative to r is a condition on numbers of roots, and a comparison a disjunction of
such conditions; where p vanishes identically, or has fewer roots, it is false. Names of bound variables do not matter.
"""

from __future__ import annotations

from itertools import pairwise

from qe.exact.ring import Ring
from qe.formula.build import atom, conj, convert, disj, exists
from qe.formula.syntax import Atomic, Formula, Relation, RootAtom
from qe.formula.traverse import atoms, map_atoms
from qe.kernel.negation import negation, normal
from qe.kernel.renaming import arranged
from qe.kernel.step import Claim, Context, Limits, only
from qe.kernel.substitution import quotient

MOST_ROOTS = 20
"""Roots that are counted at most."""


def check_roots_counted(claim: Claim, context: Context, limits: Limits) -> None:
    """Root atoms are replaced by the theorem, and the result is what stands after, up to bound names and order."""
    only(claim)
    most = max((abs(a.k) for a in atoms(claim.before) if isinstance(a, RootAtom)), default=0)
    if most > MOST_ROOTS:
        raise claim.fail(f"more than {MOST_ROOTS} roots to be counted")
    longest = max(map(len, claim.ring.names), default=0)
    names = [f"t{'_' * longest}{k}" for k in range(most)]  # longer than all others, so new
    ring = Ring.of((*claim.ring.names, *names))

    def counted(found: Atomic) -> Formula:
        return _counted(found, ring, names[: abs(found.k)]) if isinstance(found, RootAtom) else found

    replaced = map_atoms(convert(claim.before, ring), counted)
    if arranged(normal(replaced)) != arranged(normal(claim.after)):
        raise claim.fail("not what the theorem gives")


def _counted(found: RootAtom, ring: Ring, names: list[str]) -> Formula:
    """By which of the places past it (1), on it (0) and not yet at it (-1) the relation allows."""
    side = 1 if found.k > 0 else -1
    before = Relation.LT if side > 0 else Relation.GT
    enough, past, reached = (_roots(found, ring, names, r) for r in (None, before, _weak(before)))
    not_reached, not_past = conj((enough, negation(reached))), conj((enough, negation(past)))
    truth = {
        frozenset({1}): past,
        frozenset({0, 1}): reached,
        frozenset({0}): conj((reached, negation(past))),
        frozenset({-1}): not_reached,
        frozenset({-1, 0}): not_past,
        frozenset({-1, 1}): disj((past, not_reached)),
    }[frozenset(side * sign for sign in found.relation.signs)]
    coefficients = found.poly.coefficients(ring.index[found.variable])
    return conj((truth, disj(atom(c, Relation.NE) for c in coefficients)))


def _weak(relation: Relation) -> Relation:
    return Relation.LE if relation is Relation.LT else Relation.GE


def _roots(found: RootAtom, ring: Ring, names: list[str], relation: Relation | None) -> Formula:
    """That there are so many ascending roots t as names, with ``t relation x`` if one is given."""
    x, one = ring.index[found.variable], ring.constant(1)
    places = [ring.var(name) for name in names]
    zeros = [atom(quotient(found.poly, x, t, one), Relation.EQ) for t in places]
    ascending = [atom(s - t, Relation.LT) for s, t in pairwise(places)]
    sides = [] if relation is None else [atom(t - ring.gen(x), relation) for t in places]
    return exists(names, conj((*zeros, *ascending, *sides)))
