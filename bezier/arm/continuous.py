"""All continuous joint motions along a path, counted exactly, also through the places where solutions meet.

For arms with a plane that turns (``bezier.arm.vertical``), by the theorem of the rule "joint motions":
between neighbouring zeros of W and of N = Q(√W) Q(-√W) along a curve the solutions are
as many arcs, and a motion goes on from an arc to another one iff both have the same limit between them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise

from bezier.arm.critical import Number
from bezier.arm.inverse import Solution, solve
from bezier.arm.model import Arm
from bezier.arm.vertical import SignsAlong, vertical_arm
from bezier.curves.curve import Bezier
from bezier.proofs.joint_motions import Between, Label, joined
from qe.errors import InternalError
from qe.exact.nearby import rational_between
from qe.proof.entry import Entry

MOST_LISTED = 64
"""Motions that are listed; all are counted."""


@dataclass(frozen=True, slots=True)
class Arcs:
    """The solutions over an open interval of a curve, by their labels in the order of ``solutions`` at ``sample``."""

    curve: int
    low: Number
    high: Number
    sample: Fraction
    labels: tuple[Label, ...]
    solutions: tuple[Solution, ...]


@dataclass(frozen=True, slots=True)
class Junction:
    """Between two neighbours in the list of ``Arcs``, at ``s`` of a curve (its end, where a next one begins)."""

    curve: int
    s: Number
    passes: frozenset[tuple[Label, Label]]
    """The pairs of labels before and after whose solutions have the same limit."""
    on_axis: bool
    """Whether that is on the axis of the first joint."""
    meets: bool
    """Whether solutions before or after it meet there."""


@dataclass(frozen=True, slots=True)
class ContinuousMotion:
    """A continuous joint motion from start to goal: the label of its arc in each interval."""

    number: int
    labels: tuple[Label, ...]


@dataclass(frozen=True, eq=False)
class ContinuousMotions:
    """The arcs in the order of the path, with the junction between each two. ``count``: of all continuous motions from
    start to goal, limits of the joints left aside."""

    arm: Arm
    curves: tuple[SignsAlong, ...]
    arcs: tuple[Arcs, ...]
    junctions: tuple[Junction, ...]

    @cached_property
    def count(self) -> int:
        """The number of chains."""
        return sum(self._onward[0].values())

    @cached_property
    def _onward(self) -> list[dict[Label, int]]:
        """For each interval: in how many ways each arc goes on to the goal."""
        result = [dict.fromkeys(self.arcs[-1].labels, 1)]
        for arcs, junction in zip(self.arcs[-2::-1], self.junctions[::-1], strict=True):
            after = result[-1]
            result.append(
                {one: sum(n for other, n in after.items() if (one, other) in junction.passes) for one in arcs.labels}
            )
        return result[::-1]

    @cached_property
    def motions(self) -> tuple[ContinuousMotion, ...]:
        """The motions, if they are not more than ``MOST_LISTED``; else as many of them."""
        chains = (chain for _, chain in zip(range(MOST_LISTED), self._chains(()), strict=False))
        return tuple(ContinuousMotion(k, chain) for k, chain in enumerate(chains, start=1))

    def _chains(self, begun: tuple[Label, ...]) -> Iterator[tuple[Label, ...]]:
        k = len(begun)
        if k == len(self.arcs):
            yield begun
            return
        for label, ways in self._onward[k].items():
            if ways and (not begun or (begun[-1], label) in self.junctions[k - 1].passes):
                yield from self._chains((*begun, label))

    def taken(self, curve: int, s: Fraction, solution: Solution) -> frozenset[int]:
        """The numbers of the motions that take this solution (found by ``solve``) at s."""
        plane = vertical_arm(self.arm)
        assert plane is not None, "only such arms have arcs"
        label = plane.label(solution)
        here = [k for k, a in enumerate(self.arcs) if a.curve == curve and a.low <= s <= a.high]
        pairs = ((m.number, zip(label, m.labels[k], strict=True)) for m in self.motions for k in here)
        return frozenset(number for number, sides in pairs if all(0 in (a, b) or a == b for a, b in sides))


def continuous_motions(arm: Arm, curves: Mapping[str, Bezier]) -> ContinuousMotions | None:
    """All continuous motions along a path, or None for arms without such a plane.

    Raises ``Unable`` where a whole curve is on the axis or along a border, or where the second joint is free.
    """
    plane = vertical_arm(arm)
    if plane is None:
        return None
    listed = [SignsAlong.of(plane, curve) for curve in curves.values()]
    arcs, junctions = list[Arcs](), list[Junction]()
    for k, along in enumerate(listed):
        places = along.places
        marks: list[Number] = [Fraction(0), *(s for s in places if 0 < s < 1), Fraction(1)]
        for i, (low, high) in enumerate(pairwise(marks)):
            arcs.append(_arcs(along, k, low, high))
            if len(arcs) > 1:
                before = (listed[k - 1], Fraction(1)) if i == 0 else (along, low)
                junctions.append(_junction(before, along, *arcs[-2:]))
    return ContinuousMotions(arm, tuple(listed), tuple(arcs), tuple(junctions))


def _arcs(along: SignsAlong, curve: int, low: Number, high: Number) -> Arcs:
    sample = rational_between(low, high)
    result = solve(along.arm.geometry.arm, along.curve.point(sample)).solutions
    labels = tuple(along.arm.label(solution) for solution in result)
    if len(set(labels)) != len(labels) or set(labels) != {*along.signs.labels(sample)}:
        raise InternalError("the solutions of an arm contradict the signs that distinguish them")
    return Arcs(curve, low, high, sample, labels, result)


def _junction(before: tuple[SignsAlong, Number], after: SignsAlong, one: Arcs, other: Arcs) -> Junction:
    along, s = before
    between = along.between(s) if s in along.places else Between(False, frozenset(), 1)
    if along is not after:
        between = joined(along.signs, after.signs, Entry(None, "the next curve"))
    plane = along.arm.plane
    passes = frozenset((a, b) for a in one.labels for b in other.labels if between.goes_on(plane, a, b))
    on_axis = between.vanishes and not plane.offset
    return Junction(one.curve, s, passes, on_axis, bool(between.empty) or (between.vanishes and not on_axis))
