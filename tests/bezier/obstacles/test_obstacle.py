"""Bodies as unions of polynomial conditions: membership against distances, polyhedra from both descriptions."""

from fractions import Fraction
from math import dist, hypot

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bezier.curves.scalar import dot, subtract
from bezier.obstacles.bodies import Cylinder
from bezier.obstacles.obstacle import pieces_of
from bezier.obstacles.polyhedron import from_corners, from_half_spaces
from qe.errors import InputError
from tests.bezier.bodies import CUBE, OCTAHEDRON, TURNED, WEDGE, at, cylinders, half_spaces, obstacle, rounded
from tests.bezier.numbers import points
from tests.tables import each

anywhere = points(3, st.fractions(-5, 5, max_denominator=4))


@given(st.one_of(rounded, half_spaces), anywhere)
def test_a_body_is_the_points_within_its_radius_of_its_core(body, p):
    away = subtract(p, body.nearest(p))
    assert obstacle(body).contains(p) == (dot(away, away) <= body.radius**2)


@given(cylinders, anywhere)
def test_a_cylinder_with_margin_is_the_points_within_the_margin(body, p):
    across = max(hypot(float(p[0] - body.centre[0]), float(p[1] - body.centre[1])) - float(body.tube_radius), 0.0)
    above = 0.0 if body.top is None else max(float(p[2] - body.top), 0.0)
    below = 0.0 if body.bottom is None else max(float(body.bottom - p[2]), 0.0)
    excess = hypot(across, above, below) - float(body.radius)
    if abs(excess) > 1e-9:
        assert obstacle(body).contains(p) == (excess < 0)


@pytest.mark.parametrize("turn", [(1, 0), (0, 1), (-1, 0), (0, -1)])
def test_the_rim_of_a_cylinder_is_rounded_all_around(turn):
    body = Cylinder((Fraction(5), Fraction(-3)), Fraction(1), Fraction(0), Fraction(1), Fraction(1, 2))
    thing = obstacle(body)
    for away, inside in ((Fraction(13, 10), True), (Fraction(7, 5), False)):  # 0.3 and 0.4 beyond the rim, both ways
        x, y = 5 + away * turn[0], -3 + away * turn[1]
        assert thing.contains((x, y, away)) is inside and thing.contains((x, y, 1 - away)) is inside


def test_a_rim_with_a_margin_beyond_the_axis():
    body = Cylinder((Fraction(0), Fraction(0)), Fraction(1), Fraction(0), Fraction(1), Fraction(3))
    assert len(pieces_of(body)) == 6
    assert obstacle(body).contains(at(0, 0, 4)) and not obstacle(body).contains(at(0, 0, "401/100"))
    assert obstacle(body).contains(at(4, 0, "1/2")) and not obstacle(body).contains(at(4, 0, "11/10"))


@given(st.one_of(rounded, half_spaces, cylinders), anywhere)
def test_every_point_of_a_body_lies_in_its_box_and_below_its_support(body, p):
    if body.box is not None and obstacle(body).contains(p):
        assert all(low <= x <= high for low, x, high in zip(body.box[0], p, body.box[1], strict=True))
    q = body.nearest(p)
    towards = subtract(p, q)
    support = body.support(towards)
    assert support is not None and dot(towards, q) <= support


@given(st.one_of(rounded, half_spaces), anywhere)
def test_the_nearest_point_has_a_supporting_plane(body, p):
    """q is nearest iff (p - q) . k <= (p - q) . q for all k in the core (projection theorem for convex sets)."""
    q = body.nearest(p)
    assert dot(subtract(p, q), q) == body.support(subtract(p, q))


@each((CUBE, (8, 12, 6)), (TURNED, (8, 12, 6)), (OCTAHEDRON, (6, 12, 8)))
def test_corners_edges_and_facets(body, counts):
    assert (len(body.corners), len(body.edges), len(body.facets)) == counts


@each(CUBE, TURNED, OCTAHEDRON, WEDGE)
def test_half_spaces_and_corners_describe_the_same_body(body):
    assert from_half_spaces([(f.normal, f.offset) for f in body.facets]) == body
    redundant = [(f.normal, f.offset) for f in body.facets] + [(at(1, 1, 1), Fraction(100))]
    assert from_half_spaces(redundant) == body
    middle = tuple(sum(c[i] for c in body.corners) / len(body.corners) for i in range(3))
    assert from_corners([*body.corners, middle]) == body


UP, DOWN = (at(0, 0, 1), Fraction(1)), (at(0, 0, -1), Fraction(0))
WALLS = [(at(*n), Fraction(1)) for n in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0))]


@each(
    ([*WALLS, UP], "unbounded"),
    ([UP, DOWN], "unbounded"),
    ([*WALLS[:2], UP, DOWN], "unbounded"),
    ([*WALLS, UP, (at(0, 0, -1), Fraction(-2))], "empty"),
    ([*WALLS, UP, (at(0, 0, -1), Fraction(-1))], "in one plane"),
)
def test_bad_half_spaces(half_spaces, said):
    with pytest.raises(InputError, match=said):
        from_half_spaces(half_spaces)


def test_flat_corners_are_refused():
    for corners in ([at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(1, 1, 0)], [at(0, 0, 0), at(1, 1, 1), at(2, 2, 2)]):
        with pytest.raises(InputError, match="in one plane"):
            from_corners(corners)


def test_edges_have_the_length_of_a_side():
    sides = {round(dist(map(float, TURNED.corners[i]), map(float, TURNED.corners[j]))) for i, j in TURNED.edges}
    assert sides == {1, 5}
