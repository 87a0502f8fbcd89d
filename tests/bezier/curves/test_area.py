"""Areas of convex regions: known values lie between the ends, and the width is as asked for."""

from __future__ import annotations

from fractions import Fraction

import pytest

import qe
from bezier.curves.area import convex_area
from qe.errors import InputError
from tests.tables import each

PI = Fraction(3141592653589793, 10**15)


@each(
    ("x^2 + y^2 <= 1", PI),
    ("x >= 0 and y >= 0 and x + 2*y <= 3", Fraction(9, 4)),
    ("x^2 <= y and y <= 1", Fraction(4, 3)),
    ("4*x^2 + y^2 <= 4 and x >= 0", PI),
    ("0 <= x and x <= 1 and 0 <= y and y <= 1/1000", Fraction(1, 1000)),
    ("x^2 + y^2 <= 1 and (x - 1)^2 + y^2 <= 1", 2 * PI / 3 - Fraction(8660254037844386, 10**16)),
)
def test_known_areas(text: str, area: Fraction) -> None:
    for rel in (Fraction(1, 20), Fraction(1, 1000)):
        found = convex_area(qe.region(text), rel)
        assert (
            found.high is not None
            and found.low <= area + Fraction(1, 10**12)
            and found.high >= area - Fraction(1, 10**12)
        )
        assert found.high - found.low <= rel * found.high


@each("x^2 + y^2 < 0", "x^2 + y^2 <= 0", "x = y and 0 <= x and x <= 1", "x = 1 and y^2 <= 2")
def test_nothing_and_thin_sets_have_no_area(text: str) -> None:
    found = convex_area(qe.region(text, order=("x", "y")), Fraction(1, 100))
    assert found.low == 0 and found.high == 0


@each("y >= x^2", "0 <= x and x <= 1", "x > y")
def test_unbounded_regions_are_refused(text: str) -> None:
    with pytest.raises(InputError, match="bounded"):
        convex_area(qe.region(text, order=("x", "y")), Fraction(1, 100))


def test_agrees_with_the_volume_of_a_region() -> None:
    region = qe.region("x^2 + 2*y^2 - x*y <= 3 and y >= -1/2")
    low, high = region.volume(0.001)
    found = convex_area(region, Fraction(1, 500))
    assert found.high is not None and max(low, found.low) <= min(high, found.high)
