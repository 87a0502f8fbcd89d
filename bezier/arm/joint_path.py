"""A path of several curves for an arm: what is proved about each curve, and the branches that run through all of it.

A *run* is one continuous joint motion: branches of neighbouring curves that are proved to be joined. It begins at the
start or where solutions come into being, and ends at the goal or where they meet and vanish or the arm is singular.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from itertools import pairwise

from bezier.arm.follow import ONE, ZERO, Branch, follow, joined, whole
from bezier.arm.inverse import solve
from bezier.arm.limit_places import Near, ends_of
from bezier.arm.model import Arm
from bezier.arm.motion_limits import Excess, excesses, turns_of
from bezier.arm.study import Study, study
from bezier.curves.curve import Bezier
from bezier.curves.scalar import same
from qe.errors import InputError, Unable

Note = Callable[[], None]


@dataclass(frozen=True, slots=True)
class Run:
    """One continuous joint motion: (index of the curve, branch), in order. ``number`` names it, from 1.

    ``turns``: full turns of each joint that are added to the branches. ``excesses``: where it is then beyond a limit.
    """

    number: int
    parts: tuple[tuple[int, Branch], ...]
    turns: tuple[int, ...] = ()
    excesses: tuple[Excess, ...] = ()

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

    @property
    def is_reachable(self) -> bool:
        """Whether every point of the path can be reached within the limits, proved or refuted exactly."""
        return all(s.is_reachable for s in self.studies)

    @cached_property
    def whole_runs(self) -> tuple[Run, ...]:
        """The runs from start to goal within the limits: continuous joint motions for the whole path."""
        return tuple(run for run in self.runs if run.covers(len(self.curves)) and not run.excesses)


def joint_path(arm: Arm, curves: Mapping[str, Bezier], note: Note = lambda: None) -> JointPath:
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
    studies = tuple(study(arm, curve, note) for curve in curves.values())
    branches: list[tuple[Branch, ...]] = []
    for found in studies:
        branches.append(tuple(_branches(found, branches[-1] if branches else (), note)))
    runs = tuple(_limited(arm, studies, run) for run in _runs(branches))
    for k, found in enumerate(studies):
        _check_joined(found, k, runs)
    return JointPath(arm, dict(curves), studies, tuple(branches), runs)


def _branches(found: Study, before: Sequence[Branch], note: Note) -> list[Branch]:
    """All branches of a curve, each once: those that go on from the curve before, with the same angles and not only the
    same
    directions, and those through the other solutions at one parameter of every stretch."""
    branches: list[Branch] = []
    stops = [p.s if isinstance(p.s, Fraction) else p.s.interval(40)[0] for p in found.specials if p.reasons]
    for last in before:
        if last.high == ONE:
            pieces = follow(found.arm, found.curve, last.at(ONE), ZERO, ONE, note, (last.pieces[-1], ONE), stops)
            branches += [Branch(pieces)] if pieces else []
    for stretch in found.stretches:
        for solution in solve(found.arm, found.curve.point(stretch.sample)).solutions:
            if not any(b.contains(stretch.sample, solution) for b in branches):
                branch = whole(found.arm, found.curve, solution, stretch.sample, (ZERO, ONE), stops)
                branches += [branch] if branch is not None else []
            note()
    return branches


def _runs(branches: Sequence[tuple[Branch, ...]]) -> list[Run]:
    open_runs: list[list[tuple[int, Branch]]] = []
    closed: list[list[tuple[int, Branch]]] = []
    for k, level in enumerate(branches):
        still: list[list[tuple[int, Branch]]] = []
        taken: set[int] = set()
        for run in open_runs:
            last = run[-1][1]
            following = next((i for i, b in enumerate(level) if i not in taken and _follows(last, b)), None)
            if following is None:
                closed.append(run)
            else:
                taken.add(following)
                still.append([*run, (k, level[following])])
        still += [[(k, b)] for i, b in enumerate(level) if i not in taken]
        closed += [run for run in still if run[-1][1].high != ONE]
        open_runs = [run for run in still if run[-1][1].high == ONE]
    return [Run(i, tuple(run)) for i, run in enumerate([*open_runs, *closed], start=1)]


def _limited(arm: Arm, studies: Sequence[Study], run: Run) -> Run:
    if all(joint.limits is None for joint in arm.joints):
        return run
    turns = turns_of(arm, run.parts)
    return replace(run, turns=turns, excesses=excesses(arm, studies, run.parts, turns))


def _check_joined(found: Study, curve: int, runs: Sequence[Run]) -> None:
    """Where enclosures of several places are one, a motion through them has to show that there is a solution within
    the limits in between, too. Raises ``Unable``."""
    for one, other in pairwise(found.within):
        if isinstance(one.high, Near) and one.high.is_joined and one.count and other.count:
            low, high = ends_of(one.high)
            through = [r for r in runs if (b := r.branch(curve)) is not None and b.low < low and high < b.high]
            if all(any(e.curve == curve and one.high in (e.low, e.high) for e in r.excesses) for r in through):
                raise Unable(f"near s = {float(low):.12g} it is not told which joint passes its limit first")


def _follows(one: Branch, other: Branch) -> bool:
    return one.high == ONE and other.low == ZERO and joined(one.pieces[-1], other.pieces[0])
