"""Surfaces of regions in space: closed, with the right volume, with walls, cut by the frame where they go on."""

from collections import Counter
from math import pi, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.regions.solid import Solid, Surface
from qe.regions.space import framed, shape_of
from tests.tables import each

ORDER = ("x", "y", "z")
BOX = "0 <= x and x <= 2 and 0 <= y and y <= 1 and -1 <= z and z <= 2"


def edges(surface: Surface) -> Counter[tuple[int, int]]:
    """How often each edge occurs, by direction."""
    return Counter((int(f[k]), int(f[(k + 1) % 3])) for f in surface.faces for k in range(3))


def assert_closed(shape: Solid) -> None:
    for block in shape.blocks:
        found = edges(block)
        assert set(found.values()) == {1}, "an edge is run through twice in one direction"
        assert all((b, a) in found for a, b in found), "an edge belongs to one triangle only"
        assert np.isfinite(block.vertices).all()


def volume(shape: Solid) -> float:
    return sum(block.volume for block in shape.blocks)


@each(
    (BOX, 6.0),
    ("x^2 + y^2 <= 1 and 0 < z and z < 2", 2 * pi),
    ("y^2 + z^2 <= 1 and 0 <= x and x <= 2", 2 * pi),
    ("x^2 + z^2 <= 1 and 0 <= y and y <= 2", 2 * pi),
    ("x^2 + y^2 + z^2 <= 4 and z >= 0", 16 * pi / 3),
    ("x^2 + y^2 + z^2 <= 4 and x < 0", 16 * pi / 3),
    ("x >= 0 and y >= 0 and x + y <= 1 and -1 <= z and z <= 1", 1.0),
    ("x >= 0 and y >= 0 and z >= 0 and x + y + z <= 1", 1 / 6),
    ("x^2 + y^2 + z^2 <= 4 and x^2 + y^2 + z^2 >= 1 and y >= 0", 14 * pi / 3),
    ("(x^2 + y^2 + z^2 + 3)^2 <= 16*(x^2 + y^2)", 4 * pi**2),
    ("x^2 + y^2 <= 1 and x^2 + z^2 <= 1", 16 / 3),
    ("y^2 <= 1 and z^2 <= 1 and 0 <= x and x <= 2 and (x <= 1 or z <= 0)", 6.0),
)
def test_bounded_solids_are_closed_and_have_their_volume(text: str, exact: float) -> None:
    shape = shape_of(qe.region(text, order=ORDER))[0]
    assert_closed(shape)
    assert volume(shape) == pytest.approx(exact, rel=0.03)


def test_a_box_had_no_walls() -> None:
    """A box was two squares: now each of its six sides is covered by triangles, to its whole area."""
    (block,) = shape_of(qe.region(BOX, order=ORDER))[0].blocks
    corners = block.vertices[block.faces]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    for axis, value, area in ((0, 0, 3), (0, 2, 3), (1, 0, 6), (1, 1, 6), (2, -1, 2), (2, 2, 2)):
        on_side = (abs(corners[:, :, axis] - value) < 1e-5).all(axis=1)
        assert areas[on_side].sum() == pytest.approx(area, rel=1e-3)


def test_a_cylinder_had_no_mantle() -> None:
    (block,) = shape_of(qe.region("x^2 + y^2 <= 1 and 0 <= z and z <= 2", order=ORDER))[0].blocks
    corners = block.vertices[block.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    mantle = abs(normals[:, 2]) < 1e-12
    assert np.linalg.norm(normals[mantle], axis=1).sum() / 2 == pytest.approx(4 * pi, rel=0.01)


@each(("z >= x^2 + y^2 and x >= 0", None), ("x^2 + y^2 >= 100 and z >= 0 and z <= 5", None), ("x = x or y = z", 512.0))
def test_what_goes_on_for_ever_is_cut_by_the_frame(text: str, exact: float | None) -> None:
    region = qe.region(text, order=ORDER)
    inside, frame = framed(region)
    assert frame and all(end is not None for v in ORDER for end in inside.bounds(v))
    shape = shape_of(region)[0]
    assert_closed(shape)
    assert volume(shape) > 10
    if exact is not None:
        assert volume(shape) == pytest.approx(exact, rel=0.01)


def test_a_bounded_region_is_not_cut() -> None:
    region = qe.region("x^2 + y^2 + z^2 <= 1", order=ORDER)
    assert framed(region) == (region, {})


def test_sheets_curves_and_points_stay_open() -> None:
    text = "z = x*y and x^2 + y^2 <= 1 or x = 3 and y = 1 and z^2 <= 1 or x = 5 and y = 0 and z = 0"
    shape = shape_of(qe.region(text, order=ORDER))[0]
    assert not shape.blocks and len(shape.surfaces) == 1 and sorted(map(len, shape.lines))[0] == 1
    assert len(shape.lines) == 2


def test_walls_between_blocks_are_marked() -> None:
    """In an L the wall between its halves is inner where both have it, and the step above is seen."""
    shape = shape_of(qe.region("0<=y and y<=1 and 0<=z and z<=2 and 0<=x and x<=2 and (x<=1 or z<=1)", order=ORDER))[0]
    centres = [b.vertices[b.faces[b.inner]].mean(axis=1) for b in shape.blocks]
    inner = np.concatenate(centres)
    assert len(inner) and abs(inner[:, 0] - 1).max() < 1e-5 and inner[:, 2].max() <= 1.1


sizes = st.integers(1, 6)
places = st.integers(-4, 4)


@settings(max_examples=7, deadline=None)
@given(places, places, sizes, sizes, sizes, sizes)
def test_two_boxes(a: int, b: int, p: int, q: int, r: int, s: int) -> None:
    """A union of two boxes, by the volumes of both and of what they share."""
    first = f"0 <= x and x <= {p} and 0 <= y and y <= {q} and 0 <= z and z <= {r}"
    second = f"{a} <= x and x <= {a + s} and {b} < y and y < {b + p} and 1/2 < z and z < {q}"
    shared = max(0, min(p, a + s) - max(0, a)) * max(0, min(q, b + p) - max(0, b)) * max(0, min(r, q) - 0.5)
    shape = shape_of(qe.region(f"({first}) or ({second})", order=ORDER))[0]
    assert_closed(shape)
    assert volume(shape) == pytest.approx(p * q * r + s * p * (q - 0.5) - shared, rel=1e-3)


@settings(max_examples=4, deadline=None)
@given(places, places, st.integers(1, 4), sizes, st.integers(-8, 8))
def test_caps_of_balls(u: int, v: int, w: int, radius: int, cut: int) -> None:
    """A ball cut by a plane in any direction: the volume of the cap in closed form."""
    distance = cut / sqrt(u * u + v * v + w * w)
    height = radius - distance
    text = f"(x - 1)^2 + y^2 + (z + 2)^2 <= {radius**2} and {u}*(x - 1) + {v}*y + {w}*(z + 2) >= {cut}"
    shape = shape_of(qe.region(text, order=ORDER))[0]
    if height <= 0:
        assert not shape.blocks
        return
    assert_closed(shape)
    exact = 4 * pi * radius**3 / 3 if height >= 2 * radius else pi * height**2 * (3 * radius - height) / 3
    assert volume(shape) == pytest.approx(exact, rel=0.03)


@pytest.mark.parametrize("text", ["x = x", "z > x^2 + y^2", "x = y and y = z", "x = 1 and y = 2 and z = 3", BOX])
def test_pictures_in_space_are_drawn(tmp_path, text: str) -> None:
    path = tmp_path / "region.png"
    qe.region(text, order=ORDER).plot(path)
    assert path.stat().st_size > 20000
