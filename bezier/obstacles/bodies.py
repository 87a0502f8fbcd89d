"""Convex bodies with what is needed for distances: a core with nearest point and support function, and a radius.

A body is its core and all points within ``radius`` of it. ``nearest(p)`` is a point of the core, as near to p as
rational numbers allow; ``support(n)`` is at least the largest n . q over the core, None where that is infinite.
Any q in the core bounds the distance of p from above by |p - q| - radius, and any n bounds it from below by
(n . p - support(n)) / |n| - radius.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from bezier.curves.enclosure import root_above
from bezier.curves.scalar import dot
from bezier.obstacles.polyhedron import Point, Polytope

Box = tuple[Point, Point]


@dataclass(frozen=True, slots=True)
class Rounded:
    """All points within ``radius`` of a polytope: balls, capsules, boxes and polyhedra, with or without margin."""

    core: Polytope
    radius: Fraction

    @property
    def box(self) -> Box:
        """The smallest axis-parallel box around the body."""
        low = tuple(min(c[i] for c in self.core.corners) - self.radius for i in range(3))
        return low, tuple(max(c[i] for c in self.core.corners) + self.radius for i in range(3))

    def nearest(self, p: Point) -> Point:
        """The nearest point of the core, exactly."""
        return self.core.nearest(p)

    def support(self, direction: Sequence[Fraction]) -> Fraction | None:
        """The largest direction . q over the core, exactly."""
        return self.core.support(direction)


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
