"""Polynomials whose roots are the sums, differences, products or powers of the roots of others, by resultants.

Loos, Computing in algebraic extensions, 1982.
"""

from __future__ import annotations

from collections.abc import Callable
from operator import add, mul

from flint import fmpz, fmpz_mpoly, fmpz_mpoly_ctx, fmpz_poly

_PAIR = fmpz_mpoly_ctx.get(("y", "z"), "lex")


def combined_polynomial(p: fmpz_poly, q: fmpz_poly, operation: Callable[..., object]) -> fmpz_poly:
    """A polynomial in z with root x∘y for all roots x of p, y of q: Res_y(q(y), p(z ∓ y)) or Res_y(q, y^n p(z/y))."""
    y, z = _PAIR.gens()
    second = _PAIR.constant(0)
    for i, c in enumerate(q.coeffs()):
        second += c * y**i
    first = _PAIR.constant(0)
    n = p.degree()
    base = z - y if operation is add else z + y
    for i, c in enumerate(p.coeffs()):
        if c:
            first += c * (base**i if operation is not mul else z**i * y ** (n - i))
    return _eliminated(first, second)


def power_polynomial(p: fmpz_poly, exponent: int) -> fmpz_poly:
    """A polynomial in z with root x^exponent for every root x of p: Res_y(z - y^exponent, p(y))."""
    y, z = _PAIR.gens()
    return _eliminated(z - y**exponent, sum((c * y**i for i, c in enumerate(p.coeffs())), _PAIR.constant(0)))


def _eliminated(first: fmpz_mpoly, second: fmpz_mpoly) -> fmpz_poly:
    """Their resultant with respect to y, a polynomial in z."""
    resultant = first.resultant(second, 0)
    out = [fmpz(0)] * (int(resultant.degrees()[1]) + 1)
    for exponents, c in resultant.terms():
        out[int(exponents[1])] = c
    return fmpz_poly(out)
