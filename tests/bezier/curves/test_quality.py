"""Length and curvature enclosures: closed forms, bounds from sampling, cusps and degenerate curves."""

from fractions import Fraction
from itertools import pairwise
from math import asinh, dist, sqrt

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bezier.curves.bernstein import elevate, multiply, value
from bezier.curves.curve import Bezier, curvature_squared
from bezier.curves.enclosure import (
    Enclosure,
    curvature_enclosure,
    is_regular,
    length_enclosure,
    maximum,
    root_above,
    root_below,
)
from bezier.curves.scalar import dot, subtract
from qe.errors import InputError
from qe.exact.field import NumberField
from tests.bezier.made import control_points

REL = Fraction(1, 10**6)
PARABOLA = Bezier.of([(-1, 1), (0, -1), (1, 1)])  # (u, u^2) for u from -1 to 1
CUSP = Bezier.of([(0, 0), (1, 1), (0, 1), (1, 0)])


def holds(enclosure: Enclosure, value: float, rel: float = 1e-9) -> bool:
    assert enclosure.high is not None
    return float(enclosure.low) <= value * (1 + rel) and value * (1 - rel) <= float(enclosure.high)


def test_length_of_a_line_and_of_a_parabola():
    assert holds(length_enclosure(Bezier.of([(1, 2, 3), (2, 4, 5)])), 3.0)
    assert holds(length_enclosure(PARABOLA), sqrt(5) + asinh(2) / 2)


def test_length_over_a_stop_counts_both_ways():
    back = length_enclosure(Bezier.of([(0, 0), (4, 0), (1, 0)]))  # to 16/7 and back to 1
    assert holds(back, 2 * 16 / 7 - 1)
    assert length_enclosure(Bezier.of([(1, 1)] * 4)) == Enclosure(Fraction(0), Fraction(0))


def test_length_where_the_stop_has_a_higher_order():
    half = Fraction(1, 2)
    fifth_power = Bezier(tuple(((-1) ** (5 - k) * half**5,) for k in range(6)))  # (t - 1/2)^5
    assert fifth_power.point(half) == (0,)
    assert holds(length_enclosure(fifth_power), 1 / 16)


def test_length_in_a_number_field():
    field = NumberField.from_root([-2, 0, 1], 1, 2)
    root = field.generator()
    assert holds(length_enclosure(Bezier(((root, root * 0), (root * 0, root)))), 2.0)


@settings(max_examples=25, deadline=None)
@given(control_points(1, 4, 3))
def test_length_lies_between_chords_and_polygons_whatever_the_degree(points):
    curve = Bezier.of(points)
    total = length_enclosure(curve, REL)
    assert total.high - total.low <= REL * total.high
    chords = polygons = 0.0
    for k in range(16):
        piece = curve.segment(Fraction(k, 16), Fraction(k + 1, 16))
        chords += distance(piece.points[0], piece.points[-1])
        polygons += sum(distance(a, b) for a, b in pairwise(piece.points))
    assert float(total.low) <= polygons + 1e-9 and chords <= float(total.high) + 1e-9
    raised = length_enclosure(curve.elevate(curve.degree + 1), REL)
    assert raised.low <= total.high and total.low <= raised.high


def distance(a, b) -> float:
    return float(dot(subtract(b, a), subtract(b, a))) ** 0.5


def test_curvature_of_a_parabola_and_of_a_line():
    assert holds(curvature_enclosure(PARABOLA), 2.0)
    assert curvature_enclosure(Bezier.of([(0, 0, 0), (1, 1, 1), (5, 5, 5)])) == Enclosure(Fraction(0), Fraction(0))


def test_curvature_at_a_cusp_is_unbounded():
    assert not is_regular(CUSP)
    assert not curvature_enclosure(CUSP).is_bounded
    assert curvature_enclosure(CUSP).to_json() == {"low": "0", "high": "inf"}


def test_curvature_is_bounded_where_a_parabola_is_run_through_to_its_top_and_back():
    u = (1, -1, 1)  # (2t - 1)^2 in Bernstein form
    there_and_back = Bezier(tuple(zip(elevate(u, 4), multiply(u, u), strict=True)))
    assert not is_regular(there_and_back)
    assert holds(curvature_enclosure(there_and_back), 2.0)


def test_a_point_has_no_curvature():
    with pytest.raises(InputError, match="one point"):
        curvature_enclosure(Bezier.of([(1, 2)] * 3))


@settings(max_examples=25, deadline=None)
@given(control_points(3, 4, 3))
def test_curvature_is_the_largest_value(points):
    curve = Bezier.of(points)
    if len(set(points)) == 1:
        return
    top = curvature_enclosure(curve, Fraction(1, 1000))
    if top.high is None:
        assert not is_regular(curve)
        return
    above, below = curvature_squared(curve)
    for t in (Fraction(k, 40) for k in range(41)):
        assert value(above, t) <= top.high**2 * value(below, t)
    assert top.high - top.low <= Fraction(1, 500) * top.high + Fraction(1, 2**180)


def test_maximum_is_attained_from_below():
    hill = (Fraction(0), Fraction(2), Fraction(0))  # 4 t (1 - t), at most 1
    top = maximum(hill, (Fraction(1),), REL)
    assert top.low <= 1 <= top.high <= 1 + REL


@given(st.fractions(min_value=0, max_value=100, max_denominator=1000))
def test_roots_are_bounded_from_both_sides(square):
    below, above = root_below(square), root_above(square)
    assert below**2 <= square <= above**2 and above - below <= Fraction(1, 2**192)
    assert root_below(square**2) == root_above(square**2) == square


def test_the_length_of_a_curve_of_high_degree():
    """Powers of wide balls would leave this one open: a wave of degree 16 against a fine polygon."""
    bends = Bezier(tuple((Fraction(i), Fraction(7 * (-1) ** i), Fraction(i * i, 9)) for i in range(17)))
    found = length_enclosure(bends)
    corners = [tuple(map(float, bends.point(Fraction(k, 400)))) for k in range(401)]
    polygon = sum(dist(a, b) for a, b in pairwise(corners))
    assert polygon - 1e-9 < float(found.low) and float(found.high) < polygon * 1.001
