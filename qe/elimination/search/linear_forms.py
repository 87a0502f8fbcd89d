"""Polynomials as linear forms in their monomials, scaled so that those that differ in a constant are one form."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from qe.exact.linear_bounds import LinearBounds
from qe.exact.ring import Poly

Monomial = tuple[int, ...]
Direction = tuple[tuple[Monomial, Fraction], ...]


@dataclass(frozen=True, slots=True)
class LinearForm:
    """The polynomial is scale * (direction - bound), ``direction`` a sum of coefficients times monomials."""

    direction: Direction
    bound: Fraction
    scale: int


def over_monomials(poly: Poly) -> LinearForm:
    """The form of a polynomial that is no constant; the first monomial has the coefficient 1."""
    terms = poly.terms()
    scale = terms[0][1]
    direction = tuple((m, Fraction(c, scale)) for m, c in terms if any(m))
    constant = next((c for m, c in terms if not any(m)), 0)
    return LinearForm(direction, Fraction(-constant, scale), scale)


def is_square(monomial: Monomial) -> bool:
    """Whether all exponents are even."""
    return not any(power % 2 for power in monomial)


class FormBounds(LinearBounds):
    """Bounds of linear forms in monomials: each form and each monomial is one variable, squares are at least 0."""

    def __init__(self) -> None:
        super().__init__()
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
