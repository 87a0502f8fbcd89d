"""Real roots told apart by their number: very different sizes, very small distances, double roots."""

from __future__ import annotations

from flint import arb, fmpq, fmpq_poly, fmpz_poly
from hypothesis import given
from hypothesis import strategies as st

from qe.exact.algebraic import real_roots
from qe.exact.ball_roots import certified_roots
from qe.exact.balls import precision
from qe.exact.counted_roots import counted_roots
from tests.tables import each

WIDE = [fmpq(656, 10**359), fmpq(27), fmpq(162, 10**60), fmpq(243, 10**120)]
"""Roots of very different size: for FLINT's tolerance on the roots there is no precision."""


@each(64, 128, 1024)
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


@each([0, 1, -2, 1], [4, -4, 1, 0, 1], [1, 0, 2, 0, 1])
def test_counting_says_nothing_about_double_roots(coefficients: list[int]) -> None:
    with precision(272):
        found = counted_roots([arb(c) for c in coefficients], 256)
    assert found is None or len(found) == len(real_roots(fmpz_poly(coefficients)))


@each(fmpq(0), fmpq(1, 10**25), fmpq(-1, 10**25))
def test_balls_that_hold_a_polynomial_with_a_double_root_say_nothing(shift: fmpq) -> None:
    """(x - 1)^2 (x - 3) with a constant term that is known to 10^-20 only, whatever its midpoint."""
    with precision(272):
        c = [arb(x) for x in (fmpz_poly([1, -2, 1]) * fmpz_poly([-3, 1])).coeffs()]
        c[0] = arb((c[0].mid().fmpq() + shift), arb(10) ** -20)
        assert counted_roots(c, 256) is None
