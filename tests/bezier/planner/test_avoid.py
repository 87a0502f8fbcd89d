"""Planning around obstacles: acceptance, alternatives and their record, conditions above obstacles, pictures, pages."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from bezier.input.toml_table import Table
from bezier.obstacles.reader import read_obstacles
from bezier.pictures import charts
from bezier.pictures.obstacles import obstacle_pictures
from bezier.planner import avoid
from bezier.planner.outputs import summary
from bezier.planner.planning import make_plan
from bezier.planner.table import method_of
from bezier.planner.words import lines
from bezier.plans import Clock, Outcome
from bezier.problem import PlanMethod, read_problem
from bezier.report.page import render
from qe.errors import BudgetExceeded, CertificateRejected, InputError
from tests.bezier.made import CRATE_TEXT as CRATE
from tests.bezier.made import obstacle_text
from tests.tables import each

START = """
method = "quadratic"
start = [-4, 2, 1]
goal = [4, 2, 1]
radius = 6
"""
BALLOON = obstacle_text("ball", "balloon", centre=[0, 2, 2], radius=1)
WALL = obstacle_text("box", "wall", low=["-1/2", -20, -20], high=["1/2", 20, 20])


def planned(*parts: str):
    return make_plan(read_problem("".join(parts)))


@pytest.fixture(scope="module")
def over_the_crate():
    return planned(START, CRATE)


def test_a_path_over_the_obstacle_is_accepted_though_its_polygon_is_no_proof(over_the_crate):
    plan = over_the_crate
    assert plan.outcome is Outcome.SOLVED and plan.certified
    assert [a.what for a in plan.attempts] == ["as given"]
    assert all(f.is_clear and f.distance.low > Fraction(1, 5) for f in plan.findings)
    assert any("the control polygon of P does not show that it stays clear of crate" in r for r in plan.remarks)
    assert plan.checks["clearance"].accepted
    labels = [member.label for member in plan.certificate.payload]
    assert "P clear of crate" in labels and "optimum" in labels


def test_what_is_said_about_it(over_the_crate, tmp_path):
    words = "\n".join(lines(over_the_crate))
    assert "P: clear of crate for all t (Bernstein coefficients after subdivision)" in words and "length 8.66" in words
    told = summary(over_the_crate, [], 1.0)
    assert told["status"] == "solved" and len(told["clearance"]) == 3 and told["attempts"][0]["outcome"] == "solved"
    page = render(over_the_crate, method_of(over_the_crate.problem.method), None)
    assert "<h2>Obstacles</h2>" in page and "clear for all t" in page and "Length, curvature and motion" in page


@each("cubic", "single")
def test_the_other_methods_get_over_it_too(method):
    plan = planned(START.replace("quadratic", method), CRATE)
    assert plan.outcome is Outcome.SOLVED and plan.certified and plan.problem.method.value == method
    assert all(finding.is_clear for finding in plan.findings)


def test_a_blocked_path_is_raised_and_every_attempt_is_listed():
    plan = planned(START, 'via = [[-1, 2, "5/2"], [1, 2, "5/2"]]\n', BALLOON)
    assert plan.outcome is Outcome.SOLVED and plan.certified
    tried = [(a.what, a.outcome) for a in plan.attempts]
    blocked, raised = Outcome.BLOCKED, "via points raised by"
    assert tried == [("as given", blocked), (f"{raised} 1/2", blocked), (f"{raised} 1", Outcome.SOLVED)]
    assert "enters balloon, first at t = 0.06698" in plan.attempts[0].detail
    assert "touches balloon, first at t = 1/2" in plan.attempts[1].detail
    assert plan.problem.via[0][2] == Fraction(7, 2)
    stated_attempts_are_read_with_care(plan)


def stated_attempts_are_read_with_care(plan):
    """The last attempt, which is the plan, is found again; the others are read, and have to lead to this plan."""
    told = avoid.json_entries(plan)["attempts"]
    assert "attempts" in plan.not_certified
    assert avoid.with_stated_attempts(plan, told).attempts == plan.attempts
    lied = [*told[:-1], {**told[-1], "detail": "far from everything"}]
    assert avoid.with_stated_attempts(plan, lied).attempts == plan.attempts
    for wrong in (
        None,
        [],
        told[:-1],
        [*told, told[0]],
        [told[-1], *told],
        [*told[:-1], {**told[-1], "outcome": "blocked"}],
        [*told[:-1], {**told[-1], "outcome": "limits_not_kept"}],
        [{**told[0], "outcome": "unable"}, *told[1:]],
        [{**told[0], "more": "x"}, *told[1:]],
        [{"what": "as given"}, *told[1:]],
        [{**told[0], "detail": 3}, *told[1:]],
        ["as given", *told[1:]],
    ):
        with pytest.raises(CertificateRejected, match=r"summary\.json: attempts"):
            avoid.with_stated_attempts(plan, wrong)


def test_where_nothing_helps_the_path_is_blocked_and_all_methods_were_tried(tmp_path):
    plan = planned(START, "via = [[-1, 2, 3], [1, 2, 3]]\n", WALL)
    assert plan.outcome is Outcome.BLOCKED and not plan.certified and plan.path is not None
    assert {'method "cubic"', 'method "single"'} <= {a.what for a in plan.attempts}
    assert all(a.outcome is not Outcome.SOLVED for a in plan.attempts)
    words = "\n".join(lines(plan))
    assert "no path found: every path that was tried MEETS an obstacle" in words
    assert "tried: as given: Q: enters wall" in words
    assert "an obstacle is in the way" in render(plan, method_of(plan.problem.method), None)


def test_a_via_point_in_an_obstacle_is_one_line():
    with pytest.raises(
        InputError, match=r"via\[1\]: expected a point clear of all obstacles, found \(1/2, 2, 2\), which"
    ) as one:
        planned(START, 'via = [[-1, 2, 4], ["1/2", 2, 2]]\n', BALLOON)
    assert "\n" not in str(one.value) and "lies in balloon" in str(one.value)


def test_points_above_an_obstacle_are_conditions_of_the_method():
    beside = CRATE.replace("[-1, 1, 0]", "[-1, 4, 0]").replace("[1, 3, 2]", "[1, 5, 2]")
    free = planned(START, "via = [[-2, 2, 1], [2, 2, 1]]\n", beside, 'above = ["Q1"]\n')
    assert free.path.points["Q1"][2] == Fraction(21, 10)
    assert "Q1.above crate" in free.active


def test_another_method_takes_over_what_it_knows():
    problem = read_problem(START + CRATE.replace("margin", 'above = ["Q1"]\nmargin'))
    cubic = avoid.changed(problem, PlanMethod.CUBIC, Fraction(1))
    assert cubic.method is PlanMethod.CUBIC and cubic.above[0].points == ("Q1", "Q2")
    assert cubic.via[0][2] == problem.via[0][2] + 1
    assert avoid.changed(problem, PlanMethod.QUADRATIC, Fraction(10)) is None, "beyond the workspace"
    automatic = avoid.changed(replace(problem, radius_is_auto=True), PlanMethod.QUADRATIC, Fraction(10))
    assert automatic is not None and automatic.workspace.radius_squared > 100


def test_a_time_limit_ends_the_alternatives_with_what_is_known():
    with pytest.raises(BudgetExceeded, match="known so far"):
        make_plan(read_problem(START + "via = [[-1, 2, 3], [1, 2, 3]]\n" + WALL), Clock(limit=0.1))


KINDS = "".join(
    (
        obstacle_text("ball", centre=[1, 0, 0], radius=1),
        obstacle_text("box", low=[0, 0, 0], high=[1, 2, 3], margin=1),
        obstacle_text("cylinder", centre=[0, 0], radius=1, bottom=0),
        obstacle_text("half_space", normal=[0, 0, 1], offset=1),
        obstacle_text("half_space", "far", normal=[0, 0, 1], offset=99),
        obstacle_text("formula", formula="x*y > 1 and z < 0"),
    )
)


def test_every_kind_is_drawn_where_it_is():
    obstacles = read_obstacles(Table.parse(KINDS, "f"))
    drawn = {picture.name: picture for picture in obstacle_pictures(obstacles, 5.0)}
    assert list(drawn) == ["ball 1", "box 2", "cylinder 3", "half_space 4", "formula 6"]
    for obstacle in obstacles:
        if obstacle.name in drawn:
            inner = drawn[obstacle.name].vertices * (1 - 1e-9)
            centre = drawn[obstacle.name].vertices.mean(axis=0)
            shrunk = inner + 1e-6 * (centre - inner)
            assert all(obstacle.contains(tuple(map(Fraction, p))) for p in shrunk[:40].tolist())
    box = drawn["box 2"]
    assert np.allclose([box.vertices.min(), box.vertices.max()], [-1, 4]) and box.outline(0, 2) is not None
    assert drawn["formula 6"].faces is None and drawn["formula 6"].outline(0, 1) is None


def test_the_chart_of_clearances(over_the_crate, tmp_path):
    pictures = obstacle_pictures(over_the_crate.problem.obstacles, 6.0)
    panels = charts.clearance(over_the_crate.findings, pictures)
    drawn = charts.saved(panels, tmp_path / "clearance.png")
    assert drawn and all(text.startswith("<svg") and words for text, words in drawn)
    assert (tmp_path / "clearance.png").stat().st_size > 5000
