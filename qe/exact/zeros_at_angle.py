"""Real zeros of polynomials whose coefficients hold an algebraic number, and cosine and sine of a rational angle."""

from __future__ import annotations

from fractions import Fraction

from flint import arb, fmpq

from qe.exact.algebraic import RealAlgebraic
from qe.exact.ball_roots import certified_roots
from qe.exact.balls import ends, precision
from qe.exact.nearby import enclosed
from qe.exact.ring import Poly

MOST_BITS = 16384


def zeros_at_angle(
    p: Poly, var: int, theta: RealAlgebraic, angle: Fraction, bits: int
) -> list[tuple[Fraction, Fraction]] | None:
    """Disjoint intervals of about 2^-(bits/2), ascending, each with one real zero; None where they are not told apart.

    ``var``: the variable, 1 or 2 of a ring of four; variable 0 is ``theta``, and the last two are cosine and sine of
    ``angle`` (rad). The leading coefficient does not vanish there: for an angle other than 0 they are transcendental,
    and it is enough that it is not a multiple of cos² + sin² - 1.
    """
    if p.degree(var) <= 0:
        return []
    working = 2 * bits
    while working <= MOST_BITS:
        with precision(working):
            phi = arb(fmpq(angle.numerator, angle.denominator))
            at = [theta.ball(working), arb(0), phi.cos(), phi.sin()]
            balls = certified_roots([enclosed(c, at) for c in p.coefficients(var)], bits)
            if balls is not None:
                return [ends(x) for x in balls]
        working *= 2
    return None
