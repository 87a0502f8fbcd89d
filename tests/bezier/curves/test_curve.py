"""Bézier curves: each law of the docstrings, transcribed."""

from fractions import Fraction
from math import comb

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bezier.curves import bernstein as bs
from bezier.curves.curve import Bezier, Smoothness, curvature_squared, join
from bezier.curves.scalar import add, dot, is_zero, same, scale, subtract
from qe.errors import InputError
from tests.bezier.numbers import control_points, points, small, surds, unit
from tests.tables import each

HALF = Fraction(1, 2)


def by_definition(control, t):
    """P(t) by the sum of the definition."""
    n = len(control) - 1
    weights = [comb(n, k) * t**k * (1 - t) ** (n - k) for k in range(n + 1)]
    terms = [[w * x for x in p] for w, p in zip(weights, control, strict=True)]
    return tuple(sum(column, Fraction(0)) for column in zip(*terms, strict=True))


@given(control_points(), unit)
def test_de_casteljau_is_the_definition(control, t):
    assert Bezier.of(control).point(t) == by_definition(control, t)


@given(control_points(1, 4, coordinate=surds), unit)
def test_de_casteljau_over_a_number_field(control, t):
    assert same(Bezier.of(control).point(t), by_definition(control, t))


@given(control_points(), unit, unit)
def test_subdivision_reparametrises(control, t, u):
    left, right = Bezier.of(control).split(t)
    assert left.point(u) == by_definition(control, t * u)
    assert right.point(u) == by_definition(control, t + (1 - t) * u)


@given(control_points(), st.tuples(unit, unit).filter(lambda p: p[0] != p[1]), unit)
def test_segment(control, ends, u):
    low, high = sorted(ends)
    assert Bezier.of(control).segment(low, high).point(u) == by_definition(control, low + (high - low) * u)


@given(control_points(), st.integers(0, 3), unit)
def test_elevation_keeps_the_curve(control, more, t):
    curve = Bezier.of(control)
    assert curve.elevate(curve.degree + more).point(t) == curve.point(t)


@given(control_points(2, 5), unit)
def test_hodograph_is_the_derivative(control, t):
    curve = Bezier.of(control)
    for i in range(3):
        power = bs.to_power(curve.coordinate(i))
        slope = bs.from_power(bs.power_derivative(power))
        assert curve.hodograph().point(t)[i] == bs.value(slope, t)


@given(control_points(1, 4), unit)
def test_norm_squared(control, t):
    curve = Bezier.of(control)
    assert bs.value(curve.norm_squared(), t) == dot(curve.point(t), curve.point(t))


@given(control_points(2, 4), unit)
def test_curvature_is_the_cross_product_formula(control, t):
    curve = Bezier.of(control)
    u, v = curve.derivative(1, t), curve.derivative(2, t)
    cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    expected = None if not dot(u, u) else dot(cross, cross) / dot(u, u) ** 3
    assert curvature_squared(curve).at(t) == expected


def test_curvature_of_a_parabola():
    # P(t) = (t, t^2): kappa = 2 / (1 + 4 t^2)^(3/2), so kappa^2 = 4 at the vertex and 4/125 at t = 1
    curve = Bezier.of([(0, 0), (HALF, 0), (1, 1)])
    assert curvature_squared(curve).at(Fraction(0)) == 4
    assert curvature_squared(curve).at(Fraction(1)) == Fraction(4, 125)


@given(control_points(1, 4), unit.filter(lambda t: 0 < t < 1))
def test_halves_of_a_curve_join_with_all_jumps_in_proportion(control, t):
    left, right = Bezier.of(control).split(t)
    meeting = join(left, right)
    assert meeting.smoothness >= Smoothness.C0
    if t == HALF:
        assert meeting.smoothness is Smoothness.C2


@given(points(), points(), points(), points())
def test_c1_exactly_when_the_middle_is_the_mean(p0, p1, corner, q2):
    q1 = subtract(scale(2, corner), p1)
    assert join(Bezier.of([p0, p1, corner]), Bezier.of([corner, q1, q2])).smoothness >= Smoothness.C1
    moved = add(q1, (Fraction(1, 10**9), 0, 0))
    broken = join(Bezier.of([p0, p1, corner]), Bezier.of([corner, moved, q2]))
    assert broken.smoothness is Smoothness.C0 and not is_zero(broken.jumps[1][0])


def test_gap_and_direction():
    a, b = Bezier.of([(0, 0), (1, 0)]), Bezier.of([(1, 0), (3, 0)])
    assert join(a, b).smoothness is Smoothness.C0 and join(a, b).same_direction
    assert join(a, Bezier.of([(1, 1), (2, 1)])).smoothness is Smoothness.GAP
    assert not join(a, Bezier.of([(1, 0), (0, 0)])).same_direction


@each([], [()], [(1, 2), (1, 2, 3)])
def test_no_curve(control):
    with pytest.raises(InputError):
        Bezier.of(control)


def test_elevation_cannot_lower():
    with pytest.raises(InputError):
        Bezier.of([(0,), (1,)]).elevate(0)


@given(st.lists(small, min_size=1, max_size=5), st.lists(small, min_size=1, max_size=5), unit)
def test_bernstein_products_and_sums(a, b, t):
    assert bs.value(bs.multiply(a, b), t) == bs.value(a, t) * bs.value(b, t)
    assert bs.value(bs.add(a, b), t) == bs.value(a, t) + bs.value(b, t)
    assert all(x == y for x, y in zip(bs.elevate(bs.from_power(bs.to_power(a)), len(a) - 1), a, strict=True))
