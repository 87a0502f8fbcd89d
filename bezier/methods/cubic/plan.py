"""Planning with three cubic curves, step by step: formula (7), answer, optimum, curves, proofs, speed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from bezier.methods.control.optimal_path import (
    Drawn,
    Members,
    SystemPlan,
    begun,
    drawn,
    elimination,
    optimum_members,
    path_through,
    restored,
    restored_optimum,
    verified,
)
from bezier.methods.control.system import System
from bezier.methods.cubic import formula as cubic
from bezier.paths.path import Path, Slowest, slowest_of
from bezier.plans import Begun, Clock
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


def begin(problem: Problem, clock: Clock) -> Begun:
    """The path of formula (7)."""
    return begun(problem, cubic.system(problem), clock)


def finish(given: Begun, clock: Clock) -> CubicPlan:
    """The plan with formula (7)."""
    result: Drawn = given.found
    with clock.step("speed"):
        fields = {**result.fields, **_speeds(given.problem, result.system, given.path)}
    with clock.step("verification"):
        certificate, checks = verified(_members(result.system, result.optimum.certificate), given.path)
    return CubicPlan(
        **fields,
        answer=result.answer,
        optimum=result.optimum,
        certificate=certificate,
        checks=checks,
        seconds=clock.seconds,
        eliminations={FORMULA: result.answer},
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
    return CubicPlan(**restored(fields, optimum, _members(system, optimum.certificate)))


def _members(system: System, certificate: Certificate) -> Members:
    return [elimination(system), *optimum_members(certificate)]


def _speeds(problem: Problem, system: System, path: Path | None) -> dict[str, Any]:
    """What only the plan of this method has."""
    slowest = slowest_of(path) if path else {}
    return {"slowest": slowest, "trivial": _trivial(problem, system), "remarks": _remarks(problem)}


def _remarks(problem: Problem) -> tuple[str, ...]:
    result = []
    if problem.ratio != 1:
        result.append(f"the outer curves take {problem.ratio} of the time of the middle one")
    if problem.join_speed:
        result.append(
            f"a speed of at least {problem.join_speed} mm per unit of time at both joins is required, in the form of a"
            " speed in the direction from Q0 to R0"
        )
    return tuple(result)


def _trivial(problem: Problem, system: System) -> Trivial:
    points = system.points(cubic.trivial_choice(problem))
    path = path_through(problem, system, points)
    return Trivial(path, system.violated(points), slowest_of(path))
