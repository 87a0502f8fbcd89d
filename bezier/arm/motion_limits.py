"""Whether a continuous joint motion keeps the limits of the joints, exactly, and where it does not.

Between neighbouring ``places`` of a curve (``bezier.arm.limit_places``) no solution passes a limit: so one rational
parameter decides for all. Where a motion keeps a limit on both sides of a place it keeps it there, as limits are
closed. An angle counts with its full turns: all of a motion may be some turns away from its branches.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import tau

from bezier.arm.follow import Branch
from bezier.arm.inverse import Solution, solve
from bezier.arm.limit_places import Place, sample_between
from bezier.arm.limits import length_side, side
from bezier.arm.model import Arm, Joint, Motion
from bezier.arm.study import Study

Parts = Sequence[tuple[int, Branch]]


@dataclass(frozen=True, slots=True)
class Excess:
    """``joint`` is beyond a limit for all s between two parameters of a curve, given by its index."""

    curve: int
    joint: Joint
    limit: Fraction
    low: Place
    high: Place


def turns_of(arm: Arm, parts: Parts) -> tuple[int, ...]:
    """For each joint, by how many full turns its whole motion is best moved to lie between its limits."""
    found = []
    for k, joint in enumerate(arm.joints):
        if joint.limits is None or joint.motion is Motion.PRISMATIC:
            found.append(0)
            continue
        values = [v[k] for _, branch in parts for p in branch.pieces for v in (p.near(p.low), p.near(p.high))]
        found.append(round((float(sum(joint.limits)) - max(values) - min(values)) / 2 / tau))
    return tuple(found)


def excesses(arm: Arm, studies: Sequence[Study], parts: Parts, turns: Sequence[int]) -> tuple[Excess, ...]:
    """Where the motion, so many full turns added, is beyond a limit."""
    return joined(_judged(arm, studies, parts, turns))


Judged = tuple[int, Place, Place, list[tuple[Joint, Fraction]]]


def joined(judged: Iterable[Judged]) -> tuple[Excess, ...]:
    """Of the limits that are broken in stretches (curve, low, high) one after another; neighbours as one."""
    found = list[Excess]()
    for curve, low, high, broken in judged:
        for joint, limit in broken:
            before = next((e for e in found if (e.curve, e.joint, e.limit, e.high) == (curve, joint, limit, low)), None)
            if before is not None:
                found.remove(before)
            found.append(Excess(curve, joint, limit, low if before is None else before.low, high))
    return tuple(found)


def _judged(arm: Arm, studies: Sequence[Study], parts: Parts, turns: Sequence[int]) -> Iterator[Judged]:
    """Every stretch that the branches take a part of, with the limits that they break there."""
    for curve, branch in parts:
        study = studies[curve]
        for part in study.within:
            s = sample_between(part.low, part.high, (branch.low, branch.high))
            if s is None:
                continue
            (solution,) = (x for x in solve(arm, study.curve.point(s)).solutions if branch.contains(s, x))
            yield curve, part.low, part.high, list(_broken(arm, solution, branch.at(s), turns))


def _broken(
    arm: Arm, solution: Solution, near: Sequence[float], turns: Sequence[int]
) -> Iterator[tuple[Joint, Fraction]]:
    for joint, known, value, close, more in zip(
        arm.joints, solution.quotients, solution.values, near, turns, strict=True
    ):
        assert known is not None and value is not None, "a branch determines every joint"
        around = more if value.pair is None else round((close - float(value)) / tau) + more
        for limit, wanted in zip(joint.limits or (), (1, -1), strict=False):
            if joint.motion is Motion.PRISMATIC:
                here = length_side(solution.place, known[0], limit)
            else:
                here = side(solution.place, known, around, limit)
            if here == -wanted:
                yield joint, limit
