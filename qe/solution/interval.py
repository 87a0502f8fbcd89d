"""Exact intervals of one variable, and the numbers that points of regions are made of."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from qe.errors import InputError
from qe.evidence.certificate import Certificate
from qe.exact.algebraic import RealAlgebraic

Number = Fraction | RealAlgebraic
Coordinate = int | Fraction | str | RealAlgebraic


@dataclass(frozen=True, slots=True)
class Interval:
    """Exact bounds of a variable: ``lower``/``upper`` are None when unbounded; ``*_closed``: attained.

    ``certificates``: what proves the bounds, where they were found by optimisation.
    """

    lower: Number | None
    upper: Number | None
    lower_closed: bool
    upper_closed: bool
    certificates: tuple[Certificate, ...] = ()

    def __iter__(self) -> Iterator[Number | None]:
        yield self.lower
        yield self.upper

    def __contains__(self, value: Number) -> bool:
        above = self.lower is None or self.lower < value or (self.lower_closed and self.lower == value)
        below = self.upper is None or value < self.upper or (self.upper_closed and self.upper == value)
        return above and below

    def simplest(self) -> Fraction | RealAlgebraic:
        """A number of the interval that is easy to compute with: rational inside, the end of a single point."""
        if self.lower is not None and self.lower == self.upper:
            return self.lower
        low, high = self.lower, self.upper
        if low is None or high is None:
            if low is not None and low >= 0:
                return Fraction(_ceiling(low) + 1)
            return Fraction(0) if high is None or high > 0 else Fraction(-_ceiling(-high) - 1)
        denominator = 1
        while True:
            numerator = _ceiling(low * denominator)
            for candidate in (Fraction(numerator, denominator), Fraction(numerator + 1, denominator)):
                if low < candidate < high:
                    return candidate
            denominator *= 2


def _ceiling(value: Number) -> int:
    """An integer >= value and < value + 2."""
    if isinstance(value, Fraction):
        return -(-value.numerator // value.denominator)
    _, high = value.interval()
    return int(-(-high.numerator // high.denominator))


def number_of(value: Coordinate, name: str) -> Number:
    """The exact number that is given for a variable; ``InputError`` otherwise."""
    if isinstance(value, RealAlgebraic):
        return value
    try:
        return Fraction(value)
    except (ValueError, ZeroDivisionError, TypeError):
        raise InputError(f"point: an exact number for {name} expected, {value!r} found") from None
