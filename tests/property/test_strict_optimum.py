"""Strict conditions: the infimum, whether it is attained, and emptiness agree with quantifier elimination."""

from __future__ import annotations

import json
from fractions import Fraction as F

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.certify.verify import verify_json
from qe.convex.alternative import Balance, alternative
from qe.convex.optimum import Optimum, OptimumStatus, minimize
from qe.errors import Unable
from qe.exact.field import FieldElement, NumberField
from qe.exact.kkt_system import HighDegree
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, convert, exists
from qe.formula.evaluate import truth_under
from qe.formula.syntax import Formula, Relation
from qe.formula.traverse import map_atoms
from qe.options import Budget
from tests.certificates.mutation import replaced
from tests.enough import enough
from tests.strict_problems import conditions, objectives
from tests.tables import each

THREE = Ring.of(("x", "y", "z", "v"))
TWO = Ring.of(("x", "y", "v"))


@st.composite
def problems(draw: st.DrawFn, *, huge: bool = False, bent: bool = True) -> tuple[Poly, Formula]:
    """In two or three variables; the last name of the ring is left for the value."""
    whole = draw(st.sampled_from((TWO, THREE)))
    ring = Ring.of(whole.names[:-1])
    body = conj(draw(conditions(ring, huge=huge, bent=bent)))
    return draw(objectives(ring, huge=huge, bent=bent)).convert(whole), convert(body, whole)


def at_value(objective: Poly, value: F | FieldElement, relation: Relation) -> Formula:
    """objective relation value, where an irrational value is the last variable of the ring."""
    ring = objective.ring
    if isinstance(value, FieldElement) and not value.is_rational:
        v, number = ring.gen(ring.size - 1), value.to_algebraic()
        minimal = sum((c * v**k for k, c in enumerate(number.minimal_polynomial)), start=ring.constant(0))
        low, high = number.interval(40)
        between = [atom(low.denominator * v - low.numerator, Relation.GE)]
        between.append(atom(high.denominator * v - high.numerator, Relation.LE))
        return conj([atom(minimal, Relation.EQ), *between, atom(objective - v, relation)])
    number = F(value) if not isinstance(value, FieldElement) else value.as_fraction()
    return atom(objective * number.denominator - number.numerator, relation)


def agrees(objective: Poly, body: Formula, method: str) -> Optimum:
    """The optimum, proved, and compared with three decisions by elimination."""
    found = minimize(objective, body)
    verdict = qe.verify(found.certificate)
    assert verdict.accepted, verdict
    names = objective.ring.names
    assert qe.decide(exists(names, body), method=method) == (found.status is not OptimumStatus.INFEASIBLE)
    if found.status is OptimumStatus.OPTIMAL:
        below, reached = (at_value(objective, found.value, r) for r in (Relation.LT, Relation.LE))
        assert not qe.decide(exists(names, conj([body, below])), method=method)
        assert qe.decide(exists(names, conj([body, reached])), method=method) == found.attained
        if found.attained:
            assert_holds(body, found)
    return found


def assert_holds(body: Formula, found: Optimum) -> None:
    """The point of an attained optimum satisfies every condition, in the exact arithmetic of its field."""

    def sign(poly: Poly) -> int:
        total: F | FieldElement = F(0)
        for exponents, coefficient in poly.terms():
            term: F | FieldElement = F(coefficient)
            for name, e in zip(poly.ring.names, exponents, strict=True):
                for _ in range(e):
                    term = found.point[name] * term
            total = total + term
        return int(total > 0) - int(total < 0)

    assert truth_under(body, sign) is True


def tried(problem: tuple[Poly, Formula], method: str) -> bool:
    """Whether the problem was decided; then it agreed."""
    try:
        agrees(*problem, method=method)
    except HighDegree:
        return False
    except Unable as reason:
        assert "direction of descent" in str(reason)  # unbounded along a parabola: said, not guessed
        return False
    return True


@each((26, 30), pytest.param(200, 400, marks=pytest.mark.deep))
def test_attainment_agrees_with_decomposition(at_least: int, of: int) -> None:
    enough(at_least, of, problems())(lambda problem: tried(problem, "cad"))()


@settings(max_examples=40)
@given(problems(huge=True, bent=False))
def test_linear_problems_with_huge_numbers_are_all_decided(problem: tuple[Poly, Formula]) -> None:
    agrees(*problem, method="vs")


def moved(poly: Poly, factors: list[int], offsets: list[int]) -> Poly:
    """poly at the points factor_i * x_i - offset_i."""
    return poly.compose({i: factors[i] * poly.ring.gen(i) - offsets[i] for i in range(poly.ring.size)})


FAR = st.lists(st.sampled_from((0, 1, 10**6, 10**20)), min_size=4, max_size=4)
FINE = st.lists(st.sampled_from((1, 1, 10**10, 10**25)), min_size=4, max_size=4)


@pytest.mark.deep
@enough(64, 80, problems(), FINE, FAR)
def test_a_copy_far_off_or_finer_has_the_same_optimum(
    problem: tuple[Poly, Formula], factors: list[int], offsets: list[int]
) -> bool:
    objective, body = problem
    copy = map_atoms(body, lambda a: atom(moved(a.poly, factors, offsets), a.relation))
    try:
        first = minimize(objective, body, budget=Budget(5))
        second = minimize(moved(objective, factors, offsets), copy, budget=Budget(5))
    except Unable:
        return False
    assert (second.status, second.attained) == (first.status, first.attained)
    assert second.value == first.value and qe.verify(second.certificate).accepted
    return True


@settings(max_examples=30)
@given(problems())
def test_the_opposite_claim_is_rejected(problem: tuple[Poly, Formula]) -> None:
    try:
        found = minimize(*problem)
    except Unable:
        return
    if found.status is not OptimumStatus.OPTIMAL:
        return
    whole = json.loads(found.certificate.to_json())
    payload = {**whole["payload"]["steps"][0]["evidence"], "attained": not found.attained}
    if found.attained:  # the point itself is as good a proof that the infimum is right as any other
        payload["inner"] = {"field": payload["field"], "point": payload["point"]}
    verdict = verify_json(replaced(whole, ("payload", "steps", 0, "evidence"), payload))
    assert not verdict.accepted and verdict.step == "payload.steps[0].evidence.attained"


ROWS = st.integers(1, 3).flatmap(
    lambda n: st.lists(st.lists(st.integers(-3, 3), min_size=n, max_size=n), min_size=1, max_size=6)
)


@given(ROWS, ROWS, st.booleans())
def test_of_gordans_alternative_one_side_is_always_given(first, second, irrational) -> None:
    """Over Q, and over Q(sqrt 2) with rows a + b*sqrt 2."""
    field = NumberField.from_root([-2, 0, 1], 1, 2)
    size = len(first[0])
    rows = [[F(a) for a in row] for row in first]
    if irrational and len(second[0]) == size:
        for row, other in zip(rows, second, strict=False):
            row[:] = [a + b * field.generator() for a, b in zip(row, other, strict=True)]
    found = alternative(rows, size, budget=Budget())
    if isinstance(found, Balance):
        assert found.weights and all(w > 0 for w in found.weights.values())
        assert not any(sum(w * rows[i][k] for i, w in found.weights.items()) for k in range(size))
    else:
        assert all(sum(a * d for a, d in zip(row, found.direction, strict=True)) < 0 for row in rows)
