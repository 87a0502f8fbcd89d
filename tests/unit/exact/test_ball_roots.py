"""Real roots of polynomials with ball coefficients: each ball holds one root, or nothing is said."""

from __future__ import annotations

from itertools import pairwise

import pytest
from flint import arb, fmpq, fmpq_poly, fmpz_poly
from hypothesis import given
from hypothesis import strategies as st

from qe.exact.algebraic import real_roots
from qe.exact.ball_roots import certified_roots, quadratic_roots
from qe.exact.balls import precision

BITS = 128


def balls(coefficients: list[int]) -> list[arb]:
    return [arb(c) for c in coefficients]


@given(st.lists(st.integers(-9, 9), min_size=3, max_size=3).filter(lambda c: c[2]))
def test_a_quadratic_has_its_roots_in_order(coefficients: list[int]) -> None:
    c, b, a = coefficients
    with precision(BITS):
        found = quadratic_roots(balls(coefficients))
        discriminant = b * b - 4 * a * c
        if discriminant == 0:
            assert found is None  # a double root is not told from two or none
            return
        assert found is not None
        assert len(found) == (2 if discriminant > 0 else 0)
        for ball, root in zip(found, sorted(real_roots(fmpz_poly(coefficients))), strict=True):
            assert ball.overlaps(root.ball(BITS))
            assert float(ball.rad()) < 1e-30
        assert all(x < y for x, y in pairwise(found))


@given(st.sets(st.fractions(-4, 4, max_denominator=5), min_size=1, max_size=4), st.booleans())
def test_isolated_roots_are_real_ones(roots: set[object], more: bool) -> None:
    p = fmpz_poly([2, 1, 1]) if more else fmpz_poly([3])  # a factor without real roots
    for root in roots:
        p *= fmpz_poly([-root.numerator, root.denominator])  # type: ignore[attr-defined]
    with precision(BITS):
        found = certified_roots([arb(c) for c in p.coeffs()], BITS)
        assert found is not None and len(found) == len(roots)
        for ball, root in zip(found, sorted(roots), strict=True):  # type: ignore[type-var]
            assert ball.contains(arb(fmpq(root.numerator, root.denominator)))  # type: ignore[attr-defined]


def test_what_balls_do_not_tell() -> None:
    with precision(BITS):
        assert quadratic_roots([arb(0, 1e-9), arb(0), arb(1)]) is None  # x^2 + about 0
        assert certified_roots(balls([1, -2, 1]), BITS) is None  # (x - 1)^2
        wide = [arb(-2, 0.5), arb(0), arb(1)]
        found = quadratic_roots(wide)
        assert found is not None
        assert all(ball.contains(root) for ball, root in zip(found, (-arb(2).sqrt(), arb(2).sqrt()), strict=True))


@pytest.mark.parametrize("coefficients", [[-1, 10**30, 1], [-1, -(10**30), 1], [1, 10**30, -1], [1, -(10**30), -1]])
def test_a_small_root_beside_a_huge_one_keeps_its_digits(coefficients: list[int]) -> None:
    """The textbook formula would lose it by cancellation."""
    with precision(BITS):
        found = quadratic_roots(balls(coefficients))
        assert found is not None
        small = min(found, key=lambda ball: abs(float(ball)))
        assert float(small.rad()) < abs(float(small)) * 1e-30
        root = min(real_roots(fmpz_poly(coefficients)), key=lambda r: abs(float(r)))
        assert small.overlaps(root.ball(4 * BITS))


WIDE = [fmpq(656, 10**359), fmpq(27), fmpq(162, 10**60), fmpq(243, 10**120)]
"""Roots of very different size: for FLINT's tolerance on the roots there is no precision."""


@pytest.mark.parametrize("bits", [64, 128, 1024])
def test_roots_of_very_different_sizes_are_found_at_each_precision(bits: int) -> None:
    with precision(bits + 16):
        found = certified_roots([arb(c) for c in WIDE], bits)
        assert found is None or len(found) in (1, 3)


@given(st.integers(20, 60), st.integers(-3, 3), st.sampled_from([-1, 1]), st.integers(-30, 30))
def test_roots_much_closer_than_they_are_large(size: int, root: int, sign: int, scale: int) -> None:
    """((x - c)^2 -+ 10^-2k)(x - r), with x as a multiple of a power of ten: three real roots or one."""
    close = fmpq_poly([fmpq(49), -14, 1]) - fmpq(sign, 10 ** (2 * size))
    p = close * fmpq_poly([-root, 1])
    unit = fmpq(10) ** scale
    coefficients = [c * unit**k for k, c in enumerate(p.coeffs())]
    expected = sorted(real_roots(fmpq_poly(coefficients).numer()))
    assert len(expected) == (3 if sign > 0 else 1)
    for bits in (128, 256, 512):
        with precision(bits + 16):
            found = certified_roots([arb(c) for c in coefficients], bits)
        assert found is None or len(found) == len(expected)
        if found is not None:
            assert all(ball.overlaps(x.ball(bits)) for ball, x in zip(found, expected, strict=True))
    assert found is not None


@pytest.mark.parametrize("coefficients", [[0, 1, -2, 1], [4, -4, 1, 0, 1], [1, 0, 2, 0, 1]])
def test_counting_says_nothing_about_double_roots(coefficients: list[int]) -> None:
    with precision(272):
        found = certified_roots(balls(coefficients), 256)
    assert found is None or len(found) == len(real_roots(fmpz_poly(coefficients)))


@pytest.mark.parametrize("shift", [fmpq(0), fmpq(1, 10**25), fmpq(-1, 10**25)])
def test_balls_that_hold_a_polynomial_with_a_double_root_say_nothing(shift: fmpq) -> None:
    """(x - 1)^2 (x - 3) with a constant term that is known to 10^-20 only, whatever its midpoint."""
    with precision(272):
        c = [arb(x) for x in (fmpz_poly([1, -2, 1]) * fmpz_poly([-3, 1])).coeffs()]
        c[0] = arb((c[0].mid().fmpq() + shift), arb(10) ** -20)
        assert certified_roots(c, 256) is None
