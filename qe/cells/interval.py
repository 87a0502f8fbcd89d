"""Exact intervals of one variable, and the numbers that points of regions are made of."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from qe.errors import InputError
from qe.exact.algebraic import RealAlgebraic
from qe.exact.nearby import rational_between
from qe.proof.certificate import Certificate

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

    def simplest(self) -> Number:
        """A number of the interval that is easy to compute with: rational inside, the end of a single point."""
        if self.lower is not None and self.lower == self.upper:
            return self.lower
        return rational_between(self.lower, self.upper)


def number_of(value: Coordinate, name: str) -> Number:
    """The exact number that is given for a variable; ``InputError`` otherwise."""
    if isinstance(value, RealAlgebraic):
        return value
    try:
        return Fraction(value)
    except (ValueError, ZeroDivisionError, TypeError):
        raise InputError(f"point: an exact number for {name} expected, {value!r} found") from None
