"""The least time along a path: a motion that keeps all limits for all t, and seconds that none can beat."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, partial
from itertools import accumulate
from typing import Any

import numpy as np

from bezier.curves.scalar import described
from bezier.curves.sentences import verified
from bezier.motion.timelaw import Law
from bezier.retiming.bound import Weights, bound, weights
from bezier.retiming.grid import Bounds, Grid, even, stops_of
from bezier.retiming.law import Step, fastest, is_motion, timed, usual
from bezier.retiming.proposals import Proposal, proposal
from bezier.retiming.smooth import speedings, steps_of
from bezier.trajectories.evidence import claims, exceeding, refuted, whole
from bezier.trajectories.limits import Limit, Verdict, decided, in_words, to_json
from bezier.trajectories.piecewise import QUANTITIES, Trajectory
from qe.errors import CertificateRejected, InputError, Unable
from qe.formula.syntax import FALSE, Formula
from qe.options import Budget
from qe.proof.certificate import Certificate

ACCURACY = Fraction(1, 250)
"""The share by which the time may be above the bound."""
PASSES, LESS, MOST = 8, 3.0, 8
"""Grids; by how much the gap is to fall from one to the next, and into how many parts an interval is cut, at most."""
MARGIN = Fraction(1, 1 << 20)
"""The share by which a motion is slower than proposed."""
TRIES = 4
UNUSUAL = "path: expected quantities of usual size, found one beyond 10^308"
LEAST = "at least"
"""How labels of the bound begin."""


@dataclass(frozen=True)
class LeastTime:
    """``verdict``: of the path taken by ``steps``; no motion takes less than ``bound`` seconds, by ``weights``.

    ``path`` has a parameter whose speed does not jump. Where it is 0 though the direction goes on (``rests``), motions
    are meant that rest there.
    """

    path: Trajectory
    steps: tuple[Step, ...]
    verdict: Verdict
    weights: tuple[Weights, ...]
    bound: Fraction
    missed: Fraction | None = None
    """The accuracy that was asked for, where no grid reached it."""

    @property
    def duration(self) -> Fraction:
        """Seconds."""
        return sum((step.duration for step in self.steps), Fraction(0))

    @property
    def trajectory(self) -> Trajectory:
        """The path over time."""
        return self.verdict.trajectory

    @property
    def gap(self) -> Fraction:
        """The share by which the time is at most above the least one."""
        return self.duration / self.bound - 1

    @cached_property
    def rests(self) -> tuple[tuple[Fraction, ...], ...]:
        """The places inside where the parameter stands still though the direction goes on."""
        breaks = [k for k, stop in stops_of(self.path).items() if stop.by_choice]
        return tuple(tuple(p(self.path.lengths[k - 1]) for p in self.path.pieces[k - 1]) for k in breaks)

    @property
    def lines(self) -> list[str]:
        """The time from both sides, then a line for each limit."""
        share = float(self.gap) * 100
        above = f"at most {share:.2g} % above the least" if share < 100 else f"at most {share:.0f} % above the least"
        there = " that rests where the parameter of the path stands still" if self.rests else ""
        times = f"{float(self.duration):.9g} s; every motion{there} takes at least {float(self.bound):.9g} s: {above}"
        places = (", ".join(f"{float(x):.6g}" for x in place) for place in self.rests)
        has_jerk = any(outcome.limit.order > 2 for outcome in self.verdict.outcomes)
        return [
            times,
            *([] if self.missed is None else [f"the accuracy {float(self.missed):.6g} was not reached"]),
            *(["the bound is that without the limit of jerk, which it leaves aside"] if has_jerk else []),
            *(f"at rest at ({place}), where the parameter stands still" for place in places),
            *in_words(self.verdict),
        ]

    def __str__(self) -> str:
        return "\n".join(self.lines)

    @cached_property
    def certificate(self) -> Certificate:
        """The proof of both sides, for ``qe.verify``; ``checked`` also compares it with the path. Raises ``Unable``."""
        lengths = [*self.trajectory.lengths, *(part.interval.length for part in self.weights)]
        given = zip(self._claims, lengths, strict=True)
        return Certificate.bundle([(label, refuted(said, excesses, h)) for (label, excesses, said), h in given])

    @cached_property
    def _claims(self) -> list[tuple[str, list[Any], Formula]]:
        return [*_stated(self.verdict, self.steps), *(_bounding(self.path, part) for part in self.weights)]

    def check(self, certificate: Certificate) -> None:
        """Whether a certificate proves just this. Raises ``CertificateRejected``."""
        verified(certificate, [(label, sentence, FALSE) for label, _, sentence in self._claims])

    def page(self, title: str = "path") -> str:
        """An HTML page with a chart of each quantity over time and its limit."""
        from bezier.report.html import Card, document
        from bezier.report.trajectory import page

        cards = [
            Card("seconds", f"{float(self.duration):.6g}"),
            Card("at least", f"{float(self.bound):.6g}", note="no motion takes less, proved"),
        ]
        return document(page(self.verdict, self.lines, title, cards=cards))

    def to_json(self) -> dict[str, Any]:
        """Everything, with exact numbers."""
        data = to_json(self.verdict)
        return {
            **{key: data[key] for key in ("status", "kept", "limits")},
            "duration": described(self.duration),
            "at least": described(self.bound),
            "gap": float(self.gap),
            "accuracy not reached": None if self.missed is None else str(self.missed),
            "rests": [list(map(str, place)) for place in self.rests],
            "steps": [{"s": list(map(str, s.place.coefficients())), "seconds": str(s.duration)} for s in self.steps],
        }

    def to_csv(self) -> str:
        """Durations and exact polynomials of each axis, as ``bezier certify`` reads them."""
        rows = self.trajectory.pieces
        degree = max(p.degree for row in rows for p in row)
        lines = [",".join(["duration", *(f"{n}^{k}" for n in self.trajectory.names for k in range(degree + 1))])]
        for length, row in zip(self.trajectory.lengths, rows, strict=True):
            padded = ([*p.coefficients(), *[Fraction(0)] * (degree - p.degree)] for p in row)
            lines.append(",".join(map(str, (length, *(c for part in padded for c in part[: degree + 1])))))
        return "\n".join(lines) + "\n"


def least_time(
    path: Trajectory,
    limits: Sequence[Limit],
    budget: Budget | None = None,
    *,
    law: Law = Law.LEAST,
    accuracy: Fraction = ACCURACY,
) -> LeastTime:
    """The fastest motion along a path from rest to rest, at most ``accuracy`` above the bound where that is within
    reach. ``law``: one with a formula, in its own least time. Limits of jerk are kept, too, which the bound leaves
    aside. Raises ``InputError`` and ``Unable``."""
    try:
        return _least_time(path, limits, law, accuracy, budget or Budget())
    except OverflowError:
        raise InputError(UNUSUAL) from None


def _least_time(path: Trajectory, limits: Sequence[Limit], law: Law, accuracy: Fraction, budget: Budget) -> LeastTime:
    bounds = Bounds.of(limits, len(path.names))
    has_jerk = any(limit.order > 2 for limit in limits)
    if has_jerk and law not in (Law.LEAST, Law.QUINTIC):
        raise InputError(f"law: expected least or quintic with a limit of jerk, found {law.value}, of infinite jerk")
    path, result = even(path), None
    for grid, given in _proposals(Grid.of(path), bounds, float(accuracy), budget):
        result, proved = None, partial(_proved, grid, given, bounds, limits, law, accuracy)
        if budget.remaining() is not None:
            with suppress(Unable):
                result = proved()
                budget.keep(result)
    return result or proved()


def _proved(
    grid: Grid, given: Proposal, bounds: Bounds, limits: Sequence[Limit], law: Law, accuracy: Fraction
) -> LeastTime:
    """Both sides, exactly. Raises ``Unable`` and ``InputError`` as ``_keeping``."""
    path, has_jerk = grid.path, any(limit.order > 2 for limit in limits)
    proved = tuple(weights(grid, given))
    seconds = bound(path, grid.stops, bounds, proved)
    if seconds <= 0:
        raise Unable("the proposed multipliers prove nothing")
    speeds = np.sqrt(given.squares)
    parts = speedings(grid, speeds, limits) if has_jerk and law is Law.LEAST else []

    def motion(slower: Fraction) -> tuple[Step, ...]:
        if parts:
            return tuple(step for part in parts for step in steps_of(*part, slower))
        return fastest(grid, speeds / float(slower)) if law is Law.LEAST else usual(path, law, seconds * slower)

    steps, verdict = _keeping(grid, limits, motion, 1 + MARGIN if law is Law.LEAST else Fraction(1))
    missed = given.duration - given.bound > float(accuracy) * given.bound
    return LeastTime(path, steps, verdict, proved, seconds, accuracy if missed else None)


def _proposals(grid: Grid, bounds: Bounds, accuracy: float, budget: Budget) -> Iterator[tuple[Grid, Proposal]]:
    """Those of ever finer grids, finer where the gap is, each better than the ones before; one below zero is a failure
    of the solver."""
    best = np.inf
    for _ in range(PASSES):
        budget.check("speeds and multipliers")
        with np.errstate(all="ignore"):
            given = proposal(grid, bounds)
        gap = abs(given.duration - given.bound)
        if not np.isfinite(gap) or np.count_nonzero(given.squares) + len(grid.resting) < grid.nodes:
            raise Unable("the path and its limits have numbers that floating point cannot hold")
        if gap < best:
            best = gap
            yield grid, given
        if gap <= accuracy * given.bound:
            break
        grid = grid.refined(_parts(given.gaps, max(0.8 * accuracy * given.bound, gap / LESS)))


def _parts(gaps: Any, goal: float) -> list[int]:
    """Into how many parts each interval is cut, as few as bring the sum of the gaps to the goal: n parts leave gap / n,
    since what each has is quadratic in its length; then n is in proportion to the root of the gap (Lagrange)."""
    roots = np.sqrt(np.maximum(gaps, 0))
    return [int(n) for n in np.clip(np.rint(roots * roots.sum() / goal), 1, MOST)]


def _keeping(
    grid: Grid, limits: Sequence[Limit], motion: Callable[[Fraction], tuple[Step, ...]], slower: Fraction
) -> tuple[tuple[Step, ...], Verdict]:
    """The motion, slower by as little as is enough. Raises ``Unable`` where it is none or never keeps the limits, and
    ``InputError`` where the path itself breaks one."""
    for _ in range(TRIES):
        steps = motion(slower)
        if not is_motion(grid.path, grid.stops, steps):
            raise Unable("the path has corners, where this law does not stop")
        verdict = decided(timed(grid.path, steps), limits, _tolerance(grid.path))
        if verdict.is_kept:
            return steps, verdict
        if verdict.factor is None:
            jumps = (f"{QUANTITIES[j.order]} jumps by {float(j.size):.2g}" for j in verdict.breaking)
            worst, what = verdict.worst, " and ".join(jumps)
            if worst is not None and not what:
                what = f"{worst.limit.words(grid.path.names)} is {worst.value:.10g}"
            raise InputError(f"path: no motion along it keeps the limits: {what}")
        slower *= verdict.factor + MARGIN
    raise Unable("no motion along the path that keeps its limits was found")


def _tolerance(path: Trajectory) -> Fraction:
    """Floats join with small differences: what counts as continuous, by how far the path leads."""
    places = zip(*([p(Fraction(0)) for p in row] for row in path.pieces), strict=True)
    span: Fraction = max(max(axis) - min(axis) for axis in places)
    return max(span, Fraction(1)) / 10**9


# --- certificates ----------------------------------------------------------------------------------------------


def _stated(verdict: Verdict, steps: Sequence[Step]) -> list[tuple[str, list[Any], Formula]]:
    """That each piece keeps the limits; the label of the first one in each step says what the step is."""
    starts = dict(zip(accumulate((s.duration for s in steps), initial=Fraction(0)), steps, strict=False))
    listed, limits = [], [o.limit for o in verdict.outcomes]
    every = claims(verdict.trajectory, limits, Fraction(1))
    for start, (label, excesses, sentence) in zip(verdict.trajectory.breaks, every, strict=False):
        said = f"{label}: {starts[start]}" if start in starts else label
        listed.append((said, excesses, sentence))
    return listed


def _bounding(path: Trajectory, part: Weights) -> tuple[str, list[Any], Formula]:
    """That u^3 <= 2 S on an interval, whose multipliers the label says."""
    excess = [whole(part.excess(*part.interval.derivatives(path)), 1, Fraction(0))]
    return f"{LEAST}: {part}", excess, exceeding(part.interval.length, excess)


def checked(path: Trajectory, limits: Sequence[Limit], certificate: Certificate) -> LeastTime:
    """What a certificate proves about a path, whose motion and multipliers its labels state. No optimiser takes part.
    Raises ``CertificateRejected``."""
    members = certificate.payload if isinstance(certificate.payload, tuple) else ()
    labels = [member.label.partition(": ") for member in members]
    try:
        steps = tuple(Step.read(text) for head, _, text in labels if head.startswith("piece ") and text)
        proved = tuple(Weights.read(text) for head, _, text in labels if head == LEAST)
        path = even(path)
        stops = stops_of(path)
        if not is_motion(path, stops, steps):
            raise ValueError("steps that are no motion along this path")
        seconds = bound(path, stops, Bounds.of(limits, len(path.names)), proved)
        verdict = decided(timed(path, steps), limits, _tolerance(path))
    except (ValueError, LookupError, ZeroDivisionError) as error:
        raise CertificateRejected("bundle", str(error)) from None
    except OverflowError:
        raise InputError(UNUSUAL) from None
    if verdict.breaking or seconds <= 0:
        raise CertificateRejected("bundle", "a motion that jumps, or no bound")
    result = LeastTime(path, steps, verdict, proved, seconds)
    result.check(certificate)
    return result
