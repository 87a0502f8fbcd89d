"""Planning with three cubic curves, step by step: formula (7), answer, optimum, curves, proofs, speed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from bezier.methods.control.optimal_path import (
    OPTIMUM,
    SystemPlan,
    drawn,
    elimination,
    found_optimum,
    least,
    path_through,
    quantifier_free,
    restored,
    restored_optimum,
    verified,
)
from bezier.methods.control.system import System
from bezier.methods.cubic import formula as cubic
from bezier.paths.path import Path
from bezier.paths.speed import Slowest, slowest_of
from bezier.plans import Clock
from bezier.problem import Problem
from qe.formula.syntax import Formula
from qe.proof.certificate import Certificate

FORMULA = "formula (7)"
"""What the engine is asked."""


@dataclass(frozen=True, slots=True)
class Trivial:
    """The choice Q1 = Q0, Q2 = R0, which always satisfies formula (7) as printed.

    ``path``: through it; ``violated``: the problem's further conditions that it violates; ``slowest``: each curve's
    least speed, which is zero at the joins.
    """

    path: Path
    violated: tuple[str, ...]
    slowest: Mapping[str, Slowest]


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class CubicPlan(SystemPlan):
    """``slowest``: of each curve of the path (empty without a path)."""

    slowest: Mapping[str, Slowest]
    trivial: Trivial


def make(problem: Problem, clock: Clock) -> CubicPlan:
    """Plan with formula (7)."""
    system = cubic.system(problem)
    answer = quantifier_free(system.statement(), clock)
    with clock.step("optimum"):
        optimum = least(system, answer, clock)
    clock.learn("optimum", optimum.status.value)
    with clock.step("curves and proofs"):
        fields = drawn(problem, system, found_optimum(system, optimum.certificate))
    with clock.step("speed"):
        fields |= _speeds(problem, system, fields["path"])
    with clock.step("verification"):
        certificate, checks = verified([elimination(system), (OPTIMUM, optimum.certificate)], fields["path"])
    return CubicPlan(
        **fields,
        answer=answer,
        optimum=optimum,
        certificate=certificate,
        checks=checks,
        seconds=clock.seconds,
        eliminations={FORMULA: answer},
    )


def questions(problem: Problem) -> dict[str, Formula]:
    """What is asked of the engine about a problem."""
    return {FORMULA: cubic.system(problem).statement().formula}


def restore(problem: Problem, certificate: Certificate) -> CubicPlan:
    """The plan that the certificates of a folder prove. Raises ``CertificateRejected``."""
    system = cubic.system(problem)
    optimum = restored_optimum(system, certificate)
    fields = drawn(problem, system, optimum)
    fields |= _speeds(problem, system, fields["path"])
    return CubicPlan(**restored(fields, optimum, [elimination(system), (OPTIMUM, optimum.certificate)]))


def _speeds(problem: Problem, system: System, path: Path | None) -> dict[str, Any]:
    """What only the plan of this method has."""
    slowest = slowest_of(path) if path else {}
    return {"slowest": slowest, "trivial": _trivial(problem, system), "remarks": _remarks(problem)}


def _remarks(problem: Problem) -> tuple[str, ...]:
    found = []
    if problem.ratio != 1:
        found.append(f"the outer curves take {problem.ratio} of the time of the middle one")
    if problem.join_speed:
        found.append(
            f"a speed of at least {problem.join_speed} mm per unit of time at both joins is required, in the form of a"
            " speed in the direction from Q0 to R0"
        )
    return tuple(found)


def _trivial(problem: Problem, system: System) -> Trivial:
    points = system.points(cubic.trivial_choice(problem))
    path = path_through(problem, system, points)
    return Trivial(path, system.violated(points), slowest_of(path))
