"""Spherical wrists, and joints that can be chosen: for which of their values the others follow."""

from __future__ import annotations

from fractions import Fraction
from math import cos, hypot, isclose, pi, sin

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bezier.arm import command
from bezier.arm.choices import Choice, spans
from bezier.arm.command import in_words
from bezier.arm.inverse import Inverse, Solution, solve
from bezier.arm.kinematics import pose
from bezier.arm.model import Joint, JointKind
from bezier.arm.pose import rotation_of, solve_pose
from bezier.arm.reader import load_arm, read_arm
from bezier.proofs.inverse_pose import centre, meeting
from bezier.proofs.square_roots import Surd
from tests.bezier.arm.test_pose import SIX, SKEW, SKEW_FREE, Pairs, arm_of, at_the_pose_of, pairs_of
from tests.bezier.made import arm_text
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
        assert (centre(read_arm('convention = "standard"\n' + body).chain) is not None) == is_wrist
    assert centre(PUMA.chain) is not None and centre(SIX.chain) is None and centre(SKEW.chain) is None
    assert centre(STANDARD.chain) == (Surd.rational(60), Surd.rational(0))
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


PLANAR = load_arm("planar-3r")
SKEW_WRIST = arm_of('alpha = "pi/2"', "a = 60", 'alpha = "pi/2"', 'alpha = "pi/6"; d = 60', 'alpha = "pi/6"', "d = 17")
"""Neighbouring axes of the wrist are 30 degrees apart."""

STILL = arm_of('alpha = "pi/2"; d = 40', 'a = 70; alpha = "pi/2"', "d = 25")
"""The end point lies on the last axis."""


def ranges(choice: Choice) -> list[tuple[float, float]] | None:
    if choice.arcs is None:
        return None
    return [(float(a.value()), float(b.value())) for a, b in choice.arcs if a and b]


def is_in(angle: float, choice: Choice) -> bool | None:
    """Whether the angle is possible; None close to an end."""
    arcs = ranges(choice)
    if arcs is None:
        return True
    if any(abs((angle - end + pi) % (2 * pi) - pi) < 1e-6 for arc in arcs for end in arc):
        return None
    return any((angle - low) % (2 * pi) < (high - low) % (2 * pi) for low, high in arcs)


def family(found: Inverse) -> Solution:
    return next(s for s in found.solutions if s.choices)


ANGLES = [k * 2 * pi / 40 + 0.01 for k in range(40)]


@settings(max_examples=12)
@given(st.fractions(-230, 230, max_denominator=7), st.fractions(-230, 230, max_denominator=7))
def test_a_planar_arm_at_a_point(x: Fraction, y: Fraction) -> None:
    """Joint 3 determines how far the end is from axis 2: two links remain."""
    found = solve(PLANAR, (x, y, 0))
    far = hypot(x, y)

    def reaches(angle: float) -> bool:
        inner = hypot(80 + 50 * cos(angle), 50 * sin(angle))
        return abs(100 - inner) <= far <= 100 + inner

    if not found.solutions or not family(found).choices or x == y == 0:
        assert not any(map(reaches, ANGLES)) or x == y == 0
        return
    (choice,) = family(found).choices
    assert choice.joint == 2 and found.free == ("theta1", "theta2", "theta3")
    for angle in ANGLES:
        assert is_in(angle, choice) in (None, reaches(angle))


@settings(max_examples=10)
@given(st.tuples(*[st.integers(-4, 4)] * 4), st.integers(20, 110))
def test_a_skew_wrist_over_the_first_axis(quaternion: tuple[int, ...], height: int) -> None:
    """The wrist turns axis 6 at most 60 degrees away from axis 4, wherever joint 1 has brought that."""
    if not any(quaternion):
        return
    rotation = rotation_of(quaternion)
    point = [17 * row[2] + height * (k == 2) for k, row in enumerate(rotation)]
    found = solve_pose(SKEW_WRIST, point, rotation)
    wanted = [float(row[2]) for row in rotation]
    for s in found.solutions:
        (choice,) = s.choices
        forearm = float(s.angles[1] or 0) + float(s.angles[2] or 0)
        for angle in ANGLES:
            axis = np.array([cos(angle) * sin(forearm), sin(angle) * sin(forearm), -cos(forearm)])
            assert is_in(angle, choice) in (None, float(axis @ wanted) >= 0.5)


@settings(max_examples=10)
@given(st.fractions(1, 300, max_denominator=9))
def test_four_links_in_a_plane(along: Fraction) -> None:
    """Axis 6 is parallel to axes 2, 3, 4: links of 110.4 and 96, and one of 75.05 that joint 6 turns."""
    m = pose(SIX, {f"theta{k}": (0, -1) if k == 5 else (1, 0) for k in range(1, 7)})
    found = solve_pose(SIX, (along, m[1][3], Fraction("131.22")), [row[:3] for row in m])
    families = [s for s in found.solutions if s.choices]
    closes = [14.4 <= hypot(along + 75.05 * cos(a), 75.05 * sin(a)) <= 206.4 for a in ANGLES]
    if not families:
        assert not any(closes)
        return
    (choice,) = families[0].choices
    assert choice.joint == 5
    inside = [is_in(a, choice) for a in ANGLES]
    # the link's direction is that of joint 6 up to a shift and a side: as many angles of the one as of the other
    assert abs(sum(map(bool, inside)) - sum(closes)) <= 4


def test_an_end_point_on_the_last_axis() -> None:
    """The first two joints were named free with the last one, though they are determined."""
    at = pose(STILL, {"q1": (Fraction(3, 5), Fraction(4, 5)), "q2": (Fraction(4, 5), Fraction(3, 5)), "q3": (1, 0)})
    found = solve(STILL, [row[3] for row in at])
    assert found.free == ("q3",) and found.cases == ("q3 does not move the point",)
    assert all(None not in s.values[:2] and s.choices[0].arcs is None for s in found.solutions)
    assert any(isclose(cos(s.angles[0] or 0), 0.6) for s in found.solutions)
    assert solve(STILL, (500, 0, 0)).count == 0


@settings(max_examples=6)
@given(st.tuples(*[st.integers(-3, 3)] * 4), st.integers(0, 220))
def test_the_first_joint_of_parallel_axes(quaternion: tuple[int, ...], height: int) -> None:
    """Two links of 60 and 55 have to reach axis 4. It lies 7 along axis 5, which is orthogonal to these and to 6."""
    if not any(quaternion):
        return
    rotation = rotation_of(quaternion)
    last = np.array([float(row[2]) for row in rotation])
    found = solve_pose(SKEW_FREE, [30 * row[2] + height * (k == 2) for k, row in enumerate(rotation)], rotation)

    def reaches(angle: float) -> bool:
        across = np.cross([sin(angle), -cos(angle), 0], last)
        ends = [np.array([0, 0, height - 90]) + side * across / np.linalg.norm(across) for side in (7, -7)]
        return any(5 <= np.linalg.norm(end) <= 115 for end in ends)

    choices = [c for s in found.solutions for c in s.choices if c.joint == 0]
    for angle in ANGLES:
        assert (is_in(angle, choices[0]) if choices else False) in (None, reaches(angle))


# --- limits --------------------------------------------------------------------------------------------------------
def limited(low: str, high: str) -> Joint:
    return Joint("q", JointKind.REVOLUTE, (Fraction(low), Fraction(high)))


def shown(joint: Joint, choice: Choice) -> list[tuple[float, float]]:
    return [
        tuple(float(e.limit) if e.limit is not None else float(e.end.value()) + 2 * pi * e.turns for e in ends)  # type: ignore[union-attr,misc]
        for ends in spans(joint, choice)
    ]


def test_a_whole_circle_between_limits() -> None:
    assert shown(limited("-3", "3"), Choice(0)) == [(-3.0, 3.0)]


def test_arcs_between_limits() -> None:
    """At (10, 20) joint 3 may be between 0.709 and 1.938 in absolute value."""
    (choice,) = family(solve(PLANAR, (10, 20, 0))).choices
    low, high = 0.7089943725154361, 1.9380107836813947
    for limits, expected in (
        (("-1", "1"), [(-1, -low), (low, 1)]),
        (("0", "6"), [(low, high), (2 * pi - high, 2 * pi - low)]),
        (("2", "4"), []),
        (("-7/10", "7/10"), []),
        (("1", "3/2"), [(1, 1.5)]),
        (("13", "14"), [(4 * pi + low, 14)]),
    ):
        assert (
            np.allclose(shown(limited(*limits), choice), expected) if expected else not shown(limited(*limits), choice)
        )


def test_an_arc_through_half_a_turn() -> None:
    found = solve_pose(SKEW_WRIST, (17, 0, 100), rotation_of((1, 0, 1, 0)))
    (arc,) = [s.choices[0] for s in found.solutions if float(s.angles[1] or 0) < 1]
    ((low, high),) = shown(Joint("q", JointKind.REVOLUTE), arc)
    assert low < pi < high < low + 2 * pi
    assert np.allclose(shown(limited("-3", "3"), arc), [(-3, high - 2 * pi), (low, 3)])
    assert np.allclose(shown(limited("3", "7/2"), arc), [(3, 3.5)])


def test_an_end_that_is_the_limit_zero() -> None:
    """The arm can only be stretched: its last joint is exactly at 0, where its limits end."""
    text = arm_text("a = 10", "a = 10", "a = 10")
    for limits, kept in (("[0, 1]", True), ("[-1, 0]", True), ('["1/1000000000000", 1]', False)):
        found = solve(read_arm(f"{text}limits = {limits}\n"), (30, 0, 0))
        assert [s.allowed for s in found.solutions] == [kept]


def test_a_family_outside_the_limits() -> None:
    arm = read_arm(arm_text("a = 100", "a = 80", "a = 50; limits = [2, 4]"))
    found = solve(arm, (10, 20, 0))
    assert not family(found).allowed
    assert "not between its limits" in "\n".join(command.in_words(found))


def test_as_json_and_in_words() -> None:
    said = command.inverse(None, load_arm("shoulder-3r"), (0, 0, 150))[0]  # type: ignore[arg-type]
    assert said["count"] is None and said["free"] == ["theta1"]
    (choice,) = said["solutions"][0]["choices"]
    assert choice["joint"] == "theta1" and choice["possible"] == "all"
    assert choice["values"] == [{"low": {"value": -3.0, "limit": "-3"}, "high": {"value": 3.0, "limit": "3"}}]
    told = command.in_words(solve(load_arm("shoulder-3r"), (0, 0, 150)))
    assert any("theta1 free from -3.000000000 to 3.000000000 rad (its limits)" in line for line in told)
    said = command.inverse(None, PLANAR, (10, 20, 0))[0]  # type: ignore[arg-type]
    assert said["solutions"][0]["follow"] == ["theta1", "theta2"]
    (_, positive) = said["solutions"][0]["choices"][0]["possible"]
    low, high = (Fraction(v) for v in positive["low"]["box"]["cos"])
    assert low <= Fraction(cos(0.7089943725154361)) <= high or high - low < Fraction(1, 2**50)
