"""Steps that the methods with a system of control points share: the optimum, the path through it, and the checks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import qe
from bezier.curves.containment import Inside
from bezier.curves.scalar import Vector
from bezier.input.stored import numbers
from bezier.methods.control import terms
from bezier.methods.control.statements import Statement
from bezier.methods.control.system import System
from bezier.paths.path import Path, Proof, assemble, path_certificates, prove
from bezier.plans import Begun, Clock, Outcome, Plan
from bezier.problem import Problem
from qe.convex.optimum import BOUND, POINT
from qe.errors import CertificateRejected, InternalError, Unable
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.formula.syntax import FALSE, Atom, Exists, Formula
from qe.proof.certificate import Certificate

ELIMINATION, OPTIMUM = "elimination", "optimum"
NEAR, RULES_NEAR = (f"{OPTIMUM}: {BOUND}", f"{OPTIMUM}: {POINT}"), ("multipliers", "instance")
"""The labels of the certificates that every method with a system of control points has."""
Members = list[tuple[str, Certificate]]
"""Certificates with their labels."""


def answered(answer: Any) -> Any:
    """The engine's answer, if it is one. Raises ``Unable`` otherwise."""
    if answer.formula is None:
        raise Unable(answer.reason or "no answer was reached")
    return answer


def quantifier_free(question: Statement, clock: Clock) -> Any:
    """The engine's answer to a formula. Raises ``Unable`` where it has none."""
    with clock.step("elimination"):
        answer = answered(qe.eliminate(question.formula, timeout=clock.remaining()))
    clock.learn("quantifier-free answer", str(answer.formula))
    return answer


def least(system: System, answer: Any, clock: Clock) -> Any:
    """The engine's exact minimum of the objective under the quantifier-free answer, or its proof that there is none."""
    # an answer "false" holds no conditions to combine to a contradiction: then the given ones are taken
    conditions = system.in_free_points().formula if answer.formula == FALSE else answer.formula
    return qe.minimize(system.objective().polynomial, conditions, method="convex", timeout=clock.remaining())


@dataclass(frozen=True, slots=True)
class Certified:
    """What the certificate of an optimum shows about a system: its point and the multipliers of its constraints."""

    certificate: qe.Certificate
    points: Mapping[str, Vector] | None
    """All control points, None when the conditions contradict each other."""
    multipliers: Vector
    bound: Fraction | None = None
    """The objective is not below it, where the point is only near the optimum."""

    @staticmethod
    def of(system: System, certificate: qe.Certificate) -> Certified:
        """Read the certificate. Raises ``CertificateRejected`` when its point violates a condition of the system."""
        payload, (_, *near) = terms.proof_of(certificate), certificate.parts
        multipliers = numbers(payload["multipliers"], payload["field"], "optimum.multipliers")
        if not near:
            return Certified(certificate, terms.optimal_points(system, payload), multipliers)
        points, bound = terms.near_points(system, payload, near[0].evidence_for("instance"))
        return Certified(certificate, points, multipliers[:-1], bound)


def certified_optimum(system: System, certificate: qe.Certificate) -> Certified:
    """The optimum that planning goes on with: read from its certificate, so that checking it meets the same numbers."""
    try:
        return Certified.of(system, certificate)
    except CertificateRejected as error:
        raise InternalError(f"the certificate of the optimum says something else: {error}") from None


def restored_optimum(system: System, certificate: qe.Certificate) -> Certified:
    """The optimum in the certificates of a folder. Raises ``CertificateRejected`` when it is not this system's."""
    if terms.has_member(certificate, NEAR[0]):
        parts = [terms.member(certificate, label, rule) for label, rule in zip(NEAR, RULES_NEAR, strict=True)]
        terms.check_bound_of(system, parts[0].evidence_for("multipliers"), NEAR[0])
        return Certified.of(system, qe.Certificate.bundle(zip((BOUND, POINT), parts, strict=True)))
    optimum = terms.member(certificate, OPTIMUM, "multipliers")
    terms.check_optimum_of(system, optimum.evidence_for("multipliers"), OPTIMUM)
    return Certified.of(system, optimum)


def optimum_members(certificate: qe.Certificate) -> Members:
    """The certificate of an optimum under its label, or both parts of that of a point near it."""
    parts = certificate.parts
    return list(zip((OPTIMUM,) if len(parts) == 1 else NEAR, parts, strict=True))


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class SystemPlan(Plan):
    """The plan of a method with a system of control points."""

    system: System
    optimum: Any
    """What the engine's minimisation found, or its certificate shows: a point or a contradiction."""


def drawn(problem: Problem, system: System, certified: Certified) -> dict[str, Any]:
    """What follows from the optimum of a system, as fields of its plan: the path through it, if there is one, the
    labels of the active conditions (near an optimum: of those that bound it) and the value of the objective."""
    points, near = certified.points, certified.bound is not None
    close = [label for label, _ in terms.named_multipliers(system, certified)] if near else []
    return {
        "problem": problem,
        "system": system,
        "optimum": certified,
        "formula": str(system.statement()),
        "outcome": Outcome.INFEASIBLE if points is None else Outcome.NEAR_OPTIMAL if near else Outcome.SOLVED,
        "bound": certified.bound,
        "path": None if points is None else path_through(problem, system, points),
        "active": tuple(close) if near else () if points is None else system.active(points),
        "objective": None if points is None else system.objective_at(points),
    }


def begun(problem: Problem, system: System, clock: Clock) -> Begun:
    """Fields of the plan: elimination, optimum under its answer, and the path through it with what is proved."""
    answer = quantifier_free(system.statement(), clock)
    with clock.step("optimum"):
        optimum = least(system, answer, clock)
    clock.learn("optimum", optimum.status.value)
    with clock.step("curves and proofs"):
        fields = drawn(problem, system, certified_optimum(system, optimum.certificate))
    fields |= {"answer": answer, "optimum": optimum}
    return Begun(problem=problem, outcome=fields["outcome"], path=fields["path"], found=fields, seconds=clock.seconds)


def path_through(problem: Problem, system: System, points: Mapping[str, Vector]) -> Path:
    """The curves with what is proved about them: workspace, joins, and the half-spaces that hold a whole curve."""
    path = assemble(system.curves(points), points, problem.workspace, durations=durations(problem))
    proofs = list[Proof]()
    for item in problem.point_conditions:
        for name, listed in system.shape.curves.items():
            # what holds for all inner points of a curve holds on the whole curve if its ends satisfy it too
            if set(listed) & set(system.shape.inner) <= set(item.points):
                proofs += prove({name: path.curves[name]}, (item.half_space,))
    return replace(path, proofs=(*path.proofs, *(proof for proof in proofs if isinstance(proof.outcome, Inside))))


def durations(problem: Problem) -> dict[str, Fraction]:
    """The time that each curve takes, where it is not 1."""
    return {"P": problem.ratio, "R": problem.ratio} if problem.ratio != 1 else {}


def body_of(statement: Statement, order: tuple[str, ...]) -> Formula:
    """The formula behind an outermost existential block (or the whole formula), over the ring of these variables."""
    formula = statement.formula
    return convert(formula.body if isinstance(formula, Exists) else formula, Ring.of(order))


def elimination(system: System) -> tuple[str, qe.Certificate]:
    """That the joins, which are linear equations, eliminate the dependent points: the printed formula is equivalent to
    the conditions with those points substituted."""
    shape = system.shape
    order = (*shape.variables, *shape.quantified)
    pairs = zip(shape.quantified, (body_of(join, order) for join in system.joins()), strict=True)
    solved = [(name, equation.poly) for name, equation in pairs if isinstance(equation, Atom)]
    answer = body_of(system.in_free_points(), order)
    return ELIMINATION, qe.Certificate.substitution(body_of(system.statement(), order), order, solved, answer)


def verified(fields: Mapping[str, Any], members: Members, clock: Clock) -> dict[str, Any]:
    """The fields with all certificates in one, and what the independent checker says of each part."""
    with clock.step("verification"):
        checks = {label: qe.verify(certificate) for label, certificate in members}
        of_path = path_certificates(fields["path"]) if fields["path"] else []
        if of_path:
            checks["path"] = qe.verify(qe.Certificate.bundle(of_path))
    certificate = qe.Certificate.bundle([*members, *of_path])
    return {**fields, "certificate": certificate, "checks": checks, "seconds": clock.seconds}


def restored(fields: Mapping[str, Any], members: Members) -> dict[str, Any]:
    """The fields with all certificates in one, those of the path included."""
    of_path = path_certificates(fields["path"]) if fields["path"] else []
    return {**fields, "certificate": qe.Certificate.bundle([*members, *of_path])}
