"""Balls with derivatives: against values and difference quotients in floating point."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from flint import arb

from bezier.certify import duals, motions
from bezier.certify.duals import Dual
from bezier.certify.square_roots import ONE, ZERO, Surd


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


def test_motions() -> None:
    x, y, z = variables(Fraction(1), Fraction(2), Fraction(3))
    half = motions.turn((1, 2), (Surd.of([(3, Fraction(1, 2))]), Surd.rational(Fraction(1, 2))), (ONE, ZERO, ZERO))
    root = math.sqrt(3) / 2
    found = [floats(v) for v in duals.rigid(half)([x, y, z])]
    expected = [(2, 1, 0, 0), (2 * root - 1.5, 0, root, -0.5), (1 + 3 * root, 0, 0.5, root)]
    assert [v for row in found for v in row] == pytest.approx([v for row in expected for v in row])
    assert [floats(v) for v in duals.moved(False, x, [x, y, z])] == [floats(x), floats(y), floats(z + x)]
    turned = [floats(v)[0] for v in duals.moved(True, x, [x, y, z])]
    c, s = math.cos(1), math.sin(1)
    assert turned == pytest.approx([c - 2 * s, s + 2 * c, 3])
    assert [floats(-v)[0] for v in (x, y)] == [-1, -2] and floats(-x)[1:] == (-1, 0, 0)


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
