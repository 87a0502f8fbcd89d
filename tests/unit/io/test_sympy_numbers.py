"""Real algebraic numbers as SymPy numbers and back."""

from fractions import Fraction

import pytest
import sympy

from qe.exact.algebraic import RealAlgebraic
from qe.io.sympy_reader import decimal_of, number_from_sympy, number_to_sympy
from tests.tables import each

CUBIC = [RealAlgebraic.from_root([1, -3, 0, 1], low, low + 1) for low in (-2, 0, 1)]
NUMBERS = [
    RealAlgebraic.rational(Fraction(-3, 7)),
    RealAlgebraic.from_root([-2, 0, 1], 1, 2),
    RealAlgebraic.from_root([-2, 0, 1], -2, -1),
    RealAlgebraic.from_root([-1, -1, 1], 1, 2),
    RealAlgebraic.from_root([-1, 2, 3], -2, -1),
    *CUBIC,
]


@pytest.mark.parametrize("number", NUMBERS, ids=str)
def test_there_and_back(number: RealAlgebraic) -> None:
    there = number_to_sympy(number)
    assert number_from_sympy(there) == number
    assert float(there.evalf(20)) == pytest.approx(float(number), abs=1e-12)


@each(sympy.pi, sympy.I, sympy.Symbol("x"), 3, sympy.oo, sympy.exp(1), sympy.sqrt(2) * sympy.I)
def test_what_is_no_real_algebraic_number(number: object) -> None:
    assert number_from_sympy(number) is None


def test_roots_that_are_close() -> None:
    """sqrt(2) + 10^-40 has a conjugate far off; sqrt(2 + 10^-60) is told from sqrt(2)."""
    near = sympy.sqrt(2 + sympy.Rational(1, 10**60))
    found = number_from_sympy(near)
    assert found is not None and found > NUMBERS[1] and found - NUMBERS[1] < Fraction(1, 10**59)


def test_decimals() -> None:
    assert decimal_of(sympy.Float("-1.25")) == Fraction(-5, 4) and decimal_of(sympy.Float("1e-3")) == Fraction(1, 1000)
