"""Real algebraic numbers in SymPy are the numbers they are here."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp
from flint import fmpz_poly
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from qe.decomposition.interval import number_of
from qe.exact.algebraic import RealAlgebraic, real_roots
from qe.exact.field import NumberField

SMALL = st.integers(-9, 9)
COEFFICIENTS = st.one_of(SMALL, st.integers(-(10**25), 10**25))


@st.composite
def numbers(draw: st.DrawFn, *, degree: int = 5, coefficients: st.SearchStrategy[int] = COEFFICIENTS) -> RealAlgebraic:
    roots = real_roots(fmpz_poly([*draw(st.lists(coefficients, min_size=1, max_size=degree)), 1]))
    assume(roots)
    return draw(st.sampled_from(roots))


@settings(max_examples=40)
@given(numbers())
def test_value_polynomial_and_order(number: RealAlgebraic) -> None:
    there = sp.sympify(number)
    low, high = number.interval(80)
    width = max(high - low, abs(high) / 2**70, Fraction(1, 2**70))
    value = Fraction(str(there.evalf(40, maxn=400)))
    assert low - width <= value <= high + width
    assert not there.atoms(sp.Float) and there.is_number
    assert number_of(there, "number") == number
    if number.degree <= 2:
        (found,) = [sp.Poly(sp.minimal_polynomial(there, sp.Symbol("t")))]
        assert [abs(int(c)) for c in reversed(found.all_coeffs())] == [abs(c) for c in number.minimal_polynomial]


@settings(max_examples=15)
@given(numbers(degree=2, coefficients=SMALL), numbers(degree=2, coefficients=SMALL))
def test_arithmetic_with_sympy_is_arithmetic_here(left: RealAlgebraic, right: RealAlgebraic) -> None:
    there = sp.sympify(right)
    for mixed, here in ((left + there, left + right), (there - left, right - left), (left * there, left * right)):
        assert isinstance(mixed, sp.Expr) and not mixed.atoms(sp.Float)
        error = abs((mixed - sp.sympify(here)).evalf(30, maxn=400))
        assert number_of(sp.sympify(mixed), "number") == here
        assert error <= sp.Rational(1, 10**15) * (1 + abs(sp.sympify(here).evalf(30, maxn=400)))


@settings(max_examples=30)
@given(numbers(degree=3), st.lists(st.integers(-9, 9), min_size=1, max_size=3))
def test_elements_of_fields(theta: RealAlgebraic, coefficients: list[int]) -> None:
    field = NumberField(theta)
    element = field.element([Fraction(c) for c in coefficients[: field.degree]])
    assert sp.sympify(element) == sp.sympify(element.to_algebraic())
    assert element.to_algebraic() == element and element == element.to_algebraic()
    assert (element + theta) == (element.to_algebraic() + theta)
