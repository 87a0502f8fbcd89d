"""Texts of large integers, of polynomials by their terms, and numbers in their simplest form."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from qe.exact.algebraic import RealAlgebraic
from qe.exact.digits import digits
from qe.exact.number import simplest
from qe.exact.ring import Ring, format_poly
from qe.exact.sparse_text import sparse_text
from tests.tables import each


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
