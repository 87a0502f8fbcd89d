"""FLINT's univariate polynomials as polynomials of a ring."""

from __future__ import annotations

from flint import fmpz_poly

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
