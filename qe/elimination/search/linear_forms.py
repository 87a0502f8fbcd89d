"""Polynomials as linear forms in their monomials, scaled so that those that differ in a constant are one form."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from qe.exact.ring import Poly

Monomial = tuple[int, ...]


@dataclass(frozen=True, slots=True)
class LinearForm:
    """The polynomial is scale * (direction - bound), ``direction`` a sum of coefficients times monomials."""

    direction: tuple[tuple[Monomial, Fraction], ...]
    bound: Fraction
    scale: int


def over_monomials(poly: Poly) -> LinearForm:
    """The form of a polynomial that is no constant; the first monomial has the coefficient 1."""
    terms = poly.terms()
    scale = terms[0][1]
    direction = tuple((m, Fraction(c, scale)) for m, c in terms if any(m))
    constant = next((c for m, c in terms if not any(m)), 0)
    return LinearForm(direction, Fraction(-constant, scale), scale)
