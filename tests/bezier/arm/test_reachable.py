"""The reachable set in closed form, against the solutions; the arm as one object; an arm in a planning problem."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bezier.arm.robot import Robot
from bezier.check.recheck import recheck
from bezier.curves.curve import Bezier
from bezier.planner import arm as planner_arm
from bezier.planner.arm import rounded
from bezier.planner.outputs import facts, write_data
from bezier.planner.planning import make_plan
from bezier.planner.table import method_of
from bezier.plans import Outcome
from bezier.problem import from_json, read_problem, to_json
from bezier.report.page import render
from qe.errors import CertificateRejected, InputError, Unable
from qe.exact.field import NumberField
from tests.tables import each

EV3 = {length: Robot.load(f"ev3-{length}") for length in (112, 120)}


@each((120, 258.149), (112, 247.534))
def test_the_half_ball_that_can_be_reached(length: int, radius: float) -> None:
    assert EV3[length].reachable().half_ball == pytest.approx(radius, abs=5e-4)


@each(112, 120)
@given(point=st.tuples(*[st.integers(-330, 330)] * 2, st.integers(-120, 450)))
def test_the_closed_form_agrees_with_the_solutions(length: int, point: tuple[int, int, int]) -> None:
    robot = EV3[length]
    assert robot.reachable().contains(*point) == robot.inverse(point).is_reachable


def test_arms_of_other_shapes() -> None:
    with pytest.raises(Unable, match="closed form"):
        Robot.load("shoulder-3r").reachable()


def test_shipped_arms_answer_what_they_can() -> None:
    assert Robot.load("shoulder-3r").inverse((100, 50, 120)).count == 4
    assert Robot.load("planar-3r").inverse((100, 50, 0)).free == ("theta1", "theta2", "theta3")
    six = Robot.load("six-joints")
    assert np.isfinite(six.positions([[0.1] * 6])).all()
    with pytest.raises(Unable, match="three joints"):
        six.inverse((100, 50, 120))


def test_one_object_for_scripts() -> None:
    robot = EV3[120]
    half = {name: (Fraction(3, 5), Fraction(4, 5)) for name in ("theta1", "theta4", "theta7")}
    assert robot.inverse(robot.forward(half)).count == 4
    plan = robot.plan({"line": Bezier.of([(10, 40, 80), (40, 100, 20)])}, 50, samples=11)
    assert plan.is_proved and len(robot.path({"line": Bezier.of([(10, 40, 80), (12, 41, 80)])}).whole_runs) == 4


PROBLEM = """method = "cubic"
workspace = "hemisphere"
arm = "{}"
start = [-80, 60, 60]
via = [[-40, 100, 120], [40, 100, 120]]
goal = [80, 60, 60]
radius = {}
"""


def test_a_plan_with_an_arm_is_written_and_checked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(planner_arm, "SAMPLES", 21)
    made = make_plan(read_problem(PROBLEM.format("ev3", 250)))
    assert made.outcome is Outcome.SOLVED and made.joints is not None and made.joints.is_proved
    files = write_data(made, tmp_path)
    assert {"joints.csv", "joints.json", "joints_certificate.json"} <= set(files)
    (tmp_path / "report.html").write_text("")
    listed = sorted([*files, "report.html", "summary.json"])
    told = facts(made) | {"files": [str(tmp_path / name) for name in listed], "seconds": {"total": 1.0}}
    (tmp_path / "summary.json").write_text(json.dumps(told))
    assert recheck(_Channel(), tmp_path)  # type: ignore[arg-type]
    table = (tmp_path / "joints.csv").read_text()
    (tmp_path / "joints.csv").write_text(table.replace("0.", "1.", 1))
    with pytest.raises(CertificateRejected, match=r"joints\.csv"):
        recheck(_Channel(), tmp_path)  # type: ignore[arg-type]


class _Channel:
    def event(self, event: object) -> None:
        """Nothing listens."""


def test_a_path_beyond_the_arm() -> None:
    text = PROBLEM.format("ev3-112", 400).replace("-80, 60, 60", "-330, 60, 60")
    made = make_plan(read_problem(text))
    assert made.outcome is Outcome.OUT_OF_REACH and not made.certified
    assert made.path is not None and made.path.is_inside
    page = render(made, method_of(made.problem.method), None)
    assert "the arm cannot follow the path" in page and "The joints of EV3" in page


@each("ev4", "../ev3.toml", "")
def test_unknown_arms_are_refused_before_planning(name: str) -> None:
    with pytest.raises(InputError, match="arm"):
        make_plan(read_problem(PROBLEM.format(name, 250)))


def test_the_problem_keeps_its_arm() -> None:
    problem = read_problem(PROBLEM.format("ev3-120", 250))
    assert from_json(to_json(problem), "problem.json").arm == "ev3-120"


def test_irrational_control_points_are_rounded() -> None:
    root = NumberField.from_root([-2, 0, 1], 1, 2).generator()
    curve = rounded(Bezier.of([(root, 0, 1), (1, 2, 3)]))
    assert curve.points[1] == (1, 2, 3)
    assert 0 < abs(float(curve.points[0][0] - root)) < 1e-10
