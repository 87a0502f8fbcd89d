"""Optima: against other ways to find them, where conditions are strict, and of negated bodies."""

from __future__ import annotations

import json
import random
from dataclasses import replace
from fractions import Fraction as F

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import qe
from qe.certify.verify import verify, verify_json
from qe.convex.optimum import Optimum, OptimumStatus, minimize
from qe.convex.simplex import Least, Nowhere
from qe.convex.strict import alternative
from qe.elimination.protocol import Context, Outcome
from qe.engine.strategy import STRATEGY, Attempt
from qe.errors import Unable
from qe.exact.field import FieldElement, NumberField
from qe.exact.kkt_system import HighDegree
from qe.exact.ring import Poly, Ring
from qe.formula.block import Block
from qe.formula.build import atom, conj, convert, exists
from qe.formula.evaluate import holds_at, truth_under
from qe.formula.normal import nnf, rename_apart
from qe.formula.syntax import Constant, Formula, Not, Relation
from qe.formula.traverse import map_atoms
from qe.options import Budget, Options
from qe.proof.run_log import RunLog
from tests.certificates.mutation import replaced
from tests.differential.generate import SMALL, Shape, random_formula, random_point
from tests.enough import enough
from tests.optimum_problems import at_most_zero, cubic, quadratic
from tests.strict_problems import conditions, objectives
from tests.tables import each

small = st.integers(-4, 4)
heights = st.integers(0, 4)
rationals = st.fractions(-3, 3, max_denominator=6)


@st.composite
def via_points(draw, dimensions=(2, 3)):
    """Q0, R0, r^2 as the method makes them: r is a norm that bounds both, often attained by a via point."""
    n = draw(st.sampled_from(dimensions))
    q0 = tuple(draw(st.lists(small, min_size=n - 1, max_size=n - 1))) + (draw(heights),)
    r0 = draw(
        st.one_of(
            st.just(q0),
            st.just(tuple(-c for c in q0)),
            st.just((0,) * n),
            st.just(tuple(2 * c for c in q0)),
            st.tuples(*[small] * (n - 1), heights),
        )
    )
    r2 = max(sum(c * c for c in q0), sum(c * c for c in r0)) + draw(st.sampled_from([0, 0, 1, F(5, 2), 7]))
    assume(r2 > 0)
    return q0, r0, r2


@st.composite
def convex_problems(draw):
    """(objective, forms <= 0): sums of squares of linear polynomials plus linear ones, in up to three variables."""
    n = draw(st.integers(1, 3))
    ring = Ring.of(tuple("xyz"[:n]))
    numbers = st.integers(-3, 3)

    def linear() -> Poly:
        total = ring.constant(draw(numbers))
        for i in range(n):
            total = total + draw(numbers) * ring.gen(i)
        return total

    def convex(squares: int) -> Poly:
        total = linear() - draw(st.integers(0, 6))
        for _ in range(squares):
            part = linear()
            total = total + part * part
        return total

    objective = convex(draw(st.integers(0, 2)))
    forms = [convex(draw(st.integers(0, 2))) for _ in range(draw(st.integers(1, 3)))]
    if draw(st.booleans()):
        forms += [ring.gen(i) - 3 for i in range(n)] + [-ring.gen(i) - 3 for i in range(n)]
    assume(not objective.is_constant)
    return objective, forms


def _check(found: Optimum) -> None:
    verdict = verify(found.certificate)
    assert verdict.accepted, verdict


@settings(max_examples=16)
@given(via_points(), st.booleans(), st.sampled_from([cubic, quadratic]), st.data())
def test_planning_optima_are_proved_and_not_beaten(points, hemisphere, family, data) -> None:
    q0, r0, r2 = points
    objective, forms, _ = family(q0, r0, r2, hemisphere=hemisphere)
    found = minimize(objective, at_most_zero(forms))
    _check(found)
    if family is cubic and not hemisphere:
        assert found.status is OptimumStatus.OPTIMAL  # the existence theorem: Q1 = Q0, Q2 = R0
        assert found.value <= objective.evaluate([*q0, *r0])
    if found.value is None:
        return
    assert found.unique
    size = objective.ring.size
    for _ in range(4):
        point = data.draw(st.lists(rationals, min_size=size, max_size=size))
        for step in (F(1), F(1, 4), F(1, 32)):
            near = [F(float(v)).limit_denominator(1000) + step * p for v, p in zip(found.point.values(), point)]
            if all(g.evaluate(near) <= 0 for g in forms):
                assert objective.evaluate(near) >= found.value


@given(convex_problems(), st.data())
def test_random_problems_agree_with_a_numerical_solver(problem, data) -> None:
    objective, forms = problem
    try:
        found = minimize(objective, conj(atom(g, Relation.LE) for g in forms))
    except HighDegree:
        return
    except Unable as reason:
        assert "direction of descent" in str(reason)  # unbounded along a parabola: said, not guessed
        return
    _check(found)
    status, value = _numerically(objective, forms)
    if found.status is OptimumStatus.OPTIMAL and status == "Solved":
        assert abs(value - float(found.value)) <= 1e-4 * (1 + abs(value))
    if status == "PrimalInfeasible":
        assert found.status is OptimumStatus.INFEASIBLE
    if status == "DualInfeasible":
        assert found.status is not OptimumStatus.OPTIMAL
    size = objective.ring.size
    for _ in range(5):
        point = data.draw(st.lists(rationals, min_size=size, max_size=size))
        if all(g.evaluate(point) <= 0 for g in forms):
            assert found.status is not OptimumStatus.INFEASIBLE
            assert found.value is None or objective.evaluate(point) >= found.value


@settings(max_examples=10)
@given(via_points((2,)), st.sampled_from([(3, 4, 5), (5, 12, 13), (-8, 15, 17)]))
def test_rotation_into_space_keeps_the_optimum(points, triple) -> None:
    q0, r0, r2 = points
    a, b, c = triple
    plane = minimize(*_problem(cubic(q0, r0, r2)))
    lifted = [(p[0], F(p[1] * a, c), F(p[1] * b, c)) for p in (q0, r0)]
    parts = cubic(*lifted, r2)
    space = minimize(*_problem(parts))
    assert space.value == plane.value * parts[2] ** 2
    assert space.point["a0"] == plane.point["a0"] and space.point["a2"] * a == space.point["a1"] * b


@settings(max_examples=8)
@given(via_points(), st.sampled_from([2, 3, F(1, 2)]))
def test_scaling_and_exchange(points, factor) -> None:
    q0, r0, r2 = points
    first = minimize(*_problem(cubic(q0, r0, r2)))
    parts = cubic([c * factor for c in q0], [c * factor for c in r0], r2 * factor * factor)
    second = minimize(*_problem(parts))
    assert second.value == first.value * factor * factor * parts[2] ** 2
    reversed_path = minimize(*_problem(cubic(r0, q0, r2)))
    assert reversed_path.value == first.value
    assert reversed_path.point["a0"] == first.point["b0"] and reversed_path.point["b1"] == first.point["a1"]


def _problem(parts):
    return parts[0], at_most_zero(parts[1])


def _numerically(objective: Poly, forms: list[Poly]) -> tuple[str, float]:
    """Status and value from a conic solver: x^T H x/2 + b.x + c <= 0 as |(Lx, (1+2bx+2c)/2)| <= (1-2bx-2c)/2."""
    clarabel = pytest.importorskip("clarabel")
    sparse = pytest.importorskip("scipy.sparse")
    hessian, gradient, constant = _floats(objective)
    rows, right, cones = [], [], []
    for form in forms:
        h, b, c = _floats(form)
        values, vectors = np.linalg.eigh(h)
        kept = values > 1e-12
        if not kept.any():
            rows.append(b[None, :])
            right.append([-c])
            cones.append(clarabel.NonnegativeConeT(1))
            continue
        root = (vectors[:, kept] * np.sqrt(values[kept])).T
        rows.append(np.vstack([b[None, :], -root, -b[None, :]]))
        right.append(np.concatenate([[(1 - 2 * c) / 2], np.zeros(len(root)), [(1 + 2 * c) / 2]]))
        cones.append(clarabel.SecondOrderConeT(len(root) + 2))
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    solver = clarabel.DefaultSolver(
        sparse.csc_matrix(np.triu(hessian)),
        gradient,
        sparse.csc_matrix(np.vstack(rows)),
        np.concatenate(right),
        cones,
        settings,
    )
    solution = solver.solve()
    return str(solution.status), solution.obj_val + constant


def _floats(p: Poly):
    n = p.ring.size
    hessian, gradient, constant = np.zeros((n, n)), np.zeros(n), 0.0
    for exponents, coefficient in p.terms():
        places = [i for i, e in enumerate(exponents) for _ in range(e)]
        if not places:
            constant = float(coefficient)
        elif len(places) == 1:
            gradient[places[0]] = coefficient
        else:
            hessian[places[0], places[1]] += coefficient
            hessian[places[1], places[0]] += coefficient
    return hessian, gradient, constant


METHODS = tuple({attempt.method: replace(attempt, work=2_000) for attempt in STRATEGY}.values())
SHAPES = (SMALL[0], SMALL[1], SMALL[3], Shape(0, 2, 2, 4), Shape(1, 2, 1, 3))
SEEDS = range(24)


def outcome(attempt: Attempt, problem: Block) -> Outcome | None:
    """What the method makes of the problem, None where it does not take it."""
    method = attempt.load()
    if method.suits(problem, Options()) is None:
        return None
    try:
        return method.run(problem, Context(Options(), Budget(work=attempt.work), RunLog()))
    except Unable:
        return None


def problems(seed: int) -> tuple[Block, Block] | None:
    """A block over a body in negation normal form, and over the negation of the negated body."""
    plain = nnf(rename_apart(random_formula(random.Random(seed), SHAPES[seed % len(SHAPES)])))
    problem = Block.of(plain)
    if problem is None or not problem.is_flat:
        return None
    body = nnf(problem.body, negate=True)
    return None if isinstance(body, Constant) else (problem, replace(problem, body=Not(body)))


def value(formula: Formula, seed: int, question: Formula) -> bool:
    point = random_point(random.Random(seed), question)
    return formula.value if isinstance(formula, Constant) else holds_at(formula, point)


@pytest.mark.parametrize("attempt", METHODS, ids=lambda attempt: attempt.method)
def test_a_negated_body_has_the_answer_of_its_normal_form(attempt: Attempt) -> None:
    for seed in SEEDS:
        both = problems(seed)
        if both is None:
            continue
        plain, other = (outcome(attempt, problem) for problem in both)
        if plain is None or other is None:
            continue
        if plain.formula.is_quantifier_free and other.formula.is_quantifier_free:
            for point in range(8):
                asked = both[0].formula
                assert value(plain.formula, point, asked) == value(other.formula, point, asked), seed


THREE = Ring.of(("x", "y", "z", "v"))
TWO = Ring.of(("x", "y", "v"))


@st.composite
def strict_problems_in_the_plane(draw: st.DrawFn, *, huge: bool = False, bent: bool = True) -> tuple[Poly, Formula]:
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
    enough(at_least, of, strict_problems_in_the_plane())(lambda problem: tried(problem, "cad"))()


@settings(max_examples=40)
@given(strict_problems_in_the_plane(huge=True, bent=False))
def test_linear_problems_with_huge_numbers_are_all_decided(problem: tuple[Poly, Formula]) -> None:
    agrees(*problem, method="vs")


def moved(poly: Poly, factors: list[int], offsets: list[int]) -> Poly:
    """poly at the points factor_i * x_i - offset_i."""
    return poly.compose({i: factors[i] * poly.ring.gen(i) - offsets[i] for i in range(poly.ring.size)})


FAR = st.lists(st.sampled_from((0, 1, 10**6, 10**20)), min_size=4, max_size=4)
FINE = st.lists(st.sampled_from((1, 1, 10**10, 10**25)), min_size=4, max_size=4)


@pytest.mark.deep
@enough(64, 80, strict_problems_in_the_plane(), FINE, FAR)
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
@given(strict_problems_in_the_plane())
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
    if isinstance(found, Least):
        assert found.weights and all(w > 0 for w in found.weights.values())
        assert not any(sum(w * rows[i][k] for i, w in found.weights.items()) for k in range(size))
    else:
        assert isinstance(found, Nowhere)
        assert all(sum(a * d for a, d in zip(row, found.dual[:-1], strict=True)) < 0 for row in rows)
