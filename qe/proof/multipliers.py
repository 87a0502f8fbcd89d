"""Evidence about a convex optimisation problem, as pure data: what a certificate of kind "optimum" holds.

The problem: minimise f(x) subject to forms p_i(x) <= 0, p_i(x) < 0 or p_i(x) = 0 (then linear), f and p_i convex
quadratic polynomials over Q. The statements that the data proves are those of ``qe.expert.optimum``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import Enum
from fractions import Fraction

from qe.exact.field import FieldElement, NumberField
from qe.exact.quadratic_form import Quadratic, dot

Number = Fraction | FieldElement
Point = tuple[Number, ...]


class OptimumStatus(Enum):
    """What is known about a minimisation problem."""

    OPTIMAL = "optimal"
    NEAR_OPTIMAL = "near-optimal"
    """The optimum lies between two rational numbers, proved, whose difference is at most 10^-9 of it."""
    INFEASIBLE = "infeasible"
    UNBOUNDED = "unbounded"


class FormRelation(Enum):
    """How a constraint form compares with zero."""

    LE = "<="
    LT = "<"
    EQ = "="


@dataclass(frozen=True, slots=True)
class Face:
    """One step of facial reduction (Borwein–Wolkowicz 1981), over Q.

    With L = sum weights_i p_i + sum derived_k e_k (e_k the equations derived by earlier faces), ``point`` is
    stationary for L and L(point) >= 0, weights >= 0 on inequalities. Then every feasible x has L(x) = L(point) = 0,
    so for each inequality with weight > 0: H_i (x - point) = 0 and p_i(point) + grad p_i(point).(x - point) = 0.
    These linear equations (n + 1 per such inequality, in this order) are what the face derives.
    """

    weights: tuple[Fraction, ...]
    derived: tuple[Fraction, ...]
    point: tuple[Fraction, ...]


@dataclass(frozen=True, slots=True)
class FaceLink:
    """One step of facial reduction at a point y of the closed problem, over the field of that point.

    ``weights``: one number per constraint, >= 0 on inequalities and zero where those are not active at y; ``derived``:
    one per equation known so far. Their sum L is stationary at y and zero there, so all points that count have
    p_i = 0 wherever weights_i > 0: none exists if that constraint is strict, and otherwise H_i (x - y) = 0 and
    grad p_i(y).(x - y) = 0 (``tangents``), which the next link may use.
    """

    weights: tuple[Number, ...]
    derived: tuple[Number, ...]


def derived_equations(face: Face, forms: Sequence[Quadratic], relations: Sequence[FormRelation]) -> list[Quadratic]:
    """The linear polynomials that vanish by what a face derives, in their fixed order."""
    found: list[Quadratic] = []
    for weight, form, relation in zip(face.weights, forms, relations, strict=True):
        if relation is FormRelation.EQ or weight <= 0:
            continue
        for row in form.hessian:
            found.append(Quadratic.linear(row, -dot(row, face.point)))
        slope = tuple(Fraction(s) for s in form.slope(face.point))
        found.append(Quadratic.linear(slope, Fraction(form.value(face.point)) - dot(slope, face.point)))
    return found


def tangents(
    weights: Sequence[Number], forms: Sequence[Quadratic], relations: Sequence[FormRelation], point: Point
) -> list[Point]:
    """Rows a of the equations a.(x - point) = 0 that positive weights give, n + 1 per inequality, in their fixed order:
    those of its Hessian, then its gradient at the point."""
    rows: list[Point] = []
    for weight, form, relation in zip(weights, forms, relations, strict=True):
        if relation is not FormRelation.EQ and weight > 0:
            rows += [*form.hessian, tuple(form.slope(point))]
    return rows


def optimal_tangents(evidence: OptimumEvidence) -> list[Point]:
    """The same for the points where the optimum is taken: those of the objective, then those of the multipliers."""
    objective, point = evidence.objective, evidence.point
    own = [*objective.hessian, tuple(objective.slope(point))]
    return [*own, *tangents(evidence.multipliers, evidence.forms, evidence.relations, point)]


@dataclass(frozen=True, slots=True)
class OptimumEvidence:
    """The data behind one answer. ``multipliers`` has one number per constraint, ``derived`` one per derived equation.

    OPTIMAL: ``point`` is feasible (strict constraints perhaps only with equality) and stationary for
    f + sum multipliers_i p_i + sum derived_k e_k. INFEASIBLE: stationary for that sum without f, whose value there is
    > 0, or >= 0 with a strict constraint of positive multiplier; e_k are the equations derived by the faces, then the
    tangents of the ``links``. UNBOUNDED: ``point`` is feasible and f decreases forever along ``direction``.
    ``attained`` (OPTIMAL only): True when ``point`` satisfies the strict constraints too. False when no point with the
    optimal value does: a strict constraint has a positive multiplier, or a positive weight in the last of the
    ``links``, which begin with the ``optimal_tangents``; then ``inner_point`` (over ``inner_field``) satisfies all
    constraints, so that the value is the infimum.
    """

    names: tuple[str, ...]
    objective: Quadratic
    forms: tuple[Quadratic, ...]
    relations: tuple[FormRelation, ...]
    status: OptimumStatus
    field: NumberField
    faces: tuple[Face, ...]
    point: Point
    multipliers: Point = ()
    derived: Point = ()
    direction: tuple[Fraction, ...] = ()
    attained: bool | None = None
    unique: bool | None = None
    inner_field: NumberField | None = None
    inner_point: Point = ()
    links: tuple[FaceLink, ...] = ()
    stationary: Point = ()
    bound: Fraction | None = None

    def contradiction(self) -> OptimumEvidence:
        """Of NEAR_OPTIMAL evidence: that f < ``bound`` contradicts the constraints, by the same multipliers."""
        assert self.bound is not None
        below = Quadratic(self.objective.hessian, self.objective.gradient, self.objective.constant - self.bound)
        return replace(
            self,
            status=OptimumStatus.INFEASIBLE,
            forms=(*self.forms, below),
            relations=(*self.relations, FormRelation.LT),
            faces=tuple(replace(face, weights=(*face.weights, Fraction(0))) for face in self.faces),
            multipliers=(*self.multipliers, Fraction(1)),
            point=self.stationary,
        )


# --- plain data ------------------------------------------------------------------------------------------------


def _terms(form: Quadratic) -> list[list[object]]:
    """[coefficient, exponents] of each term, constant first, then linear, then quadratic ones."""
    n = form.size
    out: list[list[object]] = []
    if form.constant:
        out.append([str(form.constant), [0] * n])
    for i, b in enumerate(form.gradient):
        if b:
            out.append([str(b), [int(k == i) for k in range(n)]])
    for i in range(n):
        for j in range(i, n):
            h = form.hessian[i][j]
            if h:
                out.append([str(h / 2 if i == j else h), [int(k == i) + int(k == j) for k in range(n)]])
    return out


def number_texts(value: Number) -> list[str]:
    """Coefficients of 1, theta, theta^2, …, without trailing zeros."""
    coefficients = list(value.coefficients) if isinstance(value, FieldElement) else [Fraction(value)]
    while len(coefficients) > 1 and not coefficients[-1]:
        coefficients.pop()
    return [str(c) for c in coefficients]


def _field(field: NumberField) -> dict[str, object]:
    # narrow enough for the checker to see at once that there is one root, and a simple one
    height = max(abs(c) for c in field.minimal_polynomial).bit_length()
    lo, hi = field.generator().interval(64 + height)
    return {"minimal_polynomial": [str(c) for c in field.minimal_polynomial], "interval": [str(lo), str(hi)]}


def to_payload(evidence: OptimumEvidence) -> dict[str, object]:
    """Plain JSON data: strings for numbers, lists and dictionaries with string keys."""
    payload = _setting(evidence)
    if evidence.status is OptimumStatus.UNBOUNDED:
        payload["direction"] = [str(d) for d in evidence.direction]
        return payload
    point = evidence.point
    payload["multipliers"] = [number_texts(m) for m in evidence.multipliers]
    payload["derived"] = [number_texts(m) for m in evidence.derived]
    payload["values"] = [number_texts(form.value(point)) for form in evidence.forms]
    if evidence.status is OptimumStatus.OPTIMAL:
        payload["value"] = number_texts(evidence.objective.value(point))
        payload["attained"] = bool(evidence.attained)
        payload["unique"] = bool(evidence.unique)
        if evidence.inner_field is not None:
            payload["inner"] = {
                "field": _field(evidence.inner_field),
                "point": [number_texts(c) for c in evidence.inner_point],
            }
    return payload


def _setting(evidence: OptimumEvidence) -> dict[str, object]:
    """What every kind of evidence has: the problem, the faces that hold its solutions, and a point."""
    payload: dict[str, object] = {
        "problem": {
            "variables": list(evidence.names),
            "minimise": _terms(evidence.objective),
            "constraints": [
                {"terms": _terms(form), "relation": relation.value}
                for form, relation in zip(evidence.forms, evidence.relations, strict=True)
            ],
        },
        "status": evidence.status.value,
        "field": _field(evidence.field),
        "faces": [
            {
                "weights": [str(w) for w in face.weights],
                "derived": [str(w) for w in face.derived],
                "point": [str(c) for c in face.point],
            }
            for face in evidence.faces
        ],
        "point": [number_texts(c) for c in evidence.point],
    }
    if evidence.links:
        payload["links"] = [
            {"weights": [number_texts(w) for w in link.weights], "derived": [number_texts(w) for w in link.derived]}
            for link in evidence.links
        ]
    return payload
