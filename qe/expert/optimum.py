"""Rule "multipliers": the optimum of a convex problem, or that there is none.

Evidence: ``problem``, ``status``, ``field``, ``faces``, ``point``, and by status what docs/certificates.md lists. The
step says (``sentence``): that the constraints contradict each other (they may be some of the conjuncts of the block
before); that the objective is below every number somewhere; or which number is the least value or the infimum, and
which point alone takes it.

THEOREMS. Let f and the inequality forms p_i be convex quadratic polynomials and the equations linear.
(face) See ``convex_problem``: rational ones; then links, which have their weights in the field, at the point itself.
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

from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.expert.arithmetic.convexity import Row, inner, rank
from qe.expert.arithmetic.field import Number, RootField
from qe.expert.convex_problem import (
    PROBLEM,
    RELATIONS,
    Equation,
    Numbers,
    Place,
    Problem,
    check_faces,
    read_problem,
)
from qe.expert.sentences import Sentence, is_point, read_list, read_terms, renamed, stated
from qe.formula.build import atom, conj, disj, exists, forall, neg
from qe.formula.syntax import FALSE, TRUE, Exists, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.kernel.arithmetic.sturm import exact
from qe.kernel.block import existential
from qe.kernel.limits import check_variables
from qe.kernel.step import Claim, Context, Limits
from qe.options import Budget
from qe.proof.entry import Entry

_KEYS = {
    "optimal": ("multipliers", "derived", "values", "value", "attained", "unique"),
    "infeasible": ("multipliers", "derived", "values"),
    "unbounded": ("direction",),
}


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
    problem, field = read_problem(parts["problem"]), RootField(parts["field"], limits.budget)
    derived = check_faces(parts["faces"], problem, field)
    place = Place.of(problem, field, read_list(parts["point"], field.number, problem.size))
    if status != "optimal":
        _absent(parts["inner"])
    if status == "unbounded":
        _absent(parts["links"])
        _check_strict(place, parts["point"])
        _check_direction(problem, parts["direction"])
        return sentence(entry, limits.budget)
    if read_list(parts["values"], field.number, len(problem.forms)) != place.values:
        raise parts["values"].fail("not the values of the constraints at the point")
    weights = read_list(parts["multipliers"], field.number, len(problem.forms))
    known = follow(place, parts["links"], derived)[0] if status == "infeasible" else derived
    extra = read_list(parts["derived"], field.number, len(known))
    if status == "infeasible":
        least = field.sign(place.weighted(weights, extra, known, parts["multipliers"]))
        if least < 0 or (least == 0 and not _on_strict(problem, weights)):
            raise parts["multipliers"].fail("the weighted sum does not contradict the constraints")
    else:
        _check_optimal(place, weights, extra, derived, parts)
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
    field = RootField(parts["field"], budget)
    numbers = [field.number(parts["value"]), *read_list(parts["point"], field.number, len(names))]
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


def follow(place: Place, entry: Entry, known: Sequence[Equation]) -> tuple[list[Equation], Numbers]:
    """Check the links, each by (face), and return all equations known after them, and the weights of the last."""
    found, weights = list(known), list[Number]()
    for link in entry.items() if entry.value is not None else ():
        first, second = link.fields("weights", "derived")
        weights = read_list(first, place.field.number, len(place.problem.forms))
        found += place.face(weights, read_list(second, place.field.number, len(found)), found, first)
    if entry.value is not None and not weights:
        raise entry.fail("expected at least one link")
    return found, weights


def _check_optimal(
    place: Place, weights: Numbers, extra: Numbers, derived: Sequence[Equation], parts: dict[str, Entry]
) -> None:
    """The theorem (optimal), and what is claimed beyond it."""
    problem, field, entry = place.problem, place.field, parts["multipliers"]
    place.weighted(weights, extra, derived, entry, with_objective=True)
    attained = place.satisfies_strictly(parts["point"])
    for i, (w, value) in enumerate(zip(weights, place.values, strict=True)):
        if w and value:
            raise CertificateRejected(f"{entry.path}[{i}]", "a multiplier on a constraint that is not active")
    if field.number(parts["value"]) != field.reduced(problem.objective.value(place.point)):
        raise parts["value"].fail("not the value of the objective at the point")
    if parts["attained"].value is not attained:
        raise parts["attained"].fail(f"expected {str(attained).lower()} at this point")
    if attained:
        _absent(parts["inner"])
    else:
        first, second = parts["inner"].fields("field", "point")
        inside = RootField(first, field.budget)
        _check_strict(Place.of(problem, inside, read_list(second, inside.number, problem.size)), second)
    if attained or _on_strict(problem, weights):
        _absent(parts["links"])
    else:
        known = [*derived, *place.tangent(problem.objective, field.reduced(0)), *place.tangents(weights)]
        if not _on_strict(problem, follow(place, parts["links"], known)[1]):
            raise parts["links"].fail("no strict constraint has a positive multiplier, or weight in the last link")
    _check_unique(place, weights, derived, parts["unique"])


def _on_strict(problem: Problem, weights: Numbers) -> bool:
    """Whether a strict constraint has a weight that is not zero, and so positive."""
    return any(r == "<" and w for r, w in zip(problem.relations, weights))


def _check_unique(place: Place, weights: Numbers, derived: Sequence[Equation], entry: Entry) -> None:
    """Another minimum x* + d: H_f d = 0, equations stay and, where m_i > 0, H_i d = 0 and grad p_i(x*).d = 0."""
    if entry.value is False:
        return
    if entry.value is not True:
        raise entry.fail("expected true or false")
    problem = place.problem
    rows: list[Row] = [*problem.objective.hessian, *(e[:-1] for e in derived)]
    for w, form, relation in zip(weights, problem.forms, problem.relations, strict=True):
        slope = form.gradient(place.point)
        if relation == "=":
            rows.append(slope)
        elif w:
            rows += [*form.hessian, slope] if place.field.degree == 1 else form.hessian
    if rank([place.field.reduced(c)[0] for c in row] for row in rows) < problem.size:
        raise entry.fail("uniqueness does not follow")


def _check_strict(place: Place, entry: Entry) -> None:
    if not place.satisfies_strictly(entry):
        raise entry.fail("the point violates a strict constraint")


def _absent(entry: Entry) -> None:
    if entry.value is not None:
        raise entry.fail("not expected here")


def _check_direction(problem: Problem, entry: Entry) -> None:
    """The theorem (unbounded)."""
    d, origin = [exact(c) for c in read_list(entry, Entry.rational, problem.size)], (*[0] * problem.size, 1)
    for i, form in enumerate((problem.objective, *problem.forms)):
        slope = inner(form.gradient(origin), d)
        if any(inner(row, d) for row in form.hessian) or (slope >= 0 if i == 0 else slope > 0):
            raise entry.fail(f"it leaves constraint {i}" if i else "the objective does not fall along it")
        if slope and i and problem.relations[i - 1] == "=":
            raise entry.fail(f"it leaves constraint {i}")
