"""Real algebraic numbers: square roots, radicals, digits, fields that hold several."""

import math
import pickle
from fractions import Fraction
from fractions import Fraction as F
from math import sqrt

import pytest
from flint import fmpz_poly
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import qe
from qe.errors import InputError
from qe.exact.algebraic import RealAlgebraic, real_roots
from qe.exact.field import FieldElement, NumberField
from qe.exact.number import optimum_in_latex, point_text, simplest, square_root
from qe.exact.radicals import format_number, radical_text
from qe.exact.ring import Ring, format_poly
from qe.exact.sparse_text import digits, sparse_text
from tests.strategies import rationals
from tests.tables import each

TRIPLE = real_roots(fmpz_poly([-1, 9, -6, 1]))
"""Three positive numbers with one polynomial, x^3 - 6*x^2 + 9*x - 1."""


@each(("0", "0"), ("4", "2"), ("9/4", "3/2"))
def test_roots_of_squares_are_rational(value: str, root: str) -> None:
    found = square_root(Fraction(value))
    assert isinstance(found, Fraction) and found == Fraction(root)


@each(("2", [-2, 0, 1]), ("1/3", [-1, 0, 3]))
def test_other_roots_are_the_positive_ones(value: str, poly: list[int]) -> None:
    found = square_root(Fraction(value))
    assert isinstance(found, RealAlgebraic) and found.poly == fmpz_poly(poly) and found > 0


@pytest.mark.parametrize("k", range(3))
def test_the_root_of_each_of_several_conjugates_is_its_own(k: int) -> None:
    """The roots of p(x^2) are as many as those of p, and in their order."""
    found = square_root(TRIPLE[k])
    assert isinstance(found, RealAlgebraic) and found > 0
    assert float(found) ** 2 == pytest.approx(float(TRIPLE[k]), rel=1e-12)


def test_negative_conjugates_do_not_shift_the_roots() -> None:
    """x^2 - x - 1 has one root on each side of zero."""
    golden = real_roots(fmpz_poly([-1, -1, 1]))[1]
    assert float(square_root(golden)) == pytest.approx(float(golden) ** 0.5, rel=1e-12)


def test_rational_numbers_are_fractions() -> None:
    (half,) = real_roots(fmpz_poly([-1, 2]))
    assert simplest(half) == Fraction(1, 2) and isinstance(simplest(half), Fraction)


def test_points_and_optima_are_shown() -> None:
    assert point_text({"x": Fraction(1, 2), "y z": 3}).startswith("x = 1/2, ")
    assert optimum_in_latex("unbounded", None, []) == r"$\text{unbounded}$"
    assert "not attained" in optimum_in_latex("optimal", Fraction(1), [])
    assert r"\text{at}" in optimum_in_latex("optimal", Fraction(1), [{"x": Fraction(2)}])


@each(
    ([1, 0, -10, 0, 1], ["-sqrt(2) - sqrt(3)", "sqrt(2) - sqrt(3)", "-sqrt(2) + sqrt(3)", "sqrt(2) + sqrt(3)"]),
    ([-2, 0, 1], ["-sqrt(2)", "sqrt(2)"]),
    ([-3, 2], ["3/2"]),
    ([-2, 0, 0, 1], ["root(1, x^3 - 2)"]),
)
def test_texts(coefficients: list[int], texts: list[str]) -> None:
    found = [format_number(r) for r in sorted(real_roots(fmpz_poly(coefficients)))]
    assert len(found) == len(texts)
    for text, expected in zip(found, texts, strict=True):
        if "root(" in expected:
            assert text.startswith("root(1, ")
        else:
            assert value(text) == pytest.approx(value(expected), abs=1e-12)
            assert text.count("sqrt") == expected.count("sqrt")


def value(text: str) -> float:
    return float(eval(text, {"sqrt": sqrt}))


@settings(max_examples=30)
@given(st.integers(1, 3), st.integers(-9, 9), st.integers(-9, 9), st.integers(-2, 2), st.integers(1, 2))
def test_biquadratic_numbers_mean_what_they_were(a: int, b: int, c: int, shift: int, scale: int) -> None:
    y = fmpz_poly([-shift, scale])
    p = a * y**4 + b * y**2 + c
    for root in real_roots(p):
        text = format_number(root)
        if "root(" not in text:
            assert value(text) == pytest.approx(float(root), abs=1e-9)
            minimal = " + ".join(f"({c})*x^{k}" for k, c in enumerate(root.minimal_polynomial))
            assert qe.decide(f"ex x. x = {text} and {minimal} = 0")
        elif root.degree == 4:
            pytest.fail(f"{text} has degree 4 and is biquadratic")


@each(
    ([-1, 0, 0, -1, 0, 0, 1], ["-cbrt((-1 + sqrt(5))/2)", "cbrt((1 + sqrt(5))/2)"]),
    ([1, 0, 0, -3, 0, 0, 1], ["cbrt((3 - sqrt(5))/2)", "cbrt((3 + sqrt(5))/2)"]),
    ([-1, 0, 0, 0, -1, 0, 0, 0, 1], ["-((1 + sqrt(5))/2)^(1/4)", "((1 + sqrt(5))/2)^(1/4)"]),
    ([-5, 0, 0, 0, 1], ["-5^(1/4)", "5^(1/4)"]),
)
def test_roots_of_numbers_of_degree_two(coefficients: list[int], texts: list[str]) -> None:
    assert [radical_text(r) for r in sorted(real_roots(fmpz_poly(coefficients)))] == texts


@given(st.integers(2, 7), st.integers(-9, 9).filter(bool), st.integers(-9, 9), st.integers(1, 5))
def test_polynomials_of_degree_two_in_a_power_have_radicals(n: int, c: int, b: int, a: int) -> None:
    for root in real_roots(a * (power := fmpz_poly([0] * n + [1])) ** 2 + b * power + c):
        text = radical_text(root)
        assert "root(" not in text
        assert qe.find_instance(f"x = {text}")["x"] == root


@given(st.integers(-(10**30), 10**30))
def test_digits_are_those_of_str(value: int) -> None:
    assert digits(value) == str(value)


def test_digits_that_str_refuses() -> None:
    text = digits(-(10**5000) + 1)
    assert text == "-" + "9" * 5000


@each(
    ([], "0"),
    ([((), 7)], "7"),
    ([((), -1), (((0, 2),), 1), (((0, 1), (1, 1)), -2)], "x^2 - 2*x*y - 1"),
    ([(((1, 1),), -1), (((0, 1),), 3)], "3*x - y"),
    ([(((1, 3),), -1), (((0, 1),), 1)], "-y^3 + x"),
)
def test_polynomials_by_their_terms(terms: list[object], text: str) -> None:
    assert sparse_text(terms, ("x", "y")) == text  # type: ignore[arg-type]


def test_the_text_is_that_of_the_polynomial() -> None:
    ring = Ring.of(("x", "y", "z"))
    x, y, z = (ring.gen(i) for i in range(3))
    for p in (x**3 - 2 * x * y * z + z**2 - 1, -x * y**2 + z**3 * 5, y + z - x, ring.constant(-3)):
        terms = [(tuple((i, e) for i, e in enumerate(exponents) if e), c) for exponents, c in p.terms()]
        assert sparse_text(terms, ring.names) == format_poly(p)


def test_a_rational_number_is_a_fraction() -> None:
    three = simplest(RealAlgebraic.rational(3))
    assert three == 3 and isinstance(three, Fraction)
    root = RealAlgebraic.from_root([-2, 0, 1], 1, 2)
    assert simplest(root) is root
    assert simplest(Fraction(1, 3)) == Fraction(1, 3)


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
