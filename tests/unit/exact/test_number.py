"""Exact numbers as points hold them: square roots, and how points and optima are shown."""

from __future__ import annotations

from fractions import Fraction

import pytest
from flint import fmpz_poly

from qe.exact.algebraic import RealAlgebraic, real_roots
from qe.exact.number import optimum_in_latex, point_text, simplest, square_root
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
