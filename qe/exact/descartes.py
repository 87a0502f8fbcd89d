"""How many real roots a polynomial can have, from its exponents alone."""

from __future__ import annotations

from itertools import pairwise

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
