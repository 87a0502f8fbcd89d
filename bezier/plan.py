"""Planning, step by step: problem, formula, answer, region, optimum, curves, proofs.

The engine answers every question about existence; this module only asks, and checks the exact numbers that
come back by putting them into the conditions.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from enum import Enum
from fractions import Fraction
from typing import Any

import qe
from bezier import quadratic
from bezier.evidence import path_certificates
from bezier.path import Path, Proof, assemble, prove
from bezier.problem import PlanMethod, Problem
from bezier.scalar import Vector, sign
from bezier.workspace import Workspace, WorkspaceKind
from qe.errors import BudgetExceeded, InternalError, Unable
from qe.formula.syntax import FALSE
from qe.progress import Event, Listener, silent

Note = Callable[[str, object], None]


class Outcome(Enum):
    """What planning ended with."""

    SOLVED = "solved"
    INFEASIBLE = "infeasible"


@dataclass(frozen=True, slots=True)
class Gap:
    """Whether control points that the printed formula (8) allows can lie below the table {z = 0}.

    ``example``: control points that the formula allows, one of them below the table, or None when there are none.
    ``region``: the region with z >= 0 added for all control points, where there is a gap. ``chosen``: what was
    found out about z >= 0 along the curves of the chosen path. ``certificate``: of the example.
    """

    example: Mapping[str, Vector] | None
    region: Any | None
    chosen: tuple[Proof, ...]
    certificate: qe.Certificate | None = None

    @property
    def can_leave(self) -> bool:
        """Whether some allowed control point lies below the table."""
        return self.example is not None


@dataclass(frozen=True, slots=True)
class Plan:
    """Everything a report needs. ``optimum`` is None exactly when the problem is infeasible.

    ``certificate``: all certificates, labelled; ``checks``: what the independent checker says of them.
    """

    problem: Problem
    outcome: Outcome
    formula: str
    answer: Any
    region: Any
    optimum: Any | None
    infeasibility: Any | None
    path: Path | None
    active: tuple[str, ...]
    balls: quadratic.ThreeBalls
    gap: Gap
    certificate: qe.Certificate
    checks: Mapping[str, qe.Verdict]
    seconds: Mapping[str, float]

    @property
    def certified(self) -> bool:
        """Whether the checker accepted every certificate and the whole path is proved inside."""
        accepted = all(verdict.accepted for verdict in self.checks.values())
        return accepted and (self.path is None or self.path.is_inside)


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
    """Plan a path. Raises ``Unable`` for methods that are not there yet, and at limits with what is known by then."""
    if problem.method is not PlanMethod.QUADRATIC:
        raise Unable(f'method "{problem.method.value}" is not there yet; method "quadratic" is')
    watch = clock or Clock()
    try:
        return _quadratic_plan(problem, watch)
    except BudgetExceeded as error:
        known = "; ".join(f"{name}: {value}" for name, value in watch.facts.items()) or "nothing yet"
        raise BudgetExceeded(f"{error}; known so far: {known}", limit=error.limit) from None


def _quadratic_plan(problem: Problem, clock: Clock) -> Plan:
    text = quadratic.formula(problem)
    with clock.step("elimination"):
        answer = _answered(qe.eliminate(text, timeout=clock.remaining()))
    clock.learn("quantifier-free answer", str(answer.formula))
    with clock.step("region"):
        region = qe.region(answer.formula, order=quadratic.FREE, timeout=clock.remaining())
    clock.learn("region", "empty" if region.is_empty else f"{len(region.cells)} cells")
    with clock.step("optimum"):
        # an answer "false" holds no conditions to combine to a contradiction: then the given ones are taken
        conditions = quadratic.conditions_text(problem) if answer.formula == FALSE else answer.formula
        optimum = qe.minimize(quadratic.objective(problem), conditions, timeout=clock.remaining())
    found = None if region.is_empty else tuple(optimum.point[name] for name in quadratic.FREE)
    if (found is None) == optimum.is_optimal:
        raise InternalError("the region and the optimum disagree about the existence of a control point")
    path: Path | None = None
    active: tuple[str, ...] = ()
    with clock.step("curves and proofs"):
        if found is not None:
            path, active = _path(problem, found)
    with clock.step("hemisphere question"):
        gap = _gap(problem, region, path, clock)
    with clock.step("verification"):
        members = [("region", region.certificate), ("optimum", optimum.certificate)]
        if gap.certificate is not None:
            members.append(("below the table", gap.certificate))
        checks = {label: qe.verify(certificate) for label, certificate in members}
        of_path = path_certificates(path) if path else []
        if of_path:
            checks["path"] = qe.verify(qe.Certificate.bundle(of_path))
    solved = found is not None
    return Plan(
        problem=problem,
        outcome=Outcome.SOLVED if solved else Outcome.INFEASIBLE,
        formula=text,
        answer=answer,
        region=region,
        optimum=optimum if solved else None,
        infeasibility=None if solved else optimum,
        path=path,
        active=active,
        balls=quadratic.three_balls(problem),
        gap=gap,
        certificate=qe.Certificate.bundle([*members, *of_path]),
        checks=checks,
        seconds=clock.seconds,
    )


def _path(problem: Problem, q1: Vector) -> tuple[Path, tuple[str, ...]]:
    """The path for this Q1, after checking exactly that the engine's point satisfies every condition."""
    points = quadratic.control_points(problem, q1)
    for item in quadratic.point_conditions(problem.workspace):
        if sign(item.condition.margin(points[item.point])) < 0:
            raise InternalError(f"the optimum violates the condition on {item.label}")
    return assemble(quadratic.curves(problem, q1), points, problem.workspace), quadratic.active(problem, q1)


def _answered(answer: Any) -> Any:
    """The answer, if it is one."""
    if answer.formula is None:
        raise Unable(answer.reason or "no answer was reached")
    return answer


def _gap(problem: Problem, region: Any, path: Path | None, clock: Clock) -> Gap:
    """Ask the engine whether the printed formula lets a control point fall below the table.

    ``region``: the problem's own region, which is the corrected one for a hemisphere.
    """
    asked = _answered(qe.eliminate(quadratic.leaving_formula(problem), timeout=clock.remaining()))
    floor = Workspace(WorkspaceKind.HEMISPHERE, problem.workspace.radius_squared).floor
    chosen = prove(path.curves, (floor,)) if path else ()
    if asked.truth is False:
        return Gap(None, None, chosen)
    if asked.truth is not True or asked.witness is None:
        raise InternalError("the hemisphere question got neither a witness nor a refutation")
    q1 = tuple(asked.witness.get(name, Fraction(0)) for name in quadratic.FREE)
    example = {name: quadratic.control_points(problem, q1)[name] for name in quadratic.INNER}
    ball = problem.workspace.ball
    allowed = all(sign(ball.margin(point)) >= 0 for point in example.values())
    if not allowed or all(sign(point[2]) >= 0 for point in example.values()):
        raise InternalError("the engine's example does not show what it should")
    if problem.workspace.kind is WorkspaceKind.HEMISPHERE:
        return Gap(example, region, chosen, asked.certificate)
    corrected = _answered(qe.eliminate(quadratic.corrected_formula(problem), timeout=clock.remaining()))
    smaller = qe.region(corrected.formula, order=quadratic.FREE, timeout=clock.remaining())
    return Gap(example, smaller, chosen, asked.certificate)
