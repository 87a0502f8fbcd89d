"""Optimal points of convex quadratic problems that satisfy a constraint qualification: proposed, solved, proved.

THEOREM (Karush 1939, Kuhn–Tucker 1951; Boyd–Vandenberghe, section 5.5.3). For convex f and g_i, a point x with
g_i(x) <= 0 and numbers lambda_i >= 0, lambda_i g_i(x) = 0, grad f(x) + sum lambda_i grad g_i(x) = 0 is a global
minimum. Everything in that sentence is decided exactly here, so a wrong proposal costs time and nothing else.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations

from qe.convex.float_linear_algebra import caratheodory, free_columns
from qe.convex.interior_point import Proposal, interior_point, natural_scale, to_float
from qe.convex.simplex import Nowhere, least_cost, sign
from qe.exact.field import NumberField
from qe.exact.kkt_system import MAX_DEGREE, HighDegree, Point, critical_point
from qe.exact.quadratic_form import Number, Quadratic, independent_rows, solve_linear
from qe.options import Budget

_CONVERGED = 1e-5
_CLEAR = 1e-5  # a multiplier that is surely not zero; less clear sets of constraints are tried after it
_NEAR = 1e-4
_ALMOST = 1e-9
_PIN_DENOMINATORS = (1, 16, 10**3, 10**6, 10**9)
_MAX_SUBSETS = 300


@dataclass(frozen=True, slots=True)
class Kkt:
    """A proved optimum. ``multipliers`` has the positive ones by constraint; ``unique`` is None when not decided."""

    field: NumberField
    point: Point
    multipliers: dict[int, Number]
    unique: bool | None


def kkt_point(
    objective: Quadratic, forms: Sequence[Quadratic], *, budget: Budget, max_degree: int = MAX_DEGREE
) -> Kkt | None:
    """A proved minimum of a convex quadratic polynomial subject to convex quadratic polynomials <= 0.

    None when no proposal could be proved: the problem may be infeasible, unbounded, or without multipliers.
    When there are many minima, one with simple free coordinates is returned. Raises ``HighDegree`` when the minimum
    is there numerically but its number field exceeds ``max_degree``.
    """
    proposal = interior_point(objective, forms, [0.0] * objective.size)
    budget.check("optimum: proposal")
    if not proposal.residual < _CONVERGED:
        return None
    scaled = [to_float(g, natural_scale(g)) for g in forms]

    def feasible(point: Sequence[float]) -> bool:
        return all(g.value_and_slope(point)[0] < _ALMOST * (1 + max(map(abs, point))) for g in scaled)

    def check() -> None:
        budget.check("optimum: exact system")

    for support in _supports(objective, forms, proposal):
        for equations in _pinned(objective, forms, proposal, support):
            check()
            try:
                candidate = critical_point(
                    objective, equations, proposal.point, accept=feasible, max_degree=max_degree, check=check
                )
            except HighDegree as reason:
                raise HighDegree(str(reason), reason.near, support) from None
            if candidate is not None:
                proved = _prove(objective, forms, support, *candidate, check)
                if proved is not None:
                    return proved
    return None


def _supports(objective: Quadratic, forms: Sequence[Quadratic], proposal: Proposal) -> Iterator[tuple[int, ...]]:
    """Candidate sets of constraints with positive multipliers, the most plausible first; none twice."""
    scales = [natural_scale(g) for g in forms]
    unit = natural_scale(objective)
    weight = [u * unit / s for u, s in zip(proposal.multipliers, scales, strict=True)]
    slack = [s * k for s, k in zip(proposal.slacks, scales, strict=True)]
    slopes = [to_float(g, s).value_and_slope(proposal.point)[1] for g, s in zip(forms, scales, strict=True)]
    everywhere = range(len(forms))
    near = [i for i in everywhere if slack[i] < _NEAR or weight[i] > slack[i]]
    clear = [i for i in near if weight[i] > _CLEAR and slack[i] < _NEAR]
    likely = [i for i in near if weight[i] > slack[i]]
    seen: set[tuple[int, ...]] = set()
    for chosen in (clear, likely, near):
        reduced = tuple(caratheodory(chosen, weight, slopes))
        if reduced not in seen:
            seen.add(reduced)
            yield reduced
    tried = 0
    for size in range(min(len(near), objective.size) + 1):
        for subset in combinations(near, size):
            if subset not in seen and tried < _MAX_SUBSETS:
                tried += 1
                yield subset


def _pinned(
    objective: Quadratic, forms: Sequence[Quadratic], proposal: Proposal, support: Sequence[int]
) -> Iterator[list[Quadratic]]:
    """The active equations, with coordinates that they leave free fixed at simple rationals near the proposal."""
    active = [forms[i] for i in support]
    scales = [(q, natural_scale(q)) for q in (objective, *active)]
    rows = [[float(h) * scale for h in row] for q, scale in scales for row in q.hessian if any(row)]
    rows += [to_float(q, scale).value_and_slope(proposal.point)[1] for q, scale in scales[1:]]
    free = free_columns(rows, objective.size)
    if not free:
        yield active
        return
    for denominator in _PIN_DENOMINATORS:
        pins = []
        for column in free:
            value = Fraction(proposal.point[column]).limit_denominator(denominator)
            pins.append(Quadratic.linear([Fraction(i == column) for i in range(objective.size)], -value))
        yield active + pins


def _prove(
    objective: Quadratic,
    forms: Sequence[Quadratic],
    support: Sequence[int],
    field: NumberField,
    point: Point,
    check: Callable[[], None],
) -> Kkt | None:
    """Check the theorem's conditions exactly; the support's multipliers are recomputed by linear algebra."""
    signs = [sign(g.value(point)) for g in forms]
    if any(s > 0 for s in signs):
        return None
    zero = [i for i, s in enumerate(signs) if s == 0]
    slopes = {i: forms[i].slope(point) for i in zero}
    target = [-d for d in objective.slope(point)]
    multipliers = _nonnegative(slopes, target, [i for i in support if i in slopes])
    if multipliers is None:
        found = least_cost(list(slopes.values()), target, [Fraction(0)] * len(zero), check=check)
        if isinstance(found, Nowhere):
            return None
        multipliers = {zero[k]: w for k, w in found.weights.items()}
    return Kkt(field, point, multipliers, _unique(objective, forms, slopes, multipliers))


def _nonnegative(
    slopes: dict[int, list[Number]], target: Sequence[Number], support: Sequence[int]
) -> dict[int, Number] | None:
    """Multipliers >= 0 on an independent support with sum lambda_i slope_i = target, or None."""
    rows = [[slopes[i][j] for i in support] for j in range(len(target))]
    solution = solve_linear(rows, target, len(support))
    if solution is None or any(sign(v) < 0 for v in solution.particular):
        return None
    return {i: v for i, v in zip(support, solution.particular, strict=True) if v}


def _unique(
    objective: Quadratic, forms: Sequence[Quadratic], slopes: dict[int, list[Number]], multipliers: dict[int, Number]
) -> bool | None:
    """Whether the minimum is the only one.

    Another minimum x + d minimises the Lagrangian too, so H_f d = 0 and, for lambda_i > 0, H_i d = 0 and
    grad g_i(x).d = 0. If only d = 0 does that, x is unique. If some d /= 0 does and no other constraint is active,
    small multiples of d lead to other minima. Otherwise this test does not tell.
    """
    rows: list[Sequence[Number]] = [row for row in objective.hessian if any(row)]
    rows += [row for i in multipliers for row in forms[i].hessian if any(row)]
    rank = len(independent_rows(rows)) if rows else 0
    if rank < objective.size:
        rank = len(independent_rows([*rows, *(slopes[i] for i in multipliers)]))
    if rank == objective.size:
        return True
    return False if set(slopes) == set(multipliers) else None
