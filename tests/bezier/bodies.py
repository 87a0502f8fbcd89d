"""Obstacles for the tests, built in one line each, and a strategy over all kinds."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from hypothesis import strategies as st

from bezier.obstacles.bodies import Body, Cylinder, HalfSpaceBody, Rounded
from bezier.obstacles.obstacle import Obstacle, ObstacleKind, from_body
from bezier.obstacles.polyhedron import Point, from_corners, parallelepiped, point, segment


def at(*values: Any) -> Point:
    """A point with exact coordinates."""
    return tuple(Fraction(v) for v in values)


def obstacle(body: Body) -> Obstacle:
    """The obstacle that is this body."""
    return from_body("it", ObstacleKind.POLYHEDRON, body)


def ball(centre: Any, radius: Any) -> Obstacle:
    """A ball."""
    return obstacle(Rounded(point(at(*centre)), Fraction(radius)))


CUBE = parallelepiped(at(-1, -1, -1), [at(2, 0, 0), at(0, 2, 0), at(0, 0, 2)])
TURNED = parallelepiped(at(0, 0, 0), [at(3, 4, 0), at(-4, 3, 0), at(0, 0, 1)])
OCTAHEDRON = from_corners([at(2, 0, 0), at(-2, 0, 0), at(0, 2, 0), at(0, -2, 0), at(0, 0, 2), at(0, 0, -2)])
WEDGE = from_corners([at(0, 0, 0), at(3, 0, 0), at(0, 2, 0), at(0, 0, 1)])

radii = st.sampled_from([Fraction(1, 3), Fraction(1), Fraction(5, 2)])
margins = st.sampled_from([Fraction(0), Fraction(1, 4), Fraction(2)])
places = st.tuples(*[st.integers(-3, 3).map(Fraction)] * 3)

rounded = st.one_of(
    st.builds(lambda c, r: Rounded(point(c), r), places, radii),
    st.builds(lambda a, r: Rounded(segment(a, at(a[0] + 1, a[1] - 2, a[2] + 2)), r), places, radii),
    st.builds(Rounded, st.sampled_from([CUBE, TURNED, OCTAHEDRON, WEDGE]), margins),
)
half_spaces = st.builds(HalfSpaceBody, st.sampled_from([at(0, 0, 1), at(1, -2, 2)]), st.integers(-4, 4), margins)
heights = st.sampled_from([(None, None), (Fraction(-1), None), (None, Fraction(1)), (Fraction(-1), Fraction(2))])
cylinders = st.builds(lambda c, r, ends, m: Cylinder((c[0], c[1]), r, *ends, m), places, radii, heights, margins)
bodies = st.one_of(rounded, half_spaces, cylinders)
