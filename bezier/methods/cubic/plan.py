"""Planning with three cubic curves, step by step: formula (7), answer, optimum, curves, proofs, speed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from bezier.methods.control.optimal_path import (
    OPTIMUM,
    bundled,
    chosen_path,
    elimination,
    found_optimum,
    least,
    path_through,
    quantifier_free,
    restored_optimum,
    verified,
)
from bezier.methods.control.system import System
from bezier.methods.cubic import formula as cubic
from bezier.paths.path import Path
from bezier.paths.speed import Slowest, slowest_of
from bezier.plan import Clock, Outcome, Plan
from bezier.problem import Problem
from qe.proof.certificate import Certificate


@dataclass(frozen=True, slots=True)
class Trivial:
    """The choice Q1 = Q0, Q2 = R0, which always satisfies formula (7) as printed.

    ``path``: through it; ``violated``: the problem's further conditions that it violates; ``slowest``: each curve's
    least speed, which is zero at the joins.
    """

    path: Path
    violated: tuple[str, ...]
    slowest: Mapping[str, Slowest]


@dataclass(frozen=True, slots=True, kw_only=True)
class CubicPlan(Plan):
    """``optimum``: what the engine's minimisation found, be it a point or a contradiction; ``slowest``: of each
    curve of the path (empty without a path)."""

    system: System
    optimum: Any
    slowest: Mapping[str, Slowest]
    trivial: Trivial


def make(problem: Problem, clock: Clock) -> CubicPlan:
    """Plan with formula (7)."""
    system = cubic.system(problem)
    text = system.formula()
    answer = quantifier_free(text, clock)
    with clock.step("optimum"):
        optimum = least(system, answer, clock)
    clock.learn("optimum", optimum.status.value)
    with clock.step("curves and proofs"):
        path, active, objective = chosen_path(problem, system, found_optimum(system, optimum.certificate))
    with clock.step("speed"):
        slowest = slowest_of(path) if path else {}
        trivial = _trivial(problem, system)
    with clock.step("verification"):
        certificate, checks = verified([elimination(system), (OPTIMUM, optimum.certificate)], path)
    return CubicPlan(
        problem=problem,
        outcome=Outcome.SOLVED if path else Outcome.INFEASIBLE,
        formula=text,
        answer=answer,
        objective=objective,
        path=path,
        active=active,
        certificate=certificate,
        checks=checks,
        seconds=clock.seconds,
        remarks=_remarks(problem),
        system=system,
        optimum=optimum,
        slowest=slowest,
        trivial=trivial,
    )


def restore(problem: Problem, certificate: Certificate) -> CubicPlan:
    """The plan that the certificates of a folder prove. Raises ``CertificateRejected``."""
    system = cubic.system(problem)
    optimum = restored_optimum(system, certificate)
    path, active, objective = chosen_path(problem, system, optimum)
    return CubicPlan(
        problem=problem,
        outcome=Outcome.SOLVED if path else Outcome.INFEASIBLE,
        formula=system.formula(),
        answer=None,
        objective=objective,
        path=path,
        active=active,
        certificate=bundled([elimination(system), (OPTIMUM, optimum.certificate)], path),
        checks={},
        seconds={},
        remarks=_remarks(problem),
        system=system,
        optimum=optimum,
        slowest=slowest_of(path) if path else {},
        trivial=_trivial(problem, system),
    )


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
