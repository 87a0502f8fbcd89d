"""What the checker knows about a convex problem: reading it, values and gradients, weighted sums of its constraints."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from qe.errors import CertificateRejected
from qe.expert.arithmetic.convexity import Form, Row, is_convex, is_linear, read_form
from qe.expert.arithmetic.numbers import read_number
from qe.expert.arithmetic.residue import ZERO, Residue, RootField, add, of_rationals, scale
from qe.proof.entry import Entry

Numbers = Sequence[Residue]


@dataclass(frozen=True, slots=True)
class Problem:
    """Minimise ``objective`` where forms[i] relations[i] 0. Invariant: all convex, forms with "=" linear."""

    size: int
    objective: Form
    forms: tuple[Form, ...]
    relations: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Equation:
    """row . x = rhs, with numbers of the field in use."""

    row: tuple[Residue, ...]
    rhs: Residue


@dataclass(frozen=True, slots=True)
class Weighting:
    """The function L = sum weights_i p_i + sum extra_k e_k of a problem's forms and of linear equations."""

    weights: list[Residue]
    equations: list[Equation]
    extra: list[Residue]


# --- reading ---------------------------------------------------------------------------------------------------


def read_problem(entry: Entry) -> Problem:
    """The problem, proved to be convex."""
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
    return Problem(len(names), objective, tuple(forms), tuple(relations))


def read_numbers(entry: Entry, field: RootField, count: int) -> list[Residue]:
    """That many elements of the field."""
    numbers = [read_number(e, field) for e in entry.items()]
    if len(numbers) != count:
        raise entry.fail(f"expected {count} numbers, found {len(numbers)}")
    return numbers


def read_row(entry: Entry, count: int) -> Row:
    """That many rational numbers."""
    row = tuple(e.rational() for e in entry.items())
    if len(row) != count:
        raise entry.fail(f"expected {count} numbers, found {len(row)}")
    return row


def check_signs(problem: Problem, field: RootField, weights: Numbers, path: str, what: str) -> None:
    """Reject a negative weight of an inequality; ``what`` it is called."""
    for i, (w, relation) in enumerate(zip(weights, problem.relations, strict=True)):
        if relation != "=" and field.sign(w) < 0:
            raise CertificateRejected(f"{path}[{i}]", f"a negative {what} of an inequality")


# --- arithmetic ------------------------------------------------------------------------------------------------


def along(row: Row, x: Numbers, start: Fraction = Fraction(0)) -> Residue:
    """start + row . x for a rational row."""
    total = of_rationals([start])
    for a, v in zip(row, x, strict=True):
        if a and not v.is_zero:
            total = add(total, scale(v, a))
    return total


def slope_at(form: Form, x: Numbers) -> list[Residue]:
    """The gradient H x + b."""
    return [along(row, x, b) for row, b in zip(form.hessian, form.gradient, strict=True)]


def value_at(form: Form, x: Numbers, field: RootField) -> Residue:
    """c + sum x_i (b_i + (H x)_i / 2)."""
    total = of_rationals([form.constant])
    for xi, row, b in zip(x, form.hessian, form.gradient, strict=True):
        inner = add(scale(along(row, x), Fraction(1, 2)), of_rationals([b]))
        total = add(total, field.multiply(xi, inner))
    return total


def rational(values: Sequence[Fraction]) -> list[Residue]:
    """Fractions as numbers of any field."""
    return [of_rationals([v]) for v in values]


def as_fraction(a: Residue) -> Fraction:
    """The value of a rational number."""
    return Fraction(a.coefficients[0], a.denominator) if a.coefficients else Fraction(0)


def tangents(form: Form, y: Numbers, field: RootField, value: Residue = ZERO) -> list[Equation]:
    """H x = H y, row by row, and value + grad p(y).(x - y) = 0."""
    rows = [tuple(rational(row)) for row in form.hessian] + [tuple(slope_at(form, y))]
    found = [Equation(row, _sum(row, y, field)) for row in rows]
    found[-1] = Equation(found[-1].row, add(found[-1].rhs, scale(value, Fraction(-1))))
    return found


def _sum(row: Numbers, x: Numbers, field: RootField) -> Residue:
    total = ZERO
    for a, v in zip(row, x, strict=True):
        total = add(total, field.multiply(a, v))
    return total


def check_stationary(
    problem: Problem, field: RootField, y: Numbers, total: Weighting, path: str, *, with_objective: bool = False
) -> None:
    """Reject unless the gradient of L (of f + L ``with_objective``) vanishes at y."""
    found = slope_at(problem.objective, y) if with_objective else [ZERO] * problem.size
    for m, form in zip(total.weights, problem.forms, strict=True):
        if not m.is_zero:
            found = [add(t, field.multiply(m, s)) for t, s in zip(found, slope_at(form, y), strict=True)]
    for w, equation in zip(total.extra, total.equations, strict=True):
        if not w.is_zero:
            if all(a.is_zero for a in equation.row):
                raise CertificateRejected(path, "a multiplier on an empty equation")
            found = [add(t, field.multiply(w, a)) for t, a in zip(found, equation.row, strict=True)]
    for j, t in enumerate(found):
        if not t.is_zero:
            raise CertificateRejected(path, f"the gradient is not zero in coordinate {j + 1}")


def weighted_value(field: RootField, y: Numbers, values: Numbers, total: Weighting) -> Residue:
    """L(y), where ``values`` are those of the forms at y."""
    found = ZERO
    for m, value in zip(total.weights, values, strict=True):
        found = add(found, field.multiply(m, value))
    for w, equation in zip(total.extra, total.equations, strict=True):
        if not w.is_zero:
            off = add(_sum(equation.row, y, field), scale(equation.rhs, Fraction(-1)))
            found = add(found, field.multiply(w, off))
    return found
