"""What planning is made of: a plan, the clock that its steps run by, and a method. Types only.

A method asks the engine every question about existence and checks the exact numbers that come back by putting
them into the conditions. ``bezier.planner.table`` lists the methods.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from enum import Enum
from fractions import Fraction
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from bezier.motion.motion import Quality
from bezier.obstacles.survey import Finding
from bezier.paths.heights import Heights
from bezier.paths.path import Path
from bezier.problem import PlanMethod, Problem
from qe.errors import BudgetExceeded
from qe.formula.syntax import Formula
from qe.progress import Event, Listener, silent
from qe.proof.certificate import Certificate

if TYPE_CHECKING:
    import qe
    from bezier.arm.joint_plan import JointPlan
    from bezier.pictures.picture import Drawing
    from bezier.report.html import Section

Note = Callable[[str, object], None]


class Outcome(Enum):
    """What planning ended with."""

    SOLVED = "solved"
    NEAR_OPTIMAL = "near-optimal"
    """Solved, but for the exact optimum: the objective is proved to be within 10^-9 of the least."""
    INFEASIBLE = "infeasible"
    """No path exists, proved."""
    BLOCKED = "blocked"
    """No path was found: an obstacle is in the way of every one that was tried."""
    TOO_FAST = "limits_not_kept"
    """There is a path, but the motion asked for is not proved to keep the limits asked for."""
    OUT_OF_REACH = "out_of_reach"
    """There is a path, but the arm cannot follow it."""

    @property
    def is_success(self) -> bool:
        """Whether there is a path to use."""
        return self in (Outcome.SOLVED, Outcome.NEAR_OPTIMAL)


@dataclass(frozen=True, slots=True)
class Attempt:
    """One problem that was tried."""

    what: str
    outcome: Outcome | None
    """None when planning was unable."""
    detail: str
    """How it ended, in words."""


@dataclass(frozen=True, slots=True)
class RadiusRule:
    """``forced``: the via points on the sphere with the free points that must equal them; ``sentences``: what the
    engine decided to be true, ``answers``: how, by what was asked; ``solvable``: whether the problem has a solution all
    the same; ``larger``: a radius with which the best path does not stop at a via point, None when none was found up to
    three times the radius.
    """

    method: PlanMethod
    forced: Mapping[str, str]
    sentences: tuple[str, ...]
    solvable: bool
    larger: Fraction | None
    answers: Mapping[str, Any] = field(default_factory=dict, compare=False)

    def in_words(self) -> str:
        """What the rule forces, and the way out, as one sentence."""
        points = " and ".join(f"|{via}| = r" for via in self.forced)
        equal = " and ".join(f"{free} = {via}" for via, free in self.forced.items())
        formula = "(8)" if self.method is PlanMethod.QUADRATIC else "(7)"
        if self.solvable:
            effect = f"every path of formula {formula} stops at {' and '.join(self.forced)}, whatever the objective"
        elif len(set(self.forced.values())) < len(self.forced):
            effect = f"formula {formula} has no solution"
        else:
            effect = "the other conditions cannot hold"
        helps = "no radius up to 3 r was found that helps"
        if self.larger is not None:
            helps = f"with radius = {self.larger} there is a path that does not stop there (proved)"
        return f"{points}: this forces {equal} (proved), so {effect}; {helps}"

    def to_json(self) -> dict[str, Any]:
        """The entry of ``summary.json``."""
        return {
            "forced": [f"{free} = {via}" for via, free in self.forced.items()],
            "proved": list(self.sentences),
            "larger_radius": None if self.larger is None else str(self.larger),
        }


@dataclass(frozen=True, slots=True)
class Derived:
    """An elimination with a certificate of its derivation that was accepted; ``answer`` is None in a plan that was
    found again from its files."""

    certificate: Certificate
    answer: Any = None

    @property
    def rules(self) -> tuple[str, ...]:
        """The rules of its steps, in their order."""
        payload: Any = self.certificate.payload
        return tuple(step["rule"] for step in payload["steps"])


def derivation_page(number: int, first: str = "") -> str:
    """The name of the file with the derivation of this number, counted from 1, as a page."""
    return f"{first}derivation_{number}.html"


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """What every method finds out. ``path`` and ``objective`` are None exactly when the problem is infeasible."""

    problem: Problem
    outcome: Outcome
    formula: str
    """As handed to the engine."""
    answer: Any = None
    """Its quantifier-free answer; None where the plan was read from its certificates."""
    objective: Any | None
    path: Path | None
    active: tuple[str, ...]
    """Labels of the conditions that hold with equality (with a ``bound``: that prove it)."""
    certificate: qe.Certificate
    """All certificates, labelled."""
    checks: Mapping[str, qe.Verdict] = field(default_factory=dict)
    """What the independent checker says of them."""
    seconds: Mapping[str, float] = field(default_factory=dict)
    """The time of each step."""
    remarks: tuple[str, ...] = ()
    """For the reader."""
    findings: tuple[Finding, ...] = ()
    """Each curve and each obstacle."""
    attempts: tuple[Attempt, ...] = ()
    """What was tried to get around the obstacles."""
    bound: Fraction | None = None
    """No choice of the method has an objective below it, where the exact optimum is out of reach; None: the objective
    is the least."""
    quality: Quality | None = None
    """Lengths, curvatures and the motion in time."""
    heights: Heights | None = None
    """The height condition, decided for all curves."""
    radius_rule: RadiusRule | None = None
    """What the radius forces where a via point lies on the sphere."""
    joints: JointPlan | None = None
    """Of the arm."""
    eliminations: Mapping[str, Any] = field(default_factory=dict)
    """The answers of the engine that the plan rests on, by what was asked."""
    derivations: Mapping[str, Derived] = field(default_factory=dict)
    """Those of them (and of what else was eliminated for the plan) whose every step was checked, where that was
    asked for."""
    unproved: Mapping[str, str] = field(default_factory=dict)
    """Why others were not."""

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.outcome.value}, {self.path!r})"

    @property
    def unit(self) -> str:
        """The unit of the objective."""
        return "mm²"

    @property
    def files(self) -> dict[str, str]:
        """Its further data files, by name."""
        return {}

    @property
    def hatted_names(self) -> bool:
        """Whether the paper writes its points with hats."""
        return False

    @property
    def not_certified(self) -> tuple[str, ...]:
        """The entries of the summary that no certificate covers and ``bezier check`` cannot find again."""
        result = ("seconds", "attempts") if len(self.attempts) > 1 else ("seconds",)
        has_radius = self.radius_rule is not None and self.radius_rule.larger is not None
        return (*result, "radius_rule.larger_radius") if has_radius else result

    @property
    def derivation_pages(self) -> dict[str, str]:
        """The files with the derivations as pages, by what was asked."""
        return {name: derivation_page(k) for k, name in enumerate(self.derivations, start=1)}

    @property
    def certified(self) -> bool:
        """Whether the checker accepted every certificate and the whole path is proved inside and clear of obstacles."""
        accepted = all(verdict.accepted for verdict in self.checks.values())
        clear = all(finding.is_clear for finding in self.findings)
        follows = self.joints is None or self.joints.is_followed
        return accepted and clear and follows and (self.path is None or self.path.is_inside)


@dataclass(frozen=True, slots=True, kw_only=True)
class Begun:
    """A plan as far as its path is known and proved to stay inside; what is left shows more about it."""

    problem: Problem
    outcome: Outcome
    path: Path | None
    found: Any
    """What the method goes on from."""
    seconds: Mapping[str, float]
    """The time of each step so far."""


@dataclass(slots=True)
class Clock:
    """The steps of a plan: their times, the time left, and who is notified."""

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

    @property
    def is_over(self) -> bool:
        """Whether the limit has passed."""
        return self.limit is not None and time.perf_counter() - self.start >= self.limit

    def remaining(self, name: str = "planning") -> float | None:
        """Seconds left, or None without a limit."""
        if self.limit is None:
            return None
        seconds = self.limit - (time.perf_counter() - self.start)
        if seconds <= 0:
            raise BudgetExceeded(f"time limit of {self.limit:g} s reached before: {name}")
        return seconds


@dataclass(frozen=True, slots=True)
class Stated:
    """What a folder says besides its certificates: ``summary.json``, and ``path.json`` where there is one."""

    summary: Mapping[str, Any]
    path: Mapping[str, Any] | None


P = TypeVar("P", bound=Plan)


@dataclass(frozen=True, slots=True, kw_only=True)
class Story:
    """What the page of a method says in its own words."""

    kind: str
    """The curves."""
    place: str
    """The section of the paper."""
    given: tuple[str, str, str, str]
    """Its names of the four given points."""
    claims: Mapping[str, str]
    """What each certificate says, by its label."""
    none: Section | None
    """Why there is no path, where there is none."""
    sections: tuple[Section, ...]
    """Question, answer and optimum, in order."""
    reported: str = ""
    """The time that it gives."""


class Method(Protocol[P]):
    """A planning method: a module with these functions."""

    def begin(self, problem: Problem, clock: Clock) -> Begun:
        """The path."""

    def finish(self, given: Begun, clock: Clock) -> P:
        """The plan, from there on."""

    def questions(self, problem: Problem) -> Mapping[str, Formula]:
        """What it may ask the engine about a problem, by the names that its plan has for the answers in
        ``eliminations``."""

    def reason(self, plan: P) -> str:
        """Why there is no path, in one sentence."""

    def summary_lines(self, plan: P) -> list[str]:
        """Its lines in the summary for people."""

    def json_entries(self, plan: P) -> dict[str, Any]:
        """Its further entries in the summary as JSON."""

    def draw(self, plan: P, folder: FilePath) -> Drawing:
        """Writes the pictures into a folder."""

    def story(self, plan: P, drawing: Drawing | None) -> Story:
        """What its page says beyond what every page says, with the drawing if there is one."""

    def restore(self, problem: Problem, certificate: Certificate, stated: Stated) -> tuple[P, tuple[str, ...]]:
        """The plan that the certificates in a folder prove, without any search, before obstacles and quality, with the
        certificate that the folder has to have, and a line about each thing that was checked; ``CertificateRejected``
        where they are not about the problem."""


def make(method: Method[P], problem: Problem, clock: Clock) -> P:
    """The plan of a method."""
    return method.finish(method.begin(problem, clock), clock)
