"""How far a whole curve stays from a convex obstacle: a rigorous enclosure of the least distance.

Branch and bound over t. For any direction n, K lies in {q : n . q <= h(n)}, so every point of a part of the curve with
control points c_0, ..., c_m has at least the distance min_i (n . c_i - h(n)) / |n| from the core K: the part lies in
the convex hull of the c_i. With the direction from the nearest point of K to the middle of the part this bound is exact
up to second order in the length of the part. Any point of the curve bounds the least distance from above.
"""

from __future__ import annotations

import heapq
from dataclasses import dataclass, field
from fractions import Fraction

from bezier.curves.curve import Bezier
from bezier.curves.enclosure import Enclosure, bounds, root_above, root_below
from bezier.curves.scalar import dot, exactly, subtract
from bezier.obstacles.bodies import Body
from bezier.obstacles.polyhedron import Point
from qe.errors import Unable

REL = Fraction(1, 10**6)
BITS = 96
MAX_PARTS = 5_000
ZERO = Fraction(0)


@dataclass(order=True, slots=True)
class _Part:
    """A part of the curve: ``low`` is a lower bound of its distance from the core, ``high`` the distance of a point."""

    low: Fraction
    high: Fraction = field(compare=False)
    curve: Bezier = field(compare=False)


def distance_enclosure(curve: Bezier, body: Body, rel: Fraction = REL) -> Enclosure:
    """The least distance between a curve and a body that it does not meet, with high - low <= rel * high.

    For a curve that meets the body the lower end is 0. Raises ``Unable`` when the width is not reached within
    ``MAX_PARTS`` parts, which also happens when the distance is 0.
    """
    near, error = _rational(curve)
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


def _part(curve: Bezier, body: Body, known: Fraction) -> _Part:
    """Both bounds for a part; ``known``: a lower bound from a longer part."""
    middle = curve.point(Fraction(1, 2))
    at: Point = tuple(exactly(c) for c in middle)
    away = subtract(at, body.nearest(at))
    square = Fraction(dot(away, away))
    return _Part(max(known, _apart(curve, body, away, square)), root_above(square, BITS), curve)


def _apart(curve: Bezier, body: Body, away: Point, square: Fraction) -> Fraction:
    """The lower bound by the plane across ``away``, 0 where there is none."""
    support = body.support(away)
    if not square or support is None:
        return ZERO
    gap = min(Fraction(dot(away, c)) for c in curve.points) - support
    return gap / root_above(square, BITS) if gap > 0 else ZERO


def _rational(curve: Bezier) -> tuple[Bezier, Fraction]:
    """A curve with rational control points near the given ones, and how far its points are off at most."""
    ends = [[bounds(c, BITS) for c in p] for p in curve.points]
    off = max(high - low for p in ends for low, high in p)
    return Bezier(tuple(tuple((low + high) / 2 for low, high in p) for p in ends)), 2 * off


def distance_at(curve: Bezier, body: Body, t: Fraction) -> float:
    """The distance of one point of the curve from the body, rounded; for pictures."""
    at: Point = tuple((low + high) / 2 for low, high in (bounds(c, BITS) for c in curve.point(t)))
    away = subtract(at, body.nearest(at))
    return max(float(root_below(Fraction(dot(away, away)), BITS)) - float(body.radius), 0.0)
