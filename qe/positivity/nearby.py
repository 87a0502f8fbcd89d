"""Polynomials that are a little more than one with short coefficients, as where a bound is missed by 10^-40.

THEOREM. Let p = c*q + r, c > 0, where every monomial of r has a positive coefficient and only squares of variables that
may be negative. Where q >= 0, p >= 0; p > 0 where a monomial of r is.
"""

from __future__ import annotations

from collections.abc import Collection
from fractions import Fraction
from math import isqrt, lcm

from qe.exact.ring import Poly
from qe.positivity.identity import Positive, sum_of
from qe.positivity.prove import nowhere_negative

LEAST = 10**6
"""The largest coefficient from which shorter ones nearby are looked for."""


def positive_beyond(poly: Poly, orthant: frozenset[int], positive: Collection[int]) -> Positive | None:
    """That the polynomial is nowhere negative where variables of ``orthant`` are not, as q is; ``positive``: variables
    that are never zero there."""
    terms = dict(poly.terms())
    top = max(map(abs, terms.values()), default=0)
    near = {e: Fraction(c, top).limit_denominator(isqrt(top)) for e, c in terms.items()} if top >= LEAST else {}
    scale = lcm(*(a.denominator for a in near.values()))
    free = {e for e in near if all(k % 2 == 0 or i in orthant for i, k in enumerate(e))}
    factor = min((terms[e] / a for e, a in near.items() if a > 0 or (a and e not in free)), default=Fraction(0))
    rest = {e: terms[e] - factor * a for e, a in near.items() if terms[e] != factor * a}
    if factor <= 0 or scale > isqrt(top) or any(c < 0 or e not in free for e, c in rest.items()):
        return None
    short = poly.ring.from_terms({e: int(a * scale) for e, a in near.items() if a})
    if (proof := nowhere_negative(short, orthant)) is None:
        return None
    products = [(c, tuple((poly.ring.gen(i), k) for i, k in enumerate(e) if k)) for e, c in rest.items()]
    strict = proof.strict or any(all(i in positive for i, k in enumerate(e) if k) for e in rest)
    return Positive((sum_of(poly, [(factor / scale, ((short, 1),)), *products]), *proof.identities), strict)
