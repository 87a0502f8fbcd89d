"""Planning with three quadratic curves, step by step: formula (8), answer, region, optimum, curves, proofs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import qe
from bezier.control import System
from bezier.curves.scalar import Vector, sign
from bezier.curves.workspace import Workspace, WorkspaceKind
from bezier.optimal_path import chosen_path, eliminated, least, quantifier_free, verified
from bezier.path import Path, Proof, prove
from bezier.plan import Clock, Outcome, Plan, answered
from bezier.problem import Problem
from bezier.quadratic import formula as quadratic
from qe.errors import InternalError


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


@dataclass(frozen=True, slots=True, kw_only=True)
class QuadraticPlan(Plan):
    """``region``: of Q1. ``optimum``: what the engine's minimisation found, be it a point or a contradiction."""

    system: System
    region: Any
    optimum: Any
    balls: quadratic.ThreeBalls
    gap: Gap


def make(problem: Problem, clock: Clock) -> QuadraticPlan:
    """Plan with formula (8)."""
    system = quadratic.system(problem)
    text = system.formula()
    answer = quantifier_free(text, clock)
    with clock.step("region"):
        region = qe.region(answer.formula, order=quadratic.FREE, timeout=clock.remaining())
    clock.learn("region", "empty" if region.is_empty else f"{len(region.cells)} cells")
    with clock.step("optimum"):
        optimum = least(system, answer, clock)
    if region.is_empty == optimum.is_optimal:
        raise InternalError("the region and the optimum disagree about the existence of a control point")
    with clock.step("curves and proofs"):
        path, active = chosen_path(problem, system, optimum)
    with clock.step("hemisphere question"):
        gap = _gap(problem, region, path, clock)
    with clock.step("verification"):
        members = [*eliminated(answer), ("region", region.certificate), ("optimum", optimum.certificate)]
        if gap.certificate is not None:
            members.append(("below the table", gap.certificate))
        certificate, checks = verified(members, path)
    return QuadraticPlan(
        problem=problem,
        outcome=Outcome.SOLVED if path else Outcome.INFEASIBLE,
        formula=text,
        answer=answer,
        objective=optimum.value,
        path=path,
        active=active,
        certificate=certificate,
        checks=checks,
        seconds=clock.seconds,
        system=system,
        region=region,
        optimum=optimum,
        balls=quadratic.three_balls(problem),
        gap=gap,
    )


def _gap(problem: Problem, region: Any, path: Path | None, clock: Clock) -> Gap:
    """Ask the engine whether the printed formula lets a control point fall below the table.

    ``region``: the problem's own region, which is the corrected one for a hemisphere.
    """
    asked = answered(qe.eliminate(quadratic.leaving_formula(problem), timeout=clock.remaining()))
    floor = Workspace(WorkspaceKind.HEMISPHERE, problem.workspace.radius_squared).floor
    chosen = prove(path.curves, (floor,)) if path else ()
    if asked.truth is False:
        return Gap(None, None, chosen)
    if asked.truth is not True or asked.witness is None:
        raise InternalError("the hemisphere question got neither a witness nor a refutation")
    printed = quadratic.printed(problem)
    points = printed.points([tuple(asked.witness.get(name, Fraction(0)) for name in quadratic.FREE)])
    example = {name: points[name] for name in quadratic.SHAPE.inner}
    if printed.violated(points) or all(sign(point[2]) >= 0 for point in example.values()):
        raise InternalError("the engine's example does not show what it should")
    if problem.workspace.kind is WorkspaceKind.HEMISPHERE:
        return Gap(example, region, chosen, asked.certificate)
    answer = answered(qe.eliminate(quadratic.corrected(problem).formula(), timeout=clock.remaining()))
    smaller = qe.region(answer.formula, order=quadratic.FREE, timeout=clock.remaining())
    return Gap(example, smaller, chosen, asked.certificate)
