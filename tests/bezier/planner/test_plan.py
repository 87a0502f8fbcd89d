"""Planning in process: the engine's answers against the three-ball condition and against exact evaluation."""

import json
from dataclasses import replace
from fractions import Fraction
from types import SimpleNamespace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from bezier.check.recheck import restored
from bezier.curves.scalar import dot, sign
from bezier.curves.workspace import Workspace, WorkspaceKind
from bezier.methods.control.terms import named_multipliers
from bezier.methods.quadratic import formula as quadratic
from bezier.planner.outputs import facts
from bezier.planner.planning import make_plan
from bezier.plans import Clock, Outcome, Stated
from bezier.problem import PlanMethod, Problem, load_problem
from qe.errors import BudgetExceeded, CertificateRejected, Unable
from qe.formula.evaluate import holds_at
from qe.proof.certificate import Certificate
from tests.bezier.numbers import points

COORDINATE = st.integers(-3, 3).map(Fraction)
POINT = points(3, COORDINATE)


def problem_of(q0, r0, r2, kind=WorkspaceKind.BALL, method=PlanMethod.QUADRATIC):
    start, goal = (Fraction(0), Fraction(0), Fraction(1)), (Fraction(1), Fraction(0), Fraction(1))
    return Problem(method, Workspace(kind, Fraction(r2)), start, (q0, r0), goal, False)


@settings(max_examples=12)
@given(POINT, POINT, st.integers(1, 24), st.lists(points(), min_size=8, max_size=8), st.sampled_from(WorkspaceKind))
def test_the_answer_is_the_conditions(q0, r0, r2, candidates, kind):
    problem = problem_of(q0, r0, r2, kind)
    answer = qe.eliminate(quadratic.system(problem).statement().formula).formula
    conditions = quadratic.as_conditions_on_q1(quadratic.system(problem))
    for q1 in [*candidates, q0, r0]:
        expected = all(condition.margin(q1) >= 0 for condition in conditions)
        assert holds_at(answer, dict(zip(quadratic.FREE, q1, strict=True))) == expected


@settings(max_examples=2)
@given(POINT, POINT, st.integers(0, 6))
def test_plans_exist_exactly_when_the_balls_meet(q0, r0, more):
    least = max(dot(q0, q0), dot(r0, r0), Fraction(2))
    problem = problem_of(q0, r0, least + more)
    plan = make_plan(problem)
    assert plan.certified
    assert (plan.outcome is Outcome.SOLVED) == quadratic.three_balls(problem).meet
    if plan.path is None:
        assert not plan.optimum.is_optimal and plan.region.is_empty
        return
    assert sign(plan.objective - plan.system.objective_at(plan.path.points)) == 0
    assert plan.path.is_inside and plan.path.smoothness >= 1
    for sample in plan.region.sample_points():
        other = plan.system.points([tuple(sample[name] for name in quadratic.FREE)])
        assert float(plan.system.objective_at(other)) >= float(plan.optimum.value) - 1e-9
    labels = {label for label, _ in named_multipliers(plan.system, plan.optimum)}
    assert labels <= set(plan.active) | {"another condition"}


def test_a_half_space_for_a_quadratic_plan(root):
    from bezier.curves.workspace import HalfSpace
    from bezier.methods.quadratic.plan import restore
    from bezier.problem import PointCondition

    problem = load_problem(root / "examples" / "three_balls.toml")
    up = HalfSpace((Fraction(0), Fraction(0), Fraction(1)), Fraction(-13, 4), "half_space[0]")
    plan = make_plan(replace(problem, half_spaces=(PointCondition(up, ("Q1",)),)))
    assert plan.certified and plan.active == ("Q1.half_space[0]",) and plan.path.points["Q1"][2] == Fraction(13, 4)
    assert restore(plan.problem, plan.certificate).path.points == plan.path.points
    with pytest.raises(CertificateRejected):
        restore(problem, plan.certificate)


def found_again(plan):
    """What ``bezier check`` would say of the plan, from its certificates as text."""
    stored = Certificate.from_json(plan.certificate.to_json())
    stated = Stated(json.loads(json.dumps(facts(plan))), None)
    return facts(replace(restored(plan.problem, stored, stated)[0], checks=plan.checks))


@pytest.mark.deep
@settings(max_examples=150)
@given(points(), points(), st.integers(0, 9), st.sampled_from(WorkspaceKind), st.booleans())
def test_many_plans(q0, r0, more, kind, tight):
    if kind is WorkspaceKind.HEMISPHERE:
        q0, r0 = ((*p[:2], abs(p[2])) for p in (q0, r0))
    least = max(dot(q0, q0), dot(r0, r0), Fraction(2))
    if tight:  # the balls meet in one point at most
        least = max(least, quadratic.three_balls(problem_of(q0, r0, least)).needed_squared)
    problem = problem_of(q0, r0, least if tight else least + more, kind)
    plan = make_plan(problem)
    assert plan.certified
    assert found_again(plan) == facts(plan)
    if kind is WorkspaceKind.BALL:
        assert (plan.outcome is Outcome.SOLVED) == quadratic.three_balls(problem).meet


def test_symbolic_points_leave_no_quantifier():
    answer = qe.eliminate(quadratic.SHAPE.symbolic().formula).formula
    numbers = dict(zip([f"q0{a}" for a in "xyz"] + [f"r0{a}" for a in "xyz"], (-1, 3, 3, 1, 3, 3), strict=True))
    for r, q1, expected in ((6, (0, 3, 3), True), (6, (0, 0, 0), False), (3, (0, 3, 3), False), (-6, (0, 3, 3), False)):
        place = {**numbers, "r": r, **dict(zip(quadratic.FREE, q1, strict=True))}
        assert holds_at(answer, {name: Fraction(value) for name, value in place.items()}) is expected


def test_kkt_of_the_irrational_example(root):
    plan = make_plan(load_problem(root / "examples" / "tight_radius.toml"))
    multipliers = dict(named_multipliers(plan.system, plan.optimum))
    q1 = plan.path.points["Q1"]
    assert set(multipliers) == {"P1", "R1"} == set(plan.active)
    centres = {item.name: item.centre for item in quadratic.as_conditions_on_q1(plan.system)}
    q0, r0 = plan.problem.via
    for i in range(3):
        gradient = 2 * (q1[i] - q0[i]) + 2 * (q1[i] - r0[i])
        pull = sum((m * 2 * (q1[i] - centres[label][i]) for label, m in multipliers.items()), Fraction(0))
        assert sign(gradient + pull) == 0


def test_the_corrected_region_lies_above_the_table():
    low, high = ((Fraction(x), Fraction(3), Fraction(1, 2)) for x in (-1, 1))
    plan = make_plan(problem_of(low, high, 20))
    assert plan.gap.can_leave and plan.region.bounds("q1z").lower < 0
    assert plan.gap.region.bounds("q1z").lower == 0


def test_the_hemisphere_gap_is_the_one_of_the_paper(root):
    plan = make_plan(load_problem(root / "examples" / "hemisphere_gap.toml"))
    assert plan.gap.can_leave and plan.gap.region is plan.region
    below = [name for name, point in plan.gap.example.items() if sign(point[2]) < 0]
    assert below and all(sign(plan.problem.workspace.ball.margin(p)) >= 0 for p in plan.gap.example.values())
    printed = qe.region(qe.eliminate(quadratic.printed(plan.problem).statement().formula).formula)
    paper = dict(zip(quadratic.FREE, (0, 1, 1), strict=True))
    assert printed.contains(paper) and not plan.region.contains(paper)


def test_the_clock_stops_at_its_limit():
    problem = problem_of((Fraction(1),) * 3, (Fraction(2),) * 3, 20)
    with pytest.raises(BudgetExceeded, match="known so far: nothing yet"):
        make_plan(problem, Clock(limit=1e-9))


def test_what_is_known_when_the_limit_comes():
    clock = Clock(limit=60)
    clock.note = lambda name, value: setattr(clock, "limit", 1e-9)  # the limit passes right after the answer
    with pytest.raises(BudgetExceeded, match=r"known so far: quantifier-free answer: .*q1x"):
        make_plan(problem_of((Fraction(1),) * 3, (Fraction(2),) * 3, 20), clock)


def test_steps_are_told_and_timed(root):
    told, noted = [], {}
    clock = Clock(listener=lambda event: told.append(event.phase), note=noted.__setitem__)
    plan = make_plan(load_problem(root / "examples" / "three_balls.toml"), clock)
    assert told == list(plan.seconds) and "q1x" in noted["quantifier-free answer"]


def test_an_engine_that_stops_at_the_limit_says_what_was_known(monkeypatch):
    """However the end of the time is met: by the clock, or as an answer that the engine could not reach in it."""
    from bezier.planner import planning

    def out_of_time(problem, clock):
        clock.learn("region", "empty")
        clock.start -= 10
        raise Unable("time limit reached")

    plain = problem_of((Fraction(1),) * 3, (Fraction(2),) * 3, 20)
    monkeypatch.setattr(planning, "method_of", lambda choice: SimpleNamespace(make=out_of_time))
    with pytest.raises(BudgetExceeded, match="time limit reached; known so far: region: empty"):
        make_plan(plain, Clock(limit=5))
    with pytest.raises(Unable) as found:
        make_plan(plain, Clock())
    assert not isinstance(found.value, BudgetExceeded)
