"""Checker for certificates of kind "optimum": global optimality, infeasibility or unboundedness of convex problems.

THEOREMS. Let f and the inequality forms p_i be convex quadratic polynomials and the equations linear.
(face) Weights w >= 0 on inequalities, any on equations, and a point y with grad L(y) = 0 and L(y) >= 0 for
L = sum w_i p_i + sum v_k e_k: every feasible x has 0 >= L(x) = L(y) + (x-y)^T H_L (x-y)/2 >= 0, hence H_i(x-y) = 0 and
p_i(x) = 0 wherever w_i > 0, which gives further linear equations e_k (Borwein–Wolkowicz 1981).
(optimal) A feasible x* with multipliers of the right signs, complementary, stationary for f + L: f(x) >= f(x*) for all
feasible x (Karush 1939, Kuhn–Tucker 1951). With all strict constraints strict at x* it is attained; otherwise, given
one point where they are strict, f(x*) is the infimum and, being approached along a segment, not more.
(infeasible) As (face) with L(y) > 0, or L(y) = 0 and w_i > 0 for a strict constraint.
(unbounded) A feasible point and d with H_f d = 0, grad f.d < 0, H_i d = 0, b_i.d <= 0, a_j.d = 0.
Nothing is shared with the producer of such certificates except the format.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from qe.certify.convexity import Form, Row, is_convex, is_linear, rank, read_form
from qe.certify.numbers import read_field, read_number
from qe.certify.residue import ZERO, Residue, RootField, add, of_rationals, scale
from qe.errors import CertificateRejected
from qe.evidence.entry import Entry, Json
from qe.options import Budget

_KEYS = {
    "optimal": ("multipliers", "derived", "values", "value", "attained", "unique"),
    "infeasible": ("multipliers", "derived", "values"),
    "unbounded": ("direction",),
}


@dataclass(frozen=True, slots=True)
class _Problem:
    size: int
    objective: Form
    forms: tuple[Form, ...]
    relations: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class _Linear:
    row: Row
    rhs: Fraction


def check_optimum(payload: dict[str, Json], budget: Budget | None = None) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the entry that fails."""
    entry = Entry(payload, "payload")
    status = entry.value.get("status") if isinstance(entry.value, dict) else None
    if status not in _KEYS or not isinstance(status, str):
        raise CertificateRejected("payload.status", "expected optimal, infeasible or unbounded")
    names = ("problem", "status", "field", "faces", "point", *_KEYS[status])
    parts = dict(zip((*names, "inner"), entry.fields(*names, optional=("inner",)), strict=True))
    problem = _read_problem(parts["problem"])
    field = read_field(parts["field"], budget)
    derived = _check_faces(parts["faces"], problem)
    point = _read_numbers(parts["point"], field, problem.size)
    if status == "unbounded":
        _check_feasible(problem, field, point, parts["point"], strictly=True)
        _check_direction(problem, parts["direction"])
        _no_inner(parts["inner"])
        return
    values = _check_values(problem, field, point, parts["values"])
    multipliers = _read_numbers(parts["multipliers"], field, len(problem.forms))
    weights = _read_numbers(parts["derived"], field, len(derived))
    for i, (m, relation) in enumerate(zip(multipliers, problem.relations, strict=True)):
        if relation != "=" and field.sign(m) < 0:
            raise CertificateRejected(f"payload.multipliers[{i}]", "a negative multiplier of an inequality")
    _check_stationary(problem, field, point, multipliers, derived, weights, with_objective=status == "optimal")
    if status == "infeasible":
        _no_inner(parts["inner"])
        _check_contradiction(problem, field, point, values, multipliers, derived, weights)
    else:
        _check_optimal(problem, field, point, values, multipliers, derived, parts)


# --- reading ---------------------------------------------------------------------------------------------------


def _read_problem(entry: Entry) -> _Problem:
    variables, minimise, constraints = entry.fields("variables", "minimise", "constraints")
    names = [v.text() for v in variables.items()]
    if len(set(names)) != len(names) or not all(names):
        raise variables.fail("expected distinct names")
    objective = read_form(minimise, len(names))
    if not is_convex(objective.hessian):
        raise minimise.fail("the objective is not convex")
    forms, relations = [], []
    for constraint in constraints.items():
        terms, relation = constraint.fields("terms", "relation")
        form = read_form(terms, len(names))
        if relation.text() not in ("<=", "<", "="):
            raise relation.fail("expected <=, < or =")
        if relation.text() == "=" and not is_linear(form):
            raise terms.fail("a nonlinear equation")
        if not is_convex(form.hessian):
            raise terms.fail("a constraint that is not convex")
        forms.append(form)
        relations.append(relation.text())
    return _Problem(len(names), objective, tuple(forms), tuple(relations))


def _read_numbers(entry: Entry, field: RootField, count: int) -> list[Residue]:
    numbers = [read_number(e, field) for e in entry.items()]
    if len(numbers) != count:
        raise entry.fail(f"expected {count} numbers, found {len(numbers)}")
    return numbers


def _read_row(entry: Entry, count: int) -> Row:
    row = tuple(e.rational() for e in entry.items())
    if len(row) != count:
        raise entry.fail(f"expected {count} numbers, found {len(row)}")
    return row


# --- arithmetic ------------------------------------------------------------------------------------------------


def _dot(row: Row, x: Sequence[Residue], start: Fraction = Fraction(0)) -> Residue:
    total = of_rationals([start])
    for a, v in zip(row, x, strict=True):
        if a and not v.is_zero:
            total = add(total, scale(v, a))
    return total


def _slope(form: Form, x: Sequence[Residue]) -> list[Residue]:
    return [_dot(row, x, b) for row, b in zip(form.hessian, form.gradient, strict=True)]


def _value(form: Form, x: Sequence[Residue], field: RootField) -> Residue:
    """c + sum x_i (b_i + (H x)_i / 2)."""
    total = of_rationals([form.constant])
    for xi, row, b in zip(x, form.hessian, form.gradient, strict=True):
        inner = add(scale(_dot(row, x), Fraction(1, 2)), of_rationals([b]))
        total = add(total, field.multiply(xi, inner))
    return total


def _rational(values: Sequence[Fraction]) -> list[Residue]:
    return [of_rationals([v]) for v in values]


_Q = RootField([0, 1], Fraction(0), Fraction(0), "rationals")


# --- the theorems ----------------------------------------------------------------------------------------------


def _check_faces(entry: Entry, problem: _Problem) -> list[_Linear]:
    """Check every face and return the equations derived by all of them, in order."""
    derived: list[_Linear] = []
    for face in entry.items():
        first, second, third = face.fields("weights", "derived", "point")
        weights = _read_row(first, len(problem.forms))
        multipliers = _read_row(second, len(derived))
        y = _rational(_read_row(third, problem.size))
        for i, (w, relation) in enumerate(zip(weights, problem.relations, strict=True)):
            if relation != "=" and w < 0:
                raise CertificateRejected(f"{first.path}[{i}]", "a negative weight of an inequality")
        w_all, v_all = _rational(weights), _rational(multipliers)
        _check_stationary(problem, _Q, y, w_all, derived, v_all, with_objective=False, path=face.path)
        values = [_value(f, y, _Q) for f in problem.forms]
        if _Q.sign(_lagrangian(_Q, y, values, w_all, derived, v_all)) < 0:
            raise CertificateRejected(third.path, "the weighted sum is negative there")
        found: list[_Linear] = []
        for w, form, relation, value in zip(weights, problem.forms, problem.relations, values, strict=True):
            if relation != "=" and w > 0:
                found += _face_equations(form, y, value)
        if not found:
            raise face.fail("a face without positive weights")
        derived += found
    return derived


def _face_equations(form: Form, y: Sequence[Residue], value: Residue) -> list[_Linear]:
    """H x = H y, row by row, and p(y) + grad p(y).(x - y) = 0."""
    point = [_as_fraction(c) for c in y]
    slope = tuple(_as_fraction(s) for s in _slope(form, y))
    rows = [_Linear(row, sum((a * b for a, b in zip(row, point, strict=True)), Fraction(0))) for row in form.hessian]
    shift = sum((a * b for a, b in zip(slope, point, strict=True)), Fraction(0))
    return [*rows, _Linear(slope, shift - _as_fraction(value))]


def _as_fraction(a: Residue) -> Fraction:
    return Fraction(a.coefficients[0], a.denominator) if a.coefficients else Fraction(0)


def _check_values(problem: _Problem, field: RootField, point: list[Residue], entry: Entry) -> list[Residue]:
    stated = _read_numbers(entry, field, len(problem.forms))
    for i, (form, claim) in enumerate(zip(problem.forms, stated, strict=True)):
        if not add(_value(form, point, field), scale(claim, Fraction(-1))).is_zero:
            raise CertificateRejected(f"{entry.path}[{i}]", "not the value of the constraint at the point")
    return stated


def _check_stationary(
    problem: _Problem,
    field: RootField,
    point: list[Residue],
    multipliers: list[Residue],
    derived: list[_Linear],
    weights: list[Residue],
    *,
    with_objective: bool,
    path: str = "payload.multipliers",
) -> None:
    total = _slope(problem.objective, point) if with_objective else [ZERO] * problem.size
    for m, form in zip(multipliers, problem.forms, strict=True):
        if not m.is_zero:
            total = [add(t, field.multiply(m, s)) for t, s in zip(total, _slope(form, point), strict=True)]
    for w, equation in zip(weights, derived, strict=True):
        if not w.is_zero:
            if not any(equation.row):
                raise CertificateRejected(path, "a multiplier on an empty equation")
            total = [add(t, scale(w, a)) for t, a in zip(total, equation.row, strict=True)]
    for j, t in enumerate(total):
        if not t.is_zero:
            raise CertificateRejected(path, f"the gradient is not zero in coordinate {j + 1}")


def _lagrangian(
    field: RootField,
    point: list[Residue],
    values: list[Residue],
    multipliers: list[Residue],
    derived: list[_Linear],
    weights: list[Residue],
) -> Residue:
    total = ZERO
    for m, value in zip(multipliers, values, strict=True):
        total = add(total, field.multiply(m, value))
    for w, equation in zip(weights, derived, strict=True):
        if not w.is_zero:
            total = add(total, field.multiply(w, _dot(equation.row, point, -equation.rhs)))
    return total


def _check_contradiction(
    problem: _Problem,
    field: RootField,
    point: list[Residue],
    values: list[Residue],
    multipliers: list[Residue],
    derived: list[_Linear],
    weights: list[Residue],
) -> None:
    least = field.sign(_lagrangian(field, point, values, multipliers, derived, weights))
    strict = any(r == "<" and not m.is_zero for r, m in zip(problem.relations, multipliers, strict=True))
    if least < 0 or (least == 0 and not strict):
        raise CertificateRejected("payload.multipliers", "the weighted sum does not contradict the constraints")


def _check_feasible(problem: _Problem, field: RootField, point: list[Residue], entry: Entry, *, strictly: bool) -> None:
    for i, (form, relation) in enumerate(zip(problem.forms, problem.relations, strict=True)):
        sign = field.sign(_value(form, point, field))
        if (relation == "=" and sign) or sign > 0 or (strictly and relation == "<" and sign == 0):
            raise CertificateRejected(entry.path, f"the point violates constraint {i + 1}")


def _check_optimal(
    problem: _Problem,
    field: RootField,
    point: list[Residue],
    values: list[Residue],
    multipliers: list[Residue],
    derived: list[_Linear],
    parts: dict[str, Entry],
) -> None:
    attained = True
    for i, (value, relation, m) in enumerate(zip(values, problem.relations, multipliers, strict=True)):
        sign = field.sign(value)
        if sign > 0 or (sign and relation == "="):
            raise CertificateRejected(f"payload.values[{i}]", "the point violates the constraint")
        if sign and not m.is_zero:
            raise CertificateRejected(f"payload.multipliers[{i}]", "a multiplier on a constraint that is not active")
        attained = attained and not (relation == "<" and sign == 0)
    stated = read_number(parts["value"], field)
    if not add(_value(problem.objective, point, field), scale(stated, Fraction(-1))).is_zero:
        raise parts["value"].fail("not the value of the objective at the point")
    if parts["attained"].value is not attained:
        raise parts["attained"].fail(f"expected {str(attained).lower()}")
    if attained:
        _no_inner(parts["inner"])
    else:
        _check_inner(problem, parts["inner"], field.budget)
    _check_unique(problem, field, point, multipliers, derived, parts["unique"])


def _check_unique(
    problem: _Problem,
    field: RootField,
    point: list[Residue],
    multipliers: list[Residue],
    derived: list[_Linear],
    entry: Entry,
) -> None:
    """Another minimum x* + d has H_f d = 0, keeps equations and, where m_i > 0, has H_i d = 0, grad p_i(x*).d = 0."""
    if entry.value is False:
        return
    if entry.value is not True:
        raise entry.fail("expected true or false")
    rows: list[Row] = [*problem.objective.hessian, *(e.row for e in derived)]
    for m, form, relation in zip(multipliers, problem.forms, problem.relations, strict=True):
        if relation == "=":
            rows.append(form.gradient)
        elif not m.is_zero:
            rows += form.hessian
            if field.degree == 1:
                rows.append(tuple(_as_fraction(s) for s in _slope(form, point)))
    if rank(rows) < problem.size:
        raise entry.fail("uniqueness does not follow")


def _check_inner(problem: _Problem, entry: Entry, budget: Budget) -> None:
    if entry.value is None:
        raise entry.fail("missing: a point that satisfies the strict constraints")
    first, second = entry.fields("field", "point")
    field = read_field(first, budget)
    point = _read_numbers(second, field, problem.size)
    _check_feasible(problem, field, point, second, strictly=True)


def _no_inner(entry: Entry) -> None:
    if entry.value is not None:
        raise entry.fail("not expected here")


def _check_direction(problem: _Problem, entry: Entry) -> None:
    d = _read_row(entry, problem.size)

    def along(row: Row) -> Fraction:
        return sum((a * b for a, b in zip(row, d, strict=True)), Fraction(0))

    if any(along(row) for row in problem.objective.hessian) or along(problem.objective.gradient) >= 0:
        raise entry.fail("the objective does not fall along it")
    for i, (form, relation) in enumerate(zip(problem.forms, problem.relations, strict=True)):
        slope = along(form.gradient)
        if any(along(row) for row in form.hessian) or slope > 0 or (slope and relation == "="):
            raise entry.fail(f"it leaves constraint {i + 1}")
