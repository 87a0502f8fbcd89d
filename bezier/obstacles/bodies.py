"""Convex bodies with what is needed for distances: a core with nearest point and support function, and a radius.

A body is its core and all points within ``radius`` of it. ``nearest(p)`` is a point of the core, as near to p as
rational numbers allow; ``support(n)`` is at least the largest n . q over the core, None where that is infinite.
Any q in the core bounds the distance of p from above by |p - q| - radius, and any n bounds it from below by
(n . p - support(n)) / |n| - radius.

How far a whole curve stays from a convex obstacle: a rigorous enclosure of the least distance.

Branch and bound over t. For any direction n, K lies in {q : n . q <= h(n)}, so every point of a part of the curve with
control points c_0, ..., c_m has at least the distance min_i (n . c_i - h(n)) / |n| from the core K: the part lies in
the convex hull of the c_i. With the direction from the nearest point of K to the middle of the part this bound is exact
up to second order in the length of the part. Any point of the curve bounds the least distance from above.
"""

from __future__ import annotations

import heapq
from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from bezier.curves.curve import Bezier
from bezier.curves.enclosure import Enclosure, bounds, root_above
from bezier.curves.scalar import dot, exactly, subtract
from bezier.obstacles.polyhedron import Point, Polytope, nearest
from qe.errors import Unable

Box = tuple[Point, Point]


def around(points: Sequence[Point], radius: Fraction) -> Box:
    """The axis-parallel box around the balls of this radius about points."""
    axes = list(zip(*points, strict=True))
    return tuple(min(axis) - radius for axis in axes), tuple(max(axis) + radius for axis in axes)


@dataclass(frozen=True, slots=True)
class Rounded:
    """All points within ``radius`` of a polytope: balls, capsules, boxes and polyhedra, with or without margin."""

    core: Polytope
    radius: Fraction

    @property
    def box(self) -> Box:
        """The smallest axis-parallel box around the body."""
        return around(self.core.corners, self.radius)

    def nearest(self, p: Point) -> Point:
        """The nearest point of the core, exactly."""
        return nearest(self.core.corners, (p,))[0]

    def support(self, direction: Sequence[Fraction]) -> Fraction | None:
        """The largest direction . q over the core, exactly."""
        return max(Fraction(dot(direction, p)) for p in self.core.corners)


@dataclass(frozen=True, slots=True)
class HalfSpaceBody:
    """All points within ``radius`` of {p : normal . p <= offset}."""

    normal: Point
    offset: Fraction
    radius: Fraction = Fraction(0)

    @property
    def box(self) -> Box | None:
        """None: unbounded."""
        return None

    def nearest(self, p: Point) -> Point:
        """p itself inside, else its projection to the plane."""
        excess = Fraction(dot(self.normal, p)) - self.offset
        share = max(excess, Fraction(0)) / Fraction(dot(self.normal, self.normal))
        return tuple(x - share * n for x, n in zip(p, self.normal, strict=True))

    def support(self, direction: Sequence[Fraction]) -> Fraction | None:
        """Finite only for multiples s >= 0 of the normal: s * offset."""
        share = Fraction(dot(direction, self.normal)) / Fraction(dot(self.normal, self.normal))
        parallel = all(d == share * n for d, n in zip(direction, self.normal, strict=True))
        return share * self.offset if parallel and share >= 0 else None


@dataclass(frozen=True, slots=True)
class Cylinder:
    """All points within ``radius`` of a vertical cylinder: bottom <= z <= top, at most ``tube_radius`` from the axis.

    ``bottom`` or ``top`` is None where the cylinder goes on for ever. The core is the cylinder itself.
    """

    centre: tuple[Fraction, Fraction]
    tube_radius: Fraction
    bottom: Fraction | None
    top: Fraction | None
    radius: Fraction = Fraction(0)

    @property
    def box(self) -> Box | None:
        """The smallest axis-parallel box, if the cylinder has both ends."""
        if self.bottom is None or self.top is None:
            return None
        (x, y), wide = self.centre, self.tube_radius + self.radius
        return (x - wide, y - wide, self.bottom - self.radius), (x + wide, y + wide, self.top + self.radius)

    def nearest(self, p: Point) -> Point:
        """The nearest point of the core, moved towards the axis by a rounding error where it is irrational."""
        x, y = p[0] - self.centre[0], p[1] - self.centre[1]
        z = p[2] if self.bottom is None else max(p[2], self.bottom)
        z = z if self.top is None else min(z, self.top)
        far = root_above(x * x + y * y, bits=64)
        share = min(Fraction(1), self.tube_radius / far) if far else Fraction(1)
        return (self.centre[0] + share * x, self.centre[1] + share * y, z)

    def support(self, direction: Sequence[Fraction]) -> Fraction | None:
        """The largest value over the axis plus the radius times the horizontal length of the direction."""
        x, y, z = direction
        end = self.top if z > 0 else self.bottom if z < 0 else Fraction(0)
        if end is None:
            return None
        across = self.tube_radius * root_above(x * x + y * y, bits=96)
        return x * self.centre[0] + y * self.centre[1] + z * end + across


Body = Rounded | HalfSpaceBody | Cylinder


REL = Fraction(1, 10**6)
BITS = 96
MAX_PARTS = 5_000
ZERO = Fraction(0)


@dataclass(order=True, slots=True)
class _CurvePart:
    """A part of the curve: ``low`` is a lower bound of its distance from the core, ``high`` the distance of a point."""

    low: Fraction
    high: Fraction = field(compare=False)
    curve: Bezier = field(compare=False)


def distance_enclosure(curve: Bezier, body: Body, rel: Fraction = REL) -> Enclosure:
    """The least distance between a curve and a body that it does not meet, with high - low <= rel * high.

    For a curve that meets the body the lower end is 0. Raises ``Unable`` when the width is not reached within
    ``MAX_PARTS`` parts, which also happens when the distance is 0.
    """
    ends = [[bounds(c, BITS) for c in p] for p in curve.points]
    near = Bezier(tuple(tuple((low + high) / 2 for low, high in p) for p in ends))
    error = 2 * max(high - low for p in ends for low, high in p)
    heap = [_part(near, body, ZERO)]
    least = heap[0].high
    for _ in range(MAX_PARTS):
        first = heap[0]
        high = least - body.radius + error
        if high <= 0:
            return Enclosure(ZERO, ZERO)
        low = max(first.low - body.radius - error, ZERO)
        if high - low <= rel * high:
            return Enclosure(low, high)
        heapq.heappop(heap)
        for half in first.curve.split():
            part = _part(half, body, first.low)
            least = min(least, part.high)
            heapq.heappush(heap, part)
    raise Unable("the least distance between the curve and the obstacle was not enclosed within the limit")


def _part(curve: Bezier, body: Body, known: Fraction) -> _CurvePart:
    """Both bounds for a part; ``known``: a lower bound from a longer part."""
    middle = curve.point(Fraction(1, 2))
    at: Point = tuple(exactly(c) for c in middle)
    away = subtract(at, body.nearest(at))
    square = Fraction(dot(away, away))
    far, support = root_above(square, BITS), body.support(away)
    if square and support is not None:  # the lower bound by the plane across ``away``
        known = max(known, (min(Fraction(dot(away, c)) for c in curve.points) - support) / far)
    return _CurvePart(known, far, curve)
