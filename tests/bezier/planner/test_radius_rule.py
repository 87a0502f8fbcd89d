"""A via point at distance r: what formulas (7) and (8) then force, proved, and the larger radius that is named."""

import json
from dataclasses import replace
from fractions import Fraction

from hypothesis import assume, given, settings
from hypothesis import strategies as st

import qe
from bezier.cli import main
from bezier.curves.scalar import dot, is_zero, same
from bezier.curves.workspace import Workspace
from bezier.planner import radius_rule
from bezier.planner.planning import make_plan
from bezier.plans import Outcome
from bezier.problem import PlanMethod, read_problem
from tests.bezier.planner.test_plan import problem_of
from tests.tables import each

COORDINATE = st.integers(-3, 3).map(Fraction)
POINT = st.tuples(COORDINATE, COORDINATE, COORDINATE).filter(any)
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
@given(POINT, POINT, st.sampled_from([PlanMethod.QUADRATIC, PlanMethod.CUBIC]), st.sampled_from(["1", "1/2", "3"]))
def test_what_is_forced_holds_at_the_optimum(q0, r0, method, ratio):
    """With r the farthest via point: every solution has the forced points, and the named radius frees them."""
    assume(q0 != r0)
    square = max(dot(q0, q0), dot(r0, r0))
    problem = replace(problem_of(q0, r0, square, method=method))
    if method is PlanMethod.CUBIC:
        problem = replace(problem, ratio=Fraction(ratio))
    rule = radius_rule.radius_rule(problem, solvable=True)
    assert rule is not None and set(rule.forced) == {n for n, v in zip(("Q0", "R0"), (q0, r0)) if dot(v, v) == square}
    system = radius_rule._system(problem)
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
