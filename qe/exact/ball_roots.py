"""Real roots of polynomials with ball coefficients: disjoint balls, each with exactly one root, or None."""

from __future__ import annotations

import itertools
from contextlib import suppress

from flint import acb, acb_poly, arb, arb_mat, arb_poly, fmpq, fmpq_poly

from qe.exact.balls import EXACT_FROM, ball_sign, hull
from qe.exact.isolate import isolate


def quadratic_roots(c: list[arb]) -> list[arb] | None:
    """The real roots, ascending, of a polynomial of degree 2 (coefficients from degree 0 up)."""
    discriminant = c[1] * c[1] - 4 * c[2] * c[0]
    sign = ball_sign(discriminant)
    if not sign:
        return None
    if sign < 0:
        return []
    root = discriminant.sqrt()
    if c[1] > 0:
        low = -(c[1] + root)
        pair = [low / (2 * c[2]), 2 * c[0] / low]
    else:
        high = root - c[1]
        if high.contains(0):
            return None
        pair = [2 * c[0] / high, high / (2 * c[2])]
    if c[2] < 0:
        pair.reverse()
    return pair if pair[0] < pair[1] else None


def certified_roots(c: list[arb], bits: int) -> list[arb] | None:
    """Real roots of a polynomial of higher degree (coefficients from degree 0 up, the last one not zero)."""
    found = _by_complex_roots(arb_poly(c), bits)
    return _by_counting(arb_poly(c), bits) if found is None and bits >= EXACT_FROM else found


def _by_complex_roots(polynomial: arb_poly, bits: int) -> list[arb] | None:
    """From isolating complex balls: a ball that meets its conjugate and no other holds a real root."""
    found = _isolated(acb_poly(polynomial), bits)
    if found is None:
        return None
    real: list[arb] = []
    for i, z in enumerate(found):
        if z.imag.contains(0):
            mirror = z.conjugate()
            if any(mirror.overlaps(other) for j, other in enumerate(found) if j != i):
                return None
            real.append(z.real)
    return _ascending(real)


def _isolated(polynomial: acb_poly, bits: int) -> list[acb] | None:
    """Disjoint balls around all complex roots; None where the coefficients are not sharp enough for that.

    The tolerance is absolute, and half the bits, since cancellation in the coefficients costs some. Roots that are
    large for their coefficients do not reach it at any precision, and FLINT would try for ever: hence the bound on the
    precision, and a second call without tolerance. ``FibreRoot.ball`` asks again with more bits where it needs them.
    """
    for tolerance in (arb(2) ** -(bits // 2), None):
        with suppress(ValueError):
            return polynomial.roots(tol=tolerance, maxprec=2 * bits)
    return None


def _by_counting(polynomial: arb_poly, bits: int) -> list[arb] | None:
    """By the number of real roots, which is the same for all polynomials in the balls if neither the leading
    coefficient nor the discriminant vanishes for one of them: real roots could only appear or go in pairs, through a
    double one. So the midpoints tell it; and where that many disjoint intervals show a change of sign, each of them
    has one root. FLINT's iteration for complex roots does not end for roots much closer than they are large.
    """
    if _discriminant(polynomial).contains(0):
        return None
    middle = fmpq_poly([x.mid().fmpq() for x in polynomial.coeffs()]).numer()
    found = [_around(polynomial, lo, hi, bits) for lo, hi in isolate(middle)]
    certain = [x for x in found if x is not None]
    return _ascending(certain) if len(certain) == len(found) else None


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


def _ascending(roots: list[arb]) -> list[arb] | None:
    """The balls in their order if they are disjoint."""
    roots.sort(key=arb.mid)
    return roots if all(a < b for a, b in itertools.pairwise(roots)) else None
