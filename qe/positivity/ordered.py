"""Differences of ordered variables: polynomials whose terms are all positive there, whatever the order is.

Where x_1 >= x_2 >= ... >= x_n >= 0 the differences d_k = x_k - x_(k+1) and d_n = x_n are not negative. If every order
of the variables turns the polynomial into one of the differences without a negative coefficient, or into sums of
squares of binomials in them, it is nowhere negative on the orthant (the first step of successive difference
substitution: L. Yang 2005).
"""

from __future__ import annotations

from functools import lru_cache, partial
from itertools import combinations, pairwise, permutations

from qe.exact.ring import Poly
from qe.positivity.binomials import binomial_squares
from qe.positivity.identity import Identity, Positive, monomials

MOST_VARIABLES, MOST_TERMS = 4, 200


@lru_cache(maxsize=2_000)
def ordered_differences(poly: Poly, orthant: frozenset[int]) -> Positive | None:
    """That the polynomial is nowhere negative where its variables, all of ``orthant``, are not; None if it fails."""
    if not 2 <= len(poly.variables) <= MOST_VARIABLES or not orthant.issuperset(poly.variables):
        return None
    if poly.term_count() > MOST_TERMS:
        return None
    proofs: list[Identity] = []
    ring, own = poly.ring, frozenset(poly.variables)
    for order in permutations(poly.variables):
        steps = [ring.gen(i) - ring.gen(j) for i, j in pairwise(order)]
        # x_k is the sum of the variables that stand for the differences from the k-th on
        sums = {x: sum((ring.gen(y) for y in order[k:]), ring.constant(0)) for k, x in enumerate(order)}
        changed = poly.compose(sums)
        proof = monomials(changed) or binomial_squares(changed, own)
        if proof is None:
            return None
        places = dict(zip(order, (*steps, ring.gen(order[-1])), strict=True))
        proofs += proof.at(partial(Poly.compose, substitution=places))
    for a, b, c in combinations(map(ring.gen, poly.variables), 3):
        proofs.append(Identity(((1, ((a - b, 1),)), (1, ((b - c, 1),)), (-1, ((a - c, 1),)))))
    return Positive(tuple(proofs), strict=poly.evaluate((0,) * ring.size) > 0)
