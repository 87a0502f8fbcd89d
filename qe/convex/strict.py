"""Strict constraints: whether an infimum over the closed problem is attained, approached, or of an empty problem.

All of it is decided at one point x of the closed problem, over the number field of that point. The points that count
satisfy the constraints and linear equations that x satisfies too; on the flat of these equations, Gordan's alternative
for the gradients of the constraints that are active at x either gives a direction into the interior of all of them, so
that all strict constraints hold a little along it, or weights w >= 0 for which sum w_i p_i is stationary at x. By
convexity that sum is then nowhere negative on the flat, so p_i = 0 wherever w_i > 0 at all points that count: no such
point exists if that constraint is strict, and otherwise the flat becomes smaller (Borwein–Wolkowicz 1981).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial

from qe.convex.minimise import evidence_about, solve, with_equations
from qe.convex.simplex import Endless, Least, Nowhere, least_cost, sign
from qe.convex.system import ConvexSystem, constant
from qe.errors import InternalError, Unable
from qe.exact.kkt_system import Point
from qe.exact.quadratic_form import Number, Quadratic, Vector, dot, solve_linear
from qe.options import Budget
from qe.proof.multipliers import (
    FaceLink,
    FormRelation,
    OptimumEvidence,
    OptimumStatus,
    derived_equations,
    optimal_tangents,
    tangents,
)

_ZERO, _ONE = Fraction(0), Fraction(1)
_FINEST = 2**16


@dataclass(frozen=True, slots=True)
class _Excluded:
    """The last link puts a positive weight on a strict constraint: no point that counts satisfies it."""

    links: tuple[FaceLink, ...]


def settle_strict(system: ConvexSystem, evidence: OptimumEvidence, *, budget: Budget) -> OptimumEvidence:
    """The evidence for the problem with its strict constraints, given that for the closed one.

    Attained iff some optimal point of the closed problem satisfies the strict constraints; ``point`` is then such a
    point. Otherwise, by convexity, the optimum of the closed problem is the infimum of the strict one as soon as that
    has any point, and the strict problem is empty if it has none. The same holds for an objective without bound, which
    falls along its direction from any point.
    """
    if evidence.status in (OptimumStatus.INFEASIBLE, OptimumStatus.NEAR_OPTIMAL):
        return evidence
    optimal = evidence.status is OptimumStatus.OPTIMAL
    strict = [i for i, r in enumerate(system.relations) if r is FormRelation.LT]
    if all(sign(system.forms[i].value(evidence.point)) < 0 for i in strict):
        return replace(evidence, attained=True) if optimal else evidence
    flat = _equations(system, evidence)
    x = evidence.point
    links: tuple[FaceLink, ...] = ()
    if optimal and not any(evidence.multipliers[i] for i in strict):
        best = _strictly_inside(system, x, [*flat, *optimal_tangents(evidence)], budget)
        if not isinstance(best, _Excluded):
            return replace(evidence, attained=True, point=best, unique=False)
        links = best.links
    inside = _strictly_inside(system, x, flat, budget)
    if not isinstance(inside, _Excluded):
        if not optimal:
            return replace(evidence, point=inside)
        return replace(evidence, attained=False, inner_field=evidence.field, inner_point=inside, links=links)
    *before, last = inside.links
    return evidence_about(
        system,
        status=OptimumStatus.INFEASIBLE,
        field=evidence.field,
        faces=evidence.faces,
        point=x,
        multipliers=last.weights,
        derived=last.derived,
        links=tuple(before),
    )


def _equations(system: ConvexSystem, evidence: OptimumEvidence) -> list[Vector]:
    """The rows of the equations that hold on the closed problem: those of the system, then the derived ones."""
    rows: list[Vector] = [
        f.gradient for f, r in zip(system.forms, system.relations, strict=True) if r is FormRelation.EQ
    ]
    for face in evidence.faces:
        rows += [e.gradient for e in derived_equations(face, system.forms, system.relations)]
    return rows


def _strictly_inside(system: ConvexSystem, x: Point, equations: Sequence[Vector], budget: Budget) -> Point | _Excluded:
    """A point of the flat x + {d: row.d = 0 for all ``equations``} that satisfies every constraint, or why none does.

    x satisfies all constraints but for strict ones that may hold with equality. Each round ends the search or makes
    the flat smaller.
    """
    rows = list(equations)
    active = [
        i for i, r in enumerate(system.relations) if r is not FormRelation.EQ and not sign(system.forms[i].value(x))
    ]
    slopes = {i: system.forms[i].slope(x) for i in active}
    links: list[FaceLink] = []
    for _ in range(len(system.names) + 1):
        solution = solve_linear(rows, [_ZERO] * len(rows), len(system.names))
        assert solution is not None
        along = {i: [dot(slopes[i], d) for d in solution.kernel] for i in active}
        along = {i: row for i, row in along.items() if not _vanishes(system, i, row, solution.kernel)}
        keys = sorted(along, key=lambda i: system.relations[i] is not FormRelation.LT)
        outcome = alternative([along[i] for i in keys], len(solution.kernel), budget=budget)
        if isinstance(outcome, Nowhere):
            step = [dot(outcome.dual[:-1], column) for column in zip(*solution.kernel, strict=True)]
            return _moved(system, x, step, budget)
        weights = {keys[k]: w for k, w in outcome.weights.items()}
        derived = rows[system.relations.count(FormRelation.EQ) :]
        link = FaceLink(*with_equations(system, derived, x, weights, with_objective=False))
        links.append(link)
        if any(r is FormRelation.LT and w for r, w in zip(system.relations, link.weights, strict=True)):
            return _Excluded(tuple(links))
        rows += tangents(link.weights, system.forms, system.relations, x)
    raise InternalError("the affine hull of the points that count did not shrink")


def alternative(rows: Sequence[Vector], size: int, *, budget: Budget) -> Least | Nowhere | Endless:
    """THEOREM (Gordan 1873). For rows of length ``size`` over an ordered field either there are ``weights`` >= 0, not
    all of them zero, with sum weights_i row_i = 0, or a direction makes all rows negative: ``dual`` without its last
    entry s > 0, as (dual, s).(row_i, 1) <= 0."""
    columns = [(*row, _ONE) for row in rows]
    check = partial(budget.check, "optimum: strict conditions")
    return least_cost(columns, [*([_ZERO] * size), _ONE], [_ZERO] * len(rows), check=check)


def _vanishes(system: ConvexSystem, i: int, slope: Sequence[Number], directions: Sequence[Vector]) -> bool:
    """Whether a weak constraint that is active at a point is zero on the whole flat there: it excludes nothing."""
    if system.relations[i] is FormRelation.LT or any(slope):
        return False
    return not any(dot(row, d) for d in directions for row in system.forms[i].hessian)


def _moved(system: ConvexSystem, x: Point, step: Sequence[Number], budget: Budget) -> Point:
    """x + step/2^k for a k for which all constraints hold; the step descends into all that are active."""
    k = 0
    while k <= _FINEST:
        budget.check("optimum: strict conditions")
        point = tuple(a + d * Fraction(1, 2**k) for a, d in zip(x, step, strict=True))
        if all(_holds(form, relation, point) for form, relation in zip(system.forms, system.relations, strict=True)):
            return point
        k = max(1, 2 * k)
    raise InternalError("a step into the interior of all active constraints never gets there")


def _holds(form: Quadratic, relation: FormRelation, point: Point) -> bool:
    value_sign = sign(form.value(point))
    return value_sign < 0 or (value_sign == 0 and relation is not FormRelation.LT)


def proved(system: ConvexSystem, *, budget: Budget, near: bool = False) -> OptimumEvidence:
    """Evidence about the least value of the objective, strict conditions included; ``near`` as in ``solve``.

    Raises ``Unable`` without a proof, also where the floating-point numbers that propose one are beyond their range."""
    try:
        return settle_strict(system, solve(system, budget=budget, near=near), budget=budget)
    except Unable:
        raise
    except OverflowError:
        raise Unable("the numbers are beyond the range of floats, which propose the solution") from None


def feasible(forms: Sequence[Quadratic], relations: Sequence[FormRelation], *, budget: Budget) -> bool:
    """Whether some point satisfies forms[i] relations[i] 0 for all i: convex inequalities and linear equations.

    Minimises nothing over the set: the evidence is a feasible point or a contradiction. Raises ``Unable`` when
    neither could be proved.
    """
    size = forms[0].size
    names = tuple(f"y{k}" for k in range(size))
    optimum = proved(ConvexSystem(names, constant(size, 0), tuple(forms), tuple(relations)), budget=budget)
    if optimum.status is OptimumStatus.UNBOUNDED:
        raise Unable("a constant objective was found unbounded")
    return optimum.status is OptimumStatus.OPTIMAL
