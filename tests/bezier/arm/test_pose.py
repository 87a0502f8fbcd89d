"""Inverse kinematics at a pose: six joints with three parallel axes, planar arms."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import cos, pi, sin, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bezier.arm import command
from bezier.arm.inverse import Inverse
from bezier.arm.kinematics import floats, pose
from bezier.arm.model import Arm
from bezier.arm.pose import rotation_of, solve_pose
from bezier.arm.reader import load_arm, read_arm, read_exact
from bezier.arm.robot import Robot
from bezier.proofs.inverse_pose import has_parallel_axes
from qe.errors import InputError, Unable
from qe.exact.algebraic import RealAlgebraic
from tests.bezier.made import arm_text
from tests.tables import each

SIX, PLANAR = load_arm("six-joints"), load_arm("planar-3r")


def arm_of(*rows: str) -> Arm:
    return read_arm(arm_text(*rows))


SKEW = arm_of(
    'a = 7; alpha = "pi/3"; d = 90; theta = "pi/6"',
    "a = 60; d = 3",
    'a = 55; alpha = "pi"; d = 2; theta = "pi/4"',
    'alpha = "pi/4"; a = 4; d = 9',
    'alpha = {cos = "3/5", sin = "4/5"}; d = 20',
    'd = 30; a = 5; alpha = "pi/6"',
)
"""Axes 2 to 4 parallel (the last one turned over), 5 and 6 meet; constants in Q(sqrt 2, sqrt 3)."""

BACKWARDS = arm_of(
    'alpha = "pi/2"; d = 40',
    'alpha = "pi/3"; d = 11; a = 8',
    "a = 70",
    "a = 50; d = 5",
    'alpha = "pi/2"; a = 3; d = 6',
    "d = 17; a = 2",
)
"""Axes 1 and 2 meet, 3 to 5 are parallel."""

Pairs = Sequence[tuple[Fraction, Fraction]]


def pairs_of(tangents: Sequence[Fraction]) -> Pairs:
    return [((1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)) for t in tangents]


def at_the_pose_of(arm: Arm, pairs: Pairs) -> Inverse:
    m = pose(arm, dict(zip((j.name for j in arm.joints), pairs)))
    return solve_pose(arm, [row[3] for row in m], [row[:3] for row in m])


def frames(arm: Arm, found: Inverse) -> np.ndarray:
    return np.array([frame(arm, s.angles) for s in found.solutions])


def frame(arm: Arm, q: Sequence[float | None]) -> np.ndarray:
    """The frame of the end effector by products of matrices."""
    base, *links = ([[*row, o] for row, o in zip(*motion)] + [[0, 0, 0, 1]] for motion in floats(arm))
    whole = np.array(base)
    for turns, value, link in zip(arm.chain.turns, q, links):
        assert value is not None
        c, s, d = (cos(value), sin(value), 0) if turns else (1, 0, value)
        whole = whole @ [[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, d], [0, 0, 0, 1]] @ link
    return whole[:3]


def test_an_arm_with_irrational_constants() -> None:
    pairs = pairs_of([Fraction(k, 2) for k in (1, -1, 2, 1, 3, -2)])
    assert has_parallel_axes(SKEW.chain)
    m = pose(SKEW, dict(zip((j.name for j in SKEW.joints), pairs)))
    found = solve_pose(SKEW, [round(float(row[3])) for row in m], rotation_of((1, 2, -1, 3)))
    assert all(np.allclose(f[:, 3], [float(c) for c in found.point]) for f in frames(SKEW, found))


def test_irrational_poses() -> None:
    half = RealAlgebraic.from_root([-1, 0, 2], 0, 1)
    turned = ((half, -half, 0), (half, half, 0), (0, 0, 1))
    found = solve_pose(PLANAR, (RealAlgebraic.from_root([-2, 0, 1], 1, 2) * 90, 40, 0), turned)
    assert found.count == 2
    assert all(np.allclose(f[:, 3], (90 * sqrt(2), 40, 0)) for f in frames(PLANAR, found))
    assert all(abs(sum(s.angles) % (2 * pi) - pi / 4) < 1e-12 for s in found.solutions)


@settings(max_examples=4)
@given(st.lists(st.floats(-3, 3), min_size=6, max_size=6))
def test_no_solution_is_missed_by_newton(start: list[float]) -> None:
    """Least squares with numbers from anywhere end, if they end, in one of the solutions."""
    from scipy.optimize import least_squares

    found = solve_pose(SIX, (120, 90, 200), rotation_of((2, 1, -1, 1)))
    target = np.array([[float(v) for v in (*row, p)] for row, p in zip(found.rotation, found.point)])

    def gap(q: np.ndarray) -> np.ndarray:
        return ((frame(SIX, q) - target) * [100, 100, 100, 1]).ravel()

    ended = least_squares(gap, start, xtol=1e-14, ftol=1e-14, gtol=1e-14, max_nfev=40)
    if ended.cost < 1e-18:
        angles = np.array([s.angles for s in found.solutions], dtype=float)
        assert (np.abs((angles - ended.x + pi) % (2 * pi) - pi).max(axis=1)).min() < 1e-6


def test_poses_that_cannot_be_reached() -> None:
    found = solve_pose(SIX, (10**4, 0, 0), rotation_of((1, 0, 0, 0)))
    assert found.count == 0 and not found.is_reachable
    assert "no joint position reaches the pose" in "\n".join(command.in_words(found))
    for point, quaternion in (((100, 50, 1), (1, 0, 0, 0)), ((100, 50, 0), (1, 1, 0, 0)), ((400, 0, 0), (1, 0, 0, 0))):
        assert solve_pose(PLANAR, point, rotation_of(quaternion)).count == 0


def test_a_stretched_planar_arm() -> None:
    found = solve_pose(PLANAR, (230, 0, 0), rotation_of((1, 0, 0, 0)))
    assert [s.angles for s in found.solutions] == [(0.0, 0.0, 0.0)]
    assert found.solutions[0].multiple and "two solutions meet" in found.cases[0]


def test_a_free_pair_of_joints() -> None:
    """Equal links folded onto each other: the sum of two angles is all that is determined."""
    arm = arm_of("a = 10", "a = 10", "a = 4")
    found = solve_pose(arm, (0, 4, 0), rotation_of((1, 0, 0, 1)))
    assert found.free == ("q1", "q3") and found.count is None and found.is_reachable
    assert abs(abs(found.solutions[0].angles[1] or 0) - pi) < 1e-12


@each((120, True), (150, True), (250, False), (400, False))
def test_a_first_joint_that_can_be_chosen(height: int, follows: bool) -> None:
    """Axes 5 and 6 meet on axis 1: the others follow for some angle of joint 1, or for none."""
    found = solve_pose(SKEW_FREE, (0, 0, height), rotation_of((1, 0, 0, 0)))
    assert found.is_reachable == follows and (found.free == tuple(j.name for j in SKEW_FREE.joints)) == follows
    assert found.cases == ("the axes of q5 and q6 meet on the axis of q1",) * follows
    assert ("infinitely many solutions" in "\n".join(command.in_words(found))) == follows


@settings(max_examples=3)
@given(st.lists(st.fractions(-4, 4, max_denominator=4), min_size=6, max_size=6), st.integers(-80, 80))
def test_a_pose_that_joints_made_with_the_first_one_free_is_found(tangents: list[Fraction], up: int) -> None:
    m = pose(SKEW_FREE, dict(zip((j.name for j in SKEW_FREE.joints), pairs_of(tangents))))
    centre = [row[3] - 30 * row[2] for row in m]  # axes 5 and 6 meet there
    point = (m[0][3] - centre[0], m[1][3] - centre[1], m[2][3] - centre[2] + 90 + up)
    found = solve_pose(SKEW_FREE, point, [row[:3] for row in m])
    reach = _reach_over_all_first_angles(found)
    assert abs(reach) < 2e-3 or found.is_reachable == (reach > 0)


def _reach_over_all_first_angles(found: Inverse) -> float:
    """The greatest slack of the two links of 60 and 55, by the position of axis 4: at the pose, 7 along axis 5 from
    where it meets axis 6, and in the plane that joint 1 turns; axis 5 is orthogonal to that of the parallel ones."""
    rows = np.array([[float(v) for v in row] for row in found.rotation])
    centre = np.array([float(v) for v in found.point]) - 30 * rows[:, 2]
    best = -1.0
    for angle in np.linspace(-pi, pi, 1500):
        normal = np.array([np.sin(angle), -np.cos(angle), 0])  # axes 2 to 4
        across = np.cross(normal, rows[:, 2])  # axis 5 is orthogonal to axis 6 and to them
        if np.linalg.norm(across) < 1e-9:
            continue
        for side in (7, -7):
            far = np.linalg.norm(centre + side * across / np.linalg.norm(across) - [0, 0, 90])
            best = max(best, min(115 - far, far - 5) / 115)
    return best


def test_irrational_coordinates_share_their_square_roots() -> None:
    """Such a pose once took minutes: every coordinate was a new unknown."""
    two, three = (RealAlgebraic.from_root([-k, 0, 1], 1, 2) for k in (2, 3))
    found = solve_pose(BACKWARDS, (two * 10 + 40, three * 30, two + three + 60), rotation_of((1, 2, -1, 3)))
    assert found.count == 4
    assert all(np.allclose(f[:, 3], [float(c) for c in found.point]) for f in frames(BACKWARDS, found))


def test_coordinates_with_three_square_roots() -> None:
    point = (read_exact("sqrt(2) + sqrt(3) + sqrt(5) + 90"), 90, 200)
    found = solve_pose(SIX, point, rotation_of((2, 1, -1, 1)))
    assert found.count == 4
    assert all(np.allclose(f[:, 3], [float(c) for c in found.point]) for f in frames(SIX, found))


@each(-1, 1)
@settings(max_examples=4)
@given(st.lists(st.fractions(-4, 4, max_denominator=4), min_size=6, max_size=6))
def test_a_last_axis_parallel_to_the_three(side: int, tangents: list[Fraction]) -> None:
    pairs = [*pairs_of(tangents)]
    pairs[4] = (Fraction(0), Fraction(side))
    found = at_the_pose_of(SIX, pairs)
    assert found.count is None and {"theta6", "theta3"} <= {*found.free}
    (family,) = [s for s in found.solutions if s.angles[5] is None]
    first, fifth = family.values[0], family.values[4]
    assert first and first.cosine and first.sine and fifth and fifth.sine
    assert first.cosine[0] <= pairs[0][0] <= first.cosine[1] and first.sine[0] <= pairs[0][1] <= first.sine[1]
    assert fifth.sine[0] <= side <= fifth.sine[1] and family.angles[1:4] == (None, None, None)


@each(("281.45", True), ("281.46", False), ("0.01", True))
def test_four_links_that_close_or_not(along: str, closes: bool) -> None:
    """Axis 6 is parallel to axis 2 at this distance; the links are 110.4, 96 and 75.05 long."""
    m = pose(SIX, {f"theta{k}": (0, -1) if k == 5 else (1, 0) for k in range(1, 7)})
    point = (Fraction(along), m[1][3], Fraction("131.22"))
    found = solve_pose(SIX, point, [row[:3] for row in m])
    assert ("theta6" in found.free) == closes


SKEW_FREE = arm_of('alpha = "pi/2"; d = 90', "a = 60", "a = 55", 'alpha = "pi/2"', 'alpha = "-pi/2"; d = 7', "d = 30")


def test_limits_and_offsets() -> None:
    text = arm_text("a = 100", "a = 80", "a = 50")
    arm = read_arm(text.replace("a = 80", 'a = 80\ntheta = "pi/2"\nlimits = [0, 1]'))
    found = solve_pose(arm, (120, 30, 0), rotation_of((1, 0, 0, 0)))
    assert sorted((s.allowed, 0 <= (s.angles[1] or 0) <= 1) for s in found.solutions) == [(False, False), (True, True)]
    assert all(np.allclose(f[:, 3], (120, 30, 0)) for f in frames(arm, found))


@each(
    *map(load_arm, ("ev3-120", "shoulder-3r", "cylindrical")),
    arm_of('alpha = "pi/2"', "a = 5", "a = 5", 'alpha = "pi/2"', 'alpha = "pi/2"; a = 1', "d = 1"),
)
def test_arms_of_another_shape(arm: Arm) -> None:
    """The last one has six joints, and no point where its axes meet."""
    with pytest.raises(Unable, match="three parallel axes"):
        solve_pose(arm, (1, 2, 3), rotation_of((1, 0, 0, 0)))


@each(
    ((1, 2), ((1, 0, 0), (0, 1, 0), (0, 0, 1))),
    ((1, 2, 3), ((1, 0), (0, 1), (0, 0))),
    ((1, 2, 3), ((1, 0, 0), (0, 1, 0), (0, 0, -1))),
    ((1, 2, 3), ((1, 1, 0), (0, 1, 0), (0, 0, 1))),
    ((1, 2, 3), ((1.0, 0, 0), (0, 1, 0), (0, 0, 1))),
)
def test_no_pose(point: tuple, rotation: tuple) -> None:
    with pytest.raises(InputError):
        solve_pose(SIX, point, rotation)


@pytest.mark.parametrize(
    "quaternion", [(0, 0, 0, 0), (1, 0, 0), (1, 0, 0, 0.5), (RealAlgebraic.from_root([-2, 0, 1], 1, 2), 0, 0, 1)]
)
def test_no_quaternion(quaternion: tuple) -> None:
    with pytest.raises(InputError):
        rotation_of(quaternion)


def test_the_command() -> None:
    said = command.inverse(None, SIX, (120, 90, 200), (2, 1, -1, 1))[0]  # type: ignore[arg-type]
    assert said["count"] == len(said["solutions"]) > 0
    assert Robot(SIX).inverse_at_pose((120, 90, 200), (2, 1, -1, 1)).count == said["count"]
    with pytest.raises(InputError, match="--quaternion"):
        command.inverse(None, SIX, (120, 90, 200))  # type: ignore[arg-type]
