"""Formula (8) and formula (7) on one problem: what each gives, proved, and how long it takes."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial
from operator import mul
from typing import Any, TypeVar, cast

import qe
from bezier.compare import whole_curve
from bezier.compare.whole_curve import Plane, plane_coordinates
from bezier.curves.area import convex_area
from bezier.curves.enclosure import REL, Enclosure
from bezier.methods.control.statements import Statement, exists
from bezier.methods.cubic import formula as cubic
from bezier.methods.cubic.existence import Existence, existence, sentence
from bezier.methods.quadratic import formula as quadratic
from bezier.methods.quadratic.plan import QuadraticPlan
from bezier.motion.motion import Quality, quality_of
from bezier.planner import avoid, derivations
from bezier.planner.table import method_of
from bezier.plans import Clock, Derived, Plan, derivation_page, make
from bezier.problem import PlanMethod, Problem
from qe.errors import BudgetExceeded, InputError, Unable
from qe.formula.syntax import Formula
from qe.processes.channel import Channel, Known
from qe.processes.execution import run
from qe.processes.limits import Limits
from qe.processes.worker import end_idle
from qe.proof.certificate import Certificate

Found = TypeVar("Found")

METHODS = (PlanMethod.QUADRATIC, PlanMethod.CUBIC)
PAPER = {PlanMethod.QUADRATIC: "about 15.4 s", PlanMethod.CUBIC: "has not yet been successful"}
"""What the paper reports of quantifier elimination for formula (8), section 4.2.1, and (7), section 4.2."""

NUMBERS = {PlanMethod.QUADRATIC: "(8):", PlanMethod.CUBIC: "(7):"}
"""What the labels of the certificates of a plan begin with."""

COMPARE_SECONDS, PROOF_SECONDS, LEAST_PROOF_SECONDS = 28.0, 16.0, 4.0
"""Processor time that the comparison may take without a limit of the caller, and seconds for all derivations together,
at most and at least; what is not finished then is left out, and the comparison says so."""
PATIENCE = 20
"""A region may wait for the processor so many times as long as it may have it."""
OUTPUT_SHARE = 0.15
"""The share of the time left after the plans that is kept for the pictures and the files."""
SHARES = {"(8)": 4, "(7)": 3, "(8*)": 2}
"""One part in so many of the time left is for each planar region. (8*) may take long, so it comes last."""
AREA_REL, VOLUME_REL = Fraction(1, 1000), 0.05
"""Relative width of areas and volumes."""


@dataclass(frozen=True, slots=True)
class Side:
    """One method: its plan, and how long and bent the curves of its path are."""

    plan: Plan
    quality: Quality | None


@dataclass(frozen=True, slots=True)
class PlanarRegion:
    """The possible places of Q1 in the plane of the via points.

    ``region`` and ``area`` (None: not reached, see ``reason``; the area in the square of the unit of the points).
    """

    formula: str
    """As asked; its free variables are q1u, q1v."""
    region: qe.Region | None = None
    area: Enclosure | None = None
    reason: str = ""
    answer: qe.Answer | None = None
    """How the region's formula was found, where something was eliminated for it."""


@dataclass(frozen=True, slots=True)
class Planar:
    """The planar regions of formula (8), of (8*) for whole curves, and of (7) with Q2 quantified."""

    plane: Plane
    polygon: PlanarRegion
    whole: PlanarRegion
    cubic: PlanarRegion
    contained: bool | None
    """Whether the engine proved that the first lies in the second (None: not decided)."""
    implications: Mapping[str, Any] = field(default_factory=dict)
    """Its answers about that, by what was asked."""

    @property
    def named(self) -> dict[str, PlanarRegion]:
        """By the formula's number in the paper."""
        return {"(8)": self.polygon, "(8*)": self.whole, "(7)": self.cubic}


@dataclass(frozen=True, slots=True)
class Comparison:
    """``sides`` by method; ``volume``: of the region of formula (8) in space; ``seconds``: of the common steps.

    ``unfinished``: why a common step has no result, by its name. ``derivations``: of the eliminations of the plans, of
    the existence theorem and of what shows that (8) lies in (8*), each step checked; ``unproved``: why others have
    none. That of (8) in the plane eliminates
    nothing; that of (7) is answered by convex optimisation, which has no log.
    """

    problem: Problem
    sides: Mapping[PlanMethod, Side]
    planar: Planar
    volume: Enclosure | None
    existence: Existence
    seconds: Mapping[str, float]
    unfinished: Mapping[str, str]
    derivations: Mapping[str, Derived] = field(default_factory=dict)
    unproved: Mapping[str, str] = field(default_factory=dict)

    @property
    def derivation_pages(self) -> dict[str, str]:
        """The files with the derivations as pages, by what was asked."""
        return {name: derivation_page(k, "compare_") for k, name in enumerate(self.derivations, start=1)}

    @property
    def certificate(self) -> Certificate:
        """The certificates of both plans, each label with the formula's number before it, and the derivations."""
        result = [
            (f"{NUMBERS[method]} {label}", member)
            for method, side in self.sides.items()
            for label, member in derivations.listed(side.plan.certificate)
        ]
        return Certificate.bundle([*result, *derivations.members(self.derivations)])


def compare(problem: Problem, clock: Clock | None = None, *, proofs: bool = False) -> Comparison:
    """Plan with both methods and measure what they leave free; with ``proofs`` also the derivations of eliminations.

    Raises ``InputError`` for other methods.

    Each common part has its share of the clock's limit; one that does not finish in it is left out, with the reason.
    """
    if problem.method not in METHODS:
        raise InputError(f'method: expected "quadratic" or "cubic" to compare them, found "{problem.method.value}"')
    watch = clock or Clock()
    sides = {}
    for method in METHODS:
        with watch.step(method.value):
            sides[method] = _side(problem, method, watch)
        watch.learn(method.value, sides[method].plan.outcome.value)
    parts = _Parts(watch)
    plane = Plane.through(problem)

    def part(name: str) -> PlanarRegion:
        """The region of this formula, or why there is none."""
        step, question = f"planar region of {name}", planar_statements(problem, plane)[name]
        region = parts.take(step, SHARES[name], partial(_region, question, plane, watch))
        return region or PlanarRegion(str(question), reason=parts.unfinished[step])

    polygon, cubic_region = part("(8)"), part("(7)")
    implied = partial(whole_curve.implications, for_method(problem, METHODS[0]), plane)
    answers = parts.take("(8) lies in (8*)", 3, lambda seconds: implied(timeout=seconds))
    plan = sides[PlanMethod.QUADRATIC].plan
    assert isinstance(plan, QuadraticPlan)
    space = plan.region
    volume = parts.take("volume of the region of (8)", 2, lambda s: Enclosure(*space.volume(VOLUME_REL, timeout=s)))
    theorem = parts.take("existence theorem of (7)", 2, lambda seconds: existence(timeout=seconds))
    if theorem is None:
        theorem = Existence(sentence(), None, "")
    contained = None if answers is None else all(answer.truth for answer in answers.values())
    planar = Planar(plane, polygon, part("(8*)"), cubic_region, contained, answers or {})
    result: tuple[dict[str, Derived], dict[str, str]] | None = None
    if proofs:
        eliminations = {name: answer for side in sides.values() for name, answer in side.plan.eliminations.items()}
        eliminations |= planar.implications
        if theorem.truth is not None:
            eliminations["the existence theorem of (7)"] = theorem.answer
        # the slowest last: what the limit ends is then only that
        eliminations |= {f"the planar region of {n}": r.answer for n, r in planar.named.items() if r.answer is not None}
        result = parts.take(
            "derivations", 1, lambda limit: derivations.proved(eliminations, Clock(limit=limit)), PROOF_SECONDS
        )
    known, unproved = result or ({}, {})
    return Comparison(problem, sides, planar, volume, theorem, dict(watch.seconds), parts.unfinished, known, unproved)


def processor_time() -> float:
    """Seconds that this process and those it has waited for had the processor."""
    return sum(os.times()[:4])


@dataclass(slots=True)
class _Parts:
    """The common parts, one after the other; each may take a share of the time that is left."""

    clock: Clock
    unfinished: dict[str, str] = field(default_factory=dict)
    begin: float = field(default_factory=processor_time)

    def take(self, name: str, share: int, work: Callable[[float], Found], most: float | None = None) -> Found | None:
        """The result of a part, which gets one part in ``share`` of the time asked for; where none is asked for, what
        is left of ``COMPARE_SECONDS``, within the bounds for derivations where ``most`` is one of them. None, with the
        reason noted."""
        try:
            with self.clock.step(name):
                remaining = self.clock.remaining(name)
                if remaining is None:
                    left = COMPARE_SECONDS - (processor_time() - self.begin)
                    return work(max(0.1, left) if most is None else max(LEAST_PROOF_SECONDS, min(left, most)))
                return work(remaining * (1 - OUTPUT_SHARE) / share)
        except Unable as error:
            self.unfinished[name] = str(error)
            self.clock.learn(name, f"not finished: {error}")
            return None


def for_method(problem: Problem, method: PlanMethod) -> Problem:
    """The same problem for another method; a ratio and a join speed, which only the cubic one knows, are left out."""
    if method is problem.method:
        return problem
    plain = replace(problem, ratio=Fraction(1), join_speed=Fraction(0))
    found = avoid.changed(plain, method, Fraction(0))
    if found is None:
        raise InputError(f'{problem.source}: expected a problem that method "{method.value}" can take')
    return found


def _side(problem: Problem, method: PlanMethod, clock: Clock) -> Side:
    watch = Clock(limit=clock.remaining(), listener=clock.listener, note=clock.note)
    made: Plan = make(method_of(method), for_method(problem, method), watch)
    plan = avoid.examined(made)
    with watch.step("length and curvature"):
        quality = None if plan.path is None else quality_of(plan.path, None, REL)
    return Side(replace(plan, seconds=dict(watch.seconds)), quality)


def planar_statements(problem: Problem, plane: Plane) -> dict[str, Statement]:
    """The conditions on Q1 in the plane: free variables q1u, q1v."""
    first, second = (for_method(problem, method) for method in METHODS)
    in_plane = plane.section(cubic.system(second).in_free_points(), ("Q1", "Q2"))
    return {
        "(8)": plane.section(quadratic.system(first).in_free_points(), ("Q1",)),
        "(8*)": whole_curve.statement(first, plane),
        "(7)": exists(plane_coordinates("Q2"), in_plane),
    }


def _region(question: Statement, plane: Plane, clock: Clock, seconds: float) -> PlanarRegion:
    """The region, which is convex: its conditions are convex in Q1 and Q2, for every t; its area if time allows.

    ``seconds``: of processor time, where the clock has no limit, so that a busy machine shows as much as another one.
    """
    known = Known()
    work = partial(_measured, question.formula, seconds if clock.limit is None else None)
    patience = seconds if clock.limit is not None else PATIENCE * seconds
    try:
        region, area = run(work, Limits(patience, progress=clock.listener), known=known)
    except Unable as error:
        found = known.facts.get("region")
        if found is None:
            raise
        answer = cast("qe.Answer | None", known.facts.get("answer"))
        return PlanarRegion(str(question), cast("qe.Region", found), None, f"area not found: {error}", answer)
    finally:
        end_idle()  # the processor time of a worker is known when it has ended
    low, high = map(mul, area.finite, plane.unit_area.finite)
    answer = cast("qe.Answer | None", known.facts.get("answer"))
    return PlanarRegion(str(question), region, Enclosure(low, high), answer=answer)


class _Spent(Exception):
    """The processor time is over. No ``Unable``, after which the engine would try another way."""


def _measured(formula: Formula, most: float | None, channel: Channel) -> tuple[qe.Region, Enclosure]:
    """The region with all that is shown of it, reported as soon as it is known, and its area.

    Raises ``BudgetExceeded`` after ``most`` seconds of processor time.
    """

    def spent(number: int, frame: object) -> None:
        raise _Spent

    if most is not None:  # this is a process of its own, which nothing else has set timers in
        signal.signal(signal.SIGPROF, spent)
        signal.setitimer(signal.ITIMER_PROF, most, 1.0)
    try:
        given = qe.region(formula, progress=channel.event)
    except _Spent:
        raise BudgetExceeded(f"limit of {most:.0f} s of processor time reached") from None
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
    channel.fact("answer", given.answer)
    region = qe.Region.from_json(given.to_json())
    if region.cells and not region.is_empty:
        region.bounds(region.order[0])
    channel.fact("region", region)
    return region, convex_area(region, AREA_REL)
