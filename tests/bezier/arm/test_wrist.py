"""Inverse kinematics at a pose of arms with a spherical wrist, against the forward kinematics of random joints."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bezier.arm.command import in_words
from bezier.arm.inverse import solve
from bezier.arm.kinematics import pose
from bezier.arm.pose import chain_of, rotation_of, solve_pose
from bezier.arm.reader import load_arm, read_arm
from bezier.certify.inverse_pose import centre, meeting
from bezier.certify.square_roots import Surd
from qe.errors import Unable
from tests.bezier.arm.test_pose import SIX, SKEW, Pairs, arm_of, at_the_pose_of, frames, holds, pairs_of
from tests.tables import each

PUMA = load_arm("spherical-wrist")
STANDARD = arm_of(
    'alpha = "pi/2"; d = 40',
    "a = 70",
    'alpha = "pi/2"; a = 3',
    'alpha = "-pi/2"; d = 60',
    'alpha = {cos = "3/5", sin = "4/5"}; theta = "pi/2"',
    "d = 17; a = 2",
)
"""The axes of the wrist are not orthogonal: not every rotation is in reach."""

FLAT = arm_of('alpha = "pi/2"', "a = 70", 'alpha = "pi/2"', 'alpha = "-pi/2"; d = 60', 'alpha = "pi/2"', "d = 17")
TANGENTS = st.lists(st.fractions(-4, 4, max_denominator=3), min_size=6, max_size=6)


@pytest.mark.parametrize("arm", [PUMA, STANDARD], ids=["puma", "standard"])
@settings(max_examples=3)
@given(TANGENTS)
def test_the_joints_that_made_the_pose_are_found(arm: object, tangents: list[Fraction]) -> None:
    pairs = pairs_of(tangents)
    try:
        found = at_the_pose_of(arm, pairs)  # type: ignore[arg-type]
    except Unable as error:
        assert "can be chosen" in str(error)
        return
    if found.free:
        return
    assert found.count in range(1, 9) and holds(found, pairs)
    for frame in frames(found.arm, found):
        assert np.allclose(frame[:, 3], [float(c) for c in found.point], atol=1e-8)
        assert np.allclose(frame[:, :3], [[float(c) for c in row] for row in found.rotation], atol=1e-11)


def pairs_with(changed: dict[int, tuple[int, int]]) -> Pairs:
    found = [*pairs_of([Fraction(k, 3) for k in (1, -2, 4, 5, -1, 2)])]
    for k, (c, s) in changed.items():
        found[k - 1] = (Fraction(c), Fraction(s))
    return found


@pytest.mark.parametrize("bent", [(1, 0), (-1, 0)])
def test_axes_4_and_6_in_line(bent: tuple[int, int]) -> None:
    found = at_the_pose_of(PUMA, pairs_with({5: bent}))
    assert found.count is None and found.free == ("theta4", "theta6")
    families = [s for s in found.solutions if s.angles[3] is None]
    assert len(families) == 1 and families[0].angles[5] is None and families[0].multiple
    assert len(found.solutions) == 7  # the other three positions of the arm bend the wrist


def test_the_wrist_on_the_first_axis() -> None:
    """Joint 1 can be chosen, and the wrist follows: orthogonal axes reach every rotation."""
    found = solve_pose(FLAT, (0, 0, 100), rotation_of((1, 0, 0, 0)))
    assert found.is_reachable is (found.free != ())
    centre = solve_pose(FLAT, (0, 0, 100 + 17), rotation_of((1, 0, 0, 0)))
    assert centre.free == ("q1", "q4", "q5", "q6") and len(centre.solutions) == 2
    assert "the centre of the wrist is on the axis of q1" in centre.cases


@each(((1, 0, 0, 0), 2), ((1, 0, 1, 0), 2), ((0, 1, 0, 0), 0))
def test_a_wrist_on_the_first_axis_that_does_not_reach_every_rotation(quaternion: tuple, families: int) -> None:
    """Axis 4 is 34 degrees off the first axis; axis 6 comes within 60 degrees of axis 4."""
    skew = ('alpha = "pi/2"', "a = 60", 'alpha = "pi/2"', 'alpha = "pi/6"; d = 60', 'alpha = "pi/6"', "d = 17")
    arm, rotation = arm_of(*skew), rotation_of(quaternion)
    point = [17 * row[2] + 100 * (k == 2) for k, row in enumerate(rotation)]
    assert len(solve_pose(arm, point, rotation).solutions) == families


def test_no_solution_where_the_wrist_is_out_of_reach() -> None:
    assert solve_pose(PUMA, (2000, 0, 0), rotation_of((1, 2, 3, 4))).count == 0


def test_a_rotation_that_a_skew_wrist_does_not_reach() -> None:
    """Axis 6 is always 4/5 out of line with axis 5, and axis 5 orthogonal to axis 4."""
    at = at_the_pose_of(STANDARD, pairs_with({}))
    assert at.count
    turned = rotation_of((1, 0, 0, 0)), rotation_of((1, 1, 0, 0)), at.rotation
    counts = [solve_pose(STANDARD, (90, 30, 70), rotation).count or 0 for rotation in turned]
    assert max(counts) <= 8 and len(set(counts)) > 1


def test_shapes() -> None:
    slide = 'kind = "prismatic"\nalpha = "pi/2"'
    rows = ['alpha = "pi/2"', "a = 70", 'alpha = "pi/2"', 'alpha = "-pi/2"', 'alpha = "pi/2"', "d = 1"]
    for k, is_wrist in ((2, True), (3, False), (4, False)):
        body = "".join(f'[[row]]\njoint = "q{i}"\n{slide if i == k else row}\n' for i, row in enumerate(rows))
        assert (centre(chain_of(read_arm('convention = "standard"\n' + body))) is not None) == is_wrist
    assert centre(chain_of(PUMA)) is not None and centre(chain_of(SIX)) is None and centre(chain_of(SKEW)) is None
    assert centre(chain_of(STANDARD)) == (Surd.rational(60), Surd.rational(0))
    parallel = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    assert meeting((tuple(tuple(map(Surd.rational, row)) for row in parallel), ())) is None  # type: ignore[arg-type]
    across = ((1, 0, 0), (0, 0, -1), (0, 1, 0))  # the axis (0, -1, 0) through (0, 3, 4)
    motion = tuple(tuple(map(Surd.rational, row)) for row in across), tuple(map(Surd.rational, (0, 3, 4)))
    assert meeting(motion) == (Surd.rational(3), Surd.rational(4))  # type: ignore[arg-type]


def test_families_and_single_solutions_in_words() -> None:
    told = "\n".join(in_words(at_the_pose_of(PUMA, pairs_with({5: (1, 0)}))))
    assert "infinitely many solutions, theta4, theta6 free; 1 family and 6 single solutions" in told
    told = "\n".join(in_words(solve(load_arm("planar-3r"), (10, 20, 0))))
    assert "infinitely many solutions, theta1, theta2, theta3 free; 1 family\n" in told
    assert "theta3 free from -1.938010784 to -0.708994373 and 0.708994373 to 1.938010784 rad" in told.replace(
        "and from", "and"
    )


def test_limits_of_the_wrist() -> None:
    name = {j.name: j for j in PUMA.joints}
    assert [*name] == [f"theta{k}" for k in range(1, 7)]
    m = pose(PUMA, dict(zip(name, pairs_with({}), strict=True)))
    found = solve_pose(PUMA, [row[3] for row in m], [row[:3] for row in m])
    assert all(s.allowed for s in found.solutions)


def test_a_free_elbow_beside_positions_that_are_not_free() -> None:
    """Links of one length, folded onto each other: joint 2 can be chosen there."""
    found = solve_pose(FOLDED, (0, 0, 10), rotation_of((1, 0, 0, 0)))
    families = [s for s in found.solutions if None in s.angles]
    assert families and all(s.angles[3:] == (None, None, None) for s in families if None in s.angles[:3])


FOLDED = arm_of('alpha = "pi/2"', "a = 60", 'alpha = "pi/2"', 'alpha = "-pi/2"; d = 60', 'alpha = "pi/2"', "d = 10")
