"""Convex hulls of rational points in the plane and in space, exactly, one point after the other (beneath and beyond;
Grünbaum, "Convex Polytopes", 5.2; Edelsbrunner, "Algorithms in Combinatorial Geometry", 8.4)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations

from bezier.chains.form import Point
from bezier.curves.scalar import dot, subtract
from bezier.obstacles.polyhedron import cross


@dataclass(frozen=True, slots=True)
class Facet:
    """``corners``: numbers of as many points as the space has dimensions. The hull has normal . p <= offset."""

    corners: tuple[int, ...]
    normal: Point
    offset: Fraction

    def beyond(self, point: Point) -> Fraction:
        """Positive outside: normal . point - offset."""
        return Fraction(dot(self.normal, point)) - self.offset


def facet(points: Sequence[Point], corners: tuple[int, ...], inside: Point) -> Facet:
    """The facet through these points, ``inside`` on its inner side. Raises ``ValueError`` where they span none."""
    first, *others = (points[i] for i in corners)
    spans = [subtract(p, first) for p in others]
    if len(spans) == 1:
        ((x, y),) = spans
        normal: Point = (-y, x)
    else:
        normal = cross(*spans)
    largest = max(abs(c) for c in normal)
    if not largest:
        raise ValueError("no facet through these points")
    side = Fraction(dot(normal, subtract(inside, first)))
    if not side:
        raise ValueError("the inner point is on the facet")
    scale = (-1 if side > 0 else 1) / largest
    normal = tuple(c * scale for c in normal)
    return Facet(corners, normal, Fraction(dot(normal, first)))


def simplex(points: Sequence[Point]) -> tuple[list[Facet], Point] | None:
    """The facets of a simplex of some of the points, and a point inside; None where all lie in one plane."""
    d = len(points[0])
    for corners in combinations(range(len(points)), d + 1):
        inside = tuple(sum((points[i][k] for i in corners), Fraction(0)) / (d + 1) for k in range(d))
        try:
            return [facet(points, rest, inside) for rest in combinations(corners, d)], inside
        except ValueError:
            continue
    return None


def grown(facets: Sequence[Facet], points: Sequence[Point], new: int, inside: Point) -> list[Facet]:
    """The facets of the hull with one more point."""
    seen = [f for f in facets if f.beyond(points[new]) > 0]
    ridges = Counter(ridge for f in seen for ridge in combinations(sorted(f.corners), len(inside) - 1))
    fresh = [facet(points, (*ridge, new), inside) for ridge, count in ridges.items() if count == 1]
    return [f for f in facets if f not in seen] + fresh
