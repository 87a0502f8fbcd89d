"""Convex hulls of rational points in the plane and in space, exactly, one point after the other: the half-spaces that
hold all points are a cone (``qe.convex.cone``), and its rays are those of the facets."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from fractions import Fraction

from bezier.chains.form import Point
from bezier.curves.scalar import dot
from bezier.obstacles.polyhedron import whole
from qe.convex.cone import Cone, Vector


@dataclass(frozen=True, slots=True)
class Facet:
    """The hull has normal . p <= offset."""

    normal: Point
    offset: Fraction

    @staticmethod
    def of(ray: Vector) -> Facet:
        """normal . p - offset <= 0, the largest coordinate of the normal 1 or -1."""
        largest = max(map(abs, ray[:-1]))
        return Facet(tuple(Fraction(c, largest) for c in ray[:-1]), Fraction(-ray[-1], largest))

    def beyond(self, point: Point) -> Fraction:
        """Positive outside: normal . point - offset."""
        return Fraction(dot(self.normal, point)) - self.offset


class Hull:
    """``facets``: none until the points do not lie in one plane."""

    def __init__(self, dimension: int) -> None:
        self.cone = Cone(dimension + 1)
        self.facets: list[Facet] = []

    def add(self, point: Point) -> None:
        """One more point."""
        known = dict(zip(self.cone.rays, self.facets, strict=False))
        self.cone.cut(whole((*point, 1)))
        self.facets = [] if self.cone.lines else [known.get(ray) or Facet.of(ray) for ray in self.cone.rays]

    @property
    def corners(self) -> list[int]:
        """The numbers of extreme points, in as many facets as the space has dimensions; of equal ones all."""
        on = Counter(i for bits in self.cone.rays.values() for i in range(self.cone.count) if bits >> i & 1)
        return sorted(i for i, count in on.items() if count >= self.cone.size - 1)
