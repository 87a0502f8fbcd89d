"""The whole of convex quadratic minimisation: flats, optimality conditions, phase one, faces, infinity.

A problem is solved on the flat of its linear equations. If the optimality conditions cannot be proved, phase one
(minimise the largest violation, itself a problem with a strictly feasible point) decides exactly between an
infeasible problem, a degenerate one (the feasible set lies in a smaller flat, found by facial reduction, and the
problem is solved there) and an unbounded one.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial

from qe.convex.frame import centred_frame, lies_far, plain_frame
from qe.convex.kkt import Kkt, kkt_point
from qe.convex.near_optimum import bracket
from qe.convex.simplex import Endless, Least, linear_optimum, sign
from qe.convex.system import ConvexSystem
from qe.convex.violation import height, proposed, violation_forms
from qe.errors import BudgetExceeded, InternalError, Unable
from qe.exact.field import NumberField
from qe.exact.kkt_system import MAX_DEGREE, Flat, HighDegree, Point
from qe.exact.quadratic_form import Number, Quadratic, Vector, combine, solve_linear
from qe.options import Budget
from qe.proof.multipliers import Face, FormRelation, OptimumEvidence, OptimumStatus, derived_equations

Frame = Callable[[Flat, Sequence[Quadratic]], Flat]
_ZERO, _ONE = Fraction(0), Fraction(1)
_NEAR_DEGREE = 20  # of the optimum: beyond, rational numbers near it are preferred where they may be
_SIMPLE_DEGREE = 4  # of the least violation: beyond, rounded multipliers are tried before an exact answer


def evidence_about(system: ConvexSystem, **parts: object) -> OptimumEvidence:
    """Evidence about the least value on a system, to be filled in."""
    base = OptimumEvidence(
        names=system.names,
        objective=system.objective,
        forms=system.forms,
        relations=system.relations,
        status=OptimumStatus.OPTIMAL,
        field=NumberField.rationals(),
        faces=(),
        point=(),
    )
    return replace(base, **parts)  # type: ignore[arg-type]


@dataclass(frozen=True, slots=True)
class _State:
    """What is known: ``faces`` so far, the equations they derive, and the flat of all equations, as framed. ``near``:
    whether rational numbers near the optimum may stand for it."""

    faces: tuple[Face, ...]
    derived: tuple[Quadratic, ...]
    flat: Flat
    frame: Frame
    near: bool

    @property
    def rows(self) -> list[Vector]:
        """Of the derived equations."""
        return [e.gradient for e in self.derived]


def solve(system: ConvexSystem, *, budget: Budget, near: bool = False) -> OptimumEvidence:
    """Evidence that proves the optimum over the closed problem (strict relations read as weak ones), or that there
    is none; with ``near`` rational numbers on both sides of it where it needs a number field of high degree.

    Raises ``Unable`` when nothing could be proved."""
    equations = [f for f, r in zip(system.forms, system.relations, strict=True) if r is FormRelation.EQ]
    flat = Flat.whole(len(system.names)).cut(equations)
    if flat is None:
        return _contradictory_equations(system)
    first, second = plain_frame, centred_frame
    if lies_far(plain_frame(flat, system.forms), system.forms):
        first, second = second, first
    try:
        return _solved(system, _State((), (), first(flat, system.forms), first, near), budget)
    except (BudgetExceeded, HighDegree):
        raise
    except Unable as reason:
        try:
            return _solved(system, _State((), (), second(flat, system.forms), second, near), budget)
        except BudgetExceeded:
            raise
        except Unable:
            raise reason from None


def _solved(system: ConvexSystem, state: _State, budget: Budget) -> OptimumEvidence:
    for _ in range(len(system.names) + 2):
        step = _on_flat(system, state, budget)
        if isinstance(step, OptimumEvidence):
            return step
        state = step
    raise InternalError("facial reduction did not shrink the affine hull")


def _on_flat(system: ConvexSystem, state: _State, budget: Budget) -> OptimumEvidence | _State:
    flat = state.flat
    inequalities = [i for i, r in enumerate(system.relations) if r is not FormRelation.EQ]
    objective = system.objective.restrict(flat.origin, flat.basis)
    forms = {i: system.forms[i].restrict(flat.origin, flat.basis) for i in inequalities}
    constant = [i for i, q in forms.items() if q.is_linear and not any(q.gradient)]
    for i in constant:
        # closed or not, 0 < 0 cannot be satisfied
        strict = system.relations[i] is FormRelation.LT
        if forms[i].constant > 0 or (strict and forms[i].constant == 0):
            return _close(system, state, NumberField.rationals(), flat.origin, {i: _ONE}, infeasible=True)
        del forms[i]
    keys = list(forms)
    rest = list(forms.values())
    try:
        kkt = _least(objective, rest, budget, _NEAR_DEGREE if state.near else MAX_DEGREE, refuse=True)
    except HighDegree as reason:
        if not state.near:
            raise
        near = _near(system, state, objective, forms, reason, budget)
        if near is not None:
            return near
        kkt = _least(objective, rest, budget, MAX_DEGREE, refuse=True)
    if kkt is not None:
        weights = {keys[k]: m for k, m in kkt.multipliers.items()}
        return _close(system, state, kkt.field, flat.lift(kkt.point), weights, unique=kkt.unique)
    if objective.is_linear and all(form.is_linear for form in rest):
        return _linear(system, state, objective, forms, budget)
    return _without_multipliers(system, state, {i: forms[i] for i in keys}, budget)


def _near(
    system: ConvexSystem,
    state: _State,
    objective: Quadratic,
    forms: dict[int, Quadratic],
    reason: HighDegree,
    budget: Budget,
) -> OptimumEvidence | None:
    """Rational numbers on both sides of an optimum of high degree, if there are any."""
    keys = list(forms)
    known = bracket(objective, list(forms.values()), reason, lambda: budget.check("optimum: rational bounds"))
    if known is None:
        return None
    weights: dict[int, Number] = {keys[k]: w for k, w in known.weights.items()}
    stationary = state.flat.lift(known.stationary)
    proof = _close(system, state, NumberField.rationals(), stationary, weights)
    return replace(
        proof,
        status=OptimumStatus.NEAR_OPTIMAL,
        point=state.flat.lift(known.point),
        stationary=stationary,
        bound=known.bound,
    )


def _linear(
    system: ConvexSystem, state: _State, objective: Quadratic, forms: dict[int, Quadratic], budget: Budget
) -> OptimumEvidence:
    """The exact answer to a linear problem for which floats proposed nothing that could be proved."""
    flat, keys, rationals = state.flat, list(forms), NumberField.rationals()
    check = partial(budget.check, "optimum: simplex")
    outcome, falls = linear_optimum(objective, list(forms.values()), check=check)
    point = flat.lift(outcome.dual) if isinstance(outcome, Least) else flat.origin
    if falls is not None:
        way = flat.direction(falls)
        return evidence_about(
            system, status=OptimumStatus.UNBOUNDED, field=rationals, faces=state.faces, point=point, direction=way
        )
    weights: dict[int, Number] = {keys[k]: w for k, w in outcome.weights.items()}
    return _close(system, state, rationals, point, weights, infeasible=isinstance(outcome, Endless))


def _without_multipliers(
    system: ConvexSystem, state: _State, forms: dict[int, Quadratic], budget: Budget
) -> OptimumEvidence | _State:
    """Phase one: infeasible, degenerate (a smaller flat) or unbounded."""
    size = len(state.flat.basis)
    extended, scales = violation_forms(list(forms.values()), size)
    kkt = _least(height(size), extended, budget, _SIMPLE_DEGREE)
    if kkt is None:
        _, rounded = proposed(list(forms.values()))
        lowest = None if rounded is None else combine(rounded, list(forms.values())).stationary()
        if rounded is not None and lowest is not None:
            rational: dict[int, Number] = {i: w for i, w in zip(forms, rounded, strict=True) if w}
            point = state.flat.lift(lowest.particular)
            return _close(system, state, NumberField.rationals(), point, rational, infeasible=True)
        kkt = _least(height(size), extended, budget, MAX_DEGREE)
    if kkt is None:
        raise Unable("the largest violation of the constraints could not be minimised exactly")
    violation, keys = sign(kkt.point[-1]), list(forms)
    weights = {keys[k]: m * scales[k] for k, m in kkt.multipliers.items() if k < len(keys)}
    point = state.flat.lift(kkt.point[:-1])
    if violation > 0:
        return _close(system, state, kkt.field, point, weights, infeasible=True)
    if violation == 0:
        return _face(system, state, point, weights)
    return _recede(system, state, kkt.field, point, budget)


def equations_of_hull(system: ConvexSystem, budget: Budget) -> list[Quadratic]:
    """Of a system of inequalities, the equations that one step of facial reduction derives. Raises ``Unable``."""
    state = _State((), (), Flat.whole(len(system.names)), plain_frame, False)
    step = _without_multipliers(system, state, dict(enumerate(system.forms)), budget)
    return [*step.derived] if isinstance(step, _State) else []


def _least(
    objective: Quadratic, forms: Sequence[Quadratic], budget: Budget, max_degree: int, *, refuse: bool = False
) -> Kkt | None:
    """The proved minimum. None also for numbers beyond the range of floats, and for those of a field of too high
    degree unless they are to be refused: then ``HighDegree`` is raised."""
    try:
        return kkt_point(objective, forms, budget=budget, max_degree=max_degree)
    except OverflowError:
        return None
    except HighDegree:
        if refuse:
            raise
        return None


def rational_numbers(values: Sequence[Number]) -> tuple[Fraction, ...] | None:
    """The numbers as fractions, None if one is irrational."""
    out = []
    for v in values:
        if not isinstance(v, Fraction):
            if not v.is_rational:
                return None
            v = v.as_fraction()
        out.append(v)
    return tuple(out)


def _face(system: ConvexSystem, state: _State, point: Point, weights: dict[int, Number]) -> _State:
    """The smaller flat that holds the feasible set when the least possible violation is zero."""
    chosen, place = rational_numbers(list(weights.values())), rational_numbers(point)
    if chosen is None or place is None:
        raise Unable("the constraints touch in an irrational point or affine hull without common interior")
    exact: dict[int, Number] = dict(zip(weights, chosen, strict=True))
    full, derived = with_equations(system, state.rows, place, exact, with_objective=False)
    face = Face(_fractions(full), _fractions(derived), place)
    equations = derived_equations(face, system.forms, system.relations)
    known = (*state.derived, *equations)
    rows = [f for f, r in zip(system.forms, system.relations, strict=True) if r is FormRelation.EQ]
    flat = Flat.whole(len(system.names)).cut([*rows, *known])
    if flat is None or len(flat.basis) >= len(state.flat.basis):
        raise Unable("facial reduction found no smaller affine hull")
    return replace(state, faces=(*state.faces, face), derived=known, flat=state.frame(flat, system.forms))


def _fractions(values: Sequence[Number]) -> tuple[Fraction, ...]:
    out = rational_numbers(values)
    if out is None:
        raise InternalError("irrational weights where rational ones were expected")
    return out


def with_equations(
    system: ConvexSystem, derived: Sequence[Vector], point: Point, weights: dict[int, Number], *, with_objective: bool
) -> tuple[Point, Point]:
    """Multipliers of all constraints and of the derived equations, of which ``derived`` has the rows, that make the
    weighted sum stationary at point."""
    size = len(system.names)
    target: list[Number] = [_ZERO] * size
    if with_objective:
        target = [-d for d in system.objective.slope(point)]
    for i, w in weights.items():
        target = [t - w * d for t, d in zip(target, system.forms[i].slope(point), strict=True)]
    linear = [i for i, r in enumerate(system.relations) if r is FormRelation.EQ]
    rows = [*(system.forms[i].gradient for i in linear), *derived]
    solution = solve_linear([[row[j] for row in rows] for j in range(size)], target, len(rows))
    if solution is None:
        raise InternalError("stationarity on an affine hull does not extend to the whole space")
    multipliers: list[Number] = [_ZERO] * len(system.forms)
    for i, w in weights.items():
        multipliers[i] = w
    for i, w in zip(linear, solution.particular, strict=False):
        multipliers[i] = w
    return tuple(multipliers), tuple(solution.particular[len(linear) :])


def _close(
    system: ConvexSystem,
    state: _State,
    field: NumberField,
    point: Point,
    weights: dict[int, Number],
    *,
    infeasible: bool = False,
    unique: bool | None = None,
) -> OptimumEvidence:
    """Evidence of optimality or infeasibility, with the multipliers of the equations filled in.

    For infeasibility the point has to be stationary for the weighted sum alone; on a flat where that sum is constant
    every point is.
    """
    multipliers, derived = with_equations(system, state.rows, point, weights, with_objective=not infeasible)
    return evidence_about(
        system,
        status=OptimumStatus.INFEASIBLE if infeasible else OptimumStatus.OPTIMAL,
        field=field,
        faces=state.faces,
        point=point,
        multipliers=multipliers,
        derived=derived,
        unique=unique,
    )


def _contradictory_equations(system: ConvexSystem) -> OptimumEvidence:
    """Weights w with sum w_i (a_i.x - b_i) = 1 identically: the equations have no common solution."""
    size = len(system.names)
    linear = [i for i, r in enumerate(system.relations) if r is FormRelation.EQ]
    rows = [[system.forms[i].gradient[j] for i in linear] for j in range(size)]
    rows.append([system.forms[i].constant for i in linear])
    solution = solve_linear(rows, [*([_ZERO] * size), _ONE], len(linear))
    if solution is None:
        raise InternalError("inconsistent equations without a contradiction")
    multipliers = [_ZERO] * len(system.forms)
    for i, w in zip(linear, solution.particular, strict=True):
        multipliers[i] = w
    return evidence_about(
        system, status=OptimumStatus.INFEASIBLE, point=(_ZERO,) * size, multipliers=tuple(multipliers), derived=()
    )


def _recede(system: ConvexSystem, state: _State, field: NumberField, point: Point, budget: Budget) -> OptimumEvidence:
    """Unboundedness: a direction of recession of the feasible set along which the objective falls forever.

    d with H_f d = 0, H_i d = 0, b_i.d <= 0 for inequalities, a_j.d = 0 for equations, and grad f.d < 0: so grad f.d has
    no lower bound among them (Rockafellar 1970, theorems 8.3 and 27.1).
    """
    rows = [row for row in system.objective.hessian if any(row)]
    halves: list[Quadratic] = []
    for form, relation in zip(system.forms, system.relations, strict=True):
        rows += [row for row in form.hessian if any(row)]
        if relation is FormRelation.EQ:
            rows.append(form.gradient)
        elif any(form.gradient):
            halves.append(Quadratic.linear(form.gradient))
    flat = Flat.whole(len(system.names)).cut(list(map(Quadratic.linear, rows)))
    assert flat is not None  # the origin is on it
    objective = Quadratic.linear(system.objective.gradient)
    slope, *bounds = (form.restrict(flat.origin, flat.basis) for form in (objective, *halves))
    _, falls = linear_optimum(slope, bounds, check=partial(budget.check, "optimum: simplex"))
    if falls is None:
        raise Unable("neither optimality conditions nor a direction of descent could be proved")
    way = flat.direction(falls)
    return evidence_about(
        system, status=OptimumStatus.UNBOUNDED, field=field, faces=state.faces, point=point, direction=way
    )
