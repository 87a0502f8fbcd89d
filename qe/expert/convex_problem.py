"""What the checker knows about a convex problem: reading it, and weighted sums of its constraints at a point.

THEOREM (face). Let the inequality forms p_i be convex quadratic polynomials and the equations linear. Weights w >= 0 on
inequalities, any on equations, and a point y with grad L(y) = 0 and L(y) >= 0 for L = sum w_i p_i + sum v_k e_k, where
the e_k are linear and 0 for all feasible x: every feasible x has 0 >= L(x) = L(y) + (x-y)^T H_L (x-y)/2 >= 0, hence
H_i(x-y) = 0 and p_i(x) = 0 wherever w_i > 0, which gives further linear equations e_k (Borwein–Wolkowicz 1981).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.expert.arithmetic.convexity import Quadratic, Row, inner
from qe.expert.arithmetic.field import ONE, Number, RootField, constant
from qe.expert.sentences import read_list, read_terms
from qe.formula.syntax import Relation
from qe.kernel.limits import check_variables
from qe.proof.entry import Entry

PROBLEM = ("variables", "minimise", "constraints")
RELATIONS = {"<=": Relation.LE, "<": Relation.LT, "=": Relation.EQ}
"""The relations of constraints."""

Numbers = Sequence[Number]
Equation = Row
"""Numbers a and b such that a . x + b = 0: the coefficients, and the constant behind them."""


@dataclass(frozen=True, slots=True)
class Problem:
    """Minimise ``objective`` where forms[i] relations[i] 0. Invariant: all convex, forms with "=" linear."""

    size: int
    objective: Quadratic
    forms: tuple[Quadratic, ...]
    relations: tuple[str, ...]


def read_problem(entry: Entry) -> Problem:
    """The problem, proved to be convex."""
    variables, minimise, constraints = entry.fields(*PROBLEM)
    names = variables.names()
    check_variables(len(names))
    objective = _convex(minimise, names)
    forms, relations = [], []
    for constraint in constraints.items():
        terms, relation = constraint.fields("terms", "relation")
        if relation.text() not in RELATIONS:
            raise relation.fail("expected <=, < or =")
        forms.append(_convex(terms, names))
        if relation.text() == "=" and forms[-1].poly.total_degree > 1:
            raise terms.fail("a nonlinear equation")
        relations.append(relation.text())
    return Problem(len(names), objective, tuple(forms), tuple(relations))


def _convex(entry: Entry, names: tuple[str, ...]) -> Quadratic:
    form = Quadratic.of(*read_terms(entry, names, Ring.of(names)))
    if not form.is_convex:
        raise entry.fail("a polynomial that is not convex")
    return form


@dataclass(frozen=True, slots=True)
class Place:
    """A problem at a point y. ``point``: its coordinates, and 1; ``values``: those of the forms there."""

    problem: Problem
    field: RootField
    point: tuple[Number, ...]
    values: list[Number]

    @staticmethod
    def of(problem: Problem, field: RootField, y: Numbers) -> Place:
        """The problem at these coordinates."""
        point = (*y, ONE)
        return Place(problem, field, point, [field.reduced(form.value(point)) for form in problem.forms])

    def satisfies_strictly(self, entry: Entry) -> bool:
        """Whether strict constraints hold; as weak ones they have to, and all others."""
        strictly = True
        for i, (value, relation) in enumerate(zip(self.values, self.problem.relations, strict=True)):
            sign = self.field.sign(value)
            if sign > 0 or (sign and relation == "="):
                raise entry.fail(f"the point violates constraint {i + 1}")
            strictly = strictly and (sign < 0 or relation != "<")
        return strictly

    def weighted(
        self, weights: Numbers, extra: Numbers, known: Sequence[Equation], entry: Entry, *, with_objective: bool = False
    ) -> Number:
        """L(y). Rejected where a weight of an inequality is negative, or the gradient of L (of f + L
        ``with_objective``) is not 0 at y."""
        problem, field = self.problem, self.field
        for i, (w, relation) in enumerate(zip(weights, problem.relations, strict=True)):
            if relation != "=" and field.sign(w) < 0:
                raise CertificateRejected(f"{entry.path}[{i}]", "a negative weight of an inequality")
        slopes = [(w, e[:-1]) for w, e in zip(extra, known, strict=True) if w]
        if not all(any(slope) for _, slope in slopes):
            raise entry.fail("a multiplier on an empty equation")
        slopes += [(w, form.gradient(self.point)) for w, form in zip(weights, problem.forms, strict=True) if w]
        slopes += [(ONE, problem.objective.gradient(self.point))] if with_objective else []
        for j in range(problem.size):
            if field.reduced(sum(w * slope[j] for w, slope in slopes)):
                raise entry.fail(f"the gradient is not zero in coordinate {j + 1}")
        of_known = sum(w * inner(e, self.point) for w, e in zip(extra, known, strict=True) if w)
        return field.reduced(inner(weights, self.values) + of_known)

    def face(self, weights: Numbers, extra: Numbers, known: Sequence[Equation], entry: Entry) -> list[Equation]:
        """The equations that follow by the theorem."""
        if self.field.sign(self.weighted(weights, extra, known, entry)) < 0:
            raise entry.fail("the weighted sum is negative there")
        further = self.tangents(weights)
        if not further:
            raise entry.fail("a face without positive weights")
        return further

    def tangents(self, weights: Numbers) -> list[Equation]:
        """What is said of x by p_i(x) = 0 and H_i(x-y) = 0 for the inequalities with weights."""
        parts = zip(weights, self.problem.forms, self.problem.relations, self.values, strict=True)
        return [e for w, form, rel, value in parts if w and rel != "=" for e in self.tangent(form, value)]

    def tangent(self, form: Quadratic, value: Number) -> list[Equation]:
        """H x = H y, row by row, and value + grad p(y).(x - y) = 0."""
        rows, y = [*form.hessian, form.gradient(self.point)], self.point[:-1]
        found: list[Equation] = [(*row, self.field.reduced(-inner(row, y))) for row in rows]
        found[-1] = (*found[-1][:-1], found[-1][-1] + value)
        return found


def check_faces(entry: Entry, problem: Problem, field: RootField) -> list[Equation]:
    """Check every face, which is rational, and return the equations derived by all of them, in order."""
    derived: list[Equation] = []
    for face in entry.items():
        first, second, third = face.fields("weights", "derived", "point")
        sizes = ((first, len(problem.forms)), (second, len(derived)), (third, problem.size))
        rows = [read_list(e, Entry.rational, n) for e, n in sizes]
        weights, extra, y = (list(map(constant, row)) for row in rows)
        derived += Place.of(problem, field, y).face(weights, extra, derived, first)
    return derived
