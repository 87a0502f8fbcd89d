"""Wrong input to the arm's doors gets one clear line, never a traceback; border points and merged branches."""

from __future__ import annotations

import json
import pickle
from collections.abc import Callable
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

import qe
from bezier.arm import command
from bezier.arm.critical import Reason
from bezier.arm.inverse import solve
from bezier.arm.inverse_evidence import inverse_certificate
from bezier.arm.joint_plan import joint_plan
from bezier.arm.reader import load_arm, read_arm, read_exact
from bezier.arm.robot import Robot
from bezier.arm.study import study
from bezier.cli import main
from bezier.curves.curve import Bezier
from bezier.motion.timelaw import Law, TimeLaw
from bezier.report.joints import page
from qe.certify.verify import verify_json
from qe.errors import InputError, Unable
from tests.bezier.made import arm_text
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
    "an angle without a float": lambda: EV3.positions([1, 2, 10**5000]),
    "an endless angle": lambda: EV3.positions([1, 2, float("inf")]),
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
    _, lines, evidence, _ = command.certify(None, EV3.arm, away)  # type: ignore[arg-type]
    text = "\n".join(lines)
    assert verify_json(evidence).accepted and "REJECTED" not in text and "NOT reachable" in text


def test_the_page_names_the_units_of_joints_that_slide() -> None:
    curve = Bezier.of([(100, 20, 150), (60, 120, 250), (60, 160, 300)])
    plan = joint_plan(Robot.load("cylindrical").arm, {"c": curve}, TimeLaw.of(Law.QUINTIC), Fraction(50), 9)
    shown = page(plan, "path.toml")
    body = "".join(str(section.content) for section in shown.sections)
    assert "mm/s" in body and "rad/s" in body and shown.cards[0].value == "reached"


ARM = load_arm("ev3-120")


def test_every_edge_case(shared: Path) -> None:
    cases = json.loads((shared / "corpora/ev3/edge_cases.json").read_text())["cases"]
    assert len(cases) == 9
    for case in cases:
        found = solve(ARM, [read_exact(case[c]) for c in "xyz"])
        expected = case["distinct_real_solutions"]
        if isinstance(expected, str):
            assert found.free == ("theta1",) and len(found.solutions) == 2
        else:
            assert found.count == expected, case["name"]
        if case["per_sign_of_rho"]:
            x, y = (float(read_exact(case[c])) for c in "xy")
            outwards = sum(
                (s.values[0].cosine[0] * x + s.values[0].sine[0] * y) > 0 for s in found.solutions if s.values[0]
            )
            assert [outwards, len(found.solutions) - outwards] == case["per_sign_of_rho"], case["name"]
        assert any(s.multiple for s in found.solutions) == (
            "border" in case["name"] or isinstance(expected, str)  # on the axis both signs of the root of x² + y² meet
        )


CURVES = {
    "conic": [(150, 0, 60), (150, 220, 200), (-160, 120, 330)],
    "out and in again": [(100, 20, 100), (600, 50, 200), (-300, 300, 100), (100, 100, 250), (20, 90, 150)],
}


@each("conic", pytest.param("out and in again", marks=pytest.mark.deep))
def test_curves_of_any_degree(name: str) -> None:
    """The square root of x² + y² is no polynomial along these; the counts are those of single points."""
    curve = Bezier.of(CURVES[name])
    found = study(ARM, curve)
    marks = [float(p.s) for p in found.specials]
    for (low, high), part in zip(pairwise(marks), found.stretches, strict=True):
        for k in range(1, 6):
            s = Fraction(low) + (Fraction(high) - Fraction(low)) * k / 6
            assert solve(ARM, curve.point(s)).count == part.count
    assert found.is_reachable == all(p.count for p in found.stretches)


def test_two_branches_merge_and_end_at_an_exact_place() -> None:
    """Straight up through the top of the torus: the height there is that of the border."""
    top = read_exact("104 + 44*sqrt(2) + 8*sqrt(293) + 120")
    found = study(ARM, Bezier.of([(0, 1, 300), (0, 1, 500)]))
    merging = [p for p in found.specials if Reason.MERGE in p.reasons]
    assert found.stretches[-1].count == 0 and merging
    x = 1 - float(read_exact("44*sqrt(2)"))
    radius = float(top) - float(read_exact("104 + 44*sqrt(2)"))
    border = float(read_exact("104 + 44*sqrt(2)")) + (radius**2 - (float(read_exact("44*sqrt(2)")) - 1) ** 2) ** 0.5
    assert abs(300 + 200 * float(merging[-1].s) - border) < 1e-9 and x < 0
    assert merging[-1].inverse.count == 1 and merging[-1].inverse.solutions[0].multiple


@each("EV3", "SIX")
def test_answers_go_to_other_processes(name: str) -> None:
    """Balls cannot: they are made again."""
    known = EV3.inverse((60, 120, 140)) if name == "EV3" else SIX.inverse_at_pose((150, 50, 200), (1, 0, 0, 0))
    again = pickle.loads(pickle.dumps(known))
    assert again.count == 4 and [s.angles for s in again.solutions] == [s.angles for s in known.solutions]
    assert inverse_certificate(again) == inverse_certificate(known)


def test_a_path_along_the_border_is_named() -> None:
    with pytest.raises(Unable, match=r"everywhere along the curve: (solutions meet|on the axis)"):
        study(ARM, Bezier.of([(0, 0, 100), (0, 0, 150)]))


@each(
    (["ik", "nobody", "1", "2", "3"], "expected a file .toml or .urdf"),
    (["ik", "six-joints", "1", "2", "3"], "--quaternion W X Y Z"),
    (["ik", "six-joints", "1", "2", "3", "--quaternion", "0", "0", "0", "0"], "not all 0"),
    (["ik", "ev3-120", "1", "2", "x"], "expected an exact number"),
    (["ik", "ev3-120", "1", "2", "3", "--quaternion", "1", "0", "0", "0"], "three parallel axes"),
)
def test_the_command_says_it_in_one_line(
    arguments: list[str],
    message: str,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(arguments) != 0
    told = capsys.readouterr().err.strip()
    assert message in told.replace("\n", " ") and not list(tmp_path.iterdir())


def test_negative_coordinates_are_taken_as_typed(capsys: pytest.CaptureFixture[str]) -> None:
    """``-50`` was taken for an option."""
    for minus in "-−":
        assert main(["ik", "ev3-120", "100", f"{minus}50", "20"]) == 0
        assert "at (100, -50, 20) mm\n4 solutions (proved)" in capsys.readouterr().out
    assert main(["ik", "planar-3r", "-1/2", "-0.5", "0", "--quaternion", "1", "0", "0", "-1"]) == 0
    assert "at (-0.5, -0.5, 0) mm, turned" in capsys.readouterr().out


def test_systems_that_do_not_fit() -> None:
    """Dependent or doubled parameters, and segments with infinitely many solutions."""
    with pytest.raises(qe.InputError):
        qe.comprehensive_groebner(["a*x - b"], ["x"], ["a", "a"])
    with pytest.raises(qe.InputError):
        qe.comprehensive_groebner(["a*x - b"], ["x", "a"], ["a", "b"])
    found = qe.real_root_classification(["a*x - b"], ["x"])
    assert found.at({"a": 0, "b": 0}) is None and found.at({"a": 0, "b": 1}) == 0
    system = qe.comprehensive_groebner(["a*x - b"], ["x"])
    with pytest.raises(qe.Unable):
        system.solutions_at({"a": 0, "b": 0})
