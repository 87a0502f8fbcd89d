"""Via points for a problem that names only obstacles.

The rule. Seen from above, the way from start to goal is a straight segment. Obstacles are in the way if their bounding
boxes, seen from above, meet it; obstacles without a bounding box are left to the proof at the end. Q0 and R0 are the
points of the segment where the boxes in the way begin and end, at the height of the highest of them and a tenth of that
box's height (``lift``) more. With no obstacle in the way they are the points at a third and two thirds of the way.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from bezier.curves.scalar import Vector, add, exactly, scale, subtract
from bezier.obstacles.obstacle import Box, Obstacle
from qe.errors import InputError

LIFT = Fraction(1, 10)


def via_over(
    start: Vector, goal: Vector, obstacles: Sequence[Obstacle], lift: Fraction = LIFT
) -> tuple[Vector, Vector]:
    """The two via points. Raises ``InputError`` when the start or the goal lies below or above a box in the way."""
    along = subtract(goal, start)
    boxes = [o.box for o in obstacles if o.box is not None and _shadow(start, along, o.box) is not None]
    if not boxes:
        return via_at_thirds(start, goal)
    spans = [span for box in boxes if (span := _shadow(start, along, box)) is not None]
    first, last = min(s for s, _ in spans), max(s for _, s in spans)
    if first <= 0 or last >= 1 or first == last:
        raise InputError("an obstacle above, below or around the start or the goal; give via points")
    low, high = max(((box[0][2], box[1][2]) for box in boxes), key=lambda ends: ends[1])
    height = high + lift * (high - low)
    q0, r0 = add(start, scale(first, along)), add(start, scale(last, along))
    return (*q0[:2], height), (*r0[:2], height)


def via_at_thirds(start: Vector, goal: Vector) -> tuple[Vector, Vector]:
    """The points at a third and two thirds of the way."""
    along = subtract(goal, start)
    return add(start, scale(Fraction(1, 3), along)), add(start, scale(Fraction(2, 3), along))


def _shadow(start: Vector, along: Vector, box: Box) -> tuple[Fraction, Fraction] | None:
    """The part [a, b] of [0, 1] in which start + s along, seen from above, lies in the box; None when it never does."""
    low, high = Fraction(0), Fraction(1)
    for i in range(2):
        begin, step = exactly(start[i]), exactly(along[i])
        if not step:
            if not box[0][i] <= begin <= box[1][i]:
                return None
            continue
        ends = sorted(((box[0][i] - begin) / step, (box[1][i] - begin) / step))
        low, high = max(low, ends[0]), min(high, ends[1])
    return (low, high) if low <= high else None
