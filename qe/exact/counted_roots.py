"""Real roots of polynomials with ball coefficients by their number: for roots that iterations do not find.

FLINT's iteration for complex roots does not end for roots much closer to each other than they are large.

THEOREM. If neither the leading coefficient nor the discriminant vanishes for any polynomial in the balls, all of them
have the same number of real roots: roots depend continuously on the coefficients, and real ones could only appear or go
in pairs, through a double one (Basu, Pollack, Roy, "Algorithms in Real Algebraic Geometry", 4.1). So the polynomial of
the midpoints tells the number; where that many disjoint intervals show a change of sign, each of them has one root.
"""

from __future__ import annotations

from itertools import pairwise

from flint import arb, arb_mat, arb_poly, fmpq, fmpq_poly

from qe.exact.balls import ball_sign, hull
from qe.exact.isolate import isolate


def counted_roots(c: list[arb], bits: int) -> list[arb] | None:
    """Balls around the real roots, ascending, each with one, if they are told apart.

    ``c``: coefficients from degree 0 up; the ball of the last one does not contain zero.
    """
    polynomial = arb_poly(c)
    if _discriminant(polynomial).contains(0):
        return None
    middle = fmpq_poly([x.mid().fmpq() for x in polynomial.coeffs()]).numer()
    balls = [_around(polynomial, lo, hi, bits) for lo, hi in isolate(middle)]
    certain = [x for x in balls if x is not None]
    return certain if len(certain) == len(balls) and all(a < b for a, b in pairwise(certain)) else None


def _discriminant(polynomial: arb_poly) -> arb:
    """The resultant with the derivative, which is the discriminant times the leading coefficient."""
    n, slope = polynomial.degree(), polynomial.derivative()
    rows = [[*([0] * k), *polynomial.coeffs()[::-1], *([0] * (n - 2 - k))] for k in range(n - 1)]
    rows += [[*([0] * k), *slope.coeffs()[::-1], *([0] * (n - 1 - k))] for k in range(n)]
    return arb_mat(rows).det()


def _around(polynomial: arb_poly, lo: fmpq, hi: fmpq, bits: int) -> arb | None:
    """A ball inside the interval, with different signs at its ends; None where the balls do not tell them."""
    if lo == hi:
        margin = (abs(lo) if lo else fmpq(1)) / 2 ** (bits // 2)
        lo, hi = lo - margin, hi + margin
    left, right = (ball_sign(polynomial(arb(end))) for end in (lo, hi))
    if not left or not right or left == right:
        return None
    for _ in range(bits):
        middle = (lo + hi) / 2
        sign = ball_sign(polynomial(arb(middle)))
        if not sign:
            break
        lo, hi = (middle, hi) if sign == left else (lo, middle)
    return hull(lo, hi)
