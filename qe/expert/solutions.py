"""Rule "solutions": the real solutions of a system, all of them. The step turns the system into their list.

Evidence: ``order`` (variables), ``equations`` and ``conditions`` ([polynomial g, one of ">", ">=", "/="]: g compared
with 0), ``weights`` (of the variables, for the monomial order in which the checker works), ``form`` (an integer for
each variable) and ``solutions``. A solution has a ``field`` (its minimal polynomial and an interval of its generator
theta) and ``values``, a number of the field for each variable.

THEOREM. There are at least as many solutions as are listed: every one of them satisfies the equations and the
conditions, exactly, and they are different, since the linear form takes the value theta at each, and the intervals are
disjoint. There are no more: signatures of trace forms for products of powers of the g count the solutions (Hermite
1853; Ben-Or, Kozen, Reif 1986), and a Gröbner basis, the quotient and the signatures are worked out from the equations
alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import reduce
from itertools import product as choices

from qe.errors import Unable
from qe.exact.ring import Poly, Ring
from qe.expert.arithmetic.convexity import inner
from qe.expert.arithmetic.field import RootField
from qe.expert.arithmetic.ideal import Ideal, TraceForms, product, terms_of
from qe.expert.sentences import Sentence, is_point, read_list, renamed
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import Relation
from qe.kernel.step import Limits
from qe.options import Budget
from qe.proof.entry import Entry

INDICATORS: dict[str, tuple[Fraction, Fraction, Fraction]] = {
    ">": (Fraction(0), Fraction(1, 2), Fraction(1, 2)),
    ">=": (Fraction(1), Fraction(1, 2), Fraction(-1, 2)),
    "/=": (Fraction(0), Fraction(0), Fraction(1)),
}
"""Weights of s^0, s, s^2 for a sign s: their sum is 1 where the relation holds, and 0 elsewhere."""

MOST_SIGNATURES = 250
MOST_WEIGHT = 10_000
"""Weights are small, so that degrees are."""


def check_solutions(evidence: Entry, limits: Limits) -> Sentence:
    """What the evidence proves; or raise ``CertificateRejected`` naming the entry that fails."""
    order, equations_entry, conditions_entry, weights_entry, form_entry, listed = evidence.fields(*_MEMBERS)
    names = order.names()
    if not names:
        raise order.fail("expected different variables, at least one")
    ring = Ring.of(names)
    equations = [e.polynomial(ring) for e in equations_entry.items()]
    conditions = [_condition(e, ring) for e in conditions_entry.items()]
    weights, form = read_list(weights_entry, _weight, len(names)), read_list(form_entry, _integer, len(names))
    points = [_Solution(e, len(names), limits.budget) for e in listed.items()]
    for point in points:
        point.check(equations, conditions, form)
    for i, one in enumerate(points):
        for other in points[:i]:
            if one.field.low <= other.field.high and other.field.low <= one.field.high:
                raise one.entry.fail("the interval of theta meets that of another solution")
    found = _count(equations, conditions, weights, equations_entry, limits.budget)
    if found != len(points):
        raise listed.fail(f"there are {found} solutions, and {len(points)} are listed")
    return sentence(evidence, limits.budget)


_MEMBERS = ("order", "equations", "conditions", "weights", "form", "solutions")


def sentence(evidence: Entry, budget: Budget) -> Sentence:
    """That the equations and the conditions hold at the points that are listed, and nowhere else."""
    order, equations, conditions, _, _, listed = evidence.fields(*_MEMBERS)
    names = order.names()
    ring, whole = Ring.of(names), Ring.of((*names, *renamed(("root",), names)))
    parts = [atom(e.polynomial(ring), Relation.EQ) for e in equations.items()]
    parts += [atom(p, Relation(relation)) for p, relation in (_condition(e, ring) for e in conditions.items())]
    points = [_Solution(e, len(names), budget) for e in listed.items()]
    return conj(parts), disj(is_point(names, point.values, point.field, whole) for point in points)


def _condition(entry: Entry, ring: Ring) -> tuple[Poly, str]:
    poly, relation = entry.row("polynomial", '">" or ">=" or "/="')
    if relation.text() not in INDICATORS:
        raise relation.fail('expected ">" or ">=" or "/="')
    return poly.polynomial(ring), relation.text()


def _weight(entry: Entry) -> int:
    if entry.integer(1) > MOST_WEIGHT:
        raise entry.fail(f"expected at most {MOST_WEIGHT}")
    return entry.integer(1)


def _integer(entry: Entry) -> int:
    if not isinstance(entry.value, int) or isinstance(entry.value, bool):
        raise entry.fail("expected an integer")
    return entry.value


class _Solution:
    """A point over the field of a root, with the ends of the interval as they are written."""

    def __init__(self, entry: Entry, size: int, budget: Budget) -> None:
        field, values = entry.fields("field", "values")
        self.entry, self.field = entry, RootField(field, budget)
        self.values, self.values_entry = read_list(values, self.field.number, size), values

    def check(self, equations: Sequence[Poly], conditions: Sequence[tuple[Poly, str]], form: Sequence[int]) -> None:
        """That the equations, the conditions and the linear form have the values that they should have."""
        for p in equations:
            if self.field.value(p, self.values):
                raise self.values_entry.fail("the numbers do not satisfy an equation")
        for g, relation in conditions:
            if not Relation(relation).holds(self.field.sign(self.field.value(g, self.values))):
                raise self.values_entry.fail("the numbers do not satisfy a condition")
        if self.field.reduced(inner(form, self.values)) != self.field.theta:
            raise self.values_entry.fail("the linear form has another value than the generator of the field")


def _count(
    equations: Sequence[Poly],
    conditions: Sequence[tuple[Poly, str]],
    weights: Sequence[int],
    entry: Entry,
    budget: Budget,
) -> Fraction:
    """The number of real solutions with the conditions."""

    def tick() -> None:
        budget.check("verify")

    ideal = Ideal([terms_of(p) for p in equations], weights, tick)
    if not ideal.is_finite:
        raise entry.fail("the equations have infinitely many complex solutions")
    powers = [[(k, w) for k, w in enumerate(INDICATORS[relation]) if w] for _, relation in conditions]
    if reduce(lambda a, b: a * len(b), powers, 1) > MOST_SIGNATURES:
        raise Unable(f"{len(conditions)} conditions need more than {MOST_SIGNATURES} signatures")
    forms, total = TraceForms(ideal), Fraction(0)
    one = terms_of(equations[0].ring.constant(1))
    for chosen in choices(*powers):
        h, weight = one, Fraction(1)
        for (g, _), (k, w) in zip(conditions, chosen, strict=True):
            weight *= w
            for _ in range(k):
                h = ideal.remainder(product(h, terms_of(g)))
        total += weight * forms.signature(h)
    return total
