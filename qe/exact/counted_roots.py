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

from qe.exact.balls import ball_sign
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
    """A ball inside the interval, with different signs at its ends; None where the balls do not tell them.

    The interval is that of the middle of the balls, and may end too near to a root: then a little beside its ends.
    """
    margin = (abs(lo) + 1) / 2 ** (bits // 2)
    ends = [(arb(lo + d).mid(), arb(hi - d).mid()) for d in (fmpq(0), -margin, margin)]
    below, (start, end) = next(((s, pair) for pair in ends if (s := _sign_before(polynomial, *pair))), (0, ends[0]))
    if not below:
        return None
    slope, aside = polynomial.derivative(), arb(margin).mid()
    for _ in range(bits):
        middle, rise = ((start + end) / 2).mid(), slope(start.union(end))
        near = (middle - aside).mid(), (middle + aside).mid()
        if not rise.contains(0):  # interval Newton method
            step = middle - polynomial(middle) / rise
            narrowed = max(start, step.lower()), min(end, step.upper())
        elif sign := ball_sign(polynomial(middle)):
            narrowed = (middle, end) if sign == below else (start, middle)
        elif _sign_before(polynomial, *near) == below:
            narrowed = near
        else:
            break
        if not narrowed[1] - narrowed[0] < end - start:
            break
        start, end = narrowed
    return start.union(end)


def _sign_before(polynomial: arb_poly, start: arb, end: arb) -> int:
    """The sign at the start where that at the end is the other; 0 where the balls do not tell so."""
    below, above = (ball_sign(polynomial(x)) or 0 for x in (start, end))
    return below if start < end and below * above < 0 else 0
