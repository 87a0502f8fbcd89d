"""Planning with three quadratic curves, step by step: formula (8), answer, region, optimum, curves, proofs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

import qe
from bezier.curves.scalar import Vector, rational, sign
from bezier.curves.workspace import Workspace, WorkspaceKind
from bezier.input.stored import numbers
from bezier.methods.control import optimal_path
from bezier.methods.control.system import System
from bezier.methods.control.terms import check_optimum_of, coordinate_terms, member
from bezier.methods.quadratic import formula as quadratic
from bezier.paths.path import Path, Proof, prove
from bezier.plans import Begun, Clock, Stated
from bezier.problem import Problem
from qe.certify.claims import is_about
from qe.errors import CertificateRejected, InternalError, Unable
from qe.formula.build import exists
from qe.formula.syntax import FALSE, TRUE, Formula
from qe.proof.certificate import Certificate, table_of
from qe.simplifier.simplify import simplify

REGION, BELOW = "region", "below the table"
"""Labels of certificates."""
FORMULA, TABLE, CORRECTED = "formula (8)", "the condition z ≥ 0", "formula (8) with z >= 0"
"""What the engine is asked."""
EXAMPLE_ORDER = (*quadratic.SHAPE.free, *quadratic.SHAPE.follows)
"""The control points in the order of the variables of the question about the table."""


def above_label(point: str) -> str:
    """The label of the certificate that the printed formula keeps a control point above the table."""
    return f"{point} above the table"


@dataclass(frozen=True, slots=True)
class Gap:
    """Whether control points that the printed formula (8) allows can lie below the table {z = 0}."""

    example: Mapping[str, Vector] | None
    """Control points that the formula allows, one of them below the table, or None when there are none."""
    region: Any | None
    """The region with z >= 0 added for all control points, where there is a gap."""
    chosen: tuple[Proof, ...]
    """What was found out about z >= 0 along the curves of the chosen path."""
    certificates: tuple[tuple[str, qe.Certificate], ...] = ()
    """Of the example, or that the formula keeps each control point above the table."""
    answers: Mapping[str, Any] = field(default_factory=dict)
    """Of the engine, by what was asked."""

    @property
    def can_leave(self) -> bool:
        """Whether some allowed control point lies below the table."""
        return self.example is not None


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class QuadraticPlan(optimal_path.SystemPlan):
    """``region``: of Q1. ``gap``: what the printed formula leaves open about the table."""

    region: Any
    balls: quadratic.ThreeBalls
    gap: Gap

    @property
    def files(self) -> dict[str, str]:
        return {"region.json": self.region.to_json()}

    @property
    def hatted_names(self) -> bool:
        return True


def begin(problem: Problem, clock: Clock) -> Begun:
    """The path of formula (8)."""
    return optimal_path.begun(problem, quadratic.system(problem), clock)


def finish(given: Begun, clock: Clock) -> QuadraticPlan:
    """The plan with formula (8)."""
    found: dict[str, Any] = given.found
    problem, answer, optimum = given.problem, found["answer"], found["optimum"]
    with clock.step("region"):
        region = qe.region(answer.formula, order=quadratic.FREE, timeout=clock.remaining())
    clock.learn("region", "empty" if region.is_empty else "not empty")
    if region.is_empty == (optimum.value is not None):
        raise InternalError("the region and the optimum disagree about the existence of a control point")
    with clock.step("hemisphere question"):
        gap = _gap(problem, region, given.path, clock)
    fields = found | {"region": region, "gap": gap, "balls": quadratic.three_balls(problem)}
    members = certificates(found["system"], region, optimum, gap)
    return QuadraticPlan(**optimal_path.verified(fields, members, clock), eliminations={FORMULA: answer, **gap.answers})


def questions(problem: Problem) -> dict[str, Formula]:
    """What is asked of the engine about a problem."""
    statements = {FORMULA: quadratic.system(problem).statement(), TABLE: quadratic.leaving(problem)}
    statements[CORRECTED] = quadratic.corrected(problem).statement()
    return {name: statement.formula for name, statement in statements.items()}


def certificates(system: System, region: qe.Region, optimum: Any, gap: Gap) -> optimal_path.Members:
    """The labelled certificates of a plan, those of its path left out."""
    result = [optimal_path.elimination(system), (REGION, region.certificate)]
    return [*result, *optimal_path.optimum_members(optimum.certificate), *gap.certificates]


def _gap(problem: Problem, region: Any, path: Path | None, clock: Clock) -> Gap:
    """Ask the engine whether the printed formula lets a control point fall below the table.

    ``region``: the problem's own region, which is the corrected one for a hemisphere.
    """
    leaves = optimal_path.answered(qe.eliminate(quadratic.leaving(problem).formula, timeout=clock.remaining()))
    floor = Workspace(WorkspaceKind.HEMISPHERE, problem.workspace.radius_squared).floor
    chosen = prove(path.curves, (floor,)) if path else ()
    if leaves.truth is False:
        return Gap(None, None, chosen, tuple(above_certificates(problem, clock)), {TABLE: leaves})
    if leaves.truth is not True or leaves.witness is None:
        raise InternalError("the hemisphere question got neither a witness nor a refutation")
    printed = quadratic.printed(problem)
    points = printed.points([tuple(leaves.witness.get(name, Fraction(0)) for name in quadratic.FREE)])
    example = {name: points[name] for name in quadratic.SHAPE.inner}
    if printed.violated(points) or all(sign(point[2]) >= 0 for point in example.values()):
        raise InternalError("the engine's example does not show what it should")
    shown = ((BELOW, example_certificate(problem, example, leaves.certificate)),)
    if problem.workspace.kind is WorkspaceKind.HEMISPHERE:
        return Gap(example, region, chosen, shown, {TABLE: leaves})
    answer = optimal_path.answered(
        qe.eliminate(quadratic.corrected(problem).statement().formula, timeout=clock.remaining())
    )
    smaller = qe.region(answer.formula, order=quadratic.FREE, timeout=clock.remaining())
    return Gap(example, smaller, chosen, shown, {TABLE: leaves, CORRECTED: answer})


def above_certificates(problem: Problem, clock: Clock) -> Iterator[tuple[str, qe.Certificate]]:
    """For each inner control point the least height that the printed formula allows it, which is not negative."""
    printed = quadratic.printed(problem)
    for point in quadratic.SHAPE.inner:
        least_height = qe.minimize(
            printed.coordinate(point, 2).polynomial,
            printed.in_free_points().formula,
            method="convex",
            timeout=clock.remaining(),
        )
        if least_height.bound is not None:
            raise Unable(f"the least height of {point} needs a number field of high degree")
        if least_height.is_optimal and sign(least_height.value) < 0:
            raise InternalError(f"{point} can lie below the table although that was refuted")
        yield above_label(point), least_height.certificate


def example_certificate(
    problem: Problem, example: Mapping[str, Vector], certificate: qe.Certificate | None
) -> qe.Certificate:
    """The witness that the printed formula allows the example; the engine's own for irrational examples."""
    values = [rational(c) for name in EXAMPLE_ORDER for c in example[name]]
    known = [v for v in values if v is not None]
    if len(known) == len(values):
        order = quadratic.FREE + quadratic.QUANTIFIED
        return qe.Certificate.witness(optimal_path.body_of(quadratic.leaving(problem), order), order, known)
    if certificate is None:
        raise InternalError("an irrational example without a certificate")
    return certificate


def restore(problem: Problem, certificate: Certificate, stated: Stated) -> tuple[QuadraticPlan, tuple[str, ...]]:
    """The plan that the certificates of a folder prove; nothing else in the folder is needed for it."""
    system = quadratic.system(problem)
    optimum = optimal_path.restored_optimum(system, certificate)
    fields = optimal_path.drawn(problem, system, optimum)
    region = _region(system, certificate, infeasible=fields["path"] is None)
    gap = _restored_gap(problem, certificate, fields["path"])
    fields |= {"region": region, "gap": gap, "balls": quadratic.three_balls(problem)}
    plan = QuadraticPlan(**optimal_path.restored(fields, certificates(system, region, optimum, gap)))
    return plan, ("the region belongs to formula (8) of this problem", "the optimum belongs to this problem")


def _region(system: System, certificate: Certificate, *, infeasible: bool) -> qe.Region:
    """The region of Q1: the cell table is about a formula that says what the conditions of this system say. Where these
    are known to have no solution, and neither has the formula, it need only follow from them."""
    table = table_of(member(certificate, REGION, "cells"))
    if table is None or table.order != quadratic.FREE or not table.is_decomposition:
        raise CertificateRejected(REGION, f"expected the table of a region of {', '.join(quadratic.FREE)}")
    region = qe.Region(table.matrix, table, table.order)
    if region.is_empty != infeasible:
        raise CertificateRejected(REGION, "the region and the optimum disagree about the existence of a control point")
    conditions, matrix = system.in_free_points().formula, table.matrix
    follows = simplify(matrix, conditions) == TRUE
    if infeasible:
        is_same = follows or matrix == FALSE
    else:  # where the engine has rewritten the conditions further, it decides
        is_same = (follows and simplify(conditions, matrix) == TRUE) or qe.equivalent(conditions, matrix)
    if not is_same:
        raise CertificateRejected(REGION, "the cell table is about another formula")
    return region


# --- the question of the table -------------------------------------------------------------------------------------


def _restored_gap(problem: Problem, certificate: Certificate, path: Path | None) -> Gap:
    """Whether the printed formula lets a control point fall below the table, by its certificates."""
    floor = Workspace(WorkspaceKind.HEMISPHERE, problem.workspace.radius_squared).floor
    chosen = prove(path.curves, (floor,)) if path else ()
    labels = [item.label for item in certificate.payload] if isinstance(certificate.payload, tuple) else []
    if BELOW in labels:
        example = member(certificate, BELOW, "instance")
        order = quadratic.FREE + quadratic.QUANTIFIED
        if is_about(example, exists(order, optimal_path.body_of(quadratic.leaving(problem), order))) != TRUE:
            raise CertificateRejected(BELOW, "not the question of this problem")
        return Gap({}, None, chosen, ((BELOW, example),))
    printed, result = quadratic.printed(problem), []
    for point in quadratic.SHAPE.inner:
        label = above_label(point)
        highest = member(certificate, label, "multipliers")
        payload = highest.evidence_for("multipliers")
        check_optimum_of(printed, payload, label, coordinate_terms(printed, point, 2))
        if payload["status"] == "optimal" and sign(numbers([payload["value"]], payload["field"], label)[0]) < 0:
            raise CertificateRejected(f"{label}: value", "the control point can lie below the table")
        result.append((label, highest))
    return Gap(None, None, chosen, tuple(result))
