"""Exact numbers in Python's own operators and functions: exact where the other number is, never silently false."""

from __future__ import annotations

import math
import operator
from decimal import Decimal
from fractions import Fraction
from numbers import Real
from typing import Any

import mpmath
import numpy as np
import pytest
import sympy
from flint import fmpz_poly
from hypothesis import given
from hypothesis import strategies as st

import qe
from qe.exact.algebraic import RealAlgebraic, real_roots
from qe.exact.field import FieldElement, NumberField
from tests.tables import each

ROOT = real_roots(fmpz_poly([-2, 0, 1]))[1]
ELEMENT = NumberField(ROOT).element([0, 1])
NUMBERS = (ROOT, ELEMENT)
COMPARISONS = (operator.lt, operator.le, operator.gt, operator.ge, operator.eq, operator.ne)
OPERATIONS = (operator.add, operator.sub, operator.mul, operator.truediv, operator.floordiv, operator.mod)
SMALL = st.fractions(-50, 50, max_denominator=20)
EXACT = st.one_of(SMALL, SMALL.map(float), st.integers(-9, 9), SMALL.map(lambda q: Decimal(str(float(q)))))


def of(kind: type, value: Fraction) -> Any:
    return RealAlgebraic.rational(value) if kind is RealAlgebraic else NumberField(ROOT).rational(value)


@pytest.mark.parametrize("kind", [RealAlgebraic, FieldElement])
@given(value=SMALL, other=EXACT)
def test_a_rational_number_compares_as_its_fraction_does(kind: type, value: Fraction, other: Any) -> None:
    exact = Fraction(other)
    for compare in COMPARISONS:
        assert compare(of(kind, value), other) is compare(value, exact)
        assert compare(other, of(kind, value)) is compare(exact, value)
    if of(kind, value) == other:
        assert hash(of(kind, value)) == hash(other)


@pytest.mark.parametrize("kind", [RealAlgebraic, FieldElement])
@given(value=SMALL, other=SMALL)
def test_arithmetic_and_rounding_are_those_of_fractions(kind: type, value: Fraction, other: Fraction) -> None:
    number = of(kind, value)
    for function in (math.floor, math.ceil, math.trunc, int, round, abs, bool, lambda x: round(x, 1)):
        assert function(number) == function(value)
    for compute in OPERATIONS:
        if other or compute not in (operator.truediv, operator.floordiv, operator.mod):
            assert compute(number, other) == compute(value, other)
        if value or compute not in (operator.truediv, operator.floordiv, operator.mod):
            assert compute(other, number) == compute(other, value)
    assert f"{number:.3f}" == f"{Decimal(value.numerator) / Decimal(value.denominator):.3f}"


@each(
    (lambda x: x > 1.4 and x >= 1.4, True),
    (lambda x: x == math.sqrt(2) or x == mpmath.sqrt(2) or x >= float(x), False),
    (lambda x: x > Decimal("1.4142135623730950488016887242096980785") and x < Decimal("1.42"), True),
    (lambda x: np.float64(1.4) < x < np.float32(1.5) and np.int64(1) < x, True),
    (lambda x: mpmath.mpf("1.4") < x and x < mpmath.inf, True),
    (lambda x: x < math.inf and x > -math.inf, True),
    (lambda x: any(f(x, n) for f in COMPARISONS[:5] for n in (math.nan, Decimal("nan"), mpmath.nan)), False),
    (lambda x: x != math.nan and x != "a" and x != 1j, True),
    (lambda x: x + 0.5, math.sqrt(2) + 0.5),
    (lambda x: 2.0**x, 2.0 ** math.sqrt(2)),
    (lambda x: mpmath.mpf(x) - mpmath.sqrt(2) + mpmath.sqrt(x) - mpmath.root(2, 4), 0),
    (lambda x: x * np.float64(2), 2 * math.sqrt(2)),
    (lambda x: (x + Decimal("0.5") - Decimal("0.5")) == x, True),
    (lambda x: round(x, 3), Fraction(1414, 1000)),
    (lambda x: (round(x), int(-x), math.floor(-x), math.ceil(x), x // 1, 3 // x), (1, -1, -2, 2, 1, 2)),
    (lambda x: f"{x:.3}|{x:>8.3}", "1.41|    1.41"),  # the text was cut: sqr
    (lambda x: f"{x:.30f}|{x:>9}|{x:8.2f}|{x:+.1%}", "1.414213562373095048801688724210|  sqrt(2)|    1.41|+141.4%"),
    (lambda x: divmod(-x, 1)[0] + divmod(-x, 1)[1] == -x, True),
    (lambda x: (bool(x - x), isinstance(x, Real), complex(x).imag, x.real == +x), (False, True, 0.0, True)),
    (lambda x: x == sympy.sqrt(2) and x > sympy.Rational(7, 5) and sympy.Rational(7, 5) < x, True),
    (lambda x: sorted([x, 2.0, 1])[1] == x and max(x, 1.5), 1.5),
)
@pytest.mark.parametrize("number", NUMBERS)
def test_the_square_root_of_two(of_it: Any, expected: object, number: Any) -> None:
    assert of_it(number) == expected


@each(
    (lambda x: x > "a", TypeError),
    (lambda x: x + "a", TypeError),
    (lambda x: x + Decimal("nan"), TypeError),
    (lambda x: x // 0, ZeroDivisionError),
    (lambda x: f"{x:zz}", ValueError),
)
@pytest.mark.parametrize("number", NUMBERS)
def test_what_is_no_number_is_refused(of_it: Any, error: type[Exception], number: Any) -> None:
    with pytest.raises(error):
        of_it(number)


def test_a_tie_is_rounded_as_python_does_and_near_ones_by_what_they_are() -> None:
    near = RealAlgebraic.rational(Fraction(1, 8)) + Fraction(1, 10**60)
    assert f"{RealAlgebraic.rational(Fraction(1, 8)):.2f} {near:.2f}" == "0.12 0.13"
    assert f"{ROOT * 10**400:.0f}".startswith("14142135623730950488016887242096980785696718753769")


@each(
    ("qe.minimize('x^2 + y^2', 'x + y >= 2')", "2"),
    ("qe.minimize('x^3 - x', 'x >= 0')", "-2*sqrt(3)/9"),
    ("qe.region('x^2 <= 2')", "x**2 <= 2"),
    ("qe.solve('x^2 = 2*x')", "Eq(x, 0) | Eq(x, 2)"),
    ("qe.find_instance('x^2 = 2 and x > 0')", "{x: sqrt(2)}"),
    ("qe.eliminate('ex x. x^2 = a')", "a >= 0"),
)
def test_results_are_sympy_s_when_it_asks(result: str, expected: str) -> None:
    value = eval(result, {"qe": qe})
    assert str(sympy.sympify(value)) == str(value.to_sympy()) == expected
