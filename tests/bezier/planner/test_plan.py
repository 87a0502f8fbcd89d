"""Plans: found, proved, with an arm, with a radius by rule."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from fractions import Fraction
from types import SimpleNamespace

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import qe
from bezier.check.recheck import restored
from bezier.cli import main
from bezier.curves.scalar import dot, is_zero, same, sign
from bezier.curves.workspace import Workspace, WorkspaceKind
from bezier.methods.control.terms import named_multipliers
from bezier.methods.cubic import formula as cubic
from bezier.methods.quadratic import formula as quadratic
from bezier.planner import radius_rule
from bezier.planner.arm import check_arm
from bezier.planner.outputs import facts
from bezier.planner.planning import make_plan
from bezier.plans import Clock, Outcome, Stated
from bezier.problem import PlanMethod, Problem, from_json, load_problem, read_problem, to_json
from qe.errors import BudgetExceeded, CertificateRejected, InputError, Unable
from qe.formula.evaluate import holds_at
from qe.proof.certificate import Certificate
from tests.bezier.made import points
from tests.tables import each

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
    assert restore(plan.problem, plan.certificate, Stated({}, None))[0].path.points == plan.path.points
    with pytest.raises(CertificateRejected):
        restore(problem, plan.certificate, Stated({}, None))


def test_the_region_of_formula_8_is_printed_as_the_readme_shows_it(root):
    printed = re.search(r"as it is printed: `(.*?)`", (root / "README.md").read_text(encoding="utf-8"), re.DOTALL)
    plan = make_plan(load_problem(root / "examples" / "three_balls.toml"))
    assert " ".join(printed[1].split()) == str(plan.answer.formula)


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
    monkeypatch.setattr(planning, "method_of", lambda choice: SimpleNamespace(begin=out_of_time, finish=None))
    with pytest.raises(BudgetExceeded, match="time limit reached; known so far: region: empty"):
        make_plan(plain, Clock(limit=5))
    with pytest.raises(Unable) as found:
        make_plan(plain, Clock())
    assert not isinstance(found.value, BudgetExceeded)


EXACT_POINT = st.tuples(COORDINATE, COORDINATE, COORDINATE).filter(any)


ONE_FARTHEST = """
method = "{}"
start = [-4, 1, 0]
via = [[-2, 3, 1], [2, 4, 1]]
goal = [4, 1, 0]
"""


BOTH = """
method = "{}"
start = [-2, 0, 1]
via = [[-1, 3, 3], [1, 3, 3]]
goal = [2, 0, 1]
"""


def test_the_farthest_via_point_stops_every_path_of_seven():
    """The paper's Figure 2: the radius rule itself makes the best path stop, and the plan said nothing."""
    plan = make_plan(read_problem(ONE_FARTHEST.format("cubic")))
    assert plan.outcome is Outcome.SOLVED and same(plan.path.points["Q2"], plan.problem.via[1])
    rule = plan.radius_rule
    assert dict(rule.forced) == {"R0": "Q2"} and rule.larger == 5
    assert any("forces Q2 = R0 (proved)" in r and "radius = 5" in r for r in plan.remarks)
    wider = replace(plan.problem, workspace=Workspace(plan.problem.workspace.kind, rule.larger**2))
    better = make_plan(wider)
    assert better.radius_rule is None and better.certified and not any(slow.stops for slow in better.slowest.values())


def test_eight_has_no_solution_when_both_via_points_are_farthest(tmp_path, capsys):
    file = tmp_path / "p.toml"
    file.write_text(BOTH.format("quadratic"))
    assert main(["plan", str(file), "--out", str(tmp_path / "out"), "--no-plots"]) == 3
    out = capsys.readouterr().out
    assert "this forces Q1 = Q0 and Q1 = R0 (proved), so formula (8) has no solution; with radius = 5" in out
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["radius_rule"]["forced"] == ["Q1 = Q0", "Q1 = R0"]
    assert summary["radius_rule"]["larger_radius"] == "5" and "radius = 5" in summary["reason"]
    assert all(qe.decide(text) for text in summary["radius_rule"]["proved"])
    assert "with radius = 5" in (tmp_path / "out" / "report.html").read_text()
    file.write_text(BOTH.format("quadratic") + "radius = 5\n")
    assert main(["plan", str(file), "--out", str(tmp_path / "out"), "--no-plots"]) == 0
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert "radius_rule" not in summary and summary["certified"] and summary["heights"]["holds"] in (True, False)


def test_no_join_speed_is_possible_at_a_via_point_on_the_sphere():
    plan = make_plan(read_problem(BOTH.format("cubic") + 'join_speed = "1/2"\n'))
    assert plan.outcome is Outcome.INFEASIBLE and not plan.radius_rule.solvable
    assert dict(plan.radius_rule.forced) == {"Q0": "Q1", "R0": "Q2"}
    larger = plan.radius_rule.larger
    assert larger is not None and radius_rule.helps(plan.problem, larger)
    wider = replace(plan.problem, workspace=Workspace(plan.problem.workspace.kind, larger**2))
    assert make_plan(wider).outcome is Outcome.SOLVED


def test_a_radius_that_does_not_help_is_not_named():
    """Contradictory half-spaces: no radius makes a path."""
    text = BOTH.format("cubic") + '[[half_space]]\nnormal = [0, 0, 1]\noffset = 40\npoints = ["Q1"]\n'
    rule = make_plan(read_problem(text)).radius_rule
    assert rule.larger is None and "no radius up to 3 r" in rule.in_words()


@settings(max_examples=4, deadline=None)
@given(
    EXACT_POINT,
    EXACT_POINT,
    st.sampled_from([PlanMethod.QUADRATIC, PlanMethod.CUBIC]),
    st.sampled_from(["1", "1/2", "3"]),
)
def test_what_is_forced_holds_at_the_optimum(q0, r0, method, ratio):
    """With r the farthest via point: every solution has the forced points, and the named radius frees them."""
    assume(q0 != r0)
    square = max(dot(q0, q0), dot(r0, r0))
    problem = replace(problem_of(q0, r0, square, method=method))
    if method is PlanMethod.CUBIC:
        problem = replace(problem, ratio=Fraction(ratio))
    rule = radius_rule.radius_rule(problem, solvable=True)
    assert rule is not None and set(rule.forced) == {n for n, v in zip(("Q0", "R0"), (q0, r0)) if dot(v, v) == square}
    system = (cubic if method is PlanMethod.CUBIC else quadratic).system(problem)
    found = qe.minimize(system.objective().polynomial, system.in_free_points().formula)
    if found.is_optimal:
        for via, free in rule.forced.items():
            at = dict(zip(("Q0", "R0"), (q0, r0), strict=True))[via]
            names = (f"{free.lower()}{axis}" for axis in "xyz")
            assert all(is_zero(found.point[name] - v) for name, v in zip(names, at, strict=True))
    assert rule.larger is not None and rule.larger**2 > square and radius_rule.helps(problem, rule.larger)


def test_nothing_is_forced_inside():
    problem = problem_of((Fraction(1),) * 3, (Fraction(2), Fraction(0), Fraction(1)), 6)
    assert radius_rule.radius_rule(problem, solvable=True) is None
    asked = radius_rule.sentence(problem, "Q0", "Q1")
    assert qe.decide(asked.formula) is False, "the sentence is not true by itself"
    assert qe.decide(radius_rule.sentence(problem_of(problem.via[0], problem.via[1], 3), "Q0", "Q1").formula) is True


@each(("27.1", "32.5", "30"), ("4.58", "5.4", "5"), ("0.98", "0.99", "0.98"))
def test_short_numbers(low, high, short):
    assert radius_rule._short_decimal(Fraction(low), Fraction(high)) == Fraction(short)


TEXT = """method = "cubic"
workspace = "reachable"
arm = "ev3"
start = [-150, 60, 40]
via = [[-60, 200, 240], [60, 200, 240]]
goal = [150, 60, 300]
"""


def test_the_ball_that_holds_what_is_reached() -> None:
    """sqrt(a^2 + c^2) + R = 434.4 mm for the EV3."""
    found = check_arm(read_problem(TEXT))
    assert found.workspace.radius_squared == 435**2 and not found.radius_is_auto
    assert check_arm(read_problem(TEXT + "radius = 350\n")).workspace.radius_squared == 350**2
    again = from_json(to_json(found), "stored")
    assert (again.workspace, again.arm) == (found.workspace, found.arm)


def test_points_are_reached() -> None:
    """The hemisphere of the paper ends at 258 mm; above the arm there is more, and below its base less."""
    for point in ("[60, 200, 1000]", "[420, 200, 240]"):
        with pytest.raises(InputError, match=r"via\[1\]: a point that EV3, last link 120 mm reaches"):
            check_arm(read_problem(TEXT.replace("[60, 200, 240]", point)))


@each(
    (TEXT.replace('arm = "ev3"\n', ""), "an arm with the true reachable set"),
    (TEXT.replace('"ev3"', '"six-joints"'), "three joints"),
    (TEXT.replace('"ev3"', '"shoulder-3r"'), "reaches expected"),
    (TEXT.replace('"ev3"', '"planar-3r"'), "reaches expected"),
    (TEXT.replace('"ev3"', '"nobody"'), "arm: expected a file"),
)
def test_what_does_not_fit(text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        check_arm(read_problem(text))
    assert message in str(caught.value) and "\n" not in str(caught.value)


@pytest.mark.deep
def test_a_plan_beyond_the_hemisphere() -> None:
    found = make_plan(read_problem(TEXT))
    assert found.outcome is Outcome.SOLVED
    assert found.joints is not None and found.joints.path.is_reachable
