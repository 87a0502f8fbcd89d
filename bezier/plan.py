"""Planning: what every method's plan holds, the clock that its steps run by, and the choice of the method.

A method asks the engine every question about existence and checks the exact numbers that come back by putting
them into the conditions. ``bezier.planner.table`` lists the methods.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from enum import Enum
from typing import TYPE_CHECKING, Any

from bezier.paths.path import Path
from bezier.problem import Problem
from qe.errors import BudgetExceeded, Unable
from qe.progress import Event, Listener, silent

if TYPE_CHECKING:
    import qe
    from bezier.motion.motion import Quality
    from bezier.obstacles.survey import Finding
    from bezier.paths.heights import Heights
    from bezier.planner.avoid import Attempt
    from bezier.planner.radius_rule import RadiusRule

Note = Callable[[str, object], None]


class Outcome(Enum):
    """What planning ended with."""

    SOLVED = "solved"
    INFEASIBLE = "infeasible"
    BLOCKED = "blocked"
    """There is a path, but an obstacle is in its way."""
    TOO_FAST = "limits_not_kept"
    """There is a path, but the motion asked for is not proved to keep the limits asked for."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """What every method finds out. ``path`` and ``objective`` are None exactly when the problem is infeasible.

    ``formula``: as handed to the engine; ``answer``: its quantifier-free answer; ``active``: labels of the
    conditions that hold with equality; ``certificate``: all certificates, labelled; ``checks``: what the
    independent checker says of them; ``seconds``: the time of each step; ``remarks``: for the reader;
    ``findings``: each curve and each obstacle; ``attempts``: what was tried to get around the obstacles;
    ``quality``: lengths, curvatures and the motion in time. ``heights``: the height condition, decided for all curves.
    ``radius_rule``: what the radius forces where a via point lies on the sphere.
    """

    problem: Problem
    outcome: Outcome
    formula: str
    answer: Any
    objective: Any | None
    path: Path | None
    active: tuple[str, ...]
    certificate: qe.Certificate
    checks: Mapping[str, qe.Verdict]
    seconds: Mapping[str, float]
    remarks: tuple[str, ...] = ()
    findings: tuple[Finding, ...] = ()
    attempts: tuple[Attempt, ...] = ()
    quality: Quality | None = None
    heights: Heights | None = None
    radius_rule: RadiusRule | None = None

    @property
    def unit(self) -> str:
        """The unit of the objective."""
        return "mm²"

    @property
    def not_certified(self) -> tuple[str, ...]:
        """The entries of the summary that no certificate covers and ``bezier check`` cannot find again."""
        found = ("seconds", "attempts") if len(self.attempts) > 1 else ("seconds",)
        has_radius = self.radius_rule is not None and self.radius_rule.larger is not None
        return (*found, "radius_rule.larger_radius") if has_radius else found

    @property
    def certified(self) -> bool:
        """Whether the checker accepted every certificate and the whole path is proved inside and clear of obstacles."""
        accepted = all(verdict.accepted for verdict in self.checks.values())
        clear = all(finding.is_clear for finding in self.findings)
        return accepted and clear and (self.path is None or self.path.is_inside)


@dataclass(slots=True)
class Clock:
    """The steps of a plan: their times, the time left, and who is told."""

    limit: float | None = None
    listener: Listener = silent
    note: Note = field(default=lambda name, value: None)
    seconds: dict[str, float] = field(default_factory=dict)
    facts: dict[str, object] = field(default_factory=dict)
    start: float = field(default_factory=time.perf_counter)

    def learn(self, name: str, value: object) -> None:
        """Keep and pass on something worth knowing should a limit end the work."""
        self.facts[name] = value
        self.note(name, value)

    @contextmanager
    def step(self, name: str) -> Iterator[None]:
        """Time one step; refuses to begin after the limit."""
        self.listener(Event(name, len(self.seconds), None))
        self.remaining(name)
        begin = time.perf_counter()
        yield
        self.seconds[name] = time.perf_counter() - begin

    def remaining(self, name: str = "planning") -> float | None:
        """Seconds left, or None without a limit."""
        if self.limit is None:
            return None
        left = self.limit - (time.perf_counter() - self.start)
        if left <= 0:
            raise BudgetExceeded(f"time limit of {self.limit:g} s reached before: {name}")
        return left


def make_plan(problem: Problem, clock: Clock | None = None) -> Plan:
    """Plan a path. Raises ``Unable`` where no answer is reached, at limits with what is known by then."""
    from bezier.planner.avoid import avoiding  # these need ``Plan``
    from bezier.planner.table import method_of

    watch = clock or Clock()
    try:
        plan: Plan = avoiding(problem, watch) if problem.obstacles else method_of(problem.method).make(problem, watch)
        with watch.step("radius and heights"):
            plan = _with_findings(plan, watch)
        with watch.step("quality"):
            return with_quality(plan)
    except BudgetExceeded as error:
        known = "; ".join(f"{name}: {value}" for name, value in watch.facts.items()) or "nothing yet"
        raise BudgetExceeded(f"{error}; known so far: {known}", limit=error.limit) from None


def _with_findings(plan: Plan, clock: Clock) -> Plan:
    """The plan with what the radius forces, the height condition, and a note where the path goes through the origin."""
    from bezier.planner import radius_rule

    return with_findings(plan, lambda solvable: radius_rule.radius_rule(plan.problem, solvable, clock.remaining))


def with_findings(plan: Plan, rule: Callable[[bool], RadiusRule | None]) -> Plan:
    """The same, with what ``rule`` says of the radius, which is asked whether the problem has a solution."""
    from bezier.paths import heights, origin

    found, remarks = plan, []
    try:
        solvable = plan.outcome is not Outcome.INFEASIBLE
        forced = rule(solvable)
        if forced is not None:
            found = replace(found, radius_rule=forced)
            remarks += [forced.in_words()] if solvable else []  # else it is part of the reason
        if plan.path is not None:
            found = replace(found, heights=heights.heights_of(plan.problem, plan.path))
            remarks += origin.remarks(plan.path)
    except Unable as error:
        if isinstance(error, BudgetExceeded):
            raise
        remarks.append(f"what the radius forces and the heights are not all decided: {error}")
    return replace(found, remarks=(*found.remarks, *remarks))


def with_quality(plan: Plan) -> Plan:
    """The plan with lengths, curvatures and the motion; it is not solved when the motion does not keep its limits.

    Without them, and with a remark, if they were not found and not asked for.
    """
    from bezier.motion.motion import quality_of

    if plan.path is None:
        return plan
    try:
        quality = quality_of(plan.path, plan.problem.timing)
    except Unable as error:
        if isinstance(error, BudgetExceeded) or plan.problem.timing is not None:
            raise
        return replace(plan, remarks=(*plan.remarks, f"lengths and curvatures are left out: {error}"))
    kept = quality.motion is None or quality.motion.keeps_limits
    solved = plan.outcome is Outcome.SOLVED
    return replace(plan, quality=quality, outcome=Outcome.TOO_FAST if solved and not kept else plan.outcome)


def answered(answer: Any) -> Any:
    """The engine's answer, if it is one. Raises ``Unable`` otherwise."""
    if answer.formula is None:
        raise Unable(answer.reason or "no answer was reached")
    return answer
