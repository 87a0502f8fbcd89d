"""Joint sequences: one joint position for each sample of a path, with the least total joint change.

A layered graph: one layer for each sample, one node for each solution within the limits of the joints, edges between
neighbouring layers weighted by the sum of the angle differences on the circle (arXiv 2412.18294, section 4), of a joint
that slides by its way in units of ``SLIDE``; a shortest path through it. On the axis of the first joint its angle is
free: there the angles of the neighbouring layers are offered.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import tau

from bezier.arm.choices import spans
from bezier.arm.follow import Branch
from bezier.arm.inverse import Solution, solve
from bezier.arm.joint_path import JointPath
from bezier.arm.kinematics import wrapped
from bezier.arm.model import Arm, JointKind
from bezier.motion.timelaw import TimeLaw
from qe.errors import InputError, Unable

MOST_SAMPLES = 5_000
UNIT = 1 << 32
SLIDE = 100.0
"""The way (mm) of a joint that slides that counts as much as one rad of one that turns."""

FAR = 1.0
"""Solutions further from the middle of a box than this (rad, sum of the joints) do not lie in it: boxes are small."""


@dataclass(frozen=True, slots=True)
class Sample:
    """A moment: the share ``tau`` of the time, the curve by its index, and the parameter on it."""

    tau: Fraction
    curve: int
    s: Fraction


@dataclass(frozen=True, slots=True)
class Stand:
    """A joint position offered for a sample (rad); ``runs``: the continuous motions that it belongs to."""

    angles: tuple[float, ...]
    runs: frozenset[int]


@dataclass(frozen=True, slots=True)
class Switch:
    """Between these samples the sequence leaves one continuous motion for another: the arm would have to jump."""

    before: Sample
    after: Sample
    change: float


@dataclass(frozen=True, slots=True)
class JointSequence:
    """The joint angles (rad, without jumps by full turns) at every sample; ``change``: the sum of all angle
    differences.

    ``run``: the number of the continuous motion kept throughout, None where there are ``switches``.
    """

    samples: tuple[Sample, ...]
    angles: tuple[tuple[float, ...], ...]
    change: float
    run: int | None
    switches: tuple[Switch, ...]


def samples_of(ends: Sequence[Fraction], law: TimeLaw, count: int) -> list[Sample]:
    """``count`` moments at equal steps of time. ``ends``: the share of the law's path at which each curve ends.

    The parameters are the law's to within 2^-33: short numbers, which the points of the path are exact for.
    """
    if not 2 <= count <= MOST_SAMPLES:
        raise InputError(f"samples: 2 to {MOST_SAMPLES} expected, {count} found")
    result = []
    for k in range(count):
        tau = Fraction(k, count - 1)
        share = law.derivatives(tau)[0]
        curve = next(i for i, end in enumerate(ends) if share <= end)
        begin = ends[curve - 1] if curve else 0
        result.append(Sample(tau, curve, Fraction(round((share - begin) / (ends[curve] - begin) * UNIT), UNIT)))
    return result


def joint_sequence(joint_path_: JointPath, samples: Sequence[Sample]) -> JointSequence:
    """The sequence of least total change. Raises ``Unable`` where a sample has no joint position within the limits."""
    arm = joint_path_.arm
    layers = list(_layers(joint_path_, samples))
    costs, links = [0.0] * len(layers[0]), list[list[int]]()
    for near, far in pairwise(layers):
        ways = [[cost + _distance(arm, a.angles, b.angles) for cost, a in zip(costs, near, strict=True)] for b in far]
        costs = list(map(min, ways))
        links.append([way.index(cost) for way, cost in zip(ways, costs, strict=True)])
    k = costs.index(min(costs))
    numbers = [k, *(k := link[k] for link in reversed(links))]
    stands = [layer[i] for layer, i in zip(layers, reversed(numbers), strict=True)]
    change = sum(_distance(arm, a.angles, b.angles) for a, b in pairwise(stands))
    run, switches = _kept(arm, stands, samples)
    begin = _between_limits(joint_path_, stands[0], samples[0], run)
    return JointSequence(tuple(samples), _unrolled(arm, stands, begin), change, run, switches)


def _layers(path: JointPath, samples: Sequence[Sample]) -> Iterator[list[Stand]]:
    curves = list(path.curves.values())
    # where some motions pass a limit and others do not, a sequence that keeps the limits is wanted
    kept = path.kept_numbers if path.excesses else frozenset[int]()
    solved = []
    for sample in samples:
        solved.append([s for s in solve(path.arm, curves[sample.curve].point(sample.s)).solutions if s.allowed])
    for k, (sample, solutions) in enumerate(zip(samples, solved, strict=True)):
        under_way = ((run.number, run.branch(sample.curve)) for run in path.runs)
        places = [(n, b, b.at(sample.s)) for n, b in under_way if b is not None and b.low <= sample.s <= b.high]
        around = [a for other in solved[max(k - 1, 0) : k + 2] for s in other if (a := s.angles[0]) is not None]
        taken = [(_runs(path, places, (sample.curve, sample.s), solution), solution) for solution in solutions]
        stands = [
            Stand(angles, runs & kept if kept else runs)
            for runs, solution in taken
            if runs & kept or not kept
            for angles in _offered(path.arm, solution, around)
        ]
        if not stands:
            where = f"s = {float(sample.s):.6g} of curve {sample.curve + 1}"
            raise Unable(f"no joint position within the limits at {where}")
        yield stands


def _offered(arm: Arm, solution: Solution, around: list[float]) -> Iterator[tuple[float, ...]]:
    """The angles of a solution; where joints can be chosen, for the first one those of the neighbours, which keep its
    limits, and the middle of the first range that its limits leave for all others; 0 where that has no ends, and of a
    joint that follows another one."""
    middles = dict[int, float]()
    for choice in solution.choices:
        low, high = (edge.value for edge in spans(arm.joints[choice.joint], choice)[0])
        middles[choice.joint] = 0.0 if low is None or high is None else (low + high) / 2
    first, *rest = (middles.get(k, 0.0) if a is None else a for k, a in enumerate(solution.angles))
    for angle in dict.fromkeys(around) if solution.angles[0] is None and around else [first]:
        yield (angle, *rest)


def _runs(
    path: JointPath,
    places: Sequence[tuple[int, Branch, tuple[float, ...]]],
    at: tuple[int, Fraction],
    solution: Solution,
) -> frozenset[int]:
    curve, s = at
    angles = [a for a in solution.angles if a is not None]
    motions = frozenset[int]()
    if path.motions is not None and len(path.covering_runs) < path.motions.count:  # else boxes tell, in less time
        motions = path.motions.taken(curve, s, solution)
    if len(angles) < len(solution.angles):  # the axis: every motion passes there, or stops
        return motions if path.motions is not None else frozenset(run.number for run in path.runs)
    return motions | frozenset(
        number
        for number, branch, near in places
        if _distance(path.arm, angles, near) < FAR and branch.contains(s, solution)
    )


def _steps(arm: Arm, a: Sequence[float], b: Sequence[float]) -> list[float]:
    """From a to b, the shorter way round where a joint turns."""
    return [
        wrapped(y - x) if j.motion is JointKind.REVOLUTE else y - x for x, y, j in zip(a, b, arm.joints, strict=True)
    ]


def _distance(arm: Arm, a: Sequence[float], b: Sequence[float]) -> float:
    parts = zip(_steps(arm, a, b), arm.joints, strict=True)
    return sum(abs(step) if joint.motion is JointKind.REVOLUTE else abs(step) / SLIDE for step, joint in parts)


def _between_limits(path: JointPath, stand: Stand, sample: Sample, number: int | None) -> tuple[float, ...]:
    """The first angles, by full turns where the motion that is kept keeps the limits."""
    if path.limited is not None and number is not None and number in path.limited.listed:
        begin = zip(stand.angles, path.limited.listed[number].begin, strict=True)
        return tuple(a if near is None else near + wrapped(a - near) for a, near in begin)
    run = next((run for run in path.runs if run.number == number and run.turns), None)
    branch = None if run is None else run.branch(sample.curve)
    if run is None or branch is None or not branch.low <= sample.s <= branch.high:
        return stand.angles
    near = zip(stand.angles, branch.at(sample.s), run.turns, path.arm.joints, strict=True)
    return tuple(
        angle + tau * (round((close - angle) / tau) + turns) if joint.motion is JointKind.REVOLUTE else angle
        for angle, close, turns, joint in near
    )


def _unrolled(arm: Arm, stands: Sequence[Stand], begin: tuple[float, ...]) -> tuple[tuple[float, ...], ...]:
    """The angles with full turns added, so that no angle moves by more than half a turn between two samples."""
    result = [begin]
    for stand in stands[1:]:
        last = result[-1]
        result.append(tuple(x + step for x, step in zip(last, _steps(arm, last, stand.angles), strict=True)))
    return tuple(result)


def _kept(arm: Arm, stands: Sequence[Stand], samples: Sequence[Sample]) -> tuple[int | None, tuple[Switch, ...]]:
    """The motion kept from start to end, or the places where one has to be left for another."""
    switches, now = [], stands[0].runs
    for k in range(1, len(stands)):
        both = now & stands[k].runs
        if not both:
            change = _distance(arm, stands[k - 1].angles, stands[k].angles)
            switches.append(Switch(samples[k - 1], samples[k], change))
        now = both or stands[k].runs
    return (min(now, default=None) if not switches else None), tuple(switches)
