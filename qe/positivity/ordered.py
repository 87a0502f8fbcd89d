"""Differences of ordered variables: polynomials whose terms are all positive there, whatever the order is.

Where x_1 >= x_2 >= ... >= x_n >= 0 the differences d_k = x_k - x_(k+1) and d_n = x_n are not negative. If every order
of the variables turns the polynomial into one of the differences without a negative coefficient, it is nowhere negative
on the orthant (the first step of successive difference substitution: L. Yang 2005).
"""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache
from itertools import combinations, pairwise, permutations

from qe.exact.ring import Poly
from qe.positivity.identity import Identity, Positive, Powers, sum_of

MOST_VARIABLES, MOST_TERMS = 3, 60


@lru_cache(maxsize=2_000)
def ordered_differences(poly: Poly, orthant: frozenset[int]) -> Positive | None:
    """That the polynomial is nowhere negative where its variables, all of ``orthant``, are not; None if it fails."""
    if not 2 <= len(poly.variables) <= MOST_VARIABLES or not orthant.issuperset(poly.variables):
        return None
    if poly.term_count() > MOST_TERMS:
        return None
    found: list[Identity] = []
    ring = poly.ring
    for order in permutations(poly.variables):
        steps = [ring.gen(i) - ring.gen(j) for i, j in pairwise(order)]
        differences: list[Poly] = [*steps, ring.gen(order[-1])]
        # x_k is the sum of the variables that stand for the differences from the k-th on
        sums = {x: sum((ring.gen(y) for y in order[k:]), ring.constant(0)) for k, x in enumerate(order)}
        changed = poly.compose(sums)
        if any(c < 0 for _, c in changed.terms()):
            return None
        place = dict(zip(order, differences, strict=True))
        found.append(sum_of(poly, ((Fraction(c), _powers(e, place)) for e, c in changed.terms())))
    found += [_transitive(ring.gen(a), ring.gen(b), ring.gen(c)) for a, b, c in combinations(poly.variables, 3)]
    return Positive(tuple(found), strict=poly.evaluate((0,) * ring.size) > 0)


def _powers(exponents: tuple[int, ...], place: dict[int, Poly]) -> Powers:
    return tuple((place[i], e) for i, e in enumerate(exponents) if e)


def _transitive(a: Poly, b: Poly, c: Poly) -> Identity:
    """(a - b) + (b - c) = a - c."""
    return Identity(((1, ((a - b, 1),)), (1, ((b - c, 1),)), (-1, ((a - c, 1),))))
