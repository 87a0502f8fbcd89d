"""Regions as users meet them: degenerate sets, exact bounds, volume, JSON, certificates."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest

import qe
from qe.regions.region import Region
from tests.tables import each

THREE = "x^2+y^2+z^2 <= 27 and (x+2)^2+(y-6)^2+(z-6)^2 <= 27 and (x-2)^2+(y-6)^2+(z-6)^2 <= 27"


@each(
    ("x^2+y^2+z^2 <= 1 and (x-2)^2+y^2+z^2 <= 1", 0, {"x": 1, "y": 0, "z": 0}),
    ("x^2+y^2+z^2 <= 1 and x^2+y^2+z^2 <= 1", 3, {"x": 0, "y": 0, "z": 0}),
    (
        "x^2+y^2+z^2 = 1 and (x-1)^2+y^2+z^2 = 1",
        1,
        {"x": "1/2", "y": 0, "z": qe.RealAlgebraic.from_root([-3, 0, 4], 0, 1)},
    ),
    ("x^2+y^2 <= 1 and x > 1", -1, None),
    ("x^2+y^2 = 1 and y = x", 0, None),
    ("x^2+y^2 = 1", 1, {"x": "3/5", "y": "4/5"}),
    ("x^2+y^2 < 1", 2, {"x": "0.5", "y": 0}),
    ("x = 1 and y > 0", 1, {"x": 1, "y": 3}),
)
def test_degenerate_sets(text: str, dimension: int, inside: dict | None) -> None:
    region = qe.region(text)
    assert region.dimension == dimension
    assert region.is_empty == (dimension < 0)
    assert qe.verify(region.certificate).accepted
    if inside is not None:
        assert region.contains(inside)
    assert all(region.contains(p) for p in region.sample_points())
    assert max((piece.dimension for piece in region.cells), default=-1) == dimension


def test_three_balls_are_two_pieces_with_radical_bounds() -> None:
    region = qe.region(THREE)
    assert len(region.cells) == 2
    assert str(region.bounds("x").upper) == "(-19 + 12*sqrt(19))/19"
    assert region.bounds("x").upper_closed
    again = Region.from_json(region.to_json())
    assert again.table == region.table
    assert qe.verify(again.certificate).accepted


@each(
    ("x^2 <= 2", 2 * math.sqrt(2), 0.001),
    ("x^2+y^2 <= 4", 4 * math.pi, 0.001),
    ("x^2+y^2+z^2 <= 4", 32 * math.pi / 3, 0.02),
    ("x^2+2*y^2+3*z^2+x*y <= 1", 4 * math.pi / 3 / math.sqrt(21 / 4), 0.03),  # an ellipsoid, not axis-parallel
    ("x^2+y^2+z^2 <= 1 and (x-1)^2+y^2+z^2 <= 1", 5 * math.pi / 12, 0.1),  # a lens
    ("x^2+y^2+z^2 <= 1 and z >= y", 2 * math.pi / 3, 0.1),
    ("0 <= x and x <= 1 and 0 <= y and y <= x and 0 <= z and z <= x*y", 1 / 8, 0.1),
    ("0 <= x and x <= 1 and 0 <= y and y <= x", 0.5, 0.01),
    ("x^2+y^2 = 1", 0.0, 0.01),
    ("x^4+y^4 <= 1", 3.7081493546, 0.02),
)
def test_volume_is_enclosed(text: str, value: float, error: float) -> None:
    low, high = qe.region(text).volume(error)
    assert low <= value * (1 + 1e-15) and value * (1 - 1e-15) <= high  # enclosures may be closer than a float
    assert high - low <= Fraction(error) * high


def test_bounds_of_open_and_unbounded_sets() -> None:
    region = qe.region("x > 1 and x*y >= 1")
    bounds = region.bounds("x")
    assert (bounds.lower, bounds.upper, bounds.lower_closed) == (1, None, False)
    assert (region.bounds("y").lower, region.bounds("y").upper) == (0, None)
    with pytest.raises(qe.Unable, match="unbounded in"):
        region.volume()


@each(
    (lambda r: r.contains({"x": 1}), "a value for y expected"),
    (lambda r: r.contains({"x": "one", "y": 0}), "an exact number for x expected"),
    (lambda r: r.bounds("w"), "one of x, y expected"),
    (lambda r: r.volume(2), "between 0 and 1"),
)
def test_bad_requests_get_one_line(call, message: str) -> None:
    with pytest.raises(qe.InputError, match=message):
        call(qe.region("x^2+y^2 <= 1"))


def test_order_must_name_every_variable() -> None:
    with pytest.raises(qe.InputError, match="order"):
        qe.region("x^2+y^2 <= 1", order=("x",))


def test_a_formula_without_variables_has_a_region() -> None:
    assert qe.region("false").is_empty and not qe.region("true").is_empty
