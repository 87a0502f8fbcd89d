"""``point in region``: what ``contains`` says, with a number alone on a line."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy

import qe
from tests.tables import each


@each(1, 0.5, "1/2", Fraction(1, 2), [1], {"x": 1}, sympy.sqrt(2))
def test_points_of_a_line(point: object) -> None:
    line = qe.region("x > 0")
    assert point in line and point not in ~line


def test_points_of_a_plane() -> None:
    disc = qe.region("x^2 + y^2 < 1")
    assert (0, 0.5) in disc and {"y": 0, "x": 0} in disc and (1, 0) not in disc
    with pytest.raises(qe.InputError, match="values in order"):
        0.5 in disc
