"""Planning with Method 1: the examples, what the table [single] may say, and folders that must be rejected."""

import json
import pickle
from dataclasses import replace
from fractions import Fraction

import pytest

import qe
from bezier.curves.scalar import dot
from bezier.methods.single import method as single
from bezier.methods.single.closed import NoCurve, close
from bezier.methods.single.cuts import Model
from bezier.methods.single.plan import CLOSED, PIECEWISE_DEGREE, _least_sums, task_of
from bezier.methods.single.program import choose, curve, linear_program, lower_of, objective, rows_of, solve
from bezier.methods.single.restore import certified_curve
from bezier.planner.outputs import data_texts, facts, path_json, write_texts
from bezier.planner.planning import make_plan
from bezier.plans import Outcome, Stated
from bezier.problem import from_json, load_problem, read_problem, to_json
from qe.errors import CertificateRejected, InputError
from qe.proof.certificate import Certificate
from tests.tables import each

F = Fraction
EXAMPLES = ("single", "single_leaves", "single_dip")


@pytest.fixture(scope="module")
def plans(root):
    """The plans of the examples, with their problems."""
    return {name: make_plan(load_problem(root / "examples" / f"{name}.toml")) for name in EXAMPLES}


def stated_by(plan):
    """What the files of a plan state."""
    path = None if plan.path is None else path_json(plan, plan.path)
    return Stated(json.loads(json.dumps(facts(plan))), path)


@pytest.mark.parametrize("name", EXAMPLES)
def test_everything_is_certified_and_found_again(plans, name):
    plan = plans[name]
    assert plan.certified and all(verdict.accepted for verdict in plan.checks.values())
    stored = Certificate.from_json(plan.certificate.to_json())
    again, _ = single.restore(plan.problem, stored, stated_by(plan))
    assert again.outcome is plan.outcome and again.certificate == plan.certificate
    assert again.printed == plan.printed and again.chosen == plan.chosen and again.above == plan.above
    if plan.path is not None:
        assert again.path.points == plan.path.points and again.objective == plan.objective
        assert set(plan.above) == {axis.name for axis in plan.task.raised}


def test_the_printed_curve_that_holds(plans):
    plan = plans["single"]
    assert plan.printed.holds and plan.closed is None and plan.objective == 5
    assert {dip.axis.name for dip in plan.printed.allowed} == {"y", "z"}
    assert all(plan.printed.lowest.point(dip.t) != plan.printed.curve.point(dip.t) for dip in plan.printed.allowed)


def test_the_printed_curve_that_leaves(plans):
    plan = plans["single_leaves"]
    assert [proof.condition.name for proof in plan.printed.leaving] == ["ball"] and not plan.printed.dips
    assert plan.objective == plan.closed.bound == F(2027, 160) and plan.gap == 0
    words = "\n".join(single.summary_lines(plan))
    assert "LEAVES the ball" in words and "least possible sum, 12.66875" in words


def test_the_printed_curve_that_dips(plans):
    plan = plans["single_dip"]
    assert isinstance(plan.closed, NoCurve) and plan.outcome is Outcome.INFEASIBLE
    (dip,) = plan.printed.dips
    assert F(3, 5) < dip.t < F(4, 5) and dip.value < F(5, 2)
    assert "contradict each other" in single.reason(plan)


@pytest.mark.parametrize("name", EXAMPLES)
def test_the_problem_is_written_and_read_again(plans, name):
    problem = plans[name].problem
    again = from_json(json.loads(json.dumps(to_json(problem))), "again")
    assert again.single.task == problem.single.task and again.via == problem.via


def test_one_axis_and_a_small_degree_are_also_solved_by_elimination():
    """The goal and the end of the interval are on the sphere: the curve has to touch it there."""
    plan = make_plan(
        read_problem(
            'method = "single"\nstart = [0, 2, 0]\ngoal = [10, 0, 0]\nradius = 10\n'
            "[single]\ndegree = 4\na = 3\nb = 6\nheight_y = 8"
        )
    )
    assert plan.printed.leaving and plan.objective == plan.closed.bound == F(4589, 504)
    assert qe.decide(f"all v. v = {plan.objective} -> ({plan.attainable})")
    assert qe.decide(f"all v. ({plan.attainable}) -> v >= {plan.closed.bound}")
    (tangent,) = (cut for cut in Model.of(plan.task, plan.problem.workspace).tangents)
    assert tangent.t == F(3, 5) and dot(plan.path.curves["P"].point(tangent.t), (6, 8, 0)) == 100
    assert dot(plan.path.curves["P"].derivative(1, tangent.t), (6, 8, 0)) == 0


# --- the table [single] ------------------------------------------------------------------------------


def problem_text(
    via="via = [[4, 10, 1], [7, 10, 1]]", single="degree = 6", method="single", goal="[10, 5, 0]", radius="sqrt(155)"
):
    """A problem file."""
    table = f"[single]\n{single}\n" if single is not None else ""
    return f'method = "{method}"\nstart = [0, 0, 0]\n{via}\ngoal = {goal}\nradius = "sqrt(155)"\n{table}'


def test_the_via_points_say_the_interval_and_the_heights():
    task = task_of(read_problem(problem_text()))
    assert task.interval == (4, 7) and [axis.height for axis in task.axes] == [10, 1]
    stated = task_of(
        read_problem(problem_text(via="", single="a = 4\nb = 7\nheight_y = 10\nheight_z = '1'\np = 2\nq = 4"))
    )
    assert stated == task
    assert task_of(read_problem(problem_text(single=None))) == task


def test_via_points_on_the_way_ask_for_no_height():
    task = task_of(read_problem(problem_text(via="via = [[4, 2, 1], [7, '7/2', 1]]")))
    assert [axis.height for axis in task.axes] == [None, 1]


def test_without_a_degree_the_least_one_from_six_on_is_taken():
    narrow = "via = [['61/10', 10, 1], ['62/10', 10, 1]]"
    task = task_of(read_problem(problem_text(via=narrow, single=None)))
    assert task.degree == 13


@each(
    ({"single": "degree = 4\na = 4\nb = 7\nheight_y = 10"}, "via: expected no via points together with a, b and heigh"),
    (
        {"single": "degree = 2"},
        "single.degree: expected an interval, a degree and heights that fit together, found degree 2: no p",
    ),
    ({"single": "degree = 65"}, "single.degree: expected a whole number from 0 to 64, found 65"),
    ({"single": "degree = 6.5"}, "single.degree: expected a whole number"),
    ({"single": "degree = 6\np = 1"}, "single.p: expected 2, which follows from a and b, found 1"),
    ({"single": "order = 6"}, "single.order: expected one of the keys degree, a, b"),
    ({"single": "degree = 6", "method": "cubic"}, 'single: expected this table with method = "single" only'),
    ({"via": "via = [[4, 10, 1], [7, 9, 1]]"}, "via: expected two points with the same y above zero, or"),
    ({"via": "via = [[4, 10, 0], [7, 10, -1]]"}, "found z = 0 and -1"),
    ({"via": "", "single": "a = 4\nb = 7"}, "heights that fit together, found no positive height"),
    ({"via": "", "single": "a = 4\nheight_y = 10"}, "single.b: expected an integer"),
    (
        {"via": "", "single": "a = 4\nb = 7\nheight_y = -1"},
        "single.height_y: expected a number above zero, found -1",
    ),
    ({"via": "", "single": "a = 4\nb = 7\nheight_y = 1", "goal": "[0, 1, 0]"}, "goal: expected a goal beyond"),
)
def test_bad_tables_get_one_clear_line(change, message):
    with pytest.raises(InputError) as caught:
        read_problem(problem_text(**change), "p.toml")
    assert message in str(caught.value) and "\n" not in str(caught.value)


# --- folders that must be rejected -------------------------------------------------------------------


def members(plan):
    return [(member.label, member.certificate) for member in plan.certificate.payload]


@pytest.mark.parametrize("label", ["problem (4) for y", "problem (4) for z, another curve", CLOSED])
def test_a_missing_certificate_is_noticed(plans, label):
    plan = plans["single_leaves"]
    left = [(name, certificate) for name, certificate in members(plan) if name != label]
    assert len(left) == len(members(plan)) - 1
    with pytest.raises(CertificateRejected, match="no derivation by multipliers"):
        single.restore(plan.problem, Certificate.bundle(left), stated_by(plan))


@each("single", "single_leaves")
def test_certificates_of_another_problem_are_rejected(name, plans):
    other = plans["single_leaves" if name == "single" else "single"]
    with pytest.raises(CertificateRejected):
        single.restore(plans[name].problem, other.certificate, stated_by(plans[name]))


@pytest.mark.parametrize("label", ["problem (4) for y", CLOSED])
def test_a_linear_program_of_another_problem_is_rejected(plans, label):
    plan = plans["single_leaves"]
    task, workspace = plan.task, plan.problem.workspace
    higher = replace(task, axes=(replace(task.axes[0], height=F(3, 2)), task.axes[1]))
    chosen = choose(higher, higher.axes[0])
    other = {
        "problem (4) for y": chosen.outcome.certificate,
        CLOSED: close(task, replace(workspace, radius_squared=F(10))).certificate,
    }
    swapped = [(name, other[label] if name == label else member) for name, member in members(plan)]
    with pytest.raises(CertificateRejected, match="not the one of this problem"):
        single.restore(plan.problem, Certificate.bundle(swapped), stated_by(plan))


def with_points(plan, points):
    """What the files state, with other control points."""
    stated = stated_by(plan)
    written = {f"P{i}": [{"exact": str(c)} for c in point] for i, point in enumerate(points)}
    return Stated(stated.summary, {**stated.path, "points": written})


@each((1, 0, -1), (2, 1, 1), (3, 1, 30), (0, 2, 1), (6, 1, 1))
def test_an_altered_curve_is_rejected(point, axis, value, plans):
    plan = plans["single_leaves"]
    points = [list(p) for p in plan.path.curves["P"].points]
    points[point][axis] = F(value)
    with pytest.raises(CertificateRejected):
        certified_curve(plan.problem, plan.task, with_points(plan, points))


def test_curves_that_meet_the_equations_of_4_alone_are_rejected(plans):
    plan = plans["single"]
    task, of = plan.task, plan.task.axes[0]
    lower = tuple(low - 1 for low in lower_of(task, of))
    below = solve(linear_program("abcde", objective(task), rows_of(task, of), lower)).point
    bound = {"y": (of.start, *below, of.goal), "z": plan.chosen[1].values}
    for drawn, message in (
        (curve(task, bound), "do not satisfy"),
        (plan.printed.lowest, "below the height at t = 1/2"),
    ):
        with pytest.raises(CertificateRejected, match=message):
            certified_curve(plan.problem, task, with_points(plan, drawn.points))


@each(
    {"kind": "height", "axis": "y", "t": "1/10", "plane": []},  # before t_a nothing is asked of the height
    {"kind": "height", "axis": "x", "t": "1/2", "plane": []},
    {"kind": "ball", "axis": "", "t": "2", "plane": ["1", "1", "1"]},
    {"kind": "ball", "axis": "", "t": "1/2", "plane": ["1", "1"]},
    {"kind": "start", "axis": "", "t": "1/2", "plane": []},
    {"kind": "tangent", "axis": "", "t": "1/2", "plane": []},
    {"kind": "wish", "axis": "", "t": "1/2", "plane": []},
    {"kind": "height", "axis": "y", "t": "1/2"},
    {"kind": ["height"], "axis": {}, "t": "1/2", "plane": []},
    "height",
)
def test_a_cut_that_does_not_follow_is_rejected(cut, plans):
    plan = plans["single_leaves"]
    stated = stated_by(plan)
    with pytest.raises(CertificateRejected, match=r"summary.json: cuts\[0\]"):
        altered = Stated({**stated.summary, "cuts": [cut]}, stated.path)
        single.restore(plan.problem, plan.certificate, altered)


def test_the_files(plans, tmp_path):
    names = {"certificate.json", "problem.json", "path.json", "path.csv"}
    assert set(write_texts(tmp_path, data_texts(plans["single_leaves"]))) == names
    stored = json.loads((tmp_path / "path.json").read_text())
    assert stored["curves"] == {"P": [f"P{i}" for i in range(7)]} and stored["joins"] == []
    rows = (tmp_path / "path.csv").read_text().splitlines()
    assert rows[-1].split(",")[:4] == ["1", "3", "0", "0"]


@each(("65", "a whole number"), ('"7/2"', "a whole number"), ('"x"', "an integer"))
def test_a_bad_degree_gets_one_message(stated, expected, root):
    text = (root / "examples" / "single_leaves.toml").read_text().replace("degree = 6", f"degree = {stated}")
    with pytest.raises(InputError, match=rf"^p.toml:\d+: single.degree: expected {expected}[^:]*$"):
        read_problem(text, "p.toml")


def test_the_least_sums_for_every_height_are_found_when_they_are_asked_for(plans):
    plan = next(p for p in plans.values() if p.task.degree <= PIECEWISE_DEGREE)
    _least_sums.cache_clear()
    assert len(plan.pieces) == len(plan.task.raised) and not _least_sums.cache_info().currsize
    assert list(plan.pieces) == [axis.name for axis in plan.task.raised]
    assert _least_sums.cache_info().currsize == 1 and all(plan.pieces.values())
    assert pickle.loads(pickle.dumps(plan.pieces)) == plan.pieces
