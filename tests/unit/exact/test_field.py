"""Real number fields: laws, signs against high precision, text that evaluates back."""

from __future__ import annotations

import math
import pickle
from fractions import Fraction as F

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from qe.errors import InputError
from qe.exact.algebraic import RealAlgebraic
from qe.exact.field import FieldElement, NumberField
from tests.strategies import rationals
from tests.tables import each

FIELDS = [
    NumberField.rationals(),
    NumberField.from_root([-2, 0, 1], 1, 2),
    NumberField.from_root([-2, 0, 0, 1], 1, 2),
    NumberField.from_root([1, 0, -10, 0, 1], 3, 4),  # sqrt(2) + sqrt(3)
    NumberField.from_root([-1, -1, 0, 0, 0, 1], 1, 2),
    NumberField.from_root([-3, 0, 2, 7], 0, 1),
]
numbers = rationals(5, 7)


@st.composite
def elements(draw, count: int = 2):
    field = draw(st.sampled_from(FIELDS))
    size = field.degree
    return tuple(field.element(draw(st.lists(numbers, min_size=size, max_size=size))) for _ in range(count))


@given(elements(3))
def test_field_laws(three) -> None:
    a, b, c = three
    assert a + b == b + a and a * b == b * a
    assert (a + b) * c == a * c + b * c and (a * b) * c == a * (b * c)
    assert a - a == 0 and a + 0 == a and a * 1 == a and not a * 0
    if b:
        assert a / b * b == a and b * b.inverse() == 1 and 1 / b == b**-1


@given(elements(2))
def test_order_is_that_of_the_reals(pair) -> None:
    a, b = pair
    x, y = float(a), float(b)
    if abs(x - y) > 1e-6:
        assert (a < b) == (x < y)
    assert (a < b) + (a == b) + (a > b) == 1
    assert (a * a).sign() == (1 if a else 0)
    assert (a * b).sign() == a.sign() * b.sign()
    low, high = a.interval(80)
    assert low <= a <= high and high - low <= F(1, 2**70) * (1 + abs(high))


def test_tiny_differences_have_the_right_sign() -> None:
    root = NumberField.from_root([-2, 0, 1], 1, 2).generator()
    for p, q in ((1, 1), (3, 2), (577, 408), (886731088897, 627013566048)):  # convergents, from both sides
        assert (root - F(p, q)).sign() == (1 if p * p < 2 * q * q else -1)
    assert (root - 1) ** 60 > 0 and (1 - root) ** 61 < 0


@given(elements(1))
def test_minimal_polynomial_and_conversion(one) -> None:
    (a,) = one
    p = a.minimal_polynomial
    value = sum((c * a**i for i, c in enumerate(p)), a.field.rational(0))
    assert not value and p[-1] > 0 and math.gcd(*p) == 1
    number = a.to_algebraic()
    assert isinstance(number, RealAlgebraic) and a == number and hash(a) == hash(number)
    assert math.isclose(float(number), float(a), rel_tol=1e-9, abs_tol=1e-9)
    assert pickle.loads(pickle.dumps(a)) == a


@settings(max_examples=30)
@given(elements(1))
def test_text_evaluates_back(one) -> None:
    (a,) = one
    text = str(a)
    assume("root(" not in text)
    value = eval(text, {"sqrt": math.sqrt, "__builtins__": {}})
    assert math.isclose(value, float(a), rel_tol=1e-7, abs_tol=1e-7)


@each(
    ([1, -3, 1], 0, 1, "(3 - sqrt(5))/2"),
    ([1, 0, -10, 0, 1], 3, 4, "sqrt(3) + sqrt(2)"),
    ([1, 0, -10, 0, 1], -1, 0, "-sqrt(3) + sqrt(2)"),
    ([-5, 0, -2, 0, 1], -2, -1, "-sqrt(1 + sqrt(6))"),
    ([-2, 0, 0, 0, 1], 1, 2, "sqrt(sqrt(2))"),
    ([-1, -1, 0, 1], 1, 2, "root(1, x^3 - x - 1)"),
)
def test_text(p: list[int], lo: int, hi: int, text: str) -> None:
    assert str(NumberField.from_root(p, lo, hi).generator()) == text


def test_different_fields() -> None:
    a = NumberField.from_root([-2, 0, 1], 1, 2).generator()
    b = NumberField.from_root([1, 0, -10, 0, 1], 3, 4).generator()
    with pytest.raises(InputError):
        _ = a + b
    assert a != b and a < b and a * a == FieldElement(b.field, b.value * 0 + 2)
    # sqrt(2) = (b^3 - 9b)/2 as an element of the larger field
    same = (b**3 - 9 * b) / 2
    assert same == a and hash(same) == hash(a) and not same < a


def test_bad_fields_and_division_by_zero() -> None:
    with pytest.raises(InputError):
        NumberField.from_root([-4, 0, 1], 1, 3)
    with pytest.raises(InputError):
        NumberField.from_root([-2, 0, 1], -2, 2)
    with pytest.raises(ZeroDivisionError):
        FIELDS[1].rational(0).inverse()
    with pytest.raises(InputError):
        FIELDS[1].generator().as_fraction()
