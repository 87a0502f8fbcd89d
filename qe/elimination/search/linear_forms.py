"""Polynomials as linear forms in their monomials, scaled so that those that differ in a constant are one form."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

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
