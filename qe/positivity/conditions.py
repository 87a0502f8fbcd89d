"""Polynomials made homogeneous by a condition: x*y*z >= 1 with positive factors, or a sphere.

THEOREM. Let m be a form of degree s, c > 0, r = m - c, and p = p_0 + ... + p_J a sum of forms, of which p_j has degree
d - j*s. As m = r + c,
    m^J*p = sum of (p_j*m^j)*(r + c)^(J-j) = sum of h_i*r^i,  h_i = sum of binomial(J-j, i)*c^(J-j-i)*p_j*m^j,
and the h_i are forms of degree d. Where r >= 0 and no h_i is negative, p >= 0, as m > 0; where r = 0, h_0 alone counts.
"""

from __future__ import annotations

from collections.abc import Collection
from math import comb

from qe.exact.ring import Poly
from qe.positivity.identity import Identity, Positive
from qe.positivity.prove import nowhere_negative

MOST_TERMS, MOST_POWERS = 200, 6
"""Terms of a polynomial that is looked at, and the number J."""

Condition = tuple[Poly, int, bool]
"""A form and a positive number that it is not smaller than; whether it is that number."""


def positive_under(poly: Poly, conditions: Collection[Condition], orthant: frozenset[int]) -> Positive | None:
    """That the polynomial is nowhere negative where a condition holds and variables of ``orthant`` are not negative."""
    zero, forms = poly.ring.constant(0), dict[int, Poly]()
    for exponents, c in poly.terms() if conditions and poly.term_count() <= MOST_TERMS else ():
        forms[sum(exponents)] = forms.get(sum(exponents), zero) + poly.ring.from_terms({exponents: c})
    top = max(forms, default=0)
    for form, least, equal in conditions:
        step = form.total_degree
        last = (top - min(forms, default=0)) // step
        if not 0 < last <= MOST_POWERS or any((top - degree) % step for degree in forms):
            continue
        raised = [forms.get(top - j * step, zero) * form**j for j in range(last + 1)]
        parts = [
            sum((p * (comb(last - j, i) * least ** (last - j - i)) for j, p in enumerate(raised[: last - i + 1])), zero)
            for i in range(last + 1)
        ]
        proofs = [nowhere_negative(part, orthant) for part in parts[: 1 if equal else None] if part]
        if all(proofs):
            excess = form - least
            said = ((1, ((excess, i), (part, 1)) if i else ((part, 1),)) for i, part in enumerate(parts) if part)
            main = Identity(((-1, ((poly, 1), (form, last))), *said))
            positive = Identity(((-1, ((form, 1),)), (1, ((excess, 1),)), (least, ())))
            return Positive((main, positive, *(each for p in proofs if p is not None for each in p.identities)), False)
    return None
