"""Arms with joints that slide: inverse kinematics, whole paths, limits."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from math import pi
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bezier.arm.command import in_words, to_json
from bezier.arm.evidence import certificates
from bezier.arm.inverse import solve
from bezier.arm.joint_path import joint_path
from bezier.arm.joint_plan import in_words as plan_in_words
from bezier.arm.joint_plan import joint_plan
from bezier.arm.kinematics import jacobians, position, positions
from bezier.arm.model import Arm, JointKind
from bezier.arm.reader import read_arm
from bezier.arm.study import study
from bezier.curves.curve import Bezier
from bezier.motion.timelaw import Law, TimeLaw
from qe.certify.verify import verify
from qe.errors import Unable
from tests.bezier.arm.test_inverse import ARMS as ARMS_THAT_TURN
from tests.bezier.arm.test_pose import pairs_of
from tests.tables import each

CONSTANTS = (
    'alpha = "pi/6"\na = 5\nd = 3',
    'a = 20\nalpha = "pi/3"\nd = 7\ntheta = "pi/4"',
    'a = 30\nalpha = {cos = "3/5", sin = "4/5"}\nd = 4',
)
SQUARE = ('theta = "pi/3"', 'alpha = "pi/2"\na = 20', 'alpha = "-pi/2"\nd = 4\na = 9')
"""Neighbouring axes are orthogonal."""

KINDS = ("RRP", "RPR", "PRR", "RPP", "PRP", "PPR", "PPP")


def arm_of(kinds: str, constants: tuple[str, ...] = CONSTANTS, last: str = "a = 25") -> Arm:
    words = {"R": "revolute", "P": "prismatic"}
    rows = [
        f'[[row]]\njoint = "q{k}"\nkind = "{words[c]}"\n{body}\n' for k, (c, body) in enumerate(zip(kinds, constants))
    ]
    return read_arm('convention = "modified"\n' + "".join(rows) + f"[[row]]\n{last}\n")


ARMS = [arm_of(kinds, constants) for kinds in KINDS for constants in (CONSTANTS, SQUARE)]
IDS = [f"{kinds}-{word}" for kinds in KINDS for word in ("skew", "square")]


@pytest.mark.parametrize("arm", [*ARMS_THAT_TURN[1:], *ARMS], ids=["shoulder", "scara", "skew", *IDS])
@settings(max_examples=6)
@given(st.lists(st.floats(-3, 3), min_size=3, max_size=3))
def test_no_solution_is_missed_by_newton(arm: Arm, start: list[float]) -> None:
    """Newton's method from anywhere ends, if it ends, in one of the solutions."""
    point = [Fraction(v) for v in positions(arm, [[0.4, -1.1, 0.7]])[0]]
    if np.linalg.matrix_rank(jacobians(arm, [[0.4, -1.1, 0.7]])[0], tol=1e-9) < 3:
        return  # it moves on a surface, which points in floating point miss
    inverse = solve(arm, point)
    assert inverse.solutions and not inverse.free
    found = np.array([s.angles for s in inverse.solutions])
    turning = np.array([j.motion is JointKind.REVOLUTE for j in arm.joints])
    q = np.array(start) * np.where(turning, 1, 20)
    for _ in range(40):
        step = positions(arm, [q])[0] - [float(c) for c in point]
        q = q - np.linalg.lstsq(jacobians(arm, [q])[0], step, rcond=None)[0]
    if np.allclose(positions(arm, [q])[0], [float(c) for c in point], atol=1e-10):
        gaps = found - q
        gaps = np.abs(np.where(turning, (gaps + pi) % (2 * pi) - pi, gaps)).max(axis=1)
        assert gaps.min() < 1e-4


CYLINDER = arm_of("RPP", ("", "", 'alpha = "pi/2"'), "")
"""Turn, lift, reach: ρ² = x² + y² and height are the two lengths."""


def test_a_cylindrical_arm() -> None:
    found = solve(CYLINDER, (30, 40, -7))
    assert found.count == 2
    assert sorted(s.angles[2] for s in found.solutions) == [-50, 50]
    assert {s.angles[1] for s in found.solutions} == {-7}
    assert solve(CYLINDER, (0, 0, 5)).free == ("q0",)
    assert to_json(found)["solutions"][0]["joints"]["q1"]["length"] == -7
    assert any("q2 = -50.000000000 mm" in line for line in in_words(found))


def test_a_portal_has_one_solution_everywhere() -> None:
    arm = ARMS[IDS.index("PPP-skew")]
    assert all(solve(arm, p).count == 1 for p in ((0, 0, 0), (10**9, -3, 1), (Fraction(1, 7), 2, 3)))


def test_lengths_are_compared_with_limits_exactly() -> None:
    text = '[[row]]\njoint = "q2"\nkind = "prismatic"\nalpha = "pi/2"\nlimits = [0, 50]\n'
    arm = read_arm('convention = "modified"\n[[row]]\njoint = "q0"\n[[row]]\njoint = "q1"\nkind = "prismatic"\n' + text)
    kept = [[s.allowed for s in solve(arm, (x, 40, 1)).solutions if (s.angles[2] or 0) > 0] for x in (30, 31)]
    assert kept == [[True], [False]]
    least = replace(arm, rows=(*arm.rows[:2], replace(arm.rows[2], joint=replace(arm.joints[2], limits=(50, 60)))))
    kept = [[s.allowed for s in solve(least, (x, 40, 1)).solutions if (s.angles[2] or 0) > 0] for x in (30, 29)]
    assert kept == [[True], [False]]
    assert all(not s.allowed for s in solve(arm, (30, 40, 1)).solutions if (s.angles[2] or 0) < 0)


def test_two_slides_along_one_direction() -> None:
    with pytest.raises(Unable, match="slide along one direction"):
        solve(arm_of("PPR", ("", "", ""), "a = 3"), (1, 2, 3))


def test_a_path_on_a_circle_that_two_slides_leave_is_refused() -> None:
    """Both slide along the axis of the joint that turns: every point that can be reached is one of infinitely many."""
    with pytest.raises(Unable, match="along the curve every value of a joint"):
        joint_path(arm_of("PRP", ("", "", ""), "a = 100"), {"c": Bezier.of([(100, 0, 0), (100, 0, 50)])})


@each("RRP", "PPR")
def test_paths(kinds: str) -> None:
    """The number of solutions along a line, its branches, and their certificates."""
    arm = arm_of(kinds)
    near, far = (
        position(
            arm,
            {
                j.name: v if j.motion is JointKind.REVOLUTE else Fraction(3 * k)
                for k, v, j in zip(ks, pairs_of([Fraction(k, 3) for k in ks]), arm.joints)
            },
        )
        for ks in ((1, 2, 1), (2, 1, 2))
    )
    start, end = ([Fraction(round(float(c))) for c in p] for p in (near, far))
    line = Bezier.of([start, [a + (b - a) * 2 for a, b in zip(start, end)]])
    found = study(arm, line)
    for part in found.stretches:
        for s in (part.sample, (3 * part.sample + Fraction(float(part.low))) / 4):
            if part.low < s < part.high:
                assert solve(arm, line.point(s)).count == part.count
    path = joint_path(arm, {"line": line})
    assert path.runs
    assert all(verify(c).accepted for _, c in certificates(path))


def test_a_path_with_a_missing_stretch() -> None:
    """A turning arm with a slide orthogonal to its first axis cannot come nearer than its offset."""
    arm = arm_of("RPP", ("", "", 'alpha = "pi/2"\na = 30'), "")
    found = study(arm, Bezier.of([(-90, 5, 0), (90, 5, 0)]))
    assert [p.count for p in found.stretches] == [2, 0, 2]
    assert [round(float(p.s), 6) for p in found.specials[1:-1]] == [
        round(0.5 - 875**0.5 / 180, 6),
        round(0.5 + 875**0.5 / 180, 6),
    ]


def test_a_joint_sequence_of_a_cylindrical_arm() -> None:
    plan = joint_plan(
        CYLINDER, {"line": Bezier.of([(30, 40, 0), (-50, 60, 20)])}, TimeLaw.of(Law.QUINTIC), Fraction(4), 9
    )
    assert plan.is_proved and plan.sequence is not None and plan.motion is not None
    angles = np.array(plan.sequence.angles)
    assert np.allclose(positions(CYLINDER, angles)[-1], [-50, 60, 20])
    assert np.all(np.sign(angles[:, 2]) == np.sign(angles[0, 2]))
    assert plan.motion.speeds[1].low <= 20 / 4 * 15 / 8 <= plan.motion.speeds[1].high
    assert any("q1: at most" in line and "mm/s^2" in line for line in plan_in_words(plan))


@each(([(0, -50, 3), (7, 60, 8)], Fraction(5, 11)), ([(30, -90, 3), (31, 90, 8)], Fraction(1, 2)), daily=2)
def test_a_length_that_grows_beyond_all_bounds_ends_the_path(points: Any, place: Fraction) -> None:
    """The hand slides along the lift's direction for one angle between: there the solution is at infinity."""
    rows = '[[row]]\njoint = "{}"\nkind = "{}"\na = {}\nalpha = "pi/4"\n'
    lift = '[[row]]\njoint = "lift"\nkind = "prismatic"\n'
    text = lift + rows.format("theta2", "revolute", 10) + rows.format("out", "prismatic", 20)
    arm = read_arm(f'name = "lift and boom"\nconvention = "modified"\n{text}')
    found = joint_path(arm, {"line": Bezier.of(points)})
    (special,) = (p for p in found.studies[0].specials if p.reasons)
    assert special.s == place and special.inverse.count == 0
    assert [p.count for p in found.studies[0].stretches] == [1, 1]
    assert not found.is_reachable and found.count == 0
