"""The outline of a planar region: closed, without gaps, around the right area."""

import numpy as np
import pytest

import qe
from bezier.compare.pictures import outline
from tests.tables import each


@each(
    ("x^2 + y^2 <= 1", "x, y", np.pi),
    ("x^2 + y^2 < 1 and y <= x", "y, x", np.pi / 2),
    ("x >= 0 and y >= 0 and x + 2*y <= 2", "x, y", 1.0),
    ("0 <= x and x <= 1 and 0 <= y and y <= 3", "y, x", 3.0),
    ("x^2 + y^2 <= 4 and (x - 1)^2 + y^2 <= 4 and y <= 1", "y, x", None),
)
def test_it_is_closed_and_has_no_gap(text, order, area):
    points = outline(qe.region(text, order=order))
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    x, y = points.T
    assert (points[0] == points[-1]).all() and np.isfinite(points).all()
    # a wall across the first variable is one step; elsewhere the line goes in small ones
    walls = np.abs(np.diff(x)) < 1e-6
    assert steps[~walls].max() < 0.05
    if area is not None:
        assert abs(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])) / 2 == pytest.approx(area, rel=1e-4)


def test_a_region_without_interior_has_none():
    assert outline(qe.region("x^2 + y^2 <= 0", order="x, y")).shape == (0, 2)
