"""Families of joint positions: joints that can be chosen, and for which values.

THEOREM. For numbers a, b, c and L > 0 let R = |(a, b)| > 0, ψ the direction of (a, b). |a cos θ + b sin θ + c| <= L iff
-L - c <= R cos(θ - ψ) <= L - c. Each of the two inequalities holds everywhere, nowhere, or from ψ - arccos(k/R) to ψ +
arccos(k/R), k = -L - c, or the rest of the circle, k = L - c; both ends are ``turns(a, b, k, 1)``. Where both have ends
the set is two arcs, between an end of the one and an end of the other on each side of ψ.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import combinations
from typing import TypeVar

from bezier.proofs import square_roots as sr
from bezier.proofs.arm_rows import Box, read_joint, read_number
from bezier.proofs.nested_roots import JointValue, Nested, Place, nested, turns
from bezier.proofs.square_roots import ONE, Interval, Polynomial
from qe.options import Budget
from qe.proof.entry import Entry

Arc = tuple[JointValue, JointValue]
"""All angles from one on the way round to the other, both included; one angle where they are the same object."""
Arcs = tuple[Arc, ...] | None
"""None: the whole circle."""


@dataclass(frozen=True)
class Position:
    """What the joints are, None where one is free; ``chosen``: the joints that can be chosen, independently of each
    other, and exactly which of their values the others can follow."""

    joints: Sequence[JointValue | None]
    chosen: dict[int, Arcs] = field(default_factory=dict)

    @property
    def backwards(self) -> Position:
        """The same of the arm read from the hand to the base: all joints turn the other way."""
        last = len(self.joints) - 1
        chosen = {
            last - k: None if arcs is None else tuple((opposite[high], opposite[low]) for low, high in arcs)
            for k, arcs in self.chosen.items()
            for opposite in [{end: _opposite(end) for arc in arcs or () for end in arc}]
        }
        return Position([None if j is None else _opposite(j) for j in self.joints[::-1]], chosen)


def _opposite(joint: JointValue) -> JointValue:
    return JointValue(joint.c, None if joint.s is None else -joint.s, joint.w)


def bounded(a: Nested, b: Nested, c: Nested, square: Nested) -> Arcs:
    """The θ with |a cos θ + b sin θ + c| <= L, L² = ``square`` > 0."""
    reach, one = max(square.square_roots(), key=Nested.sign), square.unit
    if not (a * a + b * b).sign():
        return None if (square - c * c).sign() >= 0 else ()
    top, bottom = reach - c, -reach - c
    high, low = list(turns(a, b, top, one)), list(turns(a, b, bottom, one))
    if (not high and top.sign() < 0) or (not low and bottom.sign() > 0):
        return ()
    if len(high) == 1 and top.sign() < 0:
        return ((high[0], high[0]),)
    if len(low) == 1 and bottom.sign() > 0:
        return ((low[0], low[0]),)
    if len(high) < 2:
        return None if len(low) < 2 else ((low[0], low[1]),)
    return ((high[1], high[0]),) if len(low) < 2 else ((high[1], low[1]), (low[0], high[0]))


def not_negative(p: Polynomial, third: Sequence[Polynomial], norm: Polynomial, marks: Entry, budget: Budget) -> Arcs:
    """The angles with cosine and sine ``third`` over ``norm`` at whose t the polynomial is not negative. ``marks``:
    intervals of t in ascending order, one around each of its roots; the angle that t misses is no root."""
    between = list[Interval]()
    for entry in marks.items():
        budget.check()
        low, high = entry.row("low", "high")
        between.append(ascending(entry, low, high, between[-1] if between else None))
        if not (all(p.at(x) for x in between[-1]) and sr.tarski(p, Polynomial((ONE,)), between[-1]) == 1):
            raise entry.fail("expected exactly one root in the interval")
    if len(p) > 1 and len(between) != sr.tarski(p, Polynomial((ONE,))):
        raise marks.fail("not all roots are listed")
    return arcs_over(p, third, norm, [Place.of(p, x) for x in between])


def arcs_over(p: Polynomial, third: Sequence[Polynomial], norm: Polynomial, places: Sequence[Place]) -> Arcs:
    """``not_negative``, by all roots in ascending order."""
    if not places:
        return None if p[0].sign() > 0 else ()
    c, s, w = ([nested(place.value(v)) for place in places] for v in (*third, norm))
    ends = list(map(JointValue, c, s, w))
    return arcs_of(ends, [True] * len(ends), [p.at(place.between[1]).sign() > 0 for place in places])


End = TypeVar("End")


def arcs_of(marks: Sequence[End], at: Sequence[bool], after: Sequence[bool]) -> tuple[tuple[End, End], ...] | None:
    """The closed set of angles that has marks, the way round, where ``at`` says so, and what lies after one, where
    ``after`` does; None for the whole circle, if marks there are."""
    if all(after):
        return None
    result, n = list[tuple[End, End]](), len(marks)
    for i in range(n):
        if at[i] and not after[i - 1]:
            j = next(j for j in range(i, i + n) if not after[j % n])
            result.append((marks[i], marks[j % n]))
    return tuple(result)


def ascending(entry: Entry, low: Entry, high: Entry, last: Interval | None) -> Interval:
    """An interval above the last one."""
    result = read_number(low), read_number(high)
    if not result[0] < result[1] or (last is not None and result[0] <= last[1]):
        raise entry.fail("expected intervals in ascending order")
    return result


# --- what a certificate lists --------------------------------------------------------------------------------------
@dataclass(frozen=True)
class Listed:
    """Boxes for the joints of a position or a family, None where one is free, and the ends of what can be chosen."""

    boxes: tuple[Box | None, ...]
    chosen: dict[int, tuple[tuple[Box, Box], ...] | None]

    def holds(self, position: Position) -> bool:
        """Whether the position, or the family, is proved to be this one."""
        if self.chosen.keys() != position.chosen.keys():
            return False
        pairs = list(zip(self.boxes, position.joints, strict=True))
        if not all(_holds(box, joint) for box, joint in pairs):
            return False
        return all(_same(arcs, position.chosen[k]) for k, arcs in self.chosen.items())

    def meets(self, other: Listed) -> bool:
        """Whether the boxes of two have a point in common; where a joint is free in one it tells nothing."""
        pairs = zip(self.boxes, other.boxes, strict=True)
        return all(_meet(a, b) for a, b in pairs if a is not None and b is not None)


def _holds(box: Box | None, joint: JointValue | None) -> bool:
    if box is None or joint is None:
        return box is None and joint is None
    ends = joint.intervals() or []
    return len(ends) == len(box) and all(a <= c and d <= b for (a, b), (c, d) in zip(box, ends, strict=True))


def _same(listed: tuple[tuple[Box, Box], ...] | None, arcs: Arcs) -> bool:
    if listed is None or arcs is None:
        return listed is None and arcs is None
    rest = list(listed)
    for low, high in arcs:
        found = next((ends for ends in rest if _holds(ends[0], low) and _holds(ends[1], high)), None)
        if found is None or (found[0] == found[1]) != (low is high):
            return False
        rest.remove(found)
    return not rest


def read_listed(entry: Entry, turning: tuple[bool, ...]) -> Listed:
    """A list with a box for every joint; or ``box``, with null for joints that are free, and ``chosen``: for joints by
    their numbers, from 0 on, null or the ends of arcs."""
    if not isinstance(entry.value, dict):
        return Listed(_boxes(entry, turning), {})
    box, chosen = entry.fields("box", "chosen")
    result: dict[int, tuple[tuple[Box, Box], ...] | None] = {}
    for item in chosen.items():
        number, arcs = item.row("joint", "arcs")
        k = number.integer(0)
        if k >= len(turning) or k in result:
            raise number.fail("expected the number of a joint, each once")
        result[k] = None if arcs.value is None else _arcs(arcs, turning[k])
    boxes = _boxes(box, turning)
    if not result or any(boxes[k] is not None for k in result):
        raise chosen.fail("expected joints that are free")
    return Listed(boxes, result)


def _boxes(entry: Entry, turning: tuple[bool, ...]) -> tuple[Box | None, ...]:
    joints = list(entry.items())
    if len(joints) != len(turning):
        raise entry.fail(f"expected {len(turning)} joints")
    return tuple(None if j.value is None else read_joint(j, t) for j, t in zip(joints, turning, strict=True))


def _arcs(entry: Entry, turning: bool) -> tuple[tuple[Box, Box], ...]:
    """The ends of arcs, in boxes that do not meet, so that it is clear which of them is where."""
    result = list[tuple[Box, Box]]()
    for arc in entry.items():
        low, high = (read_joint(end, turning) for end in arc.row("low", "high"))
        result.append((low, high))
    disjoint = [box for low, high in result for box in ([low] if low == high else [low, high])]
    if any(_meet(a, b) for a, b in combinations(disjoint, 2)):
        raise entry.fail("two ends are not separated")
    return tuple(result)


def _meet(a: Box, b: Box) -> bool:
    return all(max(x[0], y[0]) <= min(x[1], y[1]) for x, y in zip(a, b, strict=True))
