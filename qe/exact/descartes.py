"""How many real roots a polynomial can have, from its exponents alone, or in an interval."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise

from flint import fmpq, fmpq_poly

from qe.exact.ring import Poly


def most_real_roots(poly: Poly, i: int) -> int:
    """A bound for the number of distinct real roots in variable ``i``, at every point where ``poly`` is not zero.

    THEOREM (Descartes' rule of signs for p(x) and p(-x)). A polynomial of one variable with the exponents
    e_1 < ... < e_t has at most as many real roots other than 0 as the sum over j of 1 where e_(j+1) - e_j is odd and 2
    where it is even. If terms vanish, as coefficients do at points, the sum does not grow, but where the first of them
    do, 0 becomes a root: each gap that goes counted for at least one. Nor are there more roots than the degree.
    """
    exponents = [k for k, c in enumerate(poly.coefficients(i)) if c]
    if not exponents:
        return 0
    changes = sum(1 if (high - low) % 2 else 2 for low, high in pairwise(exponents))
    return min(exponents[-1], changes + (exponents[0] > 0))


def most_roots_between(coefficients: Sequence[Fraction], low: Fraction, high: Fraction) -> int:
    """A bound for the number of distinct roots in an open interval, exact where it is 0 or 1, of a polynomial that is
    not zero (coefficients from degree 0 up).

    THEOREM (Descartes' rule of signs, for (1 + x)^n p(low + (high - low)/(1 + x)) with x > 0; p without its multiple
    roots). The bound and the number differ by an even number that is not negative.
    """
    given = fmpq_poly([fmpq(c.numerator, c.denominator) for c in coefficients]).numer()
    p = fmpq_poly(given // given.gcd(given.derivative()))
    start, width = (fmpq(c.numerator, c.denominator) for c in (low, high - low))
    moved = p(fmpq_poly([start, width])).coeffs()
    shifted = fmpq_poly(moved[::-1])(fmpq_poly([1, 1]))
    signs = [c > 0 for c in shifted.coeffs() if c != 0]
    return sum(a != b for a, b in pairwise(signs))
