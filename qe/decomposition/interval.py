"""Exact intervals of one variable, and the numbers that points of regions are made of."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from numbers import Rational

from qe.arguments import rational
from qe.exact.algebraic import RealAlgebraic
from qe.exact.field import FieldElement
from qe.exact.nearby import rational_between
from qe.proof.certificate import Certificate

Number = Fraction | RealAlgebraic
Coordinate = int | Fraction | str | float | RealAlgebraic | FieldElement
"""What a number may be given as: text such as ``-3/4`` or ``1.5e-3``, a float as the decimal number that it prints.

``Decimal`` and SymPy's real algebraic numbers are taken, too.
"""


@dataclass(frozen=True, slots=True, repr=False)
class Interval:
    """Exact bounds of a variable: ``lower``/``upper`` are None when unbounded; ``*_closed``: attained.

    ``certificates``: what proves the bounds, where they were found by optimisation.
    """

    lower: Number | None
    upper: Number | None
    lower_closed: bool
    upper_closed: bool
    certificates: tuple[Certificate, ...] = ()

    def __repr__(self) -> str:
        low = "(-oo" if self.lower is None else f"{'[' if self.lower_closed else '('}{self.lower}"
        high = "oo)" if self.upper is None else f"{self.upper}{']' if self.upper_closed else ')'}"
        return f"Interval{low}, {high}"

    def __iter__(self) -> Iterator[Number | None]:
        yield self.lower
        yield self.upper

    def __contains__(self, given: Coordinate) -> bool:
        value = number_of(given, "number")
        above = self.lower is None or self.lower < value or (self.lower_closed and self.lower == value)
        below = self.upper is None or value < self.upper or (self.upper_closed and self.upper == value)
        return above and below

    def simplest(self) -> Number:
        """A number of the interval that is easy to compute with: rational inside, the end of a single point."""
        if self.lower is not None and self.lower == self.upper:
            return self.lower
        return rational_between(self.lower, self.upper)


def number_of(value: Coordinate, what: str, expected: str = "an exact number") -> Number:
    """The exact number that is given as the argument ``what``; ``InputError`` otherwise."""
    if isinstance(value, FieldElement):
        return value.as_fraction() if value.is_rational else value.to_algebraic()
    if isinstance(value, RealAlgebraic):
        return value
    if getattr(value, "is_number", None) is True:  # so it is an expression of SymPy
        from qe.io.sympy_reader import number_from_sympy

        found = None if isinstance(value, Rational) else number_from_sympy(value)
        if found is not None:
            return found
    return rational(value, what, expected)
