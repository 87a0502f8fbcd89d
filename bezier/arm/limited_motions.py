"""Which of all continuous motions along a path (``bezier.arm.continuous``) keep the limits of the joints for every s.

Between neighbouring parameters of ``Study.within`` no solution passes a limit, so one rational parameter decides for
each arc; what a motion keeps on both sides of a parameter it keeps there, as it is continuous and limits are closed:
also where solutions meet and on the axis. THEOREM. Intervals [L, U] + 2πk are disjoint if U - L < 2π: then a continuous
angle that always lies in one of them, k any integer, always lies in the same one. For limits further apart the
parameters hold those at which the angle is a multiple of a quarter turn. So it stays on one of these or strictly
between two neighbours, and the closures of what it takes before and after a parameter meet: that counts full turns.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import tau

from bezier.arm.choices import Edge, Exact, full_turns, side
from bezier.arm.continuous import ContinuousMotion, ContinuousMotions
from bezier.arm.follow import Branch
from bezier.arm.inverse import Solution, solve
from bezier.arm.model import Arm, Joint, JointKind
from bezier.arm.study import Place, Stretch, Study, is_wide, sample_between
from bezier.arm.vertical import vertical_arm
from bezier.proofs.joint_motions import Label
from qe.errors import InternalError, Unable

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
    result = []
    for k, joint in enumerate(arm.joints):
        if joint.limits is None or joint.motion is JointKind.PRISMATIC:
            result.append(0)
            continue
        values = [v[k] for _, branch in parts for p in branch.pieces for v in (p.near(p.low), p.near(p.high))]
        result.append(round((float(sum(joint.limits)) - max(values) - min(values)) / 2 / tau))
    return tuple(result)


def excesses(arm: Arm, studies: Sequence[Study], parts: Parts, turns: Sequence[int]) -> tuple[Excess, ...]:
    """Where the motion, so many full turns added, is beyond a limit."""
    return joined(_judged(arm, studies, parts, turns))


Judged = tuple[int, Place, Place, list[tuple[Joint, Fraction]]]


def joined(judged: Iterable[Judged]) -> tuple[Excess, ...]:
    """Of the limits that are broken in stretches (curve, low, high) one after another; neighbours as one."""
    result = list[Excess]()
    for curve, low, high, broken in judged:
        for joint, limit in broken:
            at = (curve, joint, limit, low)
            before = next((e for e in result if (e.curve, e.joint, e.limit, e.high) == at), None)
            if before is not None:
                result.remove(before)
            result.append(Excess(curve, joint, limit, low if before is None else before.low, high))
    return tuple(result)


def _judged(arm: Arm, studies: Sequence[Study], parts: Parts, turns: Sequence[int]) -> Iterator[Judged]:
    """Every stretch that the branches take a part of, with the limits that they break there."""
    for curve, branch in parts:
        study = studies[curve]
        for part in study.within:
            s = sample_between(part.low, part.high, (branch.low, branch.high))
            if s is None:
                continue
            (solution,) = (x for x in solve(arm, study.curve.point(s)).solutions if branch.contains(s, x))
            yield curve, part.low, part.high, list(_broken_at(arm, solution, branch.at(s), turns))


def _broken_at(
    arm: Arm, solution: Solution, near: Sequence[float], turns: Sequence[int]
) -> Iterator[tuple[Joint, Fraction]]:
    for joint, exact, value, close, more in zip(arm.joints, solution.exact, solution.values, near, turns, strict=True):
        assert exact is not None and value is not None, "a branch determines every joint"
        around = more if value.pair is None else round((close - float(value)) / tau) + more
        for limit, wrong in zip(joint.limits or (), (-1, 1), strict=False):
            if Edge(exact, around).side(limit, joint.motion, 0) == wrong:
                yield joint, limit


SECTORS = {(1, 0): 0, (1, 1): 1, (0, 1): 2, (-1, 1): 3, (-1, 0): 4, (-1, -1): -3, (0, -1): -2, (1, -1): -1}
"""The angle in (-π, π] in eighths of a turn by the signs of cosine and sine; odd: strictly between two quarters."""


@dataclass(frozen=True, slots=True)
class Reading:
    """A joint of one solution in a stretch: by how many full turns, ``least`` to ``most``, it is moved between its
    limits (never if least > most)."""

    least: int
    most: int
    sector: int | None
    """Where its turns are counted."""
    value: float
    """About its value."""


@dataclass(frozen=True, slots=True)
class Wound:
    """A joint on its way: the full turns that it has made since the start, and by how many, ``least`` to ``most``, all
    of its motion so far is moved between its limits."""

    sector: int | None
    turns: int
    least: int
    most: int

    @staticmethod
    def after(before: Wound | None, reading: Reading) -> Wound:
        """At the next reading."""
        if before is None:
            return Wound(reading.sector, 0, reading.least, reading.most)
        turns = before.turns
        if before.sector is not None and reading.sector is not None:
            step = reading.sector - before.sector
            if 2 < abs(step) < 6:
                raise InternalError("a continuous angle jumps by more than a quarter turn")
            turns += (step < -2) - (step > 2)
        least, most = max(before.least, reading.least - turns), min(before.most, reading.most - turns)
        return Wound(reading.sector, turns, least, most)


State = tuple[Wound, ...]


@dataclass(frozen=True, slots=True)
class Part:
    """A stretch of ``Study.within`` on an arc, with the readings of all joints by the labels of the solutions."""

    curve: int
    arcs: int
    stretch: Stretch
    readings: Mapping[Label, tuple[Reading, ...]]


@dataclass(frozen=True, slots=True)
class Kept:
    """``excesses``: where a motion is beyond a limit; ``begin``: for each joint with limits about where it begins,
    or, where turns are not counted, the middle of its limits."""

    excesses: tuple[Excess, ...]
    begin: tuple[float | None, ...]


@dataclass(frozen=True, eq=False)
class LimitedMotions:
    """``count``: of all motions that keep the limits; ``listed``: the motions that are listed, by their numbers."""

    count: int
    listed: Mapping[int, Kept]

    @staticmethod
    def of(motions: ContinuousMotions, studies: Sequence[Study]) -> LimitedMotions:
        """Raises ``Unable`` where an angle is not separated from a limit."""
        if not motions.arm.has_limits:
            return LimitedMotions(motions.count, {m.number: Kept((), (None,) * 3) for m in motions.motions})
        parts = list(_parts(motions, studies))
        return LimitedMotions(_count(motions, parts), {m.number: _kept(motions.arm, parts, m) for m in motions.motions})


def _parts(motions: ContinuousMotions, studies: Sequence[Study]) -> Iterator[Part]:
    plane = vertical_arm(motions.arm)
    assert plane is not None, "only such arms have arcs"
    for curve, study in enumerate(studies):
        here = [k for k, a in enumerate(motions.arcs) if a.curve == curve]
        for stretch in study.within:
            (arcs,) = (k for k in here if motions.arcs[k].low < stretch.sample < motions.arcs[k].high)
            result = solve(motions.arm, study.curve.point(stretch.sample)).solutions
            yield Part(curve, arcs, stretch, {plane.label(x): _readings(motions.arm, x) for x in result})


def _count(motions: ContinuousMotions, parts: Sequence[Part]) -> int:
    """How many chains of arcs keep the limits; those that are alike so far are counted together."""
    states = Counter[tuple[Label, State]]()
    for k, part in enumerate(parts):
        after = Counter[tuple[Label, State]]()
        for label, readings in part.readings.items():
            if k == 0:
                after[label, tuple(Wound.after(None, r) for r in readings)] += 1
            for (one, state), ways in states.items():
                if part.arcs == parts[k - 1].arcs:
                    goes_on = one == label
                else:
                    goes_on = (one, label) in motions.junctions[part.arcs - 1].passes
                if goes_on:
                    after[label, tuple(map(Wound.after, state, readings))] += ways
        states = Counter({key: n for key, n in after.items() if all(w.least <= w.most for w in key[1])})
    return states.total()


def _kept(arm: Arm, parts: Sequence[Part], motion: ContinuousMotion) -> Kept:
    """One motion, moved by the full turns that suit it best."""
    readings = [part.readings[motion.labels[part.arcs]] for part in parts]
    states: list[State] = [tuple(Wound.after(None, r) for r in readings[0])]
    for row in readings[1:]:
        states.append(tuple(map(Wound.after, states[-1], row)))
    moved = [0 if w.sector is None else (w.least + w.most) // 2 for w in states[-1]]
    judged = [
        (p.curve, p.stretch.low, p.stretch.high, list(_broken(arm, row, state, moved)))
        for p, row, state in zip(parts, readings, states, strict=True)
    ]
    begin = [
        None
        if joint.limits is None or joint.motion is JointKind.PRISMATIC
        else float(sum(joint.limits)) / 2
        if r.sector is None
        else r.value + tau * k
        for joint, r, k in zip(arm.joints, readings[0], moved, strict=True)
    ]
    return Kept(joined(judged), tuple(begin))


def _broken(
    arm: Arm, readings: Sequence[Reading], state: State, moved: Sequence[int]
) -> Iterator[tuple[Joint, Fraction]]:
    for joint, reading, wound, more in zip(arm.joints, readings, state, moved, strict=True):
        turns = wound.turns + more
        if joint.limits is not None and not reading.least <= turns <= reading.most:
            yield joint, joint.limits[turns >= reading.least]


def _readings(arm: Arm, solution: Solution) -> tuple[Reading, ...]:
    result = []
    for joint, exact, value in zip(arm.joints, solution.exact, solution.values, strict=True):
        assert exact is not None and value is not None, "between special parameters every joint is determined"
        result.append(_reading(joint, exact, float(value)))
    return tuple(result)


def _reading(joint: Joint, exact: Exact, value: float) -> Reading:
    if joint.limits is None:
        return Reading(0, 0, None, value)
    low, high = joint.limits
    if joint.motion is JointKind.PRISMATIC:
        is_below, is_above = exact.length_side(low) < 0, exact.length_side(high) > 0
        return Reading(int(is_below), -int(is_above), None, value)
    listed = full_turns(joint.limits)
    least = next(k for k in listed if side(exact, k, low) >= 0)
    most = next(k for k in reversed(listed) if side(exact, k, high) <= 0)
    if is_wide(joint):
        sector = SECTORS[exact.sign(exact.joint.c), exact.sign(exact.joint.s)]
        if sector * value < 0:
            raise Unable("an angle is too close to half a turn to count its turns")
        return Reading(least, most, sector, value)
    is_nearer_below = float(low) - value - tau * most < value + tau * least - float(high)
    turns = most if least > most and is_nearer_below else least
    return Reading(least - turns, most - turns, None, value)
