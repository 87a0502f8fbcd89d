"""Rational points beside algebraic ones."""

from __future__ import annotations

from fractions import Fraction as F

import pytest

from qe.errors import Unable
from qe.exact.algebraic import RealAlgebraic
from qe.exact.nearby import approximation, nearby, rational_between
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from tests.tables import each

PLANE = Ring.of(("x", "y"))
X, Y = PLANE.gen(0), PLANE.gen(1)
SQRT2 = RealAlgebraic.from_root((-2, 0, 1), 1, 2)


def signs(polys: list[Poly], values: tuple[F, ...]) -> list[int]:
    return [(v > 0) - (v < 0) for v in (p.evaluate(values) for p in polys)]


def test_off_the_zeros_signs_stay() -> None:
    point = Point.of(PLANE, [SQRT2, F(1, 3)])
    polys = [10**12 * (X * X - 2) + Y, X - Y, 7 * X - 10 + Y * Y]
    found = nearby(point, polys, frozenset(), None)
    assert signs(polys, found) == [point.sign(p) for p in polys]


def test_from_a_zero_into_the_direction_of_the_centre() -> None:
    point = Point.of(PLANE, [SQRT2, SQRT2])
    circle, line = X * X + Y * Y - 4, X - Y
    inwards = nearby(point, [circle, line + 1], frozenset((circle,)), (F(0), F(0)))
    assert signs([circle, line + 1], inwards) == [-1, 1]
    outwards = nearby(point, [circle], frozenset((circle,)), (F(3), F(3)))
    assert signs([circle], outwards) == [1]


def test_tangential_and_singular_beginnings() -> None:
    cusp = Y * Y - X * X * X
    point = Point.of(PLANE, [0, 0])
    assert signs([cusp], nearby(point, [cusp], frozenset((cusp,)), (F(1), F(0)))) == [-1]
    assert signs([cusp], nearby(point, [cusp], frozenset((cusp,)), (F(0), F(1)))) == [1]
    with pytest.raises(Unable):
        nearby(point, [X - Y], frozenset((X - Y,)), (F(1), F(1)))


@each((SQRT2, F(3, 2)), (F(7, 5), SQRT2), (None, SQRT2), (SQRT2, None), (-SQRT2, SQRT2), (None, None))
def test_rational_between(low: object, high: object) -> None:
    found = rational_between(low, high)  # type: ignore[arg-type]
    assert isinstance(found, F)
    assert low is None or low < found
    assert high is None or found < high


def test_rational_between_is_simple() -> None:
    assert rational_between(RealAlgebraic.from_root((11, -8, 1), 1, 2), RealAlgebraic.from_root((-5, 0, 1), 2, 3)) == 2
    assert rational_between(F(5), None) > 5 and rational_between(None, F(-5)) < -5


def test_approximation() -> None:
    x, y = approximation(Point.of(PLANE, [SQRT2, F(1, 3)]))
    assert abs(x * x - 2) < F(1, 10**7) and abs(y - F(1, 3)) < F(1, 10**7)
