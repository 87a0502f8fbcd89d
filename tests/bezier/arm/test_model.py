"""Models of arms and their files, TOML and URDF: forward kinematics, both conventions, what is refused."""

from __future__ import annotations

import sys
from fractions import Fraction
from math import cos, isclose, pi, sin
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bezier.arm.kinematics import jacobians, pose, position, positions, skeleton
from bezier.arm.model import Angle, Arm, JointKind, field_of, in_field, read_angle
from bezier.arm.reader import load_arm, read_arm, shipped
from bezier.input.numbers import NotANumber
from qe.errors import InputError, Unable
from tests.tables import each

ANGLES = st.floats(-3.2, 3.2)


PUBLISHED = [(0, 0, 80), (0, np.pi / 2, 0), (88, 0, 0), (24, 0, 0), (96, 0, 0), (16, 0, 0), (40, 0, 0), (120, 0, 0)]


TWO = """convention = "{}"
[[row]]
joint = "a1"
a = 3
alpha = "pi/3"
d = 2
theta = "pi/4"
[[row]]
kind = "prismatic"
joint = "q"
a = 1
d = 5
"""


def craig(a: float, alpha: float, d: float, theta: float) -> np.ndarray:
    """The matrix printed in arXiv 2111.00384."""
    c, s, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
    return np.array([[c, -s, 0, a], [ca * s, ca * c, -sa, -d * sa], [sa * s, sa * c, ca, d * ca], [0, 0, 0, 1]])


def classic(a: float, alpha: float, d: float, theta: float) -> np.ndarray:
    """The matrix of Denavit and Hartenberg."""
    c, s, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
    return np.array([[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]])


@given(ANGLES, ANGLES, ANGLES)
def test_ev3_against_the_published_rows(t1: float, t4: float, t7: float) -> None:
    thetas = [t1, np.pi / 4, np.pi / 4, t4, -np.pi / 2, np.pi / 2, t7, 0]
    whole = np.linalg.multi_dot([craig(*row, theta) for row, theta in zip(PUBLISHED, thetas)])
    arm = load_arm("ev3-120")
    assert np.allclose(positions(arm, [[t1, t4, t7]])[0], whole[:3, 3], atol=1e-9)
    assert np.allclose(skeleton(arm, [t1, t4, t7])[-1], whole[:3, 3], atol=1e-9)


@each(("modified", craig), ("standard", classic))
@given(t=ANGLES, q=ANGLES)
def test_both_conventions_with_offsets(convention: str, matrix, t: float, q: float) -> None:
    arm = read_arm(TWO.format(convention))
    whole = matrix(3, np.pi / 3, 2, t + np.pi / 4) @ matrix(1, 0, 5 + q, 0)
    assert np.allclose(positions(arm, [[t, q]])[0], whole[:3, 3])


def test_exact_position() -> None:
    arm = load_arm("ev3-112")
    third = (Fraction(3, 5), Fraction(4, 5))
    exact = position(arm, {"theta1": third, "theta4": third, "theta7": (Fraction(0), Fraction(-1))})
    angle = np.arctan2(4, 3)
    assert np.allclose([float(v) for v in exact], positions(arm, [[angle, angle, -np.pi / 2]])[0])
    turn = [row[:3] for row in pose(arm, dict.fromkeys(("theta1", "theta4", "theta7"), third))]
    assert all(sum(turn[i][k] * turn[j][k] for k in range(3)) == (i == j) for i in range(3) for j in range(3))


@given(st.lists(ANGLES, min_size=3, max_size=3))
def test_jacobian_is_the_derivative(q: list[float]) -> None:
    arm, h = load_arm("ev3-120"), 1e-6
    steps = np.eye(3) * h
    slopes = (positions(arm, np.array(q) + steps) - positions(arm, np.array(q) - steps)) / (2 * h)
    assert np.allclose(jacobians(arm, [q])[0], slopes.T, atol=1e-6)


def test_values_are_checked() -> None:
    arm = load_arm("ev3-112")
    with pytest.raises(InputError, match="theta4"):
        position(arm, {"theta1": (1, 0)})
    with pytest.raises(InputError, match="theta1"):
        position(arm, {"theta1": (1, 1)})


@pytest.mark.parametrize("name", shipped())
def test_shipped_arms_are_read(name: str) -> None:
    arm = load_arm(name)
    assert isinstance(arm, Arm)
    assert len(positions(arm, [[0.1] * len(arm.joints)])[0]) == 3


@each(
    ("", "row: expected 1 to 24"),
    ('convention = "modified"\n[[row]]\na = 1\n', "a row with a joint"),
    ('[[row]]\njoint = "t"\n', "convention"),
    ('convention = "craig"\n[[row]]\njoint = "t"\n', '"modified" or "standard"'),
    (
        'convention = "modified"\n[[row]]\njoint = "t"\nalpha = "pi/7"\n',
        ":4: row[0].alpha: expected a multiple of pi/12",
    ),
    ('convention = "modified"\n[[row]]\njoint = "t"\nalpha = 1.5\n', "multiple of pi/12"),
    ('convention = "modified"\n[[row]]\njoint = "t"\nalpha = 1\n', "multiple of pi/12"),
    ('convention = "modified"\n[[row]]\njoint = "t"\nkind = "screw"\n', "revolute"),
    ('convention = "modified"\n[[row]]\njoint = "t"\n[[row]]\njoint = "t"\n', "different names"),
    ('convention = "modified"\n[[row]]\njoint = "t"\nlimits = [1, 1]\n', "below the greatest"),
    ('convention = "modified"\n[[row]]\njoint = "t"\nlimits = [2, 1]\n', "below the greatest"),
    ('convention = "modified"\n[[row]]\njoint = "t"\nd = nan\n', "d"),
    ('convention = "modified"\n', "1 to 24 tables [[row]]"),
    ('convention = "modified"\n[[row]]\njoint = "t"\nlimits = 3\n', "the least and the greatest"),
    ('convention = "modified"\n[[row]]\na = 1\nlimits = [0, 1]\n', "in a row with a joint"),
    ('convention = "modified"\n[[row]]\njoint = "t"\nkind = "ball"\n', '"revolute" or "prismatic"'),
    ('convention = "modified"\n[[row]]\njoint = "1t"\n', "a name such as theta1"),
    ('convention = "modified"\n[[row]]\njoint = "t"\nb = 1\n', "unknown key"),
    ('name = 1\nconvention = "modified"\n[[row]]\njoint = "t"\n', "a text"),
)
def test_bad_files_get_one_clear_line(text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        read_arm(text, "arm.toml")
    assert message in str(caught.value) and "arm.toml" in str(caught.value) and "\n" not in str(caught.value)


def test_an_unknown_arm_is_named() -> None:
    with pytest.raises(InputError, match="ev3-112, ev3-120"):
        load_arm("ev4")


@pytest.mark.parametrize("twelfths", range(-24, 25))
def test_cosines_and_sines_in_the_least_field(twelfths: int) -> None:
    angle = read_angle(f"{twelfths}*pi/12")
    c, s = (in_field(v, field_of(angle.exact)) for v in angle.exact)
    assert isclose(float(c), cos(twelfths * pi / 12), abs_tol=1e-15)
    assert isclose(float(s), sin(twelfths * pi / 12), abs_tol=1e-15)
    assert c * c + s * s == 1
    assert -pi < float(angle) <= pi


@pytest.mark.parametrize("twelfths", range(-11, 13))
def test_the_same_in_the_largest_field(twelfths: int) -> None:
    field = field_of([*Angle(3).exact, *Angle(2).exact])
    c, s = (in_field(v, field) for v in Angle(twelfths).exact)
    assert isclose(float(c), cos(twelfths * pi / 12), abs_tol=1e-15)
    assert isclose(float(s), sin(twelfths * pi / 12), abs_tol=1e-15)


def test_fields_are_as_small_as_they_can_be() -> None:
    assert [field_of(Angle(k).exact).degree for k in (0, 6, 3, 2, 1)] == [1, 1, 2, 2, 4]
    assert field_of([*Angle(9).exact, *Angle(-3).exact]).minimal_polynomial == (-2, 0, 1)


def test_angles_by_cosine_and_sine() -> None:
    angle = read_angle({"cos": "3/5", "sin": "-4/5"})
    assert [in_field(v, field_of(angle.exact)) for v in angle.exact] == [Fraction(3, 5), Fraction(-4, 5)]
    assert str(angle) == "atan2(-4/5, 3/5)"


@each("0", 0, "pi", "-pi/2", "3*pi/4", "2/3*pi", "pi/12", "3 pi/4")
def test_what_is_written_is_read_again(text: object) -> None:
    angle = read_angle(text)
    assert read_angle(str(angle)) == angle


@each("pi/5", "1", 1, "", "pi/0", "pipi", True, {"cos": "1/2", "sin": "1/2"}, {"cos": "1"}, [0], "sqrt(2)")
def test_what_is_no_exact_angle(raw: object) -> None:
    with pytest.raises(NotANumber):
        read_angle(raw)


ARM = """<robot name="desk arm">
  <link name="base"/><link name="turret"/><link name="upper"/><link name="lower"/><link name="tip"/>
  <joint name="waist-1" type="continuous"><parent link="base"/><child link="turret"/>
    <origin xyz="0.01 0 0.1" rpy="0 0 0.785398"/><axis xyz="0 0 1"/><limit effort="1" velocity="2.5"/></joint>
  <joint name="shoulder" type="revolute"><parent link="turret"/><child link="upper"/>
    <origin xyz="0 0.02 0.03" rpy="1.5707963 0 -0.5235988"/><axis xyz="0 1 0"/>
    <limit lower="-1.5" upper="1.5" effort="1" velocity="2"/></joint>
  <joint name="reach" type="prismatic"><parent link="upper"/><child link="lower"/>
    <origin xyz="0.12 0 0" rpy="0 1.5708 0"/><axis xyz="-1 0 0"/>
    <limit lower="0" upper="0.2" effort="1" velocity="0.1"/></joint>
  <joint name="flange" type="fixed"><parent link="lower"/><child link="tip"/>
    <origin xyz="0 0.03 0.045" rpy="3.14159265 0 0"/></joint>
</robot>
"""


def rotation(roll: float, pitch: float, yaw: float) -> np.ndarray:
    x = np.array([[1, 0, 0], [0, cos(roll), -sin(roll)], [0, sin(roll), cos(roll)]])
    y = np.array([[cos(pitch), 0, sin(pitch)], [0, 1, 0], [-sin(pitch), 0, cos(pitch)]])
    z = np.array([[cos(yaw), -sin(yaw), 0], [sin(yaw), cos(yaw), 0], [0, 0, 1]])
    return z @ y @ x


def by_hand(q: tuple[float, float, float]) -> np.ndarray:
    """The tip of the arm above, in mm."""
    tip = np.array([0, 30, 45])
    third = np.array([120, 0, 0]) + rotation(0, np.pi / 2, 0) @ (np.array([-q[2], 0, 0]) + tip)
    second = np.array([0, 20, 30]) + rotation(np.pi / 2, 0, -np.pi / 6) @ rotation(0, q[1], 0) @ third
    return np.array([10, 0, 100]) + rotation(0, 0, np.pi / 4) @ rotation(0, 0, q[0]) @ second


def written(folder: Path, text: str) -> str:
    (folder / "arm.urdf").write_text(text)
    return str(folder / "arm.urdf")


@pytest.fixture
def arm(tmp_path: Path) -> Arm:
    pytest.importorskip("yourdfpy")
    return load_arm(written(tmp_path, ARM))


def test_forward_kinematics(arm: Arm) -> None:
    for q in ((0, 0, 0), (0.3, -1.1, 40), (-2, 0.7, 130)):
        assert np.allclose(positions(arm, [q])[0], by_hand(q), atol=1e-9)


def test_joints_and_limits(arm: Arm) -> None:
    first, second, third = arm.joints
    assert [j.name for j in arm.joints] == ["waist_1", "shoulder", "reach"]
    assert (first.limits, float(first.max_velocity or 0)) == (None, 2.5)
    assert [float(v) for v in second.limits or ()] == [-1.5, 1.5]
    assert third.motion is JointKind.PRISMATIC and third.limits == (0, 200) and third.max_velocity == 100


AXES = {"1 0 0": (1, 0, 0), "-1 0 0": (-1, 0, 0), "0 1 0": (0, 1, 0), "0 -1 0": (0, -1, 0), "0 0 -1": (0, 0, -1)}


@pytest.mark.parametrize("axis", AXES)
def test_every_axis(axis: str, tmp_path: Path) -> None:
    pytest.importorskip("yourdfpy")
    text = ARM.replace('<axis xyz="0 0 1"/>', f'<axis xyz="{axis}"/>')
    still = ARM.replace('<axis xyz="0 0 1"/>', f'<axis xyz="{axis}"/>').replace("continuous", "fixed")
    angle, k = 0.4, np.array(AXES[axis], dtype=float)
    cross = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
    turn = np.eye(3) + sin(angle) * cross + (1 - cos(angle)) * cross @ cross
    base, frame = np.array([10, 0, 100]), rotation(0, 0, np.pi / 4)
    at_rest = positions(load_arm(written(tmp_path, still)), [(0.2, 30)])[0]
    moved = positions(load_arm(written(tmp_path, text)), [(angle, 0.2, 30)])[0]
    assert np.allclose(moved, base + frame @ turn @ frame.T @ (at_rest - base), atol=1e-9)


@each(
    ("0.785398", "0.7", "multiples of pi/12"),
    ('xyz="0 1 0"', 'xyz="0 0.6 0.8"', "an axis along x, y or z"),
    ('type="prismatic"', 'type="floating"', "one of revolute"),
    ('lower="0" upper="0.2"', 'lower="1" upper="0.2"', "a lower limit"),
    ('<parent link="lower"/>', '<parent link="upper"/>', "ends lower, tip"),
    ("continuous", "fixed", None),
    (ARM, "robot", "URDF expected"),
    (ARM, "", "URDF expected"),
    (ARM, ARM[:300], "no XML"),
    ("</joint>", "", "no XML"),
    ('<robot name="desk arm">', '<!DOCTYPE r [<!ENTITY x "desk">]><robot name="&x;">', "a document type"),
    (ARM, '<robot name="a"><link name="b"/></robot>', "no joint found"),
    ('<parent link="base"/>', '<parent link="tip"/>', "a circle found"),
    ('xyz="0 1 0"', 'xyz="nan 1 0"', "an axis along"),
    ("0.785398", "inf", "finite numbers expected as origin"),
    ("0.01 0 0.1", "nan 0 0.1", "joint waist-1: finite numbers"),
    ('lower="-1.5"', 'lower="nan"', "joint shoulder: a finite number"),
    ('upper="1.5"', 'upper="180"', "limits in rad"),
    ('name="shoulder"', 'name="waist_1"', "different names"),
    ('type="prismatic"', 'type="planar"', "planar found"),
    ('<axis xyz="-1 0 0"/>', '<axis xyz="-1 0 0"/><mimic joint="shoulder"/>', "one that mimics another"),
    ('name="shoulder"', 'name=""', None),
    ('<limit lower="-1.5" upper="1.5" effort="1" velocity="2"/>', "", "limits lower and upper"),
    ('lower="-1.5" upper', "upper", "limits lower and upper"),
    ('upper="0.2"', 'upper="200"', "limits in m expected"),
    ('xyz="0.12 0 0"', 'xyz="120 0 0"', "an origin in m expected, [120.0, 0.0, 0.0] found, which may be mm"),
    ('<joint name="waist-1" type="continuous">', "<joint>", "URDF expected"),
)
def test_what_is_refused(old: str, new: str, message: str | None, tmp_path: Path) -> None:
    pytest.importorskip("yourdfpy")
    name = written(tmp_path, ARM.replace(old, new, 1))
    if message is None:
        assert len(load_arm(name).joints) == (2 if new == "fixed" else 3)
        return
    with pytest.raises(InputError) as caught:
        load_arm(name)
    assert message in str(caught.value) and "\n" not in str(caught.value)


def test_links_by_name(tmp_path: Path) -> None:
    pytest.importorskip("yourdfpy")
    name = written(tmp_path, ARM)
    assert len(load_arm(f"{name}#upper").joints) == 2
    with pytest.raises(InputError, match="a link below a joint"):
        load_arm(f"{name}#nowhere")


def test_without_the_parser_one_line_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "yourdfpy", None)
    with pytest.raises(Unable, match=r"pip install 'bezier-qe\[robots\]'"):
        load_arm(written(tmp_path, ARM))
    with pytest.raises(InputError, match="urdf"):
        load_arm(str(tmp_path / "absent.urdf"))
