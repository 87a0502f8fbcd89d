"""Rule "multipliers": the optimum of a convex problem, or that there is none.

Evidence: ``problem``, ``status``, ``field``, ``faces``, ``point``, and by status what docs/certificates.md lists. The
step says (``sentence``): that the constraints contradict each other (they may be some of the conjuncts of the block
before); that the objective is below every number somewhere; or which number is the least value or the infimum, and
which point alone takes it.

THEOREMS. Let f and the inequality forms p_i be convex quadratic polynomials and the equations linear.
(face) Weights w >= 0 on inequalities, any on equations, and a point y with grad L(y) = 0 and L(y) >= 0 for
L = sum w_i p_i + sum v_k e_k: every feasible x has 0 >= L(x) = L(y) + (x-y)^T H_L (x-y)/2 >= 0, hence H_i(x-y) = 0 and
p_i(x) = 0 wherever w_i > 0, which gives further linear equations e_k (Borwein–Wolkowicz 1981).
(link) The same with weights and y in a number field, and w_i p_i(y) = 0 for all i.
(optimal) A feasible x* with multipliers of the right signs, complementary, stationary for f + L: f(x) >= f(x*) for all
feasible x (Karush 1939, Kuhn–Tucker 1951). With all strict constraints strict at x* it is attained; otherwise, given
one point where they are strict, f(x*) is the infimum and, being approached along a segment, not more.
(not attained) At a feasible x with f(x) <= f(x*) the face argument holds for f - f(x*) + L at y = x*, so p_i(x) = 0
wherever m_i > 0, and links may follow: no such x exists when one of these, or of the last link's, p_i is strict.
(infeasible) As (face), after links, with L(y) > 0, or L(y) = 0 and w_i > 0 for a strict constraint.
(unbounded) A feasible point and d with H_f d = 0, grad f.d < 0, H_i d = 0, b_i.d <= 0, a_j.d = 0.
Nothing is shared with the producer of such certificates except the format.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.expert.arithmetic.convexity import Row, rank
from qe.expert.arithmetic.numbers import read_field, read_number
from qe.expert.arithmetic.residue import Residue, RootField, add, scale
from qe.expert.convex_problem import (
    Equation,
    Problem,
    Weighting,
    as_fraction,
    check_signs,
    check_stationary,
    rational,
    read_numbers,
    read_problem,
    read_row,
    slope_at,
    tangents,
    value_at,
    weighted_value,
)
from qe.expert.sentences import Sentence, is_point, read_terms, renamed, stated
from qe.formula.build import atom, conj, disj, exists, forall, neg
from qe.formula.syntax import FALSE, TRUE, Exists, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.kernel.block import existential
from qe.kernel.limits import check_variables
from qe.kernel.step import Claim, Context, Limits
from qe.options import Budget
from qe.proof.entry import Entry

PROBLEM = ("variables", "minimise", "constraints")
RELATIONS = {"<=": Relation.LE, "<": Relation.LT, "=": Relation.EQ}
"""The relations of constraints."""

_KEYS = {
    "optimal": ("multipliers", "derived", "values", "value", "attained", "unique"),
    "infeasible": ("multipliers", "derived", "values"),
    "unbounded": ("direction",),
}
_Q = RootField([0, 1], Fraction(0), Fraction(0), "rationals")


def check_multipliers(claim: Claim, context: Context, limits: Limits) -> None:
    """The evidence is accepted, and the step says what it proves."""
    entry = claim.evidence
    if not isinstance(entry.value, dict) or entry.value.get("status") != "infeasible":
        check_stated(claim, context, limits)
        return
    check_optimum(entry, limits)
    before, after = existential(claim)
    variables, _, constraints = Entry(entry.value["problem"], f"{entry.path}.problem").fields(*PROBLEM)
    if before.free or after != FALSE or not {*variables.names()} <= {*claim.ring.names}:
        raise claim.fail("expected a sentence of one block, which is false")
    known = set(conjuncts(before.body if isinstance(before, Exists) else before))
    for constraint, condition in zip(constraints.items(), conditions(entry, claim.ring), strict=True):
        if before != FALSE and condition != TRUE and condition not in known:
            raise constraint.fail("not a conjunct of the sentence")


def check_optimum(entry: Entry, limits: Limits) -> Sentence:
    """What the evidence proves; or raise ``CertificateRejected`` naming the entry that fails."""
    status = entry.value.get("status") if isinstance(entry.value, dict) else None
    if not isinstance(status, str) or status not in _KEYS:
        raise CertificateRejected(f"{entry.path}.status", "expected optimal, infeasible or unbounded")
    names = ("problem", "status", "field", "faces", "point", *_KEYS[status])
    optional = ("inner", "links")
    parts = dict(zip((*names, *optional), entry.fields(*names, optional=optional), strict=True))
    problem = read_problem(parts["problem"])
    field = read_field(parts["field"], limits.budget)
    derived = _check_faces(parts["faces"], problem)
    point = read_numbers(parts["point"], field, problem.size)
    if status != "optimal":
        _absent(parts["inner"])
    if status == "unbounded":
        _absent(parts["links"])
        _check_feasible(problem, field, point, parts["point"])
        _check_direction(problem, parts["direction"])
        return sentence(entry, limits.budget)
    values = _check_values(problem, field, point, parts["values"])
    multipliers = read_numbers(parts["multipliers"], field, len(problem.forms))
    check_signs(problem, field, multipliers, parts["multipliers"].path, "multiplier")
    place = _Place(problem, field, point, values, entry.path)
    if status == "infeasible":
        known = place.follow(parts["links"], derived)[0]
        total = Weighting(multipliers, known, read_numbers(parts["derived"], field, len(known)))
        place.check_contradiction(total)
    else:
        total = Weighting(multipliers, derived, read_numbers(parts["derived"], field, len(derived)))
        place.check_optimal(total, parts)
    return sentence(entry, limits.budget)


check_stated = stated(check_optimum)


def sentence(entry: Entry, budget: Budget) -> Sentence:
    """What evidence that is accepted says."""
    assert isinstance(entry.value, dict)
    status, parts = entry.value["status"], {k: Entry(v, f"{entry.path}.{k}") for k, v in entry.value.items()}
    names = parts["problem"].fields(*PROBLEM)[0].names()
    check_variables(len(names))
    value, below, *others, root = renamed(("value", "below", *names, "root"), names)
    ring = Ring.of((value, *names, *others, below, root))
    if status == "infeasible":
        return exists(names, conj(conditions(entry, ring))), FALSE
    if status == "unbounded":
        lower = conj((*conditions(entry, ring), _compared(entry, ring, below, "<")))
        return forall((below,), exists(names, lower)), TRUE
    field = read_field(parts["field"], budget)
    numbers = [read_number(parts["value"], field), *read_numbers(parts["point"], field, len(names))]
    if parts["attained"].value is not True:
        above = disj((*map(neg, conditions(entry, ring)), _compared(entry, ring, value, ">")))
        near = exists(names, conj((*conditions(entry, ring), _compared(entry, ring, below, "<"))))
        larger = atom(ring.gen(ring.index[below]) - ring.gen(0), Relation.GT)
        infimum = conj((forall(names, above), forall((below,), disj((neg(larger), near)))))
        return infimum, is_point((value,), numbers[:1], field, ring)
    taken = conj((*conditions(entry, ring), _compared(entry, ring, value, "=")))
    least = disj((*map(neg, conditions(entry, ring, others)), _compared(entry, ring, value, ">=", others)))
    if parts["unique"].value is True:
        return conj((taken, forall(others, least))), is_point((value, *names), numbers, field, ring)
    return conj((exists(names, taken), forall(others, least))), is_point((value,), numbers[:1], field, ring)


def conditions(entry: Entry, ring: Ring, names: Sequence[str] = ()) -> list[Formula]:
    """The constraints of the evidence in these variables, or in its own."""
    assert isinstance(entry.value, dict)
    variables, _, constraints = Entry(entry.value["problem"], f"{entry.path}.problem").fields(*PROBLEM)
    read = [constraint.fields("terms", "relation") for constraint in constraints.items()]
    names = names or variables.names()
    return [atom(read_terms(terms, names, ring)[0], RELATIONS[relation.text()]) for terms, relation in read]


def _compared(entry: Entry, ring: Ring, bound: str, relation: str, names: Sequence[str] = ()) -> Formula:
    """The objective compared with a variable."""
    assert isinstance(entry.value, dict)
    variables, objective, _ = Entry(entry.value["problem"], f"{entry.path}.problem").fields(*PROBLEM)
    poly, scale = read_terms(objective, names or variables.names(), ring)
    return atom(poly - scale * ring.gen(ring.index[bound]), Relation(relation))


# --- faces over Q ----------------------------------------------------------------------------------------------


def _check_faces(entry: Entry, problem: Problem) -> list[Equation]:
    """Check every face and return the equations derived by all of them, in order; their numbers are rational."""
    derived: list[Equation] = []
    for face in entry.items():
        first, second, third = face.fields("weights", "derived", "point")
        weights = rational(read_row(first, len(problem.forms)))
        total = Weighting(weights, list(derived), rational(read_row(second, len(derived))))
        y = rational(read_row(third, problem.size))
        check_signs(problem, _Q, weights, first.path, "weight")
        check_stationary(problem, _Q, y, total, face.path)
        values = [value_at(f, y, _Q) for f in problem.forms]
        if _Q.sign(weighted_value(_Q, y, values, total)) < 0:
            raise CertificateRejected(third.path, "the weighted sum is negative there")
        found: list[Equation] = []
        for w, form, relation, value in zip(weights, problem.forms, problem.relations, values, strict=True):
            if relation != "=" and not w.is_zero:
                found += tangents(form, y, _Q, value)
        if not found:
            raise face.fail("a face without positive weights")
        derived += found
    return derived


def _check_values(problem: Problem, field: RootField, point: list[Residue], entry: Entry) -> list[Residue]:
    stated = read_numbers(entry, field, len(problem.forms))
    for i, (form, claim) in enumerate(zip(problem.forms, stated, strict=True)):
        if not add(value_at(form, point, field), scale(claim, Fraction(-1))).is_zero:
            raise CertificateRejected(f"{entry.path}[{i}]", "not the value of the constraint at the point")
    return stated


# --- at the point ----------------------------------------------------------------------------------------------


class _Place:
    """A problem at one point, with the values of its forms there."""

    def __init__(
        self, problem: Problem, field: RootField, point: list[Residue], values: list[Residue], path: str
    ) -> None:
        self.problem, self.field, self.point, self.values, self.path = problem, field, point, values, path

    def check_contradiction(self, total: Weighting) -> None:
        """The theorem (infeasible)."""
        check_stationary(self.problem, self.field, self.point, total, f"{self.path}.multipliers")
        least = self.field.sign(weighted_value(self.field, self.point, self.values, total))
        if least < 0 or (least == 0 and not self._on_strict(total.weights)):
            reason = "the weighted sum does not contradict the constraints"
            raise CertificateRejected(f"{self.path}.multipliers", reason)

    def check_optimal(self, total: Weighting, parts: dict[str, Entry]) -> None:
        """The theorem (optimal), and what is claimed beyond it."""
        problem, field = self.problem, self.field
        check_stationary(problem, field, self.point, total, f"{self.path}.multipliers", with_objective=True)
        attained = True
        for i, (value, relation) in enumerate(zip(self.values, problem.relations, strict=True)):
            sign = field.sign(value)
            if sign > 0 or (sign and relation == "="):
                raise CertificateRejected(f"{self.path}.values[{i}]", "the point violates the constraint")
            attained = attained and not (relation == "<" and sign == 0)
        self._check_complementary(total.weights, f"{self.path}.multipliers", "multiplier")
        stated = read_number(parts["value"], field)
        if not add(value_at(problem.objective, self.point, field), scale(stated, Fraction(-1))).is_zero:
            raise parts["value"].fail("not the value of the objective at the point")
        if parts["attained"].value is not attained:
            raise parts["attained"].fail(f"expected {str(attained).lower()} at this point")
        if attained:
            _absent(parts["inner"])
            _absent(parts["links"])
        else:
            _check_inner(problem, parts["inner"], self.field.budget)
            self._check_not_attained(total, parts)
        self._check_unique(total, parts["unique"])

    def _check_not_attained(self, total: Weighting, parts: dict[str, Entry]) -> None:
        """The theorem (not attained)."""
        if self._on_strict(total.weights):
            _absent(parts["links"])
            return
        if parts["links"].value is None:
            reason = (
                "not proved: no strict constraint has a positive multiplier, and there are no links that exclude one"
            )
            raise parts["attained"].fail(reason)
        known = [*total.equations, *tangents(self.problem.objective, self.point, self.field)]
        _, last = self.follow(parts["links"], known + self._tangents(total.weights))
        if not self._on_strict(last):
            raise parts["links"].fail("no strict constraint has a positive weight in the last link")

    def follow(self, entry: Entry, known: list[Equation]) -> tuple[list[Equation], list[Residue]]:
        """Check the links, each by (link), and return all equations known after them, and the weights of the last."""
        found, weights = list(known), list[Residue]()
        for link in entry.items() if entry.value is not None else ():
            first, second = link.fields("weights", "derived")
            weights = read_numbers(first, self.field, len(self.problem.forms))
            total = Weighting(weights, found, read_numbers(second, self.field, len(found)))
            check_signs(self.problem, self.field, weights, first.path, "weight")
            self._check_complementary(weights, first.path, "weight")
            check_stationary(self.problem, self.field, self.point, total, link.path)
            if self.field.sign(weighted_value(self.field, self.point, self.values, total)) < 0:
                raise link.fail("the weighted sum is negative at the point")
            further = self._tangents(weights)
            if not further:
                raise link.fail("a link without positive weights")
            found = found + further
        if entry.value is not None and not weights:
            raise entry.fail("expected at least one link")
        return found, weights

    def _tangents(self, weights: Sequence[Residue]) -> list[Equation]:
        found: list[Equation] = []
        for w, form, relation in zip(weights, self.problem.forms, self.problem.relations, strict=True):
            if relation != "=" and not w.is_zero:
                found += tangents(form, self.point, self.field)
        return found

    def _on_strict(self, weights: Sequence[Residue]) -> bool:
        """Whether a strict constraint has a weight that is not zero, and so positive."""
        return any(r == "<" and not w.is_zero for r, w in zip(self.problem.relations, weights, strict=True))

    def _check_complementary(self, weights: Sequence[Residue], path: str, what: str) -> None:
        for i, (w, value) in enumerate(zip(weights, self.values, strict=True)):
            if not w.is_zero and not value.is_zero:
                raise CertificateRejected(f"{path}[{i}]", f"a {what} on a constraint that is not active")

    def _check_unique(self, total: Weighting, entry: Entry) -> None:
        """Another minimum x* + d: H_f d = 0, equations stay and, where m_i > 0, H_i d = 0 and grad p_i(x*).d = 0."""
        if entry.value is False:
            return
        if entry.value is not True:
            raise entry.fail("expected true or false")
        problem = self.problem
        rows: list[Row] = [*problem.objective.hessian, *(_fractions(e.row) for e in total.equations)]
        for m, form, relation in zip(total.weights, problem.forms, problem.relations, strict=True):
            if relation == "=":
                rows.append(form.gradient)
            elif not m.is_zero:
                rows += form.hessian
                if self.field.degree == 1:
                    rows.append(_fractions(slope_at(form, self.point)))
        if rank(rows) < problem.size:
            raise entry.fail("uniqueness does not follow")


def _fractions(row: Sequence[Residue]) -> Row:
    return tuple(as_fraction(a) for a in row)


def _check_feasible(problem: Problem, field: RootField, point: list[Residue], entry: Entry) -> None:
    for i, (form, relation) in enumerate(zip(problem.forms, problem.relations, strict=True)):
        sign = field.sign(value_at(form, point, field))
        if (relation == "=" and sign) or sign > 0 or (relation == "<" and sign == 0):
            raise CertificateRejected(entry.path, f"the point violates constraint {i + 1}")


def _check_inner(problem: Problem, entry: Entry, budget: Budget) -> None:
    if entry.value is None:
        raise entry.fail("missing: a point that satisfies the strict constraints")
    first, second = entry.fields("field", "point")
    field = read_field(first, budget)
    point = read_numbers(second, field, problem.size)
    _check_feasible(problem, field, point, second)


def _absent(entry: Entry) -> None:
    if entry.value is not None:
        raise entry.fail("not expected here")


def _check_direction(problem: Problem, entry: Entry) -> None:
    d = read_row(entry, problem.size)

    def along(row: Row) -> Fraction:
        return sum((a * b for a, b in zip(row, d, strict=True)), Fraction(0))

    if any(along(row) for row in problem.objective.hessian) or along(problem.objective.gradient) >= 0:
        raise entry.fail("the objective does not fall along it")
    for i, (form, relation) in enumerate(zip(problem.forms, problem.relations, strict=True)):
        slope = along(form.gradient)
        if any(along(row) for row in form.hessian) or slope > 0 or (slope and relation == "="):
            raise entry.fail(f"it leaves constraint {i + 1}")
