"""Wrong input to the arm's doors: one clear line, never a traceback; limits and units."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from bezier.arm import command
from bezier.arm.inverse import solve
from bezier.arm.joint_plan import joint_plan
from bezier.arm.reader import read_arm
from bezier.arm.robot import Robot
from bezier.curves.curve import Bezier
from bezier.motion.timelaw import Law, TimeLaw
from bezier.report.joints import page
from qe.certify.verify import verify_json
from qe.errors import InputError
from tests.bezier.arm.arms import arm_text
from tests.tables import each

EV3, SIX = Robot.load("ev3-120"), Robot.load("six-joints")
LINE = {"line": Bezier.of([(10, 40, 80), (40, 100, 20)])}
UNIT = ((1, 0), (1, 0), (1, 0))
NAMES = ("theta1", "theta4", "theta7")

WRONG: dict[str, Callable[[], object]] = {
    "no point": lambda: EV3.inverse(None),  # type: ignore[arg-type]
    "a text": lambda: EV3.inverse("abc"),
    "a table": lambda: EV3.inverse({"x": 1, "y": 2, "z": 3}),  # type: ignore[arg-type]
    "floats of numpy": lambda: EV3.inverse(np.array([10.0, 40.0, 80.0])),  # type: ignore[arg-type]
    "not a number": lambda: EV3.inverse((float("nan"), 0, 0)),
    "a number without a float": lambda: EV3.inverse((10**400, 0, 0)),
    "no rotation": lambda: SIX.inverse_at_pose((1, 2, 3), None),  # type: ignore[arg-type]
    "no rows": lambda: SIX.inverse_at_pose((1, 2, 3), (1, 2, 3)),
    "no place": lambda: SIX.inverse_at_pose(None, (1, 0, 0, 0)),  # type: ignore[arg-type]
    "an angle in floats": lambda: EV3.forward(dict(zip(NAMES, (0.5, *UNIT[1:])))),
    "a text for a joint": lambda: EV3.forward(dict(zip(NAMES, ("ab", *UNIT[1:])))),
    "a joint too many": lambda: EV3.forward({**dict(zip(NAMES, UNIT)), "theta2": (1, 0)}),
    "no joints": lambda: EV3.forward(None),  # type: ignore[arg-type]
    "two angles": lambda: EV3.positions([[1, 2]]),
    "four angles": lambda: EV3.positions([[1, 2, 3, 4]]),
    "no angles": lambda: EV3.positions([]),
    "angles as text": lambda: EV3.positions("abc"),  # type: ignore[arg-type]
    "no name": lambda: Robot.load(3),  # type: ignore[arg-type]
    "no such file": lambda: Robot.load(Path("/nowhere/arm.toml")),
    "a curve alone": lambda: EV3.path(LINE["line"]),  # type: ignore[arg-type]
    "a text as a curve": lambda: EV3.path({"line": "line"}),  # type: ignore[dict-item]
    "no duration": lambda: EV3.plan(LINE, duration=0),
    "a duration in floats": lambda: EV3.plan(LINE, duration=2.5),  # type: ignore[arg-type]
    "half a sample": lambda: EV3.plan(LINE, samples=2.5),  # type: ignore[arg-type]
    "no law": lambda: EV3.plan(LINE, law="fast"),  # type: ignore[arg-type]
}


@pytest.mark.parametrize("name", WRONG)
def test_one_clear_line(name: str) -> None:
    with pytest.raises(InputError) as caught:
        WRONG[name]()
    assert "\n" not in str(caught.value) and ("expected" in str(caught.value) or "found" in str(caught.value))


def test_integers_of_numpy_are_exact() -> None:
    assert EV3.inverse(np.array([10, 40, 80])).count == 4  # type: ignore[arg-type]


SHOULDER = """convention = "standard"
[[row]]
joint = "q1"
alpha = "pi/2"
limits = [{}]
[[row]]
joint = "q2"
a = 120
[[row]]
joint = "q3"
a = 90
"""


@each(
    ("-1, 1", True),
    ("6, 7", True),
    ("12, 13", True),
    ("-13, -12", True),
    ("10, 12", False),
    ("1, 2", False),
    ("-4, 4", True),
)
def test_limits_hold_for_an_angle_and_all_full_turns_of_it(limits: str, kept: bool) -> None:
    """Joint 1 is at 0: at 2 pi and 4 pi as well."""
    found = solve(read_arm(SHOULDER.format(limits)), (150, 0, 50))
    assert any(s.allowed for s in found.solutions if abs(s.angles[0] or 0) < 1e-9) == kept


def test_an_arm_without_any_length_stands_in_one_point() -> None:
    """It ended in an internal error there: every angle is a solution."""
    point = read_arm(arm_text(*['alpha = "pi/2"'] * 3, convention="modified"))
    assert solve(point, (0, 0, 0)).free == ("q1", "q2", "q3")
    assert solve(point, (0, 0, 1)).count == 0


def test_limits_in_degrees_are_refused() -> None:
    with pytest.raises(InputError, match="which may be degrees"):
        read_arm(SHOULDER.format("-180, 180"))


def test_a_path_without_any_motion_is_certified_to_have_none() -> None:
    """It was called rejected, later it had no certificate."""
    away = {"line": Bezier.of([(500, 500, 500), (600, 600, 600)])}
    text, evidence = command.certify(None, EV3.arm, away, json=False)  # type: ignore[arg-type]
    assert verify_json(evidence).accepted and "REJECTED" not in text and "NOT reachable" in text


def test_the_page_names_the_units_of_joints_that_slide() -> None:
    curve = Bezier.of([(100, 20, 150), (60, 120, 250), (60, 160, 300)])
    plan = joint_plan(Robot.load("cylindrical").arm, {"c": curve}, TimeLaw.of(Law.QUINTIC), Fraction(50), 9)
    shown = page(plan, "path.toml")
    body = "".join(str(section.content) for section in shown.sections)
    assert "mm/s" in body and "rad/s" in body and shown.cards[0].value == "reached"
