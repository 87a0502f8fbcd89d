"""A path of several curves for an arm: what is proved about each curve, its continuous motions, and the branches that
run through all of it.

A *run* is one continuous joint motion: branches of neighbouring curves that are proved to be joined. It begins at the
start or where solutions come into being, and ends at the goal or where they meet and vanish or the arm is singular.
Runs are what boxes hold, with bounds of the velocities; how many continuous motions there are is decided exactly
(``bezier.arm.continuous``), also where boxes give up.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from itertools import count, pairwise

from bezier.arm.continuous import Arcs, ContinuousMotions, continuous_motions
from bezier.arm.follow import ONE, ZERO, Branch, follow, joined, whole
from bezier.arm.inverse import solve
from bezier.arm.limited_motions import Excess, LimitedMotions, excesses, turns_of
from bezier.arm.model import Arm
from bezier.arm.study import Near, Study, ends_of, study
from bezier.arm.vertical import VerticalArm, vertical_arm
from bezier.curves.curve import Bezier
from bezier.curves.scalar import same
from bezier.proofs.joint_motions import Label
from qe.errors import BudgetExceeded, InputError, Unable


@dataclass(frozen=True, slots=True)
class Run:
    """One continuous joint motion: (index of the curve, branch), in order. ``number`` names it, from 1."""

    number: int
    parts: tuple[tuple[int, Branch], ...]
    turns: tuple[int, ...] = ()
    """Full turns of each joint that are added to the branches."""
    excesses: tuple[Excess, ...] = ()
    """Where it is then beyond a limit."""

    def branch(self, curve: int) -> Branch | None:
        """Its branch on a curve."""
        return next((branch for k, branch in self.parts if k == curve), None)

    def covers(self, curves: int) -> bool:
        """Whether it goes from the start to the goal of a path of so many curves."""
        whole_ones = [k for k, b in self.parts if b.low == ZERO and b.high == ONE]
        return whole_ones == list(range(curves))


@dataclass(frozen=True, eq=False)
class JointPath:
    """The curves of a path by name, the study of each, and the runs."""

    arm: Arm
    curves: Mapping[str, Bezier]
    studies: tuple[Study, ...]
    branches: tuple[tuple[Branch, ...], ...]
    runs: tuple[Run, ...] = field(default=())
    motions: ContinuousMotions | None = None
    """All continuous motions, through singular places too."""
    limited: LimitedMotions | None = None
    """Which of them keep the limits of the joints; None where that is not decided, and ``undecided`` says why. Whole
    runs have the numbers of their motions."""
    undecided: str = ""

    @cached_property
    def count(self) -> int | None:
        """The number of all continuous motions from start to goal, without limits; None where it is not decided."""
        if self.motions is not None:
            return self.motions.count
        if any(0 in (*(p.count for p in s.stretches), *(p.inverse.count for p in s.specials)) for s in self.studies):
            return 0
        inside = [p for k, s in enumerate(self.studies) for p in s.specials if (k, p.s) != (0, ZERO)]
        if any(p.reasons or p.inverse.count is None for p in inside[:-1]):
            return None
        # all solutions between start and goal are simple and none escapes: each is a continuous function of s
        return self.studies[0].stretches[0].count

    @cached_property
    def allowed_count(self) -> int | None:
        """The number of those that keep the limits of the joints for all s; None where it is not decided."""
        if self.limited is not None:
            return self.limited.count
        if not self.is_reachable:
            return 0
        if not self.arm.has_limits or self.count == len(self.covering_runs):
            return len(self.whole_runs) if self.arm.has_limits else self.count
        return None

    @property
    def is_reachable(self) -> bool:
        """Whether every point of the path can be reached within the limits, proved or refuted exactly."""
        return all(s.is_reachable for s in self.studies)

    @property
    def is_stopped(self) -> bool:
        """Whether no continuous motion from start to goal keeps the limits; where that is not decided: none that boxes
        hold, and some pass a limit."""
        if self.allowed_count is None:
            return bool(self.excesses) and not self.whole_runs
        return not self.allowed_count

    @cached_property
    def covering_runs(self) -> tuple[Run, ...]:
        """The runs from start to goal."""
        return tuple(run for run in self.runs if run.covers(len(self.curves)))

    @cached_property
    def whole_runs(self) -> tuple[Run, ...]:
        """The runs from start to goal within the limits: continuous joint motions for the whole path."""
        return tuple(run for run in self.covering_runs if not run.excesses)

    @cached_property
    def excesses(self) -> dict[int, tuple[Excess, ...]]:
        """Where motions and runs are beyond limits, by their numbers."""
        result = {run.number: run.excesses for run in self.runs}
        result |= {} if self.limited is None else {n: kept.excesses for n, kept in self.limited.listed.items()}
        return {n: result[n] for n in sorted(result) if result[n]}

    @cached_property
    def kept_numbers(self) -> frozenset[int]:
        """The numbers of the motions from start to goal that keep the limits, listed or held by boxes."""
        listed = {run.number for run in self.covering_runs} | {*(() if self.limited is None else self.limited.listed)}
        return frozenset(listed - {*self.excesses})


def joint_path(arm: Arm, curves: Mapping[str, Bezier]) -> JointPath:
    """Study a path (curves with rational control points in mm, each beginning where the last one ends) and follow its
    branches.

    Raises ``InputError`` for curves that do not join.
    """
    if not isinstance(curves, Mapping) or not all(isinstance(curve, Bezier) for curve in curves.values()):
        raise InputError("path: curves (Bezier) by their names expected")
    listed = list(curves.items())
    if not listed:
        raise InputError("path: at least one curve expected")
    for (first, a), (second, b) in pairwise(listed):
        if not same(a.points[-1], b.points[0]):
            raise InputError(f"path: {second} has to begin where {first} ends")
    motions, undecided = None, "its arm is of another shape"
    try:
        motions = continuous_motions(arm, curves)
    except BudgetExceeded:
        raise
    except Unable as error:
        undecided = str(error)
    also = [()] * len(listed) if motions is None else [signs.places for signs in motions.curves]
    studies = tuple(study(arm, curve, places) for curve, places in zip(curves.values(), also, strict=True))
    branches: list[tuple[Branch, ...]] = []
    for result in studies:
        branches.append(tuple(_branches(result, branches[-1] if branches else ())))
    runs = tuple(_runs(branches))
    if arm.has_limits:
        turns = [turns_of(arm, run.parts) for run in runs]
        pairs = zip(runs, turns, strict=True)
        runs = tuple(replace(run, turns=t, excesses=excesses(arm, studies, run.parts, t)) for run, t in pairs)
    limited = None
    if motions is not None:
        runs, undecided = tuple(_numbered(runs, motions, len(listed))), ""
        limited = LimitedMotions.of(motions, studies)
    for k, result in enumerate(studies):
        _check_joined(result, k, runs, None if motions is None else vertical_arm(arm))
    return JointPath(arm, dict(curves), studies, tuple(branches), runs, motions, limited, undecided)


def _branches(studied: Study, before: Sequence[Branch]) -> list[Branch]:
    """All branches of a curve, each once: those that go on from the curve before, with the same angles and not only the
    same directions, and those through the other solutions at one parameter of every stretch."""
    branches: list[Branch] = []
    stops = [p.s if isinstance(p.s, Fraction) else p.s.interval(40)[0] for p in studied.specials if p.reasons]
    for last in before:
        if last.high == ONE:
            pieces = follow(studied.arm, studied.curve, last.at(ONE), ZERO, ONE, (last.pieces[-1], ONE), stops)
            branches += [Branch(pieces)] if pieces else []
    for stretch in studied.stretches:
        for solution in solve(studied.arm, studied.curve.point(stretch.sample)).solutions:
            if not any(b.contains(stretch.sample, solution) for b in branches):
                branch = whole(studied.arm, studied.curve, solution, stretch.sample, (ZERO, ONE), stops)
                branches += [branch] if branch is not None else []
    return branches


def _runs(branches: Sequence[tuple[Branch, ...]]) -> list[Run]:
    open_runs: list[list[tuple[int, Branch]]] = []
    closed: list[list[tuple[int, Branch]]] = []
    for k, level in enumerate(branches):
        still: list[list[tuple[int, Branch]]] = []
        taken: set[int] = set()
        for run in open_runs:
            last = run[-1][1].pieces[-1]
            begun = (i for i, b in enumerate(level) if i not in taken and b.low == ZERO and joined(last, b.pieces[0]))
            following = next(begun, None)
            if following is None:
                closed.append(run)
            else:
                taken.add(following)
                still.append([*run, (k, level[following])])
        still += [[(k, b)] for i, b in enumerate(level) if i not in taken]
        closed += [run for run in still if run[-1][1].high != ONE]
        open_runs = [run for run in still if run[-1][1].high == ONE]
    return [Run(i, tuple(run)) for i, run in enumerate([*open_runs, *closed], start=1)]


def _numbered(runs: Sequence[Run], motions: ContinuousMotions, curves: int) -> Iterator[Run]:
    """The runs with the numbers of their motions; others come behind all motions."""
    numbers = {m.labels: m.number for m in motions.motions}
    free = count(len(numbers) + 1)
    for run in runs:
        labels = [_label(run, arcs) for arcs in motions.arcs] if run.covers(curves) else [None]
        number = numbers.get(tuple(label for label in labels if label is not None))
        yield replace(run, number=next(free) if number is None else number)


def _label(run: Run, arcs: Arcs) -> Label | None:
    branch = run.branch(arcs.curve)
    if branch is None:
        return None
    held = zip(arcs.labels, arcs.solutions, strict=True)
    return next((label for label, solution in held if branch.contains(arcs.sample, solution)), None)


def _check_joined(studied: Study, curve: int, runs: Sequence[Run], plane: VerticalArm | None) -> None:
    """Where enclosures of several places are one, a motion through them has to show that there is a solution within
    the limits in between, too: one of the runs, or of the arcs of an arm with a plane, which do not end at such places.
    Raises ``Unable``."""
    for one, other in pairwise(studied.within):
        if isinstance(one.high, Near) and one.high.is_joined and one.count and other.count:
            low, high = ends_of(one.high)
            if plane is not None:
                ends = (solve(studied.arm, studied.curve.point(part.sample)).solutions for part in (one, other))
                before, after = ({plane.label(x) for x in solutions if x.allowed} for solutions in ends)
                shown = bool(before & after)
            else:
                through = [r for r in runs if (b := r.branch(curve)) is not None and b.low < low and high < b.high]
                near = ([e for e in r.excesses if e.curve == curve and one.high in (e.low, e.high)] for r in through)
                shown = not all(near)
            if not shown:
                raise Unable(f"near s = {float(low):.12g} it is not decided which joint passes its limit first")
