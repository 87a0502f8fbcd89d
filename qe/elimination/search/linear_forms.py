"""Polynomials as linear forms in their monomials, divided so that those that differ in a constant are one form."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import gcd

from qe.exact.linear_bounds import LinearBounds
from qe.exact.ring import Poly

Monomial = tuple[tuple[int, int], ...]
"""Variables with their exponents, ascending; of all others the exponent is 0."""
Direction = tuple[tuple[Monomial, int], ...]
"""A sum of coprime multiples of monomials, the first one positive."""


@dataclass(frozen=True, slots=True)
class LinearForm:
    """The polynomial is scale * (direction - bound)."""

    direction: Direction
    bound: Fraction
    scale: int


def over_monomials(poly: Poly) -> LinearForm:
    """The form of a polynomial that is no constant."""
    terms = sorted(poly.sparse_terms())
    constant = 0 if terms[0][0] else terms.pop(0)[1]
    content = gcd(*(c for _, c in terms))
    scale = content if terms[0][1] > 0 else -content
    return LinearForm(tuple((m, c // scale) for m, c in terms), Fraction(-constant, scale), scale)


def is_square(monomial: Monomial) -> bool:
    """Whether all exponents are even."""
    return not any(power % 2 for _, power in monomial)


class FormBounds(LinearBounds):
    """Bounds of linear forms in monomials: each form and each monomial is one variable, squares are at least 0."""

    def __init__(self, most: int | None = None) -> None:
        super().__init__(most)
        self.monomials: dict[Monomial, int] = {}
        self.forms: dict[Direction, int] = {}

    def of(self, direction: Direction) -> int:
        """The variable of a form."""
        found = self.forms.get(direction)
        if found is None:
            columns = {self.monomial(m): c for m, c in direction}
            found = self.forms[direction] = next(iter(columns)) if len(columns) == 1 else self.form(columns)
        return found

    def monomial(self, monomial: Monomial) -> int:
        """The variable of a monomial."""
        found = self.monomials.get(monomial)
        if found is None:
            found = self.monomials[monomial] = self.variable()
            self._bound_square(monomial)
        return found

    def bound_squares(self) -> None:
        """Say of the squares again, after ``clear``, that they are at least 0."""
        for monomial in self.monomials:
            self._bound_square(monomial)

    def _bound_square(self, monomial: Monomial) -> None:
        if is_square(monomial):
            self.at_least(self.monomials[monomial], Fraction(0), strict=False, reason=None)

    def values_of_monomials(self) -> dict[Monomial, Fraction]:
        """Numbers that keep all bounds (``point``)."""
        values = self.point()
        return {m: values[x] for m, x in self.monomials.items()}
