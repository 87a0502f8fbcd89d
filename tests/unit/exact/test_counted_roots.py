"""Real roots told apart by the sign of the discriminant's ball, for polynomials with balls as coefficients."""

import random

from flint import arb, fmpq, fmpq_poly
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.exact.balls import precision
from qe.exact.counted_roots import counted_roots
from tests.tables import each

BITS = 256


def balls(roots: list[fmpq], radius: arb, rng: random.Random) -> list[arb]:
    """The coefficients of the polynomial with these roots, each in a ball beside whose middle it lies."""
    poly = fmpq_poly([1])
    for root in roots:
        poly *= fmpq_poly([-root, 1])
    off = [arb(fmpq(rng.randint(-9, 9), 10)) * radius for _ in roots]
    return [*((arb(c) + d).mid() + arb(0, radius) for c, d in zip(poly.coeffs(), off, strict=False)), arb(1)]


@each([0, 1, -1, fmpq(1, 2)], [0, fmpq(1, 10**9)], [fmpq(-1, 3), 0, fmpq(1, 7), 5, 6])
def test_a_root_that_is_zero_is_told_apart(roots: list[fmpq]) -> None:
    """Its interval for the middle of the balls is narrower than they are: precision was doubled for ever."""
    with precision(BITS):
        told = counted_roots(balls([fmpq(r) for r in roots], arb(2) ** -200, random.Random(1)), BITS)
        assert told is not None and len(told) == len(roots)
        for ball, root in zip(told, sorted(map(fmpq, roots)), strict=True):
            assert ball.contains(arb(root)) and ball.rad() < arb(2) ** -90


@settings(deadline=None, max_examples=60)
@given(st.integers(0, 10**9))
def test_each_ball_has_its_root(seed: int) -> None:
    rng = random.Random(seed)
    roots = sorted({fmpq(rng.randint(-20, 20), rng.choice((1, 2, 3, 10**6))) for _ in range(rng.randint(1, 7))})
    with precision(BITS):
        told = counted_roots(balls(roots, arb(2) ** -rng.randint(60, 200), rng), BITS)
        if told is not None:
            assert len(told) == len(roots)
            assert all(ball.contains(arb(root)) for ball, root in zip(told, roots, strict=True))
