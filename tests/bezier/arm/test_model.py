"""Models and forward kinematics: the published matrices, both conventions, bad files."""

from __future__ import annotations

from fractions import Fraction
from math import cos, isclose, pi, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bezier.arm.kinematics import jacobians, pose, position, positions, skeleton
from bezier.arm.model import Angle, Arm, field_of, read_angle
from bezier.arm.reader import load_arm, read_arm, shipped
from bezier.input.numbers import NotANumber
from qe.errors import InputError
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
    ('convention = "modified"\n[[row]]\njoint = "t"\n[[row]]\njoint = "t"\n', "different names"),
    ('convention = "modified"\n[[row]]\njoint = "t"\nlimits = [1, 1]\n', "below the greatest"),
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
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_an_unknown_arm_is_named() -> None:
    with pytest.raises(InputError, match="ev3-112, ev3-120"):
        load_arm("ev4")


@pytest.mark.parametrize("twelfths", range(-24, 25))
def test_cosines_and_sines_in_the_least_field(twelfths: int) -> None:
    angle = read_angle(f"{twelfths}*pi/12")
    c, s = angle.in_field(field_of([angle]))
    assert isclose(float(c), cos(twelfths * pi / 12), abs_tol=1e-15)
    assert isclose(float(s), sin(twelfths * pi / 12), abs_tol=1e-15)
    assert c * c + s * s == 1
    assert -pi < float(angle) <= pi


@pytest.mark.parametrize("twelfths", range(-11, 13))
def test_the_same_in_the_largest_field(twelfths: int) -> None:
    c, s = Angle(twelfths).in_field(field_of([Angle(3), Angle(2)]))
    assert isclose(float(c), cos(twelfths * pi / 12), abs_tol=1e-15)
    assert isclose(float(s), sin(twelfths * pi / 12), abs_tol=1e-15)


def test_fields_are_as_small_as_they_can_be() -> None:
    assert [field_of([Angle(k)]).degree for k in (0, 6, 3, 2, 1)] == [1, 1, 2, 2, 4]
    assert field_of([Angle(9), Angle(-3)]).minimal_polynomial == (-2, 0, 1)


def test_angles_by_cosine_and_sine() -> None:
    angle = read_angle({"cos": "3/5", "sin": "-4/5"})
    assert angle.in_field(field_of([angle])) == (Fraction(3, 5), Fraction(-4, 5))
    assert str(angle) == "atan2(-4/5, 3/5)"


@each("0", 0, "pi", "-pi/2", "3*pi/4", "2/3*pi", "pi/12", "3 pi/4")
def test_what_is_written_is_read_again(text: object) -> None:
    angle = read_angle(text)
    assert read_angle(str(angle)) == angle


@each("pi/5", "1", 1, "", "pi/0", "pipi", True, {"cos": "1/2", "sin": "1/2"}, {"cos": "1"}, [0], "sqrt(2)")
def test_what_is_no_exact_angle(raw: object) -> None:
    with pytest.raises(NotANumber):
        read_angle(raw)
