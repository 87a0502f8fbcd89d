"""Strict constraints: whether an infimum over the closed problem is attained, approached, or of an empty problem."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from qe.convex.kkt import sign
from qe.convex.minimise import Task, solve
from qe.convex.violation import violation_form
from qe.errors import Unable
from qe.exact.quadratic_form import Number, Quadratic
from qe.options import Budget
from qe.proof.multipliers import Face, FormRelation, OptimumEvidence, OptimumStatus

_ZERO = Fraction(0)


def settle_strict(task: Task, evidence: OptimumEvidence, *, budget: Budget) -> OptimumEvidence:
    """The evidence for the problem with its strict constraints, given that for the closed one.

    If the optimal point satisfies them it is attained. Otherwise, by convexity, the optimum of the closed problem is
    the infimum of the strict one as soon as that has any point, and the strict problem is empty otherwise.
    """
    if evidence.status is not OptimumStatus.OPTIMAL:
        return evidence
    strict = [i for i, r in enumerate(task.relations) if r is FormRelation.LT]
    if all(sign(task.forms[i].value(evidence.point)) < 0 for i in strict):
        return replace(evidence, attained=True)
    extended, scales = _least_violation(task, strict)
    found = solve(extended, budget=budget)
    if found.status is not OptimumStatus.OPTIMAL:
        raise Unable("the strict constraints could not be decided")
    if sign(found.point[-1]) < 0:
        return replace(evidence, attained=False, inner_field=found.field, inner_point=found.point[:-1])
    return _empty(task, found, scales)


def _least_violation(task: Task, strict: list[int]) -> tuple[Task, dict[int, Fraction]]:
    """Minimise t subject to scale_i * p_i <= t for the strict constraints, -1 <= t, and all others as they are."""
    size = len(task.names)
    forms: list[Quadratic] = []
    scales: dict[int, Fraction] = {}
    for i, form in enumerate(task.forms):
        if i in strict:
            extended, scales[i] = violation_form(form)
        else:
            hessian = (*((*row, _ZERO) for row in form.hessian), (_ZERO,) * (size + 1))
            extended = Quadratic(hessian, (*form.gradient, _ZERO), form.constant)
        forms.append(extended)
    nothing = ((_ZERO,) * (size + 1),) * (size + 1)
    forms.append(Quadratic(nothing, (_ZERO,) * size + (Fraction(-1),), Fraction(-1)))
    relations = tuple(FormRelation.EQ if r is FormRelation.EQ else FormRelation.LE for r in task.relations)
    height = Quadratic(nothing, (_ZERO,) * size + (Fraction(1),), _ZERO)
    names = (*task.names, "violation")
    return Task(names, height, tuple(forms), (*relations, FormRelation.LE)), scales


def _empty(task: Task, found: OptimumEvidence, scales: dict[int, Fraction]) -> OptimumEvidence:
    """Infeasibility: the multipliers of the least violation t >= 0, without the coordinate t."""
    size = len(task.names)
    kept: list[int] = []  # places of derived equations that are not about t alone
    place = 0
    faces = []
    for face in found.faces:
        weights = [w * scales.get(i, 1) for i, w in enumerate(face.weights[:-1])]
        chosen = tuple(face.derived[k] for k in kept)
        faces.append(Face(tuple(weights), chosen, face.point[:size]))
        for i, w in enumerate(face.weights):
            if w > 0 and found.relations[i] is not FormRelation.EQ:
                block = range(place, place + size + 2)
                kept += [k for k in block if k != place + size]
                place += size + 2
    multipliers: list[Number] = [m * scales.get(i, 1) for i, m in enumerate(found.multipliers[:-1])]
    return task.start(
        status=OptimumStatus.INFEASIBLE,
        field=found.field,
        faces=tuple(faces),
        point=found.point[:size],
        multipliers=tuple(multipliers),
        derived=tuple(found.derived[k] for k in kept),
    )
