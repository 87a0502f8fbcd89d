"""Balls contain what they are said to contain, and enclosures of roots hold exactly one root each."""

import random
from fractions import Fraction

import flint
import pytest

from qe.plain.balls import arb, arb_poly, ball, ctx
from qe.plain.numbers import fmpq
from qe.plain.roots import acb_poly
from qe.plain.univariate import fmpz_poly
from tests.tables import each


def ends(x: arb) -> tuple[Fraction, Fraction]:
    return x.mid().fmpq() - x.rad().fmpq(), x.mid().fmpq() + x.rad().fmpq()


def random_ball(rng: random.Random) -> arb:
    middle, radius = rng.randint(-(2**70), 2**70) >> rng.randint(0, 70), rng.choice((0, 0, 1, rng.randint(0, 2**40)))
    return ball(middle, radius, rng.randint(-80, 10))


def inside(rng: random.Random, x: arb) -> Fraction:
    low, high = ends(x)
    return rng.choice((low, high, low + (high - low) * Fraction(rng.randint(0, 99), 99)))


@each(8, 53, 200)
def test_operations_contain_the_results(bits: int) -> None:
    rng = random.Random(bits)
    with ctx.workprec(bits):
        for _ in range(400):
            x, y = random_ball(rng), random_ball(rng)
            p, q = inside(rng, x), inside(rng, y)
            results = [(x + y, p + q), (x - y, p - q), (x * y, p * q), (-x, -p), (x**3, p**3), (3 - x, 3 - p)]
            results += [] if y.contains(0) else [(x / y, p / q), (1 / y, 1 / q)]
            results += [(x.union(y), p), (x.union(y), q), (arb(fmpq(p.numerator, p.denominator)), p)]
            results += [(arb_poly([x, y, 2])(y), p + q * q + 2 * q * q)]
            if x.overlaps(y) and ends(y)[0] <= p <= ends(y)[1]:
                results.append((x.intersection(y), p))
            for found, exact in results:
                low, high = ends(found)
                assert low <= exact <= high
            assert (x < y) == (ends(x)[1] < ends(y)[0]) and (x > y) == (ends(x)[0] > ends(y)[1])
            assert x.overlaps(y) == (ends(x)[0] <= ends(y)[1] and ends(y)[0] <= ends(x)[1])
            assert x.contains(0) == (ends(x)[0] <= 0 <= ends(x)[1])


def test_errors_are_small() -> None:
    with ctx.workprec(64):
        third = arb(fmpq(1, 3))
        assert third.rel_accuracy_bits() >= 60 and (third * third / third - third).contains(0)
        assert (third * third / third).rel_accuracy_bits() >= 55
    assert arb(5).rel_accuracy_bits() > 10**9 and ball(0, 1, 0).rel_accuracy_bits() < 0


def test_division_by_a_ball_with_zero_and_an_empty_intersection_are_errors() -> None:
    with pytest.raises(ZeroDivisionError):
        arb(1) / ball(1, 1, 0)
    with pytest.raises(ValueError, match="empty"):
        arb(1).intersection(arb(2))


def test_quotients_of_polynomials() -> None:
    p, q = arb_poly([arb(1), arb(3), arb(2)]), arb_poly([arb(1), arb(1)])
    assert [c.fmpq() for c in (p // q).coeffs()] == [1, 2]


@pytest.mark.parametrize(
    "given",
    [[-2, 0, 1], [1, 0, 1], [1, 1], [6, -5, 1], [-1, 0, 0, 0, 0, 0, 0, 1], [1, -(10**30), 1], [10**40, 0, 0, 1]]
    + [[3, 1, -4, 1, 5, -9, 2, 6], [-(2**200), 0, 1], [1, 0, -(2**300)], [0, 0 - 6, 11, -6, 1]],
)
def test_roots_are_those_of_flint(given: list[int]) -> None:
    mine, theirs = acb_poly(fmpz_poly(given)).roots(2000), flint.acb_poly(flint.fmpz_poly(given)).roots(maxprec=2000)
    assert len(mine) == len(theirs) == len(given) - 1
    boxes = [(*_bounds(z.real.mid(), z.real.rad()), *_bounds(z.imag.mid(), z.imag.rad())) for z in theirs]
    for z in mine:
        (a, b), (c, d) = ends(z.real), ends(z.imag)
        assert sum(a <= h and g <= b and c <= j and i <= d for g, h, i, j in boxes) == 1
    assert sum(z.imag.contains(0) for z in mine) == sum(bool(z.imag.contains(0)) for z in theirs)


def _bounds(middle: flint.arb, radius: flint.arb) -> tuple[Fraction, Fraction]:
    m, r = (Fraction(int(x.fmpq().p), int(x.fmpq().q)) for x in (middle, radius))
    return m - r, m + r


def test_random_polynomials_have_their_real_roots_enclosed() -> None:
    rng = random.Random(6)
    for _ in range(60):
        given = [rng.randint(-99, 99) for _ in range(rng.randint(2, 9))] + [rng.randint(1, 9)]
        p = flint.fmpz_poly(given)
        if p.gcd(p.derivative()).degree() > 0:
            continue
        mine, theirs = acb_poly(fmpz_poly(given)).roots(4000), flint.acb_poly(p).roots(maxprec=4000)
        assert sum(z.imag.contains(0) for z in mine) == sum(bool(z.imag.contains(0)) for z in theirs), given


def test_inexact_coefficients_give_boxes_for_all_polynomials_they_hold() -> None:
    """x^2 - c for c between 2 - 2^-20 and 2 + 2^-20: the boxes hold the roots for both ends."""
    boxes = acb_poly(arb_poly([ball(-(2**21), 1, -20), arb(0), arb(1)])).roots(64)
    low, high = ends(max(boxes, key=lambda z: z.real.mid().fmpq()).real)
    assert low**2 <= 2 - Fraction(1, 2**20) and high**2 >= 2 + Fraction(1, 2**20)


@each([1, 2, 1], [0, 0, 1], [4, -4, -3, 2, 1])
def test_multiple_roots_are_given_up(given: list[int]) -> None:
    with pytest.raises(ValueError, match="converge"):
        acb_poly(fmpz_poly(given)).roots(20_000)


def test_a_leading_coefficient_that_may_be_zero_is_refused() -> None:
    with pytest.raises(ValueError, match="leading"):
        acb_poly(arb_poly([arb(1), ball(1, 1, 0)])).roots(64)
