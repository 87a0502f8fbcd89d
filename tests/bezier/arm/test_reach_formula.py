"""Reachable sets by elimination against forward kinematics and against the solutions at single points, exactly."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from random import Random

import pytest

import qe
from bezier.arm.inverse import solve
from bezier.arm.kinematics import position
from bezier.arm.model import Arm, JointKind
from bezier.arm.reachable import question, reachable_formula
from bezier.arm.reader import load_arm, read_arm
from bezier.arm.robot import Robot
from qe.errors import Unable
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Formula
from tests.bezier.arm.test_pose import arm_of, pairs_of
from tests.tables import each

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
