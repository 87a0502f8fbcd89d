"""What polynomials in one and in several variables have in common."""

from __future__ import annotations

from typing import Self

from qe.plain.factors import of_terms
from qe.plain.numbers import DomainError
from qe.plain.terms import MASK, Terms, added, common_divisor, content, division, times


class Polynomial:
    """A polynomial with integer coefficients by its terms; immutable. ``places``: where its exponents begin."""

    __slots__ = ("places", "t")
    places: tuple[int, ...]
    t: Terms

    def like(self, terms: Terms) -> Self:
        """The polynomial with these terms in the same variables."""
        made = object.__new__(type(self))
        made.places, made.t = self.places, terms
        return made

    def _terms(self, other: Self | int) -> Terms:
        return other.t if isinstance(other, Polynomial) else {0: int(other)} if other else {}

    def __eq__(self, other: object) -> bool:
        return isinstance(other, type(self) | int) and self.t == self._terms(other)

    def __bool__(self) -> bool:
        return bool(self.t)

    def __neg__(self) -> Self:
        return self.like({k: -c for k, c in self.t.items()})

    def __add__(self, other: Self | int) -> Self:
        return self.like(added(self.t, self._terms(other)))

    __radd__ = __add__

    def __sub__(self, other: Self | int) -> Self:
        return self.like(added(self.t, self._terms(other), -1))

    def __rsub__(self, other: int) -> Self:
        return -self + other

    def __mul__(self, other: Self | int) -> Self:
        if isinstance(other, int):
            return self.like({k: c * other for k, c in self.t.items()} if other else {})
        return self.like(times(self.t, other.t, len(self.places)))

    __rmul__ = __mul__

    def __pow__(self, exponent: int) -> Self:
        if exponent < 0:
            raise DomainError("a negative power")
        result = self.like({0: 1})
        for bit in bin(exponent)[2:]:
            result = result * result * self if bit == "1" else result * result
        return result

    def __truediv__(self, other: Self | int) -> Self:
        divisor = self._terms(other)
        if not divisor:
            raise ZeroDivisionError("division by zero")
        quotient, remainder = division(self.t, divisor, len(self.places))
        if remainder:
            raise DomainError("division is not exact")
        return self.like(quotient)

    def leading_coefficient(self) -> int:
        """The coefficient of the first term, 0 for zero."""
        return self.t[max(self.t)] if self.t else 0

    def content(self) -> int:
        """The greatest common divisor of the coefficients."""
        return content(self.t)

    def derivative(self, i: int = 0) -> Self:
        """The derivative in variable i."""
        place = self.places[i]
        return self.like({k - (1 << place): c * (k >> place & MASK) for k, c in self.t.items() if k >> place & MASK})

    def gcd(self, other: Self) -> Self:
        """The greatest common divisor, with a positive leading coefficient."""
        return self.like(common_divisor(self.t, other.t, self.places))

    def factor(self) -> tuple[int, list[tuple[Self, int]]]:
        """The unit, and irreducible factors with their multiplicities."""
        unit, parts = of_terms(self.t, self.places)
        return unit, [(self.like(f), e) for f, e in parts]
