"""Sizes that the checkers refuse to compute with: a certificate may hold anything.

What is refused is not called wrong: ``Unable`` makes the verdict "not decided". The limits lie far above what the
producers write, and low enough that no single operation takes more than a few seconds or much memory.
"""

from __future__ import annotations

from fractions import Fraction

from qe.errors import Unable
from qe.exact.ring import Poly

DEGREES = 1_000
"""The sum of the degrees of two polynomials whose resultant is formed."""

POWER_BITS = 20_000_000
"""The bit length of a power of a rational number."""

POWER_TERMS = 2_000
"""Exponent times number of terms of a power of a polynomial with more than one term."""

FIELD_BITS = 1_000_000_000
"""The bit length of the multiplication table of a number field."""


VARIABLES = 2_000
"""The number of variables of a quadratic form."""


def check_variables(count: int) -> None:
    """``Unable`` where matrices of this size are out of reach."""
    if count > VARIABLES:
        raise Unable(f"a matrix of {count} rows is needed")


def check_resultant(f: Poly, g: Poly, k: int) -> None:
    """``Unable`` where the resultant with respect to variable k is out of reach."""
    if f.degree(k) + g.degree(k) > DEGREES:
        raise Unable(f"a resultant of polynomials of degrees {f.degree(k)} and {g.degree(k)} is needed")


def check_value(f: Poly, k: int, value: Fraction) -> None:
    """``Unable`` where putting the value for variable k gives numbers out of reach."""
    bits = value.numerator.bit_length() + value.denominator.bit_length()
    if f.degree(k) * bits > POWER_BITS:
        raise Unable(f"the power {f.degree(k)} of a number of {bits} bits is needed")


def check_power(p: Poly, exponent: int) -> None:
    """``Unable`` where the power is out of reach."""
    if p.term_count() > 1 and exponent * p.term_count() > POWER_TERMS:
        raise Unable(f"the power {exponent} of a polynomial of {p.term_count()} terms is needed")


def check_field(coefficients: list[int]) -> None:
    """``Unable`` where the residues modulo the polynomial are out of reach."""
    degree, height = len(coefficients) - 1, max(abs(c).bit_length() for c in coefficients)
    if degree**3 * height > FIELD_BITS:
        raise Unable(f"a number field of degree {degree} with coefficients of {height} bits is needed")
