"""How many real roots a polynomial can have, from its exponents alone, or in an interval."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from math import lcm

from flint import fmpz_poly

from qe.exact.ring import Poly
from qe.exact.univariate import sign_changes


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
    given = fmpz_poly([int(c * lcm(*(c.denominator for c in coefficients))) for c in coefficients])
    p = given // given.gcd(given.derivative())
    scale = lcm(low.denominator, high.denominator)
    top, bottom = fmpz_poly([int(high * scale), int(low * scale)]), fmpz_poly([scale, scale])
    parts = (c * top**k * bottom ** (p.degree() - k) for k, c in enumerate(p.coeffs()))
    return sign_changes(sum(parts, fmpz_poly()).coeffs())
