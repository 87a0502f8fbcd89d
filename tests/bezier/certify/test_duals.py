"""Balls with derivatives: against values and difference quotients in floating point."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from flint import arb

from bezier.certify import duals
from bezier.certify.duals import Dual


def floats(d: Dual) -> tuple[float, ...]:
    return float(d.value), *map(float, d.slope)


def variables(*values: Fraction) -> list[Dual]:
    return [duals.seed(duals.ball(v), k, len(values)) for k, v in enumerate(values)]


def test_values_and_derivatives_of_sums_products_and_angles() -> None:
    x, y = variables(Fraction(1, 3), Fraction(2))
    assert floats(x * y + x) == pytest.approx((1, 3, 1 / 3))
    assert floats(x - y * y) == pytest.approx((1 / 3 - 4, 1, -4))
    sine, cosine = (x * y).sine_cosine()
    at = 2 / 3
    assert floats(sine) == pytest.approx((math.sin(at), 2 * math.cos(at), math.cos(at) / 3))
    assert floats(cosine) == pytest.approx((math.cos(at), -2 * math.sin(at), -math.sin(at) / 3))
    assert floats(duals.number(Fraction(5, 2), 2)) == (2.5, 0, 0)


@pytest.mark.parametrize("twelfths", [-6, 0, 4, 17])
def test_multiples_of_a_twelfth_of_pi(twelfths: int) -> None:
    sine, cosine = duals.multiple_of_pi(twelfths, 1)
    angle = twelfths * math.pi / 12
    assert floats(sine) == pytest.approx((math.sin(angle), 0), abs=1e-15)
    assert floats(cosine) == pytest.approx((math.cos(angle), 0), abs=1e-15)


def moved(motions: list[object], *point: int) -> list[float]:
    found = duals.image(motions, [duals.number(Fraction(v), 1) for v in point])  # type: ignore[arg-type]
    return [float(v.value) for v in found]


QUARTER = duals.multiple_of_pi(6, 1)


def test_motions_in_their_order() -> None:
    up = duals.shift("z", duals.number(Fraction(5), 1))
    assert moved([duals.turn("z", QUARTER)], 1, 2, 3) == pytest.approx([-2, 1, 3])
    assert moved([duals.turn("x", QUARTER)], 1, 2, 3) == pytest.approx([1, -3, 2])
    assert moved([duals.shift("x", duals.number(Fraction(5), 1))], 1, 2, 3) == pytest.approx([6, 2, 3])
    assert moved([duals.turn("x", QUARTER), up], 1, 2, 3) == pytest.approx([1, -8, 2])  # the last one first
    assert moved([up, duals.turn("x", QUARTER)], 1, 2, 3) == pytest.approx([1, -3, 7])
    both = [duals.turn("x", QUARTER), up, duals.turn("z", QUARTER)]
    assert moved([duals.together(both, 1)], 1, 2, 3) == pytest.approx(moved(both, 1, 2, 3))


RADII = [Fraction(1, 4), Fraction(1, 4), Fraction(1, 2)]


def system(half: Fraction, radii: list[Fraction], middle: Fraction) -> list[arb] | None:
    """Krawczyk's image for r1 = middle + sigma, r2 = r1^2, r3 = r1 + r2, for |sigma| <= half, around r = 0."""

    def f(sigma: arb, r: list[arb]) -> list[Dual]:
        s = duals.seed(sigma, 0, 4)
        x, y, z = (duals.seed(v, j + 1, 4) for j, v in enumerate(r))
        return [x - s - duals.number(middle, 4), y - x * x, z - x - y]

    zero = [duals.ball(Fraction(0))] * 3
    wide, box = duals.around(half), [duals.around(r) for r in radii]
    return duals.krawczyk(f(zero[0], zero), f(wide, zero), f(wide, box), wide, box)


def test_the_image_of_krawczyk_holds_the_solution_for_every_parameter() -> None:
    image = system(Fraction(1, 20), RADII, Fraction(1, 10))
    assert image is not None
    assert duals.strictly_within(image, RADII)
    for k in range(-4, 5):
        x = Fraction(1, 10) + Fraction(k, 80)
        for value, ball in zip((x, x * x, x + x * x), image, strict=True):
            assert ball.contains(duals.ball(value))
    far = system(Fraction(1, 20), RADII, Fraction(1))  # the solution lies outside the box
    assert far is not None
    assert not duals.strictly_within(far, RADII)


def test_a_singular_matrix_has_no_image() -> None:
    zero = [duals.seed(duals.ball(Fraction(0)), 0, 4)] * 3
    assert duals.krawczyk(zero, zero, zero, arb(0), [arb(0)] * 3) is None


def test_bounds_of_balls() -> None:
    ball = duals.ball(Fraction(1, 3)) + duals.around(Fraction(1, 3))
    assert Fraction(2, 3) <= duals.radius_above(ball) < Fraction(667, 1000)
    assert duals.radius_above(-ball) == duals.radius_above(ball)
    assert not duals.strictly_within([ball], [Fraction(2, 3)])
    assert duals.strictly_within([ball], [Fraction(667, 1000)])
    assert not duals.strictly_within([ball, arb("nan")], [Fraction(1)] * 2)
