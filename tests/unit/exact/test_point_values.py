"""Roots above points, values there, and angles as intervals: against values that are known."""

import math
from fractions import Fraction

import pytest
from flint import arb
from hypothesis import given
from hypothesis import strategies as st

from qe.exact.algebraic import RealAlgebraic
from qe.exact.point_values import Ball, Evaluation, multiple_roots, pi_ends, roots_above, roots_between
from qe.exact.point_values import angle as angle_of
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from tests.strategies import polynomials
from tests.tables import each

RING = Ring.of(("a", "x"))
A, X = RING.gen(0), RING.gen(1)
ROOT2 = RealAlgebraic.from_root([-2, 0, 1], 1, 2)


def above(value: object, f: object) -> list[float] | None:
    found = roots_above(Point.of(RING, [value]), 1, f)  # type: ignore[arg-type, list-item]
    return None if found is None else [float(Point.of(RING, [value]).extend(r).number(1)) for r in found]  # type: ignore[list-item, arg-type]


def test_roots_above_a_point() -> None:
    assert above(Fraction(2), X**2 - A) == pytest.approx([-math.sqrt(2), math.sqrt(2)])
    assert above(ROOT2, (X - A) * (X + A) * (X - 1)) == pytest.approx([-math.sqrt(2), 1, math.sqrt(2)])
    assert above(Fraction(-1), X**2 - A) == []
    assert above(ROOT2, (A**2 - 2) * X + A**2 - 2) is None
    assert above(ROOT2, (A**2 - 2) * X**2 + X - A) == pytest.approx([math.sqrt(2)])  # the degree drops


@each(
    ((X - A) ** 2 * (X - 1), [False, True]),
    ((X - A) * (X - 1), [False, False]),
    ((X - A) ** 3 * (X - 1) ** 2, [True, True]),
    ((X**2 - 2) * (X - A), [False, True]),  # sqrt 2 is a root of both factors
    ((X**2 + 1) ** 2 * (X - A), [False]),
    (X**2 + 1, []),
)
def test_which_roots_are_multiple(f: object, multiple: list[bool]) -> None:
    roots = roots_above(Point.of(RING, [ROOT2]), 1, f)  # type: ignore[arg-type]
    assert roots is not None and multiple_roots(roots) == multiple


def test_roots_in_the_unit_interval() -> None:
    f = X * (X - 1) * (2 * X - 1) ** 2 * (X + 1) * (X - 2) * (2 * X**2 - 1)
    found = roots_between(f, 1)
    assert found[0] == 0 and found[1] == Fraction(1, 2) and found[3] == 1 and len(found) == 4
    assert all(isinstance(found[k], Fraction) for k in (0, 1, 3)) and isinstance(found[2], RealAlgebraic)
    assert float(found[2]) == pytest.approx(math.sqrt(0.5))


@given(st.integers(-3, 3), st.integers(-3, 3), st.fractions(-2, 2, max_denominator=5), st.sampled_from([20, 80]))
def test_quotients_at_a_point(k: int, m: int, scale: Fraction, bits: int) -> None:
    """(k*a + m)/(a^2 + 1) at sqrt 2, times a rational number."""
    low, high = Evaluation(Point.of(RING, [ROOT2])).quotient(k * A + m, A**2 + 1, scale, bits).ends
    assert high - low <= Fraction(1, 2**bits)
    a = Fraction(math.isqrt(2 * 10**80), 10**40)
    value = (k * a + m) / 3 * scale
    assert low - Fraction(1, 10**38) <= value <= high + Fraction(1, 10**38)


def test_coordinates_of_several_levels() -> None:
    point = Point.of(RING, [ROOT2])
    (root,) = [r for r in roots_above(point, 1, X**2 - A) or [] if float(point.extend(r).number(1)) > 0]
    low, high = Evaluation(point).extend(root).quotient(X + A, X, Fraction(1), 60).ends
    expected = 1 + math.sqrt(2) / 2**0.25
    assert float(low) == pytest.approx(expected) and float(high) == pytest.approx(expected)


@each(0, 0.3, math.pi / 2, 2, 3.1, -0.2, -1.6, -3.1)
def test_angles_in_all_quadrants(angle: float) -> None:
    found = angle_of(Ball(arb(math.cos(angle), 1e-12)), Ball(arb(math.sin(angle), 1e-12)), 60)
    low, high = found.ends
    assert float(found) == pytest.approx(angle)
    assert low <= Fraction(angle) <= high and high - low < Fraction(1, 10**10)


def test_the_angle_pi_and_pi_itself() -> None:
    low, high = angle_of(Ball(arb(-1)), Ball(arb(0, 1e-12)), 60).ends
    assert low < Fraction(314159265358979, 10**14) < high < 4
    low, high = pi_ends(100)
    assert low < Fraction(314159265358979323846264338327950288, 10**35) + Fraction(1, 10**28)
    assert high > Fraction(314159265358979323846264338327, 10**29) and high - low < Fraction(1, 2**90)


@given(polynomials(RING, max_degree=3), st.fractions(-3, 3, max_denominator=7))
def test_balls_contain_the_values_at_a_rational_point(p: Poly, x: Fraction) -> None:
    here = Evaluation(Point.of(RING, [x, x * x - 1]))
    low, high = here.quotient(p, RING.constant(3), Fraction(1, 2), 70).ends
    assert low <= p.evaluate([x, x * x - 1]) / 6 <= high


@given(polynomials(RING, max_degree=3))
def test_roots_over_one_point_share_what_lies_below(p: Poly) -> None:
    """At (sqrt 2, ± sqrt(2 + sqrt 2)): the two values add up to twice the part of even degree."""
    below = Evaluation(Point.of(RING, [ROOT2]))
    one, other = (
        below.extend(root).quotient(p, RING.constant(1), Fraction(1), 60).ends
        for root in roots_above(below.point, 1, X**2 - A - 2) or []
    )
    even = sum((c * (A + 2) ** (k // 2) for k, c in enumerate(p.coefficients(1)) if k % 2 == 0), RING.constant(0))
    low, high = below.quotient(2 * even, RING.constant(1), Fraction(1), 60).ends
    assert one[0] + other[0] <= high and low <= one[1] + other[1]
