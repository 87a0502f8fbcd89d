"""Arithmetic on terms: exact values, bounds of the coefficients that hold, and growth refused before it happens."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.exact.ring import Ring
from qe.io import terms
from qe.io.terms import MAX_DEGREE, MAX_DIGITS, MAX_EXPONENT, TermError, Value, decimal, integer
from tests.strategies import polynomials
from tests.tables import each

RING = Ring.of(("x", "y"))
X, Y = terms.variable(RING, "x"), terms.variable(RING, "y")
VALUES = st.builds(lambda p, den: Value(p, den, p.height_bits()), polynomials(RING), st.integers(1, 6))
POINT = (Fraction(2, 3), Fraction(-5, 7))


def at(value: Value) -> Fraction:
    return value.poly.evaluate(POINT) / value.den


def bounded(value: Value) -> bool:
    """Whether the bound on the coefficients holds, and the denominator is positive."""
    return value.poly.height_bits() <= value.bits and value.den > 0


@each(
    ("12", Fraction(12)),
    ("1.25", Fraction(5, 4)),
    (".5", Fraction(1, 2)),
    ("3.", Fraction(3)),
    ("1.5e-3", Fraction(3, 2000)),
    ("2E2", Fraction(200)),
    ("0.0e10000", Fraction(0)),
    ("1e-10000", Fraction(1, 10**10000)),
)
def test_decimals_are_exact(text: str, value: Fraction) -> None:
    assert decimal(text) == value


@each("1e10001", "1e-10001", "1e99999999", "1e999999999999999999")
def test_large_exponents_are_refused_unread(text: str) -> None:
    with pytest.raises(TermError, match="exponent of the number"):
        decimal(text)


@each(1, 3999, 4000, 4001, 7999, 8000, 8001, 12_345)
def test_long_integers(digits: int) -> None:
    """Built from a remainder: the text of the value would ask for what is tested."""
    text = ("1234567890" * (digits // 10 + 1))[:digits]
    value = integer(text)
    assert value % 10**9 == int(text[-9:]) and value // 10 ** max(digits - 9, 0) == int(text[:9])
    assert value % 999_983 == sum(int(c) * pow(10, k, 999_983) for k, c in enumerate(reversed(text))) % 999_983


def test_more_digits_than_the_limit_are_refused() -> None:
    assert integer("0" * (MAX_DIGITS - 1) + "7") == 7
    with pytest.raises(TermError, match="1000001 digits"):
        integer("0" * MAX_DIGITS + "7")


@given(VALUES, VALUES, VALUES)
def test_sums_and_products_have_their_values(a: Value, b: Value, c: Value) -> None:
    whole = terms.total([a, b, c])
    assert at(whole) == at(a) + at(b) + at(c) and bounded(whole)
    product = terms.product(a, b)
    assert at(product) == at(a) * at(b) and bounded(product)
    assert at(terms.negative(a)) == -at(a) and bounded(terms.negative(a))


@given(VALUES, st.integers(0, 5))
def test_powers_have_their_values(a: Value, k: int) -> None:
    power = terms.power(a, k)
    assert at(power) == at(a) ** k and bounded(power)


def test_a_bound_counts_the_carries_of_sums() -> None:
    """Four times a number of the same length takes two bits more, denominators some more."""
    value = terms.number(RING, 2**64 - 1)
    assert terms.total([value] * 4).bits >= 66
    thirds = terms.total([terms.number(RING, Fraction(2**64 + 1, 3)), terms.number(RING, Fraction(2**64 + 1, 5))])
    assert bounded(thirds) and thirds.den == 15


@each((MAX_EXPONENT + 1, "exponent 10001"), (10**30, "an exponent is above"))
def test_exponents_out_of_range(exponent: int, said: str) -> None:
    with pytest.raises(TermError, match=said):
        terms.power(X, exponent)


def test_the_degree_is_bounded_but_may_be_reached() -> None:
    top = terms.power(X, MAX_DEGREE)
    assert top.poly.total_degree == MAX_DEGREE
    with pytest.raises(TermError, match="degree 10001"):
        terms.product(top, Y)
    with pytest.raises(TermError, match="degree 20000"):
        terms.power(terms.product(X, Y), MAX_EXPONENT)


def test_expansions_that_are_too_large_are_refused() -> None:
    """Fifteen variables: (x1 + … + x15)^9 has binomial(23, 9) = 817190 monomials, the tenth power has 1961256."""
    names = tuple(f"x{k}" for k in range(15))
    ring = Ring.of(names)
    some = terms.total([terms.variable(ring, name) for name in names])
    with pytest.raises(TermError, match="more than a million monomials"):
        terms.power(some, 10)
    with pytest.raises(TermError, match="too much memory"):
        terms.power(terms.total([X, Y, terms.number(RING, 10**300)]), 700)
    with pytest.raises(TermError, match="power is too large"):
        terms.power(terms.number(RING, Fraction(1, 2**30000)), 10_000)


def test_dense_powers_within_the_limit_are_computed() -> None:
    """Counted by degrees, not by the multinomial bound: a power of one variable has few monomials."""
    one = terms.total([terms.power(X, k) for k in range(12)])
    assert terms.power(one, 20).poly.term_count() == 221


def test_products_of_many_monomials_are_refused_unexpanded() -> None:
    ring = Ring.of(tuple(f"x{k}" for k in range(8)))
    some = terms.total([terms.variable(ring, name) for name in ring.names])
    big = terms.power(some, 7)  # 3432 monomials; the product has at most 11.8 million
    assert big.poly.term_count() == 3432
    with pytest.raises(TermError, match="million monomials"):
        terms.product(big, big)
