"""Numbers known to lie between two rational ends, and the largest value of a rational function on [0, 1].

Quality of a curve in rigorous numbers: length, largest curvature, whether it ever stops.

Lengths are in the unit of the coordinates, curvatures in its inverse. Nothing is sampled: every number is an
enclosure that holds for the whole curve.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction
from itertools import pairwise
from math import ceil, inf, isqrt, lcm
from typing import Any

from bezier.curves import bernstein as bs
from bezier.curves.bernstein import Numbers, halves
from bezier.curves.curve import Bezier, curvature_squared
from bezier.curves.nonnegative import events_of
from bezier.curves.scalar import is_zero, rational, sign
from qe.errors import InputError, Unable
from qe.exact.quadrature import root_integral

BITS = 192
MAX_PIECES = 20_000


@dataclass(frozen=True, slots=True)
class Enclosure:
    """A real number x with low <= x <= high; ``high`` is None when x is infinite. Invariant: low <= high."""

    low: Fraction
    high: Fraction | None

    def __post_init__(self) -> None:
        if self.high is not None and self.high < self.low:
            raise InputError("an enclosure needs low <= high")

    @property
    def is_bounded(self) -> bool:
        """Whether the number is finite."""
        return self.high is not None

    def __add__(self, other: Enclosure) -> Enclosure:
        high = None if self.high is None or other.high is None else self.high + other.high
        return Enclosure(self.low + other.low, high)

    @property
    def finite(self) -> tuple[Fraction, Fraction]:
        """Both ends of a number that is known to be finite."""
        assert self.high is not None
        return self.low, self.high

    def scaled(self, factor: Fraction) -> Enclosure:
        """The number times a positive one."""
        return Enclosure(self.low * factor, None if self.high is None else self.high * factor)

    def keeps(self, limit: Fraction | None) -> bool | None:
        """Whether the number is at most a limit, if there is one: proved, refuted, or (None) closer than the ends."""
        if limit is None or (self.high is not None and self.high <= limit):
            return True
        return False if self.low > limit else None

    def __float__(self) -> float:
        """The middle, rounded; infinite beyond the range of floating point."""
        if self.high is None:
            return inf
        try:
            return float((self.low + self.high) / 2)
        except OverflowError:
            return inf if self.low > 0 else -inf

    def shown(self, digits: int = 6) -> str:
        """For people: as many digits as both ends agree in; both ends where they agree in none."""
        if self.high is None:
            return f"at least {self.to_json(digits)['low']}"
        low, high = float(self.low), float(self.high)
        for count in range(digits, 1, -1):
            if f"{low:.{count}g}" == f"{high:.{count}g}":
                return f"{low:.{count}g}"
        return f"{self.to_json(digits)['low']} … {self.to_json(digits)['high']}"

    def to_json(self, digits: int = 12) -> dict[str, str]:
        """``{"low", "high"}`` as decimals rounded outwards; ``high`` is "inf" for an infinite number."""
        return {"low": _decimal(self.low, digits, ROUND_FLOOR), "high": _decimal(self.high, digits, ROUND_CEILING)}


def _decimal(value: Fraction | None, digits: int, rounding: str) -> str:
    if value is None:
        return "inf"
    context = Context(prec=digits, rounding=rounding)
    return f"{context.divide(Decimal(value.numerator), Decimal(value.denominator)):f}"


def bounds(value: Any, bits: int = BITS) -> tuple[Fraction, Fraction]:
    """Rational numbers low <= value <= high: equal for a rational value, else ``bits`` good bits."""
    number = rational(value)
    if number is not None:
        return number, number
    low, high = value.interval(bits)
    return Fraction(low), Fraction(high)


def root_below(square: Fraction, bits: int = BITS) -> Fraction:
    """The square root of ``square`` >= 0 if that is rational, else a rational number at most 2^-bits below it."""
    return Fraction(isqrt((square.numerator * square.denominator) << 2 * bits), square.denominator << bits)


def root_above(square: Fraction, bits: int = BITS) -> Fraction:
    """The square root of ``square`` >= 0 if that is rational, else a rational number at most 2^-bits above it."""
    below = root_below(square, bits)
    return below if below * below == square else below + Fraction(1, square.denominator << bits)


def root_enclosure(low: Fraction, high: Fraction) -> Enclosure:
    """The square root of a number in [low, high], low >= 0."""
    return Enclosure(root_below(low), root_above(high))


def maximum(numerator: Sequence[Any], denominator: Sequence[Any], rel: Fraction) -> Enclosure:
    """The largest value on [0, 1] of N(t)/D(t), N and D in Bernstein form, N >= 0 somewhere and D > 0 on [0, 1].

    high - low <= rel * high. If c D - N has nonnegative Bernstein coefficients on a piece, N/D <= c there. With c a
    little above the largest value seen, a piece is left when that holds and halved otherwise; near the maximum the
    coefficients approach c D - N >= (c - max) D > 0 with quadratic speed, so the halving ends. Irrational coefficients
    are replaced by rational ones with an error that is carried along.

    Raises ``Unable`` beyond ``MAX_PIECES`` pieces.
    """
    if all(map(is_zero, numerator)):
        return Enclosure(Fraction(0), Fraction(0))
    degree = max(len(numerator), len(denominator)) - 1
    todo, pieces, best = [_Quotient.of(bs.elevate(numerator, degree), bs.elevate(denominator, degree))], 0, Fraction(0)
    while todo:
        piece = todo.pop()
        best = max(best, *piece.at_ends())
        if piece.is_at_most(best * (1 + rel)):
            continue
        pieces += 1
        if pieces > MAX_PIECES:
            raise Unable("the maximum of a rational function was not enclosed within the subdivision limit")
        todo += piece.halves()
    return Enclosure(best, best * (1 + rel))


@dataclass(frozen=True, slots=True)
class _Quotient:
    """N/D on a piece: integers over a common factor, each wrong by at most ``error``."""

    above: Numbers
    below: Numbers
    error: int

    @staticmethod
    def of(numerator: Sequence[Any], denominator: Sequence[Any]) -> _Quotient:
        """Rational coefficients exactly, others to ``BITS`` binary places of the largest one."""
        values = [*numerator, *denominator]
        if all(rational(v) is not None for v in values):
            exact = [Fraction(rational(v) or 0) for v in values]
            scale = lcm(*(v.denominator for v in exact))
            whole, error = [int(v * scale) for v in exact], 0
        else:
            ends = [bounds(v) for v in values]
            factor = (1 << BITS) / max(abs(end) for pair in ends for end in pair)
            whole = [round((low + high) / 2 * factor) for low, high in ends]
            error = 1 + ceil(max(high - low for low, high in ends) * factor)
        size = len(numerator)
        return _Quotient(tuple(whole[:size]), tuple(whole[size:]), error)

    def at_ends(self) -> list[Fraction]:
        """Lower bounds of the values at both ends."""
        return [Fraction(self.above[k] - self.error, self.below[k] + self.error) for k in (0, -1)]

    def is_at_most(self, ceiling: Fraction) -> bool:
        """Whether the Bernstein coefficients of c D - N are nonnegative."""
        top, bottom, e = ceiling.numerator, ceiling.denominator, self.error
        return all(top * (d - e) >= bottom * (n + e) for n, d in zip(self.above, self.below, strict=True))

    def halves(self) -> list[_Quotient]:
        """Both halves, the left one last."""
        error = self.error << (len(self.above) - 1)
        pairs = zip(halves(self.above), halves(self.below), strict=True)
        left, right = (_Quotient(above, below, error) for above, below in pairs)
        return [right, left]


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
    stops = [event.t for event in events_of((stopping,), STOP_WIDTH)[1:-1]]
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
    radicand, factor, stopping = bs.to_power(squared), one, one
    while len(common := bs.gcd(radicand, bs.power_derivative(radicand))) > 1:
        part = bs.divide(common, bs.gcd(common, bs.power_derivative(common)))[0]  # every multiple factor once
        factor, stopping = bs.power_multiply(factor, part), part if stopping == one else stopping
        radicand = bs.divide(radicand, bs.power_multiply(part, part))[0]
    return bs.from_power(factor), bs.from_power(radicand), bs.from_power(stopping)


def curvature_enclosure(curve: Bezier, rel: Fraction = REL) -> Enclosure:
    """The supremum of the curvature over [0, 1], with high - low <= rel * high; infinite at a cusp.

    Where P'(t) = 0 the curvature is understood as its limit: the common factors of numerator and denominator of
    kappa^2 are divided out; a root of the denominator that remains makes the curvature unbounded.
    Raises ``InputError`` for a curve that is one point, ``Unable`` when the width is not reached.
    """
    top, bottom = curvature_squared(curve)
    if all(map(is_zero, bottom)):
        raise InputError("a curve that is one point has no curvature")
    if all(map(is_zero, top)):
        return Enclosure(Fraction(0), Fraction(0))
    if not is_regular(curve):
        top, bottom = _reduced(top, bottom)
        if _has_root(bottom):
            return Enclosure(Fraction(0), None)
    return root_enclosure(*maximum(top, bottom, rel).finite)


def is_regular(curve: Bezier) -> bool:
    """Whether P'(t) differs from zero for all t in [0, 1]: the curve never stops and has a direction everywhere."""
    return not _has_root(curve.hodograph().norm_squared())


def _has_root(b: bs.Coefficients) -> bool:
    """Whether a polynomial other than 0 has a root in [0, 1]."""
    return is_zero(b[0]) or is_zero(b[-1]) or (bs.sign_changes(b) > 0 and len(events_of((b,))) > 2)


def _reduced(*quotient: bs.Coefficients) -> list[bs.Coefficients]:
    """Numerator and denominator without common factors, the denominator nonnegative on [0, 1]."""
    powers = list(map(bs.to_power, quotient))
    common = bs.gcd(*powers)
    sides = [bs.from_power(bs.divide(side, common)[0]) for side in powers]
    # a gcd with an odd power of 1 - t or with negative sign would turn both signs around
    if sign(sides[1][0]) < 0:
        sides = [bs.negate(side) for side in sides]
    return sides
