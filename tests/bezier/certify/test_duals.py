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


def fixed(rows: list[list[int]], shift: list[int]) -> tuple[list[list[arb]], list[arb]]:
    return [[arb(v) for v in row] for row in rows], [arb(v) for v in shift]


STILL = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
ABOUT_X = fixed([[1, 0, 0], [0, 0, -1], [0, 1, 0]], [0, 0, 5])


def test_motions_in_their_order() -> None:
    point = [duals.number(Fraction(v), 1) for v in (1, 2, 3)]
    turn = duals.seed(arb.pi() / 2, 0, 1)
    turned = duals.joint_moved(turn, True, point)
    assert [float(c.value) for c in turned] == pytest.approx([-2, 1, 3])
    assert [float(c.slope[0]) for c in turned] == pytest.approx([-1, -2, 0])
    slid = duals.joint_moved(duals.seed(arb(5), 0, 1), False, point)
    assert [float(c.value) for c in slid] == [1, 2, 8] and [float(c.slope[0]) for c in slid] == [0, 0, 1]
    assert [float(c.value) for c in duals.moved(ABOUT_X, point)] == [1, -3, 7]
    assert [float(c.value) for c in duals.moved(fixed(STILL, [1, 0, 0]), slid)] == [2, 2, 8]
    assert [float(c.slope[0]) for c in duals.moved(ABOUT_X, turned)] == pytest.approx([-1, 0, -2])


def test_sums_of_square_roots() -> None:
    terms = ((1, Fraction(1, 2)), (2, Fraction(-3)))
    assert float(duals.root_sum(terms, 1).value) == pytest.approx(0.5 - 3 * 2**0.5)
    assert duals.root_ball(()).contains(0)


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
