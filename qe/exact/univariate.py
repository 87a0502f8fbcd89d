"""FLINT's univariate polynomials as polynomials of a ring, and the changes of sign in their coefficients."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise

from flint import fmpq, fmpz, fmpz_poly

from qe.exact.ring import Poly, Ring


def from_univariate(ring: Ring, i: int, p: fmpz_poly) -> Poly:
    """The FLINT univariate polynomial ``p`` as a polynomial in variable ``i``."""
    unit = [0] * ring.size
    terms = {}
    for k, c in enumerate(p.coeffs()):
        if c:
            unit[i] = k
            terms[tuple(unit)] = int(c)
    return ring.from_terms(terms)


def sign_changes(coefficients: Iterable[fmpz | fmpq]) -> int:
    """How often the sign changes from one coefficient other than 0 to the next."""
    return sum(a != b for a, b in pairwise([c > 0 for c in coefficients if c]))
