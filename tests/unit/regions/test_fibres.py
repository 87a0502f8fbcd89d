"""Fibres of regions: what is left for the next variable."""

from __future__ import annotations

from fractions import Fraction as F

import pytest

import qe
from qe.decomposition.interval import Interval
from qe.errors import InputError
from qe.exact.algebraic import RealAlgebraic

SQRT2 = RealAlgebraic.from_root((-2, 0, 1), 1, 2)
ANNULUS = "x^2 + y^2 <= 4 and x^2 + y^2 > 1"


def test_fibres_of_an_annulus() -> None:
    region = qe.region(ANNULUS)
    assert region.fibre() == [Interval(F(-2), F(2), True, True)]
    low, high = region.fibre([0])
    assert low == Interval(F(-2), F(-1), True, False) and high == Interval(F(1), F(2), False, True)
    (whole,) = region.fibre({"x": F(3, 2)})
    assert whole.lower == -whole.upper and whole.lower_closed and whole.upper_closed
    assert whole.upper * whole.upper == F(7, 4)


def test_fibres_at_the_rim_and_beyond() -> None:
    region = qe.region(ANNULUS)
    assert region.fibre([2]) == [Interval(F(0), F(0), True, True)]
    assert region.fibre([3]) == []
    low, high = region.fibre([1])
    assert (low.upper, low.upper_closed, high.lower, high.lower_closed) == (0, False, 0, False)
    assert high.upper == -low.lower and high.upper * high.upper == 3


def test_algebraic_prefix() -> None:
    (found,) = qe.region(ANNULUS).fibre([SQRT2])
    assert found == Interval(-SQRT2, SQRT2, True, True)


def test_isolated_points_and_rays() -> None:
    region = qe.region("(y^2 = x or y = 5) and (x <= 1 or x = 4)", order=("x", "y"))
    assert region.fibre() == [Interval(None, F(1), False, True), Interval(F(4), F(4), True, True)]
    assert region.fibre([4]) == [Interval(F(v), F(v), True, True) for v in (-2, 2, 5)]
    assert region.fibre([-3]) == [Interval(F(5), F(5), True, True)]
    assert region.fibre([2]) == []


def test_undecomposed_directions() -> None:
    region = qe.region("x > 0", order=("x", "y"))
    assert region.fibre() == [Interval(F(0), None, False, False)]
    assert region.fibre([1]) == [Interval(None, None, False, False)]
    assert region.fibre([0]) == []


def test_three_variables_walk_to_a_point() -> None:
    region = qe.region("x^2 + y^2 + z^2 <= 3 and x*y*z >= 1")
    point: list[object] = []
    for _ in region.order:
        intervals = region.fibre(point)  # type: ignore[arg-type]
        point.append(intervals[0].simplest())
    assert region.contains(dict(zip(region.order, point, strict=True)))  # type: ignore[arg-type]


def test_prefix_must_name_the_first_variables() -> None:
    region = qe.region(ANNULUS)
    for wrong in ({"y": 1}, {"x": 0, "y": 1}, [1, 2], {"x": "one"}, [1, 2, 3]):
        with pytest.raises(InputError):
            region.fibre(wrong)  # type: ignore[arg-type]


def test_membership_in_intervals() -> None:
    interval = Interval(F(0), SQRT2, False, True)
    assert SQRT2 in interval and F(1) in interval and F(0) not in interval and F(3, 2) not in interval
    assert F(-5) in Interval(None, F(0), False, False)
