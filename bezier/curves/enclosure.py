"""Numbers known to lie between two rational ends, and the largest value of a rational function on [0, 1]."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction
from math import ceil, inf, isqrt, lcm
from typing import Any

from bezier.curves import bernstein as bs
from bezier.curves.bernstein import Numbers, halves
from bezier.curves.scalar import is_zero, rational
from qe.errors import InputError, Unable

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
        best = max(best, piece.at_start(), piece.at_end())
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

    def at_start(self) -> Fraction:
        """A lower bound of the value at the start."""
        return Fraction(self.above[0] - self.error, self.below[0] + self.error)

    def at_end(self) -> Fraction:
        """A lower bound of the value at the end."""
        return Fraction(self.above[-1] - self.error, self.below[-1] + self.error)

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
