"""The least speed of a curve: enclosed where it is positive, located where it is zero."""

from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from bezier.curves.curve import Bezier
from bezier.curves.scalar import dot
from bezier.paths.path import slowest
from tests.bezier.numbers import control_points, unit


@given(control_points(2, 5), unit, st.sampled_from([Fraction(1), Fraction(1, 3)]))
def test_no_parameter_is_slower(points, t, duration):
    curve = Bezier.of(points)
    found = slowest(curve, duration)
    velocity = curve.derivative(1, t)
    speed_squared = dot(velocity, velocity) / duration**2
    assert speed_squared >= found.least.low**2
    if found.stops:
        assert found.least.low == found.least.high == 0
    else:
        assert found.least.low > 0 and found.least.high - found.least.low <= found.least.high / 1000


def test_the_least_speed_is_reached():
    curve = Bezier.of([(0, 0, 0), (1, 0, 0), (1, 1, 0)])  # P' = (2 - 2t, 2t, 0), slowest at t = 1/2 with sqrt(2)
    least = slowest(curve).least
    assert least.low**2 <= 2 <= least.high**2


def test_stops():
    there_and_back = Bezier.of([(0, 0, 0), (1, 1, 1), (0, 0, 0)])
    assert slowest(there_and_back).stops == ((Fraction(1, 2), Fraction(1, 2)),)
    cusp_at_the_end = Bezier.of([(0, 0, 0), (1, 0, 0), (2, 3, 4), (2, 3, 4)])
    assert slowest(cusp_at_the_end).stops == ((1, 1),)
    assert slowest(Bezier.of([(1, 2, 3), (1, 2, 3)])).stops == ((0, 1),)
