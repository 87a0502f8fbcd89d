"""The quadratic plan found again from the certificates of a folder, without any search."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import qe
from bezier.curves.scalar import sign
from bezier.curves.workspace import Workspace, WorkspaceKind
from bezier.input.stored import numbers
from bezier.methods.control.claims import check_optimum_of, foreign, member
from bezier.methods.control.optimal_path import body_of, drawn, restored, restored_optimum
from bezier.methods.control.system import System
from bezier.methods.control.terms import Terms, condition_terms, coordinate_terms, fixed_by, reduced
from bezier.methods.quadratic import formula as quadratic
from bezier.methods.quadratic.plan import BELOW, REGION, Gap, QuadraticPlan, above_label, certificates
from bezier.paths.path import Path, prove
from bezier.problem import Problem
from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.build import conj
from qe.formula.syntax import FALSE, And, Atom, Formula, Relation
from qe.proof.cells_json import CellEvidence
from qe.proof.certificate import Certificate, Kind
from qe.proof.entry import Entry, formula_from_json


def restore(problem: Problem, certificate: Certificate) -> QuadraticPlan:
    """The plan that the certificates of a folder prove. Raises ``CertificateRejected``."""
    system = quadratic.system(problem)
    optimum = restored_optimum(system, certificate)
    fields = drawn(problem, system, optimum)
    region = _region(system, certificate, infeasible=fields["path"] is None)
    gap = _gap(problem, certificate, fields["path"])
    fields |= {"region": region, "gap": gap, "balls": quadratic.three_balls(problem)}
    return QuadraticPlan(**restored(fields, optimum, certificates(system, region, optimum, gap)))


def _region(system: System, certificate: Certificate, *, infeasible: bool) -> qe.Region:
    """The region of Q1: the cell table is about the conditions of this system."""
    payload = member(certificate, REGION, Kind.CELLS)
    table = payload.table if isinstance(payload, CellEvidence) and payload.table.is_decomposition else None
    if table is None or table.order != quadratic.FREE or any(table.quantifiers) or payload.answer is not None:
        raise CertificateRejected(REGION, f"expected the table of a region of {', '.join(quadratic.FREE)}")
    region = qe.Region(table.matrix, table, table.order)
    if region.is_empty != infeasible:
        raise CertificateRejected(REGION, "the region and the optimum disagree about the existence of a control point")
    if not _says_the_same(system, table.matrix, infeasible=infeasible):
        raise CertificateRejected(REGION, "the cell table is about another formula")
    return region


def _says_the_same(system: System, matrix: Formula, *, infeasible: bool) -> bool:
    """Whether the formula says what the conditions of the system say.

    Each atom is one of the conditions, and each condition is an atom or weaker than one (a smaller constant); variables
    that are fixed by equations may have been replaced. Where the engine has rewritten the conditions further, it
    decides the equivalence of two formulas without quantifiers. ``infeasible``: the conditions are known to have no
    solution, and neither has the formula; then only the atoms need to be conditions of this system.
    """
    stated = [_at_most_zero(part) for part in (matrix.args if isinstance(matrix, And) else (matrix,))]
    known = [item for item in stated if item is not None]
    fixed = fixed_by(known)
    ours = len(known) == len(stated) and foreign(system, known, fixed) is None
    if infeasible:
        return ours or matrix == FALSE
    if ours and all(_follows(condition_terms(system, item), known, fixed) for item in system.conditions):
        return True
    return qe.equivalent(system.in_free_points().formula, matrix)


def _at_most_zero(part: Formula) -> tuple[Terms, str] | None:
    """An atom as a polynomial that is at most zero, or zero; None for anything else."""
    if not isinstance(part, Atom) or part.relation not in (Relation.LE, Relation.GE, Relation.EQ):
        return None
    side = -1 if part.relation is Relation.GE else 1
    terms: Terms = {exponents: Fraction(side * c) for exponents, c in part.poly.terms()}
    return terms, "=" if part.relation is Relation.EQ else "<="


def _follows(terms: Terms, known: list[tuple[Terms, str]], fixed: dict[int, Any]) -> bool:
    """Whether p <= 0 follows from one of the atoms s <= 0 (or s = 0): p = c s - d with c > 0 and d >= 0."""
    goal = reduced(terms, fixed)
    if all(not any(exponents) for exponents in goal):
        return all(c <= 0 for c in goal.values())
    for other, relation in known:
        atom = reduced(other, fixed)
        for side in (1, -1) if relation == "=" else (1,):
            if _weaker(goal, {exponents: side * c for exponents, c in atom.items()}):
                return True
    return False


def _weaker(goal: Terms, atom: Terms) -> bool:
    """Whether goal = c atom - d with c > 0 and d >= 0."""
    slopes = {e: c for e, c in goal.items() if any(e)}
    others = {e: c for e, c in atom.items() if any(e)}
    if slopes.keys() != others.keys():
        return False
    key = next(iter(slopes))
    ratio = slopes[key] / others[key]
    zero = (0,) * len(key)
    same = ratio > 0 and all(slopes[e] == ratio * others[e] for e in slopes)
    return same and goal.get(zero, 0) <= ratio * atom.get(zero, 0)


# --- the question of the table -------------------------------------------------------------------------------------


def _gap(problem: Problem, certificate: Certificate, path: Path | None) -> Gap:
    """Whether the printed formula lets a control point fall below the table, by its certificates."""
    floor = Workspace(WorkspaceKind.HEMISPHERE, problem.workspace.radius_squared).floor
    chosen = prove(path.curves, (floor,)) if path else ()
    labels = [item.label for item in certificate.payload] if isinstance(certificate.payload, tuple) else []
    if BELOW in labels:
        payload: Any = member(certificate, BELOW, Kind.WITNESS)
        _check_example(problem, payload)
        return Gap({}, None, chosen, ((BELOW, Certificate(Kind.WITNESS, payload)),))
    printed, found = quadratic.printed(problem), []
    for point in quadratic.SHAPE.inner:
        label = above_label(point)
        payload = member(certificate, label, Kind.OPTIMUM)
        check_optimum_of(printed, payload, label, coordinate_terms(printed, point, 2))
        if payload["status"] == "optimal" and sign(numbers([payload["value"]], payload["field"], label)[0]) < 0:
            raise CertificateRejected(f"{label}: value", "the control point can lie below the table")
        found.append((label, Certificate(Kind.OPTIMUM, payload)))
    return Gap(None, None, chosen, tuple(found))


def _check_example(problem: Problem, payload: dict[str, Any]) -> None:
    """The witness is about the question of this problem."""
    order = quadratic.FREE + quadratic.QUANTIFIED
    if tuple(payload["order"]) != order:
        raise CertificateRejected(f"{BELOW}: order", f"expected {', '.join(order)}")
    stated = formula_from_json(Entry(payload["matrix"], f"{BELOW}: matrix"), Ring.of(order))
    if _parts(stated) != _parts(body_of(quadratic.leaving(problem), order)):
        raise CertificateRejected(f"{BELOW}: matrix", "not the question of this problem")


def _parts(formula: Formula) -> frozenset[Formula]:
    whole = conj([formula])
    return frozenset(whole.args if isinstance(whole, And) else (whole,))
