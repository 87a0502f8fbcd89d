"""Steps that the methods with a system of control points share: the optimum, the path through it, and the checks."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

import qe
from bezier.control import System
from bezier.curves.containment import Inside
from bezier.curves.evidence import path_certificates
from bezier.curves.scalar import Vector
from bezier.path import Path, Proof, assemble, prove
from bezier.plan import Clock, answered
from bezier.problem import Problem
from qe.errors import InternalError
from qe.formula.syntax import FALSE


def quantifier_free(text: str, clock: Clock) -> Any:
    """The engine's answer to a formula. Raises ``Unable`` where it has none."""
    with clock.step("elimination"):
        answer = answered(qe.eliminate(text, timeout=clock.remaining()))
    clock.learn("quantifier-free answer", str(answer.formula))
    return answer


def least(system: System, answer: Any, clock: Clock) -> Any:
    """The engine's exact minimum of the objective under the quantifier-free answer, or its proof that there is none."""
    # an answer "false" holds no conditions to combine to a contradiction: then the given ones are taken
    conditions = system.conditions_text() if answer.formula == FALSE else answer.formula
    return qe.minimize(system.objective(), conditions, timeout=clock.remaining())


def chosen_path(problem: Problem, system: System, optimum: Any) -> tuple[Path | None, tuple[str, ...]]:
    """The path through the optimum with the labels of the active conditions; (None, ()) when there is no optimum.

    Checks exactly that the engine's point satisfies every condition.
    """
    if not optimum.is_optimal:
        return None, ()
    values = iter([optimum.point[name] for name in system.shape.variables])
    points = system.points([(next(values), next(values), next(values)) for _ in system.shape.free])
    violated = system.violated(points)
    if violated:
        raise InternalError(f"the optimum violates the condition {violated[0]}")
    return path_through(problem, system, points), system.active(points)


def path_through(problem: Problem, system: System, points: Mapping[str, Vector]) -> Path:
    """The curves with what is proved about them: workspace, joins, and the half-spaces that hold a whole curve."""
    path = assemble(system.curves(points), points, problem.workspace, durations=durations(problem))
    return path.with_proofs(_whole_curves(problem, system, path))


def durations(problem: Problem) -> dict[str, Fraction]:
    """The time that each curve takes, where it is not 1."""
    return {"P": problem.ratio, "R": problem.ratio} if problem.ratio != 1 else {}


def _whole_curves(problem: Problem, system: System, path: Path) -> tuple[Proof, ...]:
    """A condition on all inner points of a curve holds on the whole curve if its ends satisfy it too."""
    found: list[Proof] = []
    for item in problem.point_conditions:
        for name, listed in system.shape.curves.items():
            if set(listed) & set(system.shape.inner) <= set(item.points):
                found += prove({name: path.curves[name]}, (item.half_space,))
    return tuple(proof for proof in found if isinstance(proof.outcome, Inside))


def eliminated(answer: Any) -> list[tuple[str, qe.Certificate]]:
    """The certificate that the answer is equivalent to the formula as printed, where there is one."""
    return [] if answer.certificate is None else [("elimination", answer.certificate)]


def verified(
    members: list[tuple[str, qe.Certificate]], path: Path | None
) -> tuple[qe.Certificate, dict[str, qe.Verdict]]:
    """All certificates in one, those of the path included, and what the independent checker says of each part."""
    checks = {label: qe.verify(certificate) for label, certificate in members}
    of_path = path_certificates(path) if path else []
    if of_path:
        checks["path"] = qe.verify(qe.Certificate.bundle(of_path))
    return qe.Certificate.bundle([*members, *of_path]), checks
