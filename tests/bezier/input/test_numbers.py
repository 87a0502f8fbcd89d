"""Radii: what is printed can be read back."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bezier.curves.workspace import root_text
from bezier.input.numbers import NotANumber, describe, read_squared
from tests.tables import each


@given(st.fractions(0, 10**6, max_denominator=10**6))
def test_a_radius_is_read_as_it_is_printed(square):
    assert read_squared(root_text(square)) == square


@each((" 3/2 * sqrt( 2 ) / 3 ", Fraction(1, 2)), ("sqrt(27/4)", Fraction(27, 4)), ("1.5", Fraction(9, 4)))
def test_other_spellings(text, square):
    assert read_squared(text) == square


@each(
    "sqrt(-1)",
    "-2*sqrt(3)",
    "sqrt(3)/0",
    "sqrt(3)/-2",
    "2*3*sqrt(5)",
    "sqrt(2)*3",
    "sqrt(sqrt(2))",
    "sqrt()",
    "*sqrt(2)",
)
def test_what_is_no_radius(text):
    with pytest.raises(NotANumber):
        read_squared(text)


def test_articles():
    assert describe(object()) == "an object" and describe(b"") == "a bytes"
