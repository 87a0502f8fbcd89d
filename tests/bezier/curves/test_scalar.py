"""Numbers for people: the decimal first, the exact text where it says more and is short."""

from fractions import Fraction

from bezier.curves.scalar import brief, with_decimal
from tests.tables import each


@each(
    (Fraction(3), "3"),
    (Fraction(7, 10), "0.7"),
    (Fraction(-3, 2), "-1.5"),
    (Fraction(1, 3), "0.33333333 (exactly 1/3)"),
    (Fraction(1, 3**100), "about 1.9403252e-48"),
    (Fraction(1, 2**40), "9.094947e-13 (exactly 1/1099511627776)"),
)
def test_numbers_in_words(value, text):
    assert brief(value) == text


def test_roots_in_words():
    assert with_decimal("sqrt(14)", "3.74166") == "3.74166 (exactly sqrt(14))"
    assert with_decimal("sqrt(89)/2", "4.71699") == "4.71699 (exactly sqrt(89)/2)"
    assert with_decimal("6", "6") == "6"
