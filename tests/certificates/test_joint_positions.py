"""Certificates of joint positions at points and poses: right ones are accepted, changed ones are not."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bezier.arm import inverse_evidence
from bezier.arm import pose as poses
from bezier.arm.choices import Choice
from bezier.arm.inverse import Inverse, solve
from bezier.arm.inverse_evidence import _box, _over, _parameter, _wider, inverse_certificate
from bezier.arm.kinematics import pose, position
from bezier.arm.model import Arm, JointKind
from bezier.arm.pose import rotation_of, solve_pose
from bezier.arm.reader import load_arm, read_arm, read_exact
from qe.certify.claims import claim_of
from qe.certify.verify import verify, verify_json
from qe.errors import Unable
from qe.exact.algebraic import RealAlgebraic
from tests.bezier.arm.test_choices import FLAT, FOLDED, PLANAR, PUMA, SKEW_WRIST, STANDARD, STILL, pairs_with
from tests.bezier.arm.test_inverse import ARMS as ARMS_THAT_TURN
from tests.bezier.arm.test_pose import BACKWARDS, SIX, SKEW_FREE, arm_of, at_the_pose_of, frames, pairs_of
from tests.bezier.arm.test_prismatic import ARMS, IDS
from tests.certificates.mutation import at, leaves
from tests.certificates.restated import evidence_of, verdict_by
from tests.tables import each

POINT = ("599/66", "824/33", "323/10")
EDGES = {
    "outer border": (("44*sqrt(2) + 8*sqrt(293) + 120", "0", "104 + 44*sqrt(2)"), 1),
    "inner border": (("44*sqrt(2) + 8*sqrt(293) - 120", "0", "104 + 44*sqrt(2)"), 3),
    "inner border, written otherwise": (("-44*sqrt(2) + 8*sqrt(293) - 120 + 2*44*sqrt(2)", "0", "104 + 44*sqrt(2)"), 3),
    "axis, out of reach": (("0", "0", "500"), 0),
    "circle of the shoulder": (("44*sqrt(2)", "0", "104 + 44*sqrt(2)"), 2),
    "outer border from above": (("0", "44*sqrt(2)", "104 + 44*sqrt(2) + 8*sqrt(293) + 120"), 1),
    "y = 0": (("100", "0", "100"), 4),
    "z = 104 + 44 sqrt 2": (("100", "50", "104 + 44*sqrt(2)"), 4),
    "far away": (("1000", "1/7", "-3"), 0),
}
SKEW = """convention = "modified"
[[row]]
joint = "t1"
alpha = {cos = "4/5", sin = "3/5"}
a = 5
d = 3
[[row]]
joint = "t2"
a = 20
alpha = {cos = "5/13", sin = "12/13"}
d = 7
theta = "pi/4"
[[row]]
joint = "t3"
a = 30
alpha = {cos = "3/5", sin = "4/5"}
d = 4
[[row]]
a = 25
"""


Payload = dict[str, Any]
Change = Callable[[Payload], object]


def made(found: Inverse) -> Payload:
    """What the certificate shows, which is accepted."""
    payload: Payload = evidence_of(inverse_certificate(found))
    assert payload["count"] == found.count and accepted(payload)
    return payload


def at_point(arm: str, *point: str) -> Inverse:
    return solve(load_arm(arm), [read_exact(c) for c in point])


def accepted(payload: Any) -> bool:
    verdict = verdict_by("joint positions", payload)
    assert verdict.decided and (verdict.accepted or verdict.step.startswith("payload"))
    return verdict.accepted


def last_parallel(along: str) -> Inverse:
    m = pose(SIX, {f"theta{k}": (0, -1) if k == 5 else (1, 0) for k in range(1, 7)})
    return solve_pose(SIX, (Fraction(along), m[1][3], Fraction("131.22")), [row[:3] for row in m])


def skew(quaternion: tuple[int, ...], height: int = 100) -> Inverse:
    rotation = rotation_of(quaternion)
    return solve_pose(SKEW_WRIST, [17 * row[2] + height * (k == 2) for k, row in enumerate(rotation)], rotation)


def still() -> Inverse:
    at = pose(STILL, {"q1": (Fraction(3, 5), Fraction(4, 5)), "q2": (Fraction(4, 5), Fraction(3, 5)), "q3": (1, 0)})
    return solve(STILL, [row[3] for row in at])


SLIDE = 'kind = "prismatic"; '
WRIST = ('alpha = "-pi/2"', 'alpha = "pi/2"', "d = 6")
SLIDING: dict[str, Arm] = {
    "scara": arm_of("a = 225; d = 400", 'a = 175; alpha = "pi"', SLIDE + "limits = [-30, 200]", "d = 30"),
    "scara on a rail": arm_of(SLIDE + "a = 3", "a = 225; d = 40", 'a = 175; alpha = "pi"; theta = "pi/4"', "a = 20"),
    "scara with a rod": arm_of("a = 225; d = 40", 'a = 175; alpha = "pi"', 'a = 10; theta = "pi/6"', SLIDE + "a = 5"),
    "stanford": arm_of('alpha = "-pi/2"; d = 40', 'alpha = "pi/2"; d = 15', SLIDE, *WRIST),
    "cylinder": arm_of("d = 40", SLIDE + 'alpha = "-pi/2"', SLIDE + "d = 15", *WRIST),
    "gantry": arm_of(
        *[SLIDE + 'alpha = "-pi/2"; theta = "-pi/2"'] * 2,
        SLIDE,
        'alpha = "pi/4"',
        'alpha = {cos = "3/5", sin = "4/5"}',
        "",
    ),
    "skew gantry": arm_of(
        SLIDE + 'alpha = "-pi/3"; theta = "-pi/2"', SLIDE + 'alpha = "-pi/2"; theta = "-pi/3"', SLIDE, *WRIST
    ),
}
CASES: dict[str, Callable[[], Inverse]] = {
    "four at a point": lambda: at_point("ev3-120", *POINT),
    "two for a root": lambda: at_point("shoulder-3r", "100", "50", "120"),
    "six joints": lambda: solve_pose(SIX, (120, 90, 200), rotation_of((2, 1, -1, 1))),
    "planar": lambda: solve_pose(PLANAR, (120, 90, 0), rotation_of((2, 0, 0, 1))),
    "wrist": lambda: solve_pose(PUMA, (400, 200, 300), rotation_of((2, 1, -1, 1))),
    "slides": lambda: solve(load_arm("cylindrical"), (100, 20, 150)),
    "scara": lambda: solve_pose(SLIDING["scara"], (300, 50, 300), rotation_of((0, 1, 0, 0))),
}
CHOSEN: dict[str, Callable[[], Inverse]] = {
    "on the axis": lambda: solve(load_arm("ev3-120"), (0, 0, 200)),
    "on the axis, two for a root": lambda: solve(load_arm("shoulder-3r"), (0, 0, 150)),
    "two arcs": lambda: solve(PLANAR, (10, 20, 0)),
    "one arc": lambda: solve(PLANAR, (150, 0, 0)),
    "does not move the point": still,
    "wrist in line": lambda: at_the_pose_of(PUMA, pairs_with({5: (1, 0)})),
    "wrist over the first axis": lambda: solve_pose(FLAT, (0, 0, 117), rotation_of((1, 0, 0, 0))),
    "two joints": lambda: solve_pose(FOLDED, (0, 0, 10), rotation_of((1, 0, 0, 0))),
    "skew wrist": lambda: skew((1, 0, 1, 0)),
    "skew wrist, all": lambda: skew((1, 0, 0, 0)),
    "last axis parallel": lambda: last_parallel("200"),
    "last axis parallel, one angle": lambda: last_parallel("281.45"),
    "folded links": lambda: solve_pose(arm_of("a = 10", "a = 10", "a = 4"), (0, 4, 0), rotation_of((1, 0, 0, 1))),
}


@cache
def case(name: str) -> Inverse:
    return {**CASES, **CHOSEN}[name]()


@cache
def payload_of(name: str) -> Payload:
    """Of a case, accepted; whoever changes it takes a copy."""
    return made(case(name))


def families(payload: Payload) -> list[Any]:
    over = [s for root in payload.get("roots", ()) for s in root["solutions"]]
    return [s for s in over or payload.get("solutions", ()) if isinstance(s, dict)]


# --- accepted ------------------------------------------------------------------------------------------------------
@pytest.mark.parametrize("name", EDGES)
def test_borders_and_degenerate_points(name: str) -> None:
    point, count = EDGES[name]
    payload = made(at_point("ev3-120", *point))
    assert payload["count"] == count
    assert accepted(payload)
    assert not accepted({**payload, "count": count + 1})
    moved = [
        [["1/1000000000000000000000", 1]] if not c else [[c[0][0], c[0][1]], ["1/1000000000000000000000", 3]]
        for c in payload["point"]
    ]
    if name == "outer border":
        assert not accepted({**payload, "point": moved}), "no double root there"


def test_two_solutions_for_one_last_joint() -> None:
    """Axes 1 and 2 meet: each root of the equation has two solutions, on the border one."""
    for point, counts in (
        (("100", "50", "120"), [2, 2]),
        (("210", "0", "100"), [2]),
        (("-50", "1/3*sqrt(5)", "130"), [2, 2]),
    ):
        payload = made(at_point("shoulder-3r", *point))
        found = [len(root["solutions"]) for root in payload["roots"]]
        assert sum(found) == payload["count"] and accepted(payload), (found, counts)
        if payload["count"] == 4:
            assert found == counts
            payload["roots"][0]["solutions"].append(payload["roots"][0]["solutions"].pop(0))
            assert accepted(payload), "their order says nothing"
            payload["roots"][0]["solutions"][0] = payload["roots"][0]["solutions"][1]
            assert not accepted(payload)


def test_axes_askew() -> None:
    arm = read_arm(SKEW)
    assert verify(inverse_certificate(solve(arm, (3, 50, 30)))).accepted  # made only where the checker accepts


TANGENTS = st.lists(st.fractions(-4, 4, max_denominator=3), min_size=6, max_size=6)


POSES = {"six": SIX, "backwards": BACKWARDS, "puma": PUMA, "skew wrist": STANDARD, "plane": PLANAR, **SLIDING}
TURNED = (
    'name = "turned"\nconvention = "standard"\n[[row]]\njoint = "theta1"\nd = 100\nalpha = "pi/2"\n'
    '[[row]]\ntheta = "pi/3"\n[[row]]\njoint = "theta2"\na = 120\n[[row]]\njoint = "theta3"\na = 90\n'
)
"""Axes that meet, and a turn between them: u is along no axis of the second joint's frame."""
POINTS = {
    "turned": read_arm(TURNED),
    "ev3": load_arm("ev3-120"),
    **dict(zip(("shoulder", "scara", "skew"), ARMS_THAT_TURN[1:])),
    **dict(zip(IDS, ARMS)),
}
EACH = [*((arm, solve_pose) for arm in POSES.values()), *((arm, solve) for arm in POINTS.values())]


@each(dict(zip((*POSES, *POINTS), EACH, strict=True)), daily=4)
@settings(max_examples=settings.default.max_examples // 5)
@given(TANGENTS, st.sampled_from((0, 0, 0, 1, -1)))
def test_the_joints_that_led_there_are_found(
    arm: Arm, by: Callable[..., Inverse], t: list[Fraction], aside: int
) -> None:
    """At a point or a pose that joints made, or beside it; all solutions lead there, and a certificate says so."""
    values = [v if j.motion is JointKind.REVOLUTE else 7 * n for v, n, j in zip(pairs_of(t), t, arm.joints)]
    m = pose(arm, dict(zip((j.name for j in arm.joints), values)))
    rotation = [row[:3] for row in m] if by is solve_pose else None
    point = [row[3] + 20 * aside for row in m]
    try:
        found = solve(arm, point) if rotation is None else solve_pose(arm, point, rotation)
    except Unable as error:
        assert "can be chosen" in str(error) or "slide along one direction" in str(error)
        return
    assert found.is_reachable or aside
    if not found.free:
        assert aside or any(all(_is(v, w) for v, w in zip(s.values, values)) for s in found.solutions)
        for frame in frames(arm, found) if found.solutions else ():
            assert np.allclose(frame[:, 3], [float(c) for c in point], atol=1e-8)
            assert rotation is None or np.allclose(frame[:, :3], [[float(c) for c in r] for r in rotation], atol=1e-11)
    if all(arm.joints[c.joint].motion is JointKind.REVOLUTE for s in found.solutions for c in s.choices):
        made(found)


STRETCHED = (
    (Fraction(1501, 20), Fraction(-317, 5), Fraction(14601, 50)),
    ((Fraction(12, 13), Fraction(-5, 13), 0), (Fraction(-5, 13), Fraction(-12, 13), 0), (0, 0, -1)),
)


def test_a_stretched_arm_whose_square_roots_are_rational() -> None:
    """The checker once took one square root for another, and counted no solution."""
    found = solve_pose(SIX, *STRETCHED)
    assert made(found)["count"] == 2 and all(s.multiple for s in found.solutions)


def test_no_solution_is_proved() -> None:
    for arm, point in ((SIX, (10**4, 0, 0)), (PUMA, (2000, 0, 0)), (PLANAR, (100, 50, 1)), (PLANAR, (400, 0, 0))):
        payload = made(solve_pose(arm, point, rotation_of((1, 0, 0, 0))))
        assert payload["count"] == 0
        assert not accepted({**payload, "count": 1})
    assert made(solve(load_arm("cylindrical"), (10, 2, 150)))["count"] == 0


def test_a_wrist_that_does_not_reach_the_rotation_over_an_arm_that_reaches_the_point() -> None:
    payload = made(solve_pose(STANDARD, (90, 30, 70), rotation_of((1, 1, 0, 0))))
    assert any(not root["solutions"] for root in payload["roots"]) or payload["count"] == 8
    payload["roots"] = [root for root in payload["roots"] if root["solutions"]]
    assert accepted(payload) == (payload["count"] == 8), "a root without solutions has to be listed, too"


def test_what_it_claims() -> None:
    at_pose = inverse_certificate(solve_pose(PLANAR, (120, 90, 0), rotation_of((2, 0, 0, 1))))
    at_point = inverse_certificate(solve(load_arm("cylindrical"), (100, 20, 150)))
    first, *rest = claim_of(at_pose).words
    assert first.startswith("the sentence  ex c1_1, s1_1, c2_1, s2_1, c3_1, s3_1, c1_2, s1_2, c2_2, s2_2, c3_2, s3_2. ")
    assert "all c1, s1, c2, s2, c3, s3. (not (c1^2 + s1^2 = 1 and" in first
    assert rest == ["is true", "by joint positions"] and at_pose.trusts == ("joint positions",)
    assert "ex c1_1, s1_1, d2_1, d3_1, c1_2, s1_2, d2_2, d3_2. " in claim_of(at_point).words[0]


@each(*CHOSEN, daily=2)
def test_a_joint_that_can_be_chosen(name: str) -> None:
    found, payload = case(name), payload_of(name)
    assert found.free and payload["count"] is None and families(payload)
    words = claim_of(inverse_certificate(found)).words
    assert "all c" in words[0] and "ex c" in words[0] and words[1:] == ("is true", "by joint positions")


@settings(max_examples=6)
@given(st.tuples(*[st.integers(-4, 4)] * 4), st.integers(20, 125))
def test_wrists_over_the_first_axis(quaternion: tuple[int, ...], height: int) -> None:
    if any(quaternion):
        made(skew(quaternion, height))


@settings(max_examples=6)
@given(st.fractions(-230, 230, max_denominator=7), st.fractions(-230, 230, max_denominator=7))
def test_planar_arms_at_points(x: Fraction, y: Fraction) -> None:
    made(solve(PLANAR, (x, y, 0)))


@settings(max_examples=4)
@given(TANGENTS, st.integers(0, 1))
def test_last_axes_that_are_parallel(tangents: list[Fraction], side: int) -> None:
    pairs = [*pairs_of(tangents)]
    pairs[4] = (Fraction(0), Fraction(2 * side - 1))
    found = at_the_pose_of(SIX, pairs)
    assert found.free
    made(found)


def test_out_of_reach_with_a_free_joint() -> None:
    for found in (last_parallel("281.46"), skew((0, 1, 0, 0)), solve(PLANAR, (231, 0, 0)), solve(STILL, (500, 0, 0))):
        assert made(found)["count"] == 0


def test_what_has_no_certificate_says_so() -> None:
    with pytest.raises(Unable, match="a joint can be chosen here"):
        inverse_certificate(solve_pose(SKEW_FREE, (0, 0, 120), rotation_of((1, 0, 0, 0))))


def _is(value: Any, given: Any) -> bool:
    if not isinstance(given, tuple):
        low, high = value.ends
        return bool(low <= given <= high)
    return bool(value.cosine[0] <= given[0] <= value.cosine[1] and value.sine[0] <= given[1] <= value.sine[1])


def test_the_length_of_a_scara_keeps_its_limits() -> None:
    rotation = rotation_of((0, 1, 0, 0))
    for height, kept in ((400 - 30 + 30, True), (400 - 30 + 31, False), (170, True), (169, False)):
        found = solve_pose(SLIDING["scara"], (300, 50, height), rotation)
        assert found.count == 2 and {s.allowed for s in found.solutions} == {kept}
    assert solve_pose(SLIDING["scara"], (300, 50, 300), rotation_of((1, 1, 0, 0))).count == 0
    assert made(solve_pose(SLIDING["scara"], (900, 50, 300), rotation))["count"] == 0


@pytest.mark.parametrize("first", ['alpha = "pi/2"; d = 40', 'alpha = "pi/3"; d = 40', 'alpha = "pi/4"; d = 40'])
@pytest.mark.parametrize("angle", ["pi/4", "pi/6", "pi/12"])
def test_a_wrist_with_another_square_root_than_the_first_joints_had_no_solutions(first: str, angle: str) -> None:
    """Constants of the first three joints were read in their own field, and the pose in that of the whole arm."""
    arm = read_arm(
        'convention = "standard"\n'
        + "".join(
            f'[[row]]\njoint = "q{k}"\n{row}\n'.replace("; ", "\n")
            for k, row in enumerate(
                (first, "a = 70", 'alpha = "pi/2"; a = 3', f'alpha = "{angle}"; d = 60', 'alpha = "pi/2"', "")
            )
        )
    )
    found = at_the_pose_of(arm, pairs_of([Fraction(k, 3) for k in (1, -2, 4, 5, -1, 2)]))
    assert found.count and any(abs(float(s.angles[3] or 0) - 2 * 1.0303768265243125) < 1e-12 for s in found.solutions)


# --- rejected ------------------------------------------------------------------------------------------------------
def _slide(p: dict[str, Any], by: Fraction) -> None:
    for solution in (s for root in p["roots"] for s in root["solutions"]):
        solution[1][0] = [str(Fraction(end) + by) for end in solution[1][0]]


def _larger(p: dict[str, Any]) -> None:
    for solution in p.get("solutions") or [s for root in p["roots"] for s in root["solutions"]]:
        for joint in solution:
            joint[:] = [["-1", "1"] for _ in joint]


def _family(p: Payload) -> Any:
    return families(p)[0]


def _range(p: Payload) -> Any:
    return _family(p)["chosen"][0]


def _moved(ends: Any) -> Any:
    return [[str(Fraction(v) + Fraction(1, 1000)) for v in part] for part in ends]


EVERY: dict[str, Change] = {
    "another length": lambda p: p["arm"]["rows"][1].update(a="123"),
    "another place": lambda p: p["point"].__setitem__(2, [["121", 1]]),
    "two coordinates": lambda p: p["point"].pop(),
    "another convention": lambda p: p["arm"].update(
        convention="standard" if p["arm"]["convention"] == "modified" else "modified"
    ),
    "the count": lambda p: p.update(count=(p["count"] or 0) + 1),
    "no count": lambda p: p.pop("count"),
    "another field": lambda p: p.update(more=1),
    "a joint that slides": lambda p: p["arm"]["rows"][0].update(joint="prismatic"),
    "another kind of joint": lambda p: p["arm"]["rows"][0].update(joint="screw"),
    "a joint less": lambda p: p["arm"]["rows"][0].update(joint=None),
}
AT_A_POSE: dict[str, Change] = {
    "another rotation": lambda p: p.update(rotation=[[[["1", 1]], [], []], [[], [["1", 1]], []], [[], [], [["1", 1]]]]),
    "no rotation": lambda p: p["rotation"][0].__setitem__(0, [["2", 1]]),
    "a reflection": lambda p: p["rotation"].reverse(),
    "null": lambda p: p.update(rotation=None),
    "two rows": lambda p: p["rotation"].pop(),
}
SINGLE: dict[str, Change] = {"large boxes": _larger}
LISTED: dict[str, Change] = {
    "a solution left out": lambda p: p["solutions"].pop(),
    "a solution and the count": lambda p: (p["solutions"].pop(), p.update(count=p["count"] - 1)),
    "a solution twice": lambda p: p["solutions"].__setitem__(0, p["solutions"][1]),
    "a joint less": lambda p: p["solutions"][0].pop(),
    "no solutions": lambda p: p.update(count=0, solutions=[]),
}
OVER_ROOTS: dict[str, Change] = {
    "a root left out": lambda p: p["roots"].pop(),
    "a root and the count": lambda p: p.update(count=p["count"] - len(p["roots"].pop()["solutions"])),
    "no solution": lambda p: p.update(count=0, roots=[]),
    "all in one": lambda p: p.update(roots=[{**p["roots"][0], "low": "-90", "high": "400"}]),
    "another turn": lambda p: p.update(turn=["3/5", "4/5"] if p["turn"] is None else None),
    "no turn": lambda p: p.update(turn=["1", "1"]),
    "a root twice": lambda p: p["roots"].insert(1, p["roots"][0]),
    "boxes exchanged": lambda p: p["roots"][0].update(solutions=p["roots"][1]["solutions"]),
    "two boxes": lambda p: p["roots"][0]["solutions"].append(p["roots"][1]["solutions"][0]),
    "a joint of a box less": lambda p: p["roots"][0]["solutions"][0].pop(),
    "a float": lambda p: p["roots"][0].update(low=0.5),
}
FAMILY: dict[str, Change] = {
    "no family": lambda p: _family(p).update(chosen=[]),
    "another joint": lambda p: _range(p).__setitem__(0, (_range(p)[0] + 1) % len(_family(p)["box"])),
    "a joint that is not there": lambda p: _range(p).__setitem__(0, 9),
    "a joint twice": lambda p: _family(p)["chosen"].append(_range(p)),
    "a box for the free joint": lambda p: _family(p)["box"].__setitem__(_range(p)[0], [["-1", "1"], ["-1", "1"]]),
    "no box": lambda p: _family(p).update(box=[None] * (len(_family(p)["box"]) - 1)),
    "nothing is possible": lambda p: _range(p).__setitem__(1, []),
    "only one angle": lambda p: _range(p).__setitem__(1, [[[["1", "1"], ["0", "0"]]] * 2]),
    "another length": lambda p: p["arm"]["rows"][1].update(a="123"),
    "another place": lambda p: p["point"].__setitem__(2, [["121", 1]]),
}
ARCS: dict[str, Callable[[Payload], object]] = {
    "all angles": lambda p: _range(p).__setitem__(1, None),
    "an arc left out": lambda p: _range(p)[1].pop(),
    "an arc twice": lambda p: _range(p)[1].append(_range(p)[1][0]),
    "the other way round": lambda p: _range(p)[1][0].reverse(),
    "an end moved": lambda p: _range(p)[1][0].__setitem__(0, _moved(_range(p)[1][0][0])),
    "large boxes": lambda p: _range(p).__setitem__(1, [[[["-1", "1"], ["-1", "1"]]] * 2 for _ in _range(p)[1]]),
    "one end": lambda p: _range(p)[1][0].pop(),
}
MARKS: dict[str, Callable[[Payload], object]] = {
    "a mark left out": lambda p: p["marks"].pop(),
    "a mark more": lambda p: p["marks"].append(["100", "101"]),
    "one mark for all": lambda p: p.update(marks=[["-90", "90"]]),
    "marks in another order": lambda p: p["marks"].reverse(),
    "another turn": lambda p: p.update(turn=["3/5", "4/5"] if p["turn"][0] != "3/5" else ["0", "1"]),
    "no turn": lambda p: p.update(turn=None),
    "roots": lambda p: (p.pop("marks"), p.pop("solutions"), p.update(roots=[])),
}
SOME: dict[str, dict[str, Change]] = {
    "four at a point": {
        "another angle": lambda p: p["arm"]["rows"][1].update(theta=4),
        "a square under the root": lambda p: p["point"].__setitem__(0, [["599/132", 4]]),
        "a wider interval": lambda p: p["roots"][0].update(low="-100"),
    },
    "slides": {"a shifted box": lambda p: _slide(p, Fraction(1, 100))},
    "scara": {
        "another length of the rod": lambda p: p["solutions"][0].__setitem__(2, [["20", "21"]]),
        "another height": lambda p: p["point"].__setitem__(2, [["301", 1]]),
        "a joint that turns": lambda p: p["arm"]["rows"][2].update(joint="revolute"),
        "a tilt": lambda p: p["arm"]["rows"][0].update(alpha=1),
        "two slides": lambda p: p["arm"]["rows"][0].update(joint="prismatic"),
    },
}


def changes(name: str) -> dict[str, Change]:
    """What makes the payload of a case wrong, by what it has."""
    payload = payload_of(name)
    found = EVERY | SOME.get(name, {})
    if payload.get("rotation") is not None:
        found |= AT_A_POSE
    if not families(payload):
        found |= SINGLE | (OVER_ROOTS if payload.get("roots") else LISTED)
        return found
    arcs = _range(payload)[1]
    found |= FAMILY | (ARCS if arcs else {}) | (MARKS if "marks" in payload else {})
    if arcs and arcs[0][0] == arcs[0][1]:
        del found["the other way round"]
    return found


@each(*CASES, *CHOSEN, daily=3)
def test_changed_certificates_are_rejected(name: str) -> None:
    effective = 0
    for what, change in changes(name).items():
        changed = json.loads(json.dumps(payload_of(name)))
        change(changed)
        if changed != payload_of(name):  # a pose may have the other rotation already
            effective += 1
            assert not verdict_by("joint positions", changed).accepted, what
    assert effective > 10


def test_boxes_and_intervals_may_not_lose_their_solution() -> None:
    payload = payload_of("four at a point")
    ends = [path for path, _ in leaves(payload) if path[0] == "roots"]
    for path in ends[::9]:
        changed = json.loads(json.dumps(payload))
        node = at(changed, path[:-1])
        inwards = Fraction(1, 10) if path[-1] in (0, "low") else Fraction(-1, 10)
        node[path[-1]] = str(Fraction(node[path[-1]]) + inwards)
        assert not accepted(changed), path


def test_the_angle_that_t_misses_cannot_hide_a_solution() -> None:
    """θ7 = pi is a solution, but no t: without it the other three and their intervals are right."""
    arm = load_arm("ev3-120")
    point = position(arm, {"theta1": (1, 0), "theta4": (Fraction(3, 5), Fraction(4, 5)), "theta7": (-1, 0)})
    found = solve(arm, point)
    payload = evidence_of(inverse_certificate(found))
    assert payload["turn"] != ["1", "0"] and payload["count"] == 4
    others = [s for s in found.solutions if abs(s.angles[2] or 0) < 3.1]
    turn = (Fraction(1), Fraction(0))
    t = sorted(_parameter(s, turn, 100) for s in others)
    around = [_wider((v, v), 100) for v in t]
    roots = _over(around, [_parameter(s, turn, 100) for s in others], [_box(s, 30) for s in others])
    assert len(roots) == 3 and all(root["solutions"] for root in roots)
    assert not accepted({**payload, "turn": ["1", "0"], "count": 3, "roots": roots})


def test_as_text() -> None:
    certificate = inverse_certificate(solve(load_arm("ev3-112"), (0, 60, 250)))
    assert verify_json(certificate.to_json()).accepted
    assert not verify_json(certificate.to_json().replace('"112"', '"113"')).accepted


def test_what_has_no_certificate() -> None:
    cubic = read_exact("0") + solve(load_arm("ev3-120"), (1, 2, 3)).point[0]
    assert cubic == 1
    root = RealAlgebraic.from_root([-2, 0, 0, 1], 1, 2)
    with pytest.raises(Unable, match="certificates of joint positions"):
        inverse_certificate(solve(load_arm("ev3-120"), (root, 0, 100)))


@pytest.mark.parametrize("name", ["six joints", "planar", "wrist", "slides"])
def test_a_producer_that_loses_or_moves_a_solution_gets_no_certificate(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(inverse_evidence, "ATTEMPTS", inverse_evidence.ATTEMPTS[:1])
    monkeypatch.setattr(poses, "TURNS", poses.TURNS[:1])
    found = case(name)
    lost = replace(found, solutions=found.solutions[1:])
    moved = replace(found, solutions=(found.solutions[1], *found.solutions[1:]))
    shifted = replace(found, point=(found.point[0] + Fraction(1, 1000), *found.point[1:]))
    for wrong in (lost, moved, shifted):
        with pytest.raises(Unable, match="no certificate was found"):
            inverse_certificate(wrong)


def test_a_family_left_out() -> None:
    payload = payload_of("skew wrist")
    for root in payload["roots"]:
        changed = json.loads(json.dumps(payload))
        changed["roots"][payload["roots"].index(root)]["solutions"] = []
        assert not accepted(changed)


@pytest.mark.parametrize("name", ["two arcs", "one arc", "skew wrist", "last axis parallel"])
def test_a_producer_with_wrong_ranges_gets_no_certificate(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(inverse_evidence, "ATTEMPTS", inverse_evidence.ATTEMPTS[:1])
    found = case(name)
    (family, *_), rest = [s for s in found.solutions if s.choices], [s for s in found.solutions if not s.choices]
    (choice,) = family.choices
    others = [s for s in found.solutions if s is not family and s.choices]
    assert choice.arcs
    for arcs in (None, (), choice.arcs[1:], tuple((b, a) for a, b in choice.arcs)):
        wrong = replace(family, choices=(Choice(choice.joint, arcs),))
        with pytest.raises(Unable, match="no certificate was found"):
            inverse_certificate(replace(found, solutions=(wrong, *others, *rest)))


def test_a_producer_that_takes_every_wrist_for_orthogonal_gets_no_certificate() -> None:
    found = skew((1, 0, 1, 0))
    wrong = tuple(replace(s, choices=tuple(Choice(c.joint) for c in s.choices)) for s in found.solutions)
    with pytest.raises(Unable, match="no certificate was found"):
        inverse_certificate(replace(found, solutions=wrong))


def test_a_producer_with_another_length_gets_no_certificate() -> None:
    found = case("scara")
    lower = solve_pose(SLIDING["scara"], (300, 50, 299), rotation_of((0, 1, 0, 0)))
    with pytest.raises(Unable, match="no certificate was found"):
        inverse_certificate(replace(found, solutions=lower.solutions))
