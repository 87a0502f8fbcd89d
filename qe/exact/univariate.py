"""FLINT's univariate polynomials as polynomials of a ring, and the changes of sign in their coefficients."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise

from flint import fmpq, fmpz, fmpz_poly

from qe.exact.ring import Poly, Ring


def from_univariate(ring: Ring, i: int, p: fmpz_poly) -> Poly:
    """The FLINT univariate polynomial ``p`` as a polynomial in variable ``i``."""
    below, above = (0,) * i, (0,) * (ring.size - i - 1)
    return ring.from_terms({(*below, k, *above): int(c) for k, c in enumerate(p.coeffs()) if c})


def sign_changes(coefficients: Iterable[fmpz | fmpq]) -> int:
    """How often the sign changes from one coefficient other than 0 to the next."""
    return sum(a != b for a, b in pairwise([c > 0 for c in coefficients if c]))
