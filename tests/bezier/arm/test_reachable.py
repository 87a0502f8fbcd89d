"""What an arm reaches: points, and the formula of its reach."""

from __future__ import annotations

import json
from fractions import Fraction
from functools import cache
from pathlib import Path
from random import Random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import qe
from bezier.arm.inverse import solve
from bezier.arm.kinematics import position
from bezier.arm.model import Arm, JointKind
from bezier.arm.reachable import question, reachable_formula
from bezier.arm.reader import load_arm, read_arm
from bezier.arm.robot import Robot
from bezier.check.recheck import recheck
from bezier.curves.curve import Bezier
from bezier.planner import arm as planner_arm
from bezier.planner.arm import rounded
from bezier.planner.outputs import data_texts, facts, write_texts
from bezier.planner.planning import make_plan
from bezier.planner.table import method_of
from bezier.plans import Outcome
from bezier.problem import from_json, read_problem, to_json
from bezier.report.page import render
from qe.errors import CertificateRejected, InputError, Unable
from qe.exact.field import NumberField
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Formula
from tests.bezier.arm.test_pose import arm_of, pairs_of
from tests.bezier.folder_mutation import Memory
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
    files = write_texts(tmp_path, data_texts(made))
    assert {"joints.csv", "joints.json", "joints_certificate.json"} <= set(files)
    (tmp_path / "report.html").write_text("")
    listed = sorted([*files, "report.html", "summary.json"])
    told = facts(made) | {"files": [str(tmp_path / name) for name in listed], "seconds": {"total": 1.0}}
    (tmp_path / "summary.json").write_text(json.dumps(told))
    Memory().use(monkeypatch, plans=False)
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


TWO = arm_of("a = 100", "a = 80")
SCARA = read_arm(
    'convention = "standard"\n[[row]]\njoint = "a"\na = 100\nd = 50\n[[row]]\njoint = "b"\na = 80\nalpha = "pi"\n'
    '[[row]]\njoint = "d"\nkind = "prismatic"\nlimits = [10, 60]\n'
)
SLIDING_BASE = read_arm(
    'convention = "standard"\n[[row]]\njoint = "d"\nkind = "prismatic"\nlimits = [0, 30]\na = 5\nalpha = "pi/4"\n'
    '[[row]]\njoint = "a"\na = 20\n'
)
"""Irrational constants: an ellipse seen from above, moved up and down."""

ARMS = {
    "two": TWO,
    "three": load_arm("planar-3r"),
    "cylindrical": load_arm("cylindrical"),
    "scara": SCARA,
    "slide": SLIDING_BASE,
}


@cache
def formula_of(name: str) -> Formula:
    answer = reachable_formula(ARMS[name], timeout=120)
    assert answer.formula is not None and answer.guarantee is qe.Guarantee.CHECKED
    assert set(answer.formula.free) <= {"x", "y", "z"}
    return answer.formula


def joints_of(arm: Arm, random: Random) -> dict[str, object]:
    tangents = [Fraction(random.randint(-12, 12), random.randint(1, 6)) for _ in arm.joints]
    found: dict[str, object] = {}
    for joint, pair in zip(arm.joints, pairs_of(tangents)):
        low, high = joint.limits or (Fraction(0), Fraction(1))
        share = Fraction(random.randint(0, 8), 8)
        found[joint.name] = pair if joint.motion is JointKind.REVOLUTE else low + share * (high - low)
    return found


@each("two", pytest.param("three", marks=pytest.mark.deep), "cylindrical", "scara")
def test_what_is_reached_satisfies_the_formula(name: str) -> None:
    random, formula = Random(7), formula_of(name)
    for _ in range(150):
        point = position(ARMS[name], joints_of(ARMS[name], random))
        assert holds_at(formula, dict(zip("xyz", point, strict=True)))


@each("cylindrical", "scara")
def test_what_satisfies_the_formula_is_reached(name: str) -> None:
    """Limits of joints that turn are left aside; those of joints that slide are kept."""
    random, formula, arm = Random(8), formula_of(name), ARMS[name]
    seen = set()
    for _ in range(60):
        point = tuple(Fraction(random.randint(-200, 200)) for _ in range(2)) + (Fraction(random.randint(-20, 380)),)
        if name == "scara":
            point = (*point[:2], point[2] / 5)
        holds = holds_at(formula, dict(zip("xyz", point, strict=True)))
        slides = [k for k, j in enumerate(arm.joints) if j.motion is JointKind.PRISMATIC]
        reached = any(
            all(low <= (s.angles[k] or 0) <= high for k in slides for low, high in [arm.joints[k].limits or (0, 0)])
            for s in solve(arm, point).solutions
        )
        assert holds == reached
        seen.add(holds)
    assert seen == {True, False}


def test_a_base_that_slides_and_irrational_constants() -> None:
    """x² + 2 y²-like ellipse: the circle of radius 20 leans by pi/4, so (x - 5)² + 2 y² = 400; z = d + y."""
    formula = formula_of("slide")
    for x, y, z in ((25, 0, 7), (5, 0, 10), (25, 0, 31), (-15, 0, 30), (-15, 0, -1), (25, 1, 8)):
        expected = (x - 5) ** 2 + 2 * y * y == 400 and 0 <= z - y <= 30
        assert holds_at(formula, {"x": x, "y": y, "z": z}) == expected


def test_the_question_has_no_first_joint() -> None:
    text = str(question(TWO))
    assert "c2" in text and "c1" not in text
    assert set(question(load_arm("ev3-120")).free) == {"x", "y", "z"}


def test_one_line_where_it_does_not_end() -> None:
    with pytest.raises(Unable, match="reachable set of EV3, last link 120 mm is not found by elimination: "):
        Robot.load("ev3-120").reachable_formula(timeout=0.2)
