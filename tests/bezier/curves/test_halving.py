"""Halving without division: the halves have the values of the whole, up to one positive factor."""

from __future__ import annotations

from fractions import Fraction
from math import comb

from hypothesis import given
from hypothesis import strategies as st

from bezier.curves.bernstein import exact, halves

PLACES = [Fraction(k, 4) for k in range(5)]


def value(b, t: Fraction) -> Fraction:
    n = len(b) - 1
    return sum((comb(n, k) * t**k * (1 - t) ** (n - k) * c for k, c in enumerate(b)), Fraction(0))


@given(st.lists(st.integers(-9, 9), min_size=1, max_size=6))
def test_integers_stay_integers(b: list[int]) -> None:
    left, right = halves(tuple(b))
    factor = 2 ** (len(b) - 1)
    assert all(isinstance(c, int) for c in left + right)
    for t in PLACES:
        assert value(left, t) == factor * value(b, t / 2)
        assert value(right, t) == factor * value(b, (1 + t) / 2)


@given(st.lists(st.fractions(-3, 3, max_denominator=5), min_size=1, max_size=5))
def test_fractions_are_split_as_they_are(b: list[Fraction]) -> None:
    left, right = halves(tuple(b))
    for t in PLACES:
        assert value(left, t) == value(b, t / 2) and value(right, t) == value(b, (1 + t) / 2)


def test_integers_ready_for_division() -> None:
    found = exact((1, Fraction(1, 2), -3))
    assert found == (1, Fraction(1, 2), -3) and all(isinstance(c, Fraction) for c in found)
