"""Rigorous integrals of square roots of polynomials (Petras' algorithm in ball arithmetic).

FLINT integrates functions that are analytic near the path by Gauss-Legendre quadrature on adaptively bisected
pieces, with an error bound from their size on an ellipse around each piece (Johansson, "Numerical integration in
arbitrary-precision ball arithmetic", ICMS 2018); elsewhere a piece counts with the range of the function on it.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from flint import acb, acb_poly, arb

from qe.errors import Unable
from qe.exact.balls import ends as ends_of
from qe.exact.balls import hull, precision
from qe.exact.field import to_fmpq

FIRST_BITS = 96
MAX_BITS = 768

Interval = tuple[Fraction, Fraction]


def root_integral(
    factor: Sequence[Interval], radicand: Sequence[Interval], low: Fraction, high: Fraction, rel: Fraction
) -> Interval:
    """Enclosure of the integral over [low, high] of |f(t)| sqrt(q(t)), no wider than ``rel`` times its upper end.

    ``factor``, ``radicand``: enclosures of the coefficients of 1, t, t^2, ... of f and q. Promised: f does not change
    its sign and q > 0 on [low, high]. Raises ``Unable`` when the integral is not found that closely.
    """
    bits, goal = FIRST_BITS, rel / 16  # the goal bounds single pieces; their sum may miss it by a small factor
    while bits <= MAX_BITS:
        below, above = _attempt(factor, radicand, (low, high), goal, bits)
        if above - below <= rel * above:
            return below, above
        bits, goal = bits * 2, goal / 256
    raise Unable(f"the integral of a square root was not enclosed within {float(rel):g}")


def _attempt(
    factor: Sequence[Interval], radicand: Sequence[Interval], over: Interval, rel: Fraction, bits: int
) -> Interval:
    with precision(bits):
        f, q = _polynomial(factor), _polynomial(radicand)

        def value(z: acb, analytic: bool) -> acb:
            return _value(f, z) * _value(q, z).sqrt(analytic=analytic)

        ends = [acb(arb(to_fmpq(t))) for t in over]
        integral = acb.integral(value, *ends, rel_tol=arb(to_fmpq(rel)), abs_tol=arb(2) ** (-8 * bits)).real
        total = abs(integral)
        if not total.is_finite():
            return Fraction(0), Fraction(1)
        low, high = ends_of(total)
    return max(low, Fraction(0)), high


def _value(polynomial: acb_poly, z: acb) -> acb:
    """The polynomial on the ball z, by its expansion at the midpoint: powers of z itself would widen the result."""
    middle = acb(z.real.mid(), z.imag.mid())
    return polynomial(acb_poly([middle, 1]))(z - middle)


def _polynomial(coefficients: Sequence[Interval]) -> acb_poly:
    return acb_poly([acb(hull(to_fmpq(low), to_fmpq(high))) for low, high in coefficients])
