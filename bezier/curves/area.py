"""The area of a convex planar region, enclosed by chords.

THEOREM. Let h(x) be the length of the fibre of a bounded convex set over x; h is concave on the interval [a, b] where
it is not empty. For two neighbouring abscissae the area between them is at least that under the chord of h, and at
most that under the chords on either side, extended (a concave function lies below the extension of its chords). Before
the first abscissa and after the last one there is one such extension, and h >= 0.
"""

from __future__ import annotations

import heapq
from dataclasses import dataclass
from fractions import Fraction

import qe
from bezier.curves.enclosure import Enclosure, bounds
from qe.errors import InputError, Unable

MOST = 2000
"""Abscissae that are used at most."""


@dataclass(frozen=True, slots=True)
class _Height:
    """An abscissa with the length of its fibre."""

    x: Fraction
    low: Fraction
    high: Fraction


def convex_area(region: qe.Region, rel: Fraction) -> Enclosure:
    """The area of a bounded convex region in two variables, with high - low <= rel * high.

    That the region is convex is for the caller to know. Raises ``InputError`` for an unbounded region, ``Unable`` when
    the width is not reached.
    """
    if region.is_empty:
        return Enclosure(Fraction(0), Fraction(0))
    first, last = region.bounds(region.order[0])
    if first is None or last is None:
        raise InputError("the area of a bounded region can be enclosed only")
    (begin, inner_begin), (inner_end, end) = bounds(first), bounds(last)
    if begin == end or inner_begin >= inner_end:
        return Enclosure(Fraction(0), Fraction(0))
    return _refined(region, (begin, end), (inner_begin, inner_end), rel)


def _refined(
    region: qe.Region, outer: tuple[Fraction, Fraction], inner: tuple[Fraction, Fraction], rel: Fraction
) -> Enclosure:
    """Abscissae are added where the gap between the two bounds is widest."""
    width = inner[1] - inner[0]
    heights = [_height(region, inner[0] + width * k / 8) for k in range(1, 8)]
    while len(heights) < MOST:
        gaps = _gaps(heights, outer)
        low, high = (sum((g[side] for g in gaps), Fraction(0)) for side in (0, 1))
        if high - low <= rel * high:
            return Enclosure(low, high)
        worst = heapq.nlargest(max(1, len(gaps) // 4), range(len(gaps)), key=lambda k: gaps[k][1] - gaps[k][0])
        edges = [inner[0], *(h.x for h in heights), inner[1]]
        heights += [_height(region, (edges[k] + edges[k + 1]) / 2) for k in worst]
        heights.sort(key=lambda h: h.x)
    raise Unable("the area was not enclosed as narrowly as asked for")


def _height(region: qe.Region, x: Fraction) -> _Height:
    intervals = region.fibre({region.order[0]: x})
    if not intervals:
        return _Height(x, Fraction(0), Fraction(0))
    lower, upper = intervals[0]
    if len(intervals) > 1 or lower is None or upper is None:
        raise InputError("the area of a bounded convex region can be enclosed only")
    (a, b), (c, d) = bounds(lower), bounds(upper)
    return _Height(x, max(Fraction(0), c - b), d - a)


def _gaps(heights: list[_Height], outer: tuple[Fraction, Fraction]) -> list[tuple[Fraction, Fraction]]:
    """Lower and upper bound of the area left of, between and right of the abscissae."""
    mirrored = [_Height(-h.x, h.low, h.high) for h in reversed(heights)]
    result = [_end(heights, outer[0])]
    for k in range(len(heights) - 1):
        left, right = heights[k], heights[k + 1]
        low = (left.low + right.low) / 2 * (right.x - left.x)
        before = _extension(heights[k - 1], left) if k > 0 else None
        after = _extension(heights[k + 2], right) if k + 2 < len(heights) else None
        result.append((low, _under(left, right, before, after)))
    result.append(_end(mirrored, -outer[1]))
    return result


def _extension(far: _Height, near: _Height) -> Fraction:
    """The largest slope, seen from ``near`` away from ``far``, of the chord through both."""
    return (near.high - far.low) / abs(near.x - far.x)


def _end(heights: list[_Height], begin: Fraction) -> tuple[Fraction, Fraction]:
    """The area between the begin of the region and the first abscissa."""
    first = heights[0]
    width, slope = first.x - begin, _extension(heights[1], first)
    last = first.high + slope * width
    if last >= 0:
        return Fraction(0), (first.high + last) / 2 * width
    return Fraction(0), first.high**2 / (-2 * slope)


def _under(left: _Height, right: _Height, before: Fraction | None, after: Fraction | None) -> Fraction:
    """The area under the lower one of two lines: from ``left`` with slope ``before``, and from ``right`` backwards."""
    width = right.x - left.x
    lines = []
    if before is not None:
        lines.append((left.high, left.high + before * width))
    if after is not None:
        lines.append((right.high + after * width, right.high))
    areas = [(a + b) / 2 * width for a, b in lines]
    if len(lines) == 2:
        (a, b), (c, d) = lines
        if (c - a) * (d - b) < 0:
            share = (c - a) / (c - a - (d - b))
            middle = a + (b - a) * share
            return (min(a, c) + middle) / 2 * width * share + (middle + min(b, d)) / 2 * width * (1 - share)
    return min(areas)
