"""Whether a polynomial is nowhere negative, by the first way that proves it."""

from __future__ import annotations

from functools import lru_cache

from qe.exact.ring import Poly
from qe.positivity.binomials import binomial_squares
from qe.positivity.gram import sum_of_squares
from qe.positivity.identity import Positive
from qe.positivity.ordered import ordered_differences
from qe.positivity.samples import may_be_positive

MOST_VARIABLES, MOST_DEGREE, MOST_TERMS = 6, 16, 500
FEWEST_VARIABLES, LOWEST_DEGREE = 4, 12
"""Below these, decomposition decides sooner than the libraries of a semidefinite program are loaded."""


@lru_cache(maxsize=5_000)
def nowhere_negative(poly: Poly, orthant: frozenset[int], least: int = FEWEST_VARIABLES) -> Positive | None:
    """That it is nowhere negative where variables of ``orthant`` are not; semidefinite programs from ``least`` on."""
    used, degree = poly.variables, poly.total_degree
    if not 2 <= degree <= MOST_DEGREE or len(used) > MOST_VARIABLES or poly.term_count() > MOST_TERMS:
        return None
    signed = orthant.intersection(used)
    if any(poly.degree(i) % 2 for i in used if i not in signed) or not may_be_positive(poly, signed):
        return None
    found = binomial_squares(poly, signed)
    if found is None and signed:
        found = ordered_differences(poly, signed)
    return found or (sum_of_squares(poly, signed) if len(used) >= least or degree >= LOWEST_DEGREE else None)
