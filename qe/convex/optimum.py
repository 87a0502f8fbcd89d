"""Exact convex optimisation: the best point as algebraic numbers over one field, with a certificate.

``minimize`` handles convex quadratic objectives and conjunctions of convex quadratic inequalities, linear inequalities
and linear equations. Anything else raises ``NotConvex``; the caller may then turn to quantifier elimination.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from qe.convex.evidence import optimum_certificate
from qe.convex.minimise import rational_numbers
from qe.convex.simplex import sign
from qe.convex.strict import proved
from qe.convex.system import NotConvex, atoms_of, read_system
from qe.errors import Unable
from qe.exact.algebraic import RealAlgebraic
from qe.exact.field import FieldElement, NumberField
from qe.exact.number import optimum_in_latex, point_text
from qe.exact.quadratic_form import independent_rows
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, convert
from qe.formula.syntax import Atom, Formula, Relation
from qe.options import Budget
from qe.proof.answer import Guarantee
from qe.proof.certificate import Certificate
from qe.proof.multipliers import (
    FaceLink,
    FormRelation,
    Number,
    OptimumEvidence,
    OptimumStatus,
    derived_equations,
)
from qe.services import SymPyForm

Exact = Fraction | RealAlgebraic

__all__ = ["NotConvex", "Optimum", "OptimumStatus", "maximize", "minimize"]


@dataclass(frozen=True, slots=True, repr=False)
class Optimum(SymPyForm):
    """The answer to an optimisation problem.

    OPTIMAL: ``value`` is the exact minimum or maximum where ``attained``, and ``point`` satisfies all constraints and
    has it; otherwise no point has it (proved too), ``value`` is the infimum or supremum, and ``point`` one of the
    closed problem, with strict constraints read as weak ones. All numbers are ``Fraction``, or elements of the one real
    number ``field``.
    ``active``: indices of the constraints that hold with equality; ``multipliers``: one number per constraint, >= 0 for
    inequalities, such that grad f + sum multipliers_i grad p_i = 0 with constraint i read as p_i <= 0 (after facial
    reduction also equations implied by the constraints take part; see ``evidence``). ``unique`` is None when not
    decided. INFEASIBLE: ``multipliers`` combine the constraints to a contradiction, seen from ``point``. UNBOUNDED:
    from ``point`` the objective improves forever along ``direction``. ``attained`` is None for both. NEAR_OPTIMAL: the
    exact numbers need a field of high degree; ``point`` satisfies all constraints with room to spare, ``value`` is the
    objective there, and no point has one beyond ``bound``, which ``multipliers`` prove; all are rational, and ``value``
    and ``bound`` differ by at most 10^-9 of the former. The certificate is a bundle: the contradiction of a value
    beyond the bound, and the point.
    ``active``: the constraints with a positive multiplier. ``attained`` and ``unique`` are None. ``guarantee``:
    CHECKED where ``check`` was asked for and separate code accepted the certificate; otherwise ``reason`` says why not.
    """

    status: OptimumStatus
    value: Number | None
    point: Mapping[str, Number]
    active: tuple[int, ...]
    constraints: tuple[str, ...]
    multipliers: tuple[Number, ...]
    unique: bool | None
    attained: bool | None
    direction: Mapping[str, Fraction]
    field: NumberField
    evidence: OptimumEvidence
    certificate: Certificate
    guarantee: Guarantee = Guarantee.DERIVED
    reason: str = ""
    bound: Fraction | None = None

    @property
    def active_constraints(self) -> tuple[str, ...]:
        """The active constraints as text."""
        return tuple(self.constraints[i] for i in self.active)

    def __repr__(self) -> str:
        if self.bound is not None:
            return f"Optimum(near {self.value}{f' at {point_text(self.point)}'}, proved bound {self.bound})"
        if not self.is_optimal:
            return f"Optimum({self.status.value})"
        return f"Optimum({self.value}{f' at {point_text(self.point)}' if self.attained else ', not attained'})"

    def _repr_latex_(self) -> str:
        points = [] if self.attained is False else [self.point]
        return optimum_in_latex(self.status.value, self.value, points, near=self.bound is not None)

    @property
    def is_optimal(self) -> bool:
        """Whether the optimum is attained, and known exactly."""
        return self.status is OptimumStatus.OPTIMAL


def minimize(
    objective: Poly,
    constraints: Formula,
    *,
    scale: Fraction | int = 1,
    budget: Budget | None = None,
    near: bool = False,
) -> Optimum:
    """Minimise ``scale * objective`` (scale > 0 for a convex objective) subject to a conjunction of atoms; ``near``:
    NEAR_OPTIMAL is an answer too.

    The answer is proved exactly and carries a certificate for ``qe.certify``. Raises ``NotConvex`` for problems
    outside the class, ``BudgetExceeded`` at a limit, and ``Unable`` when no proof was found.
    """
    system = read_system(constraints, objective, scale=scale)
    evidence = proved(system, budget=budget or Budget(), near=near)
    optimum = _answer(atoms_of(constraints), _uniform(evidence))
    if evidence.status is OptimumStatus.NEAR_OPTIMAL:
        return _near(optimum, constraints, objective, Fraction(scale))
    return optimum


def maximize(
    objective: Poly,
    constraints: Formula,
    *,
    scale: Fraction | int = 1,
    budget: Budget | None = None,
    near: bool = False,
) -> Optimum:
    """The maximum of a concave objective: minus the minimum of its negative, which the certificate is about."""
    optimum = minimize(objective, constraints, scale=-Fraction(scale), budget=budget, near=near)
    if optimum.value is None:
        return optimum
    return replace(optimum, value=-optimum.value, bound=None if optimum.bound is None else -optimum.bound)


BOUND, POINT = "bound", "point"
"""The labels of the certificates of a near optimum."""


def _near(optimum: Optimum, constraints: Formula, objective: Poly, scale: Fraction) -> Optimum:
    """The near optimum with its value and its proof: no point has a value below the bound, and one has this value."""
    evidence = optimum.evidence
    ring, values = Ring.of(evidence.names), rational_numbers(evidence.point) or ()
    value = Fraction(evidence.objective.value(values))
    goal = scale.numerator * value.denominator * objective.convert(ring) - value.numerator * scale.denominator
    reached = conj((convert(constraints, ring), atom(goal, Relation.LE)))
    return replace(
        optimum,
        value=value,
        bound=evidence.bound,
        active=tuple(i for i, (_, m) in enumerate(zip(optimum.constraints, optimum.multipliers, strict=False)) if m),
        certificate=Certificate.bundle(
            [(BOUND, optimum.certificate), (POINT, Certificate.witness(reached, evidence.names, values))]
        ),
    )


@dataclass(frozen=True, slots=True)
class Decision:
    """``values``: a point of the set; None when it is empty, which ``certificate`` then proves."""

    values: Mapping[str, Exact] | None
    certificate: Certificate


def decide(conditions: Formula, *, budget: Budget) -> Decision:
    """Whether convex quadratic inequalities and linear equations have a common solution.

    The minimum of the constant 0 over the set: an optimal point is a solution (one of the closure only may have been
    found; the point that proves the strict conditions possible is one then), and there is none iff nonnegative
    multipliers combine the constraints to a contradiction (up to facial reduction; see ``qe.convex.minimise``).
    Raises ``NotConvex``, and ``Unable`` when neither was proved.
    """
    optimum = minimize(Ring.of(()).constant(0), conditions, budget=budget)
    if optimum.status is OptimumStatus.INFEASIBLE:
        return Decision(None, optimum.certificate)
    if optimum.status is OptimumStatus.UNBOUNDED:
        raise Unable("a constant objective was found unbounded")
    values = optimum.point.values() if optimum.attained else optimum.evidence.inner_point
    return Decision(dict(zip(optimum.point, map(exact, values), strict=True)), optimum.certificate)


def exact(value: Number) -> Exact:
    """The number without its field: rational where it is that."""
    if isinstance(value, FieldElement):
        return value.as_fraction() if value.is_rational else value.to_algebraic()
    return Fraction(value)


def _uniform(evidence: OptimumEvidence) -> OptimumEvidence:
    """All numbers as fractions if the field is Q, as elements of the field otherwise."""
    field = NumberField.rationals() if evidence.field.degree == 1 else evidence.field

    def convert(value: Number) -> Number:
        if field.degree == 1:
            return value.as_fraction() if isinstance(value, FieldElement) else Fraction(value)
        return value if isinstance(value, FieldElement) else field.rational(value)

    return replace(
        evidence,
        field=field,
        point=tuple(map(convert, evidence.point)),
        multipliers=tuple(map(convert, evidence.multipliers)),
        derived=tuple(map(convert, evidence.derived)),
        inner_field=None if evidence.inner_field is None else field,
        inner_point=tuple(map(convert, evidence.inner_point)),
        links=tuple(FaceLink(tuple(map(convert, k.weights)), tuple(map(convert, k.derived))) for k in evidence.links),
    )


def _answer(constraints: Sequence[Atom], evidence: OptimumEvidence) -> Optimum:
    optimal = evidence.status is OptimumStatus.OPTIMAL
    signs = [sign(form.value(evidence.point)) for form in evidence.forms]
    if optimal and any(s > 0 or (s and r is FormRelation.EQ) for s, r in zip(signs, evidence.relations, strict=True)):
        raise Unable("the proposed optimum violates a constraint")
    unique = evidence.unique if optimal else None
    proved = replace(evidence, unique=unique is True and _provably_unique(evidence))
    near = evidence.status is OptimumStatus.NEAR_OPTIMAL
    return Optimum(
        status=evidence.status,
        value=evidence.objective.value(evidence.point) if optimal else None,
        point=dict(zip(evidence.names, evidence.point, strict=True)),
        active=tuple(i for i, s in enumerate(signs) if s == 0) if optimal else (),
        constraints=tuple(map(str, constraints)),
        multipliers=evidence.multipliers,
        unique=unique,
        attained=evidence.attained,
        direction=dict(zip(evidence.names, evidence.direction, strict=False)),
        field=evidence.field,
        evidence=proved,
        certificate=optimum_certificate(evidence.contradiction() if near else proved),
    )


def _provably_unique(evidence: OptimumEvidence) -> bool:
    """Whether uniqueness follows from rational data alone, which is what the certificate claims."""
    rows = [row for row in evidence.objective.hessian if any(row)]
    for face in evidence.faces:
        rows += [e.gradient for e in derived_equations(face, evidence.forms, evidence.relations)]
    for form, relation, m in zip(evidence.forms, evidence.relations, evidence.multipliers, strict=True):
        if relation is FormRelation.EQ:
            rows.append(form.gradient)
        elif m:
            rows += [row for row in form.hessian if any(row)]
            if evidence.field.degree == 1:
                rows.append(tuple(Fraction(s) for s in form.slope(evidence.point)))
    return len(independent_rows(rows)) == len(evidence.names)
