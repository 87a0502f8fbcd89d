"""Arms from URDF: forward kinematics are those of the file, and what is not exact is refused in one line."""

from __future__ import annotations

import sys
from math import cos, sin
from pathlib import Path

import numpy as np
import pytest

from bezier.arm.kinematics import positions
from bezier.arm.model import Arm, JointKind
from bezier.arm.reader import load_arm
from qe.errors import InputError, Unable
from tests.tables import each

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
    ('<limit lower="-1.5" upper="1.5" effort="1" velocity="2"/>', "", None),
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
