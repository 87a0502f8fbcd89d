"""Measures in closed form."""

from __future__ import annotations

import pytest
import sympy as sp

import qe
from tests.tables import each


@each(
    ("x^2 < 2 and x > -1", sp.sqrt(2) + 1),
    ("x^5 - 4*x < 1 and x > 0", None),
    ("x^2 < 0", 0),
    ("x^2 + y^2 <= 1", sp.pi),
    ("x^2 + y^2/4 <= 1 and y > 0", sp.pi),
    ("1 <= x^2 + y^2 and x^2 + y^2 <= 4", 3 * sp.pi),
    ("x > 0 and y > 0 and x + y < 1", sp.Rational(1, 2)),
    ("y > x^2 and y < 1", sp.Rational(4, 3)),
    ("y^2 < x and x < 2", 8 * sp.sqrt(2) / 3),
    ("x*y < 1 and 2*x > 1 and x < 3 and y > 0", sp.log(6)),
    ("y^2 - x^2 < 1 and x^2 < 1", 2 * sp.sqrt(2) + 2 * sp.asinh(1)),
    ("(x - 1)^2 + y^2 <= 1 and x^2 + y^2 <= 1", 2 * sp.pi / 3 - sp.sqrt(3) / 2),
    ("x^2 + y^2 + z^2 <= 4 and x >= 1", 5 * sp.pi / 3),
)
def test_known_measures(text: str, value: object) -> None:
    region = qe.region(text, order=[v for v in "xyz" if v in text])
    found = region.exact_volume()
    low, high = region.volume()
    assert low <= float(found) * (1 + 1e-12) and float(found) * (1 - 1e-12) <= high
    assert value is None or sp.simplify(found - value).equals(0)


@each("x > 0", "x^4 + y^4 < 1", "y^2 < x^3 - x + 2 and x < 1", "y^2 < x^3 and x < 1")
def test_no_closed_form(text: str) -> None:
    with pytest.raises(qe.Unable):
        qe.region(text).exact_volume()
