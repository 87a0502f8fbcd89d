"""Quality of a curve in rigorous numbers: length, largest curvature, whether it ever stops.

Lengths are in the unit of the coordinates, curvatures in its inverse. Nothing is sampled: every number is an
enclosure that holds for the whole curve.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

from bezier.curves import bernstein as bs
from bezier.curves.curve import Bezier, RationalFunction, curvature_squared
from bezier.curves.enclosure import Enclosure, bounds, maximum, root_above, root_enclosure
from bezier.curves.nonnegative import isolate, refine
from bezier.curves.scalar import is_zero, sign
from qe.errors import InputError
from qe.exact.quadrature import root_integral

REL = Fraction(1, 10**9)
"""Relative width of an enclosure unless another one is asked for."""
STOP_WIDTH = Fraction(1, 2**192)
"""To what width the parameters are refined where a curve stops."""


def length_enclosure(curve: Bezier, rel: Fraction = REL) -> Enclosure:
    """The arc length: the integral of |P'(t)| over [0, 1], with high - low <= rel * high.

    |P'| = |h| sqrt(q) with q > 0 on [0, 1] is integrated between the roots of h, where the curve stops.
    Raises ``Unable`` when the width is not reached.
    """
    squared = curve.hodograph().norm_squared()
    if all(map(is_zero, squared)):
        return Enclosure(Fraction(0), Fraction(0))
    factor, radicand, stopping = _square_split(squared)
    stops = [refine(stopping, stop, STOP_WIDTH) for stop in isolate(stopping)]
    fastest = root_above(max(bounds(c)[1] for c in squared))
    total = Enclosure(Fraction(0), sum((fastest * (high - low) for low, high in stops), Fraction(0)))
    f, q = ([bounds(c) for c in bs.to_power(part)] for part in (factor, radicand))
    for (_, low), (high, _) in pairwise([(Fraction(0), Fraction(0)), *stops, (Fraction(1), Fraction(1))]):
        total += Enclosure(*root_integral(f, q, low, high, rel / 2))
    return total


def _square_split(squared: bs.Coefficients) -> tuple[bs.Coefficients, bs.Coefficients, bs.Coefficients]:
    """h, q and s with |P'|^2 = h^2 q, q > 0 on [0, 1] and s square-free with the roots of h.

    A sum of squares has real roots of even order only.
    """
    one: bs.Coefficients = (Fraction(1),)
    if not _has_root(squared):
        return one, squared, one
    power, factor, stopping = bs.to_power(squared), one, one
    for exponent, part in enumerate(bs.square_free_parts(power), start=1):
        for _ in range(exponent // 2):
            factor = bs.power_multiply(factor, part)
        if exponent > 1:
            stopping = bs.power_multiply(stopping, part)
    radicand = bs.divide(power, bs.power_multiply(factor, factor))[0]
    return bs.from_power(factor), bs.from_power(radicand), bs.from_power(stopping)


def curvature_enclosure(curve: Bezier, rel: Fraction = REL) -> Enclosure:
    """The supremum of the curvature over [0, 1], with high - low <= rel * high; infinite at a cusp.

    Where P'(t) = 0 the curvature is understood as its limit: the common factors of numerator and denominator of
    kappa^2 are divided out; a root of the denominator that remains makes the curvature unbounded.
    Raises ``InputError`` for a curve that is one point, ``Unable`` when the width is not reached.
    """
    squared = curvature_squared(curve)
    if all(map(is_zero, squared.denominator)):
        raise InputError("a curve that is one point has no curvature")
    if all(map(is_zero, squared.numerator)):
        return Enclosure(Fraction(0), Fraction(0))
    if not is_regular(curve):
        squared = _reduced(squared)
        if _has_root(squared.denominator):
            return Enclosure(Fraction(0), None)
    top = maximum(squared.numerator, squared.denominator, rel)
    assert top.high is not None
    return root_enclosure(top.low, top.high)


def is_regular(curve: Bezier) -> bool:
    """Whether P'(t) differs from zero for all t in [0, 1]: the curve never stops and has a direction everywhere."""
    return not _has_root(curve.hodograph().norm_squared())


def _has_root(b: bs.Coefficients) -> bool:
    """Whether a polynomial other than 0 has a root in [0, 1]."""
    return is_zero(b[0]) or is_zero(b[-1]) or (bs.sign_changes(b) > 0 and bool(isolate(b)))


def _reduced(function: RationalFunction) -> RationalFunction:
    """The same function without common factors, the denominator nonnegative on [0, 1]."""
    top, bottom = bs.to_power(function.numerator), bs.to_power(function.denominator)
    common = bs.gcd(top, bottom)
    sides = [bs.from_power(bs.divide(side, common)[0]) for side in (top, bottom)]
    # a gcd with an odd power of 1 - t or with negative sign would turn both signs around
    if sign(sides[1][0]) < 0:
        sides = [bs.negate(side) for side in sides]
    return RationalFunction(sides[0], sides[1])
