"""Certificates of joint positions where a joint can be chosen: right ranges are accepted, changed ones are not; poses
of arms with joints that slide."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from functools import cache
from math import cos, pi, sin, sqrt
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bezier.arm import inverse_evidence
from bezier.arm.choices import Choice
from bezier.arm.inverse import Inverse, solve
from bezier.arm.inverse_evidence import inverse_certificate
from bezier.arm.kinematics import pose
from bezier.arm.model import Arm, JointKind
from bezier.arm.pose import rotation_of, solve_pose
from bezier.arm.reader import load_arm, read_arm
from bezier.certify.families import bounded
from bezier.certify.nested_roots import nested
from bezier.certify.square_roots import Surd
from qe.certify.claims import claim_of
from qe.errors import Unable
from tests.bezier.arm.test_choices import PLANAR, SKEW_WRIST, STILL
from tests.bezier.arm.test_pose import SIX, SKEW_FREE, arm_of, at_the_pose_of, pairs_of
from tests.bezier.arm.test_wrist import FLAT, FOLDED, PUMA, pairs_with
from tests.certificates.restated import evidence_of, verdict_by
from tests.certificates.test_inverse_position import accepted

Payload = dict[str, Any]


def made(found: Inverse) -> Payload:
    payload: Payload = evidence_of(inverse_certificate(found))
    assert payload["count"] == found.count and accepted(payload)
    return payload


def last_parallel(along: str) -> Inverse:
    m = pose(SIX, {f"theta{k}": (0, -1) if k == 5 else (1, 0) for k in range(1, 7)})
    return solve_pose(SIX, (Fraction(along), m[1][3], Fraction("131.22")), [row[:3] for row in m])


def skew(quaternion: tuple[int, ...], height: int = 100) -> Inverse:
    rotation = rotation_of(quaternion)
    return solve_pose(SKEW_WRIST, [17 * row[2] + height * (k == 2) for k, row in enumerate(rotation)], rotation)


def still() -> Inverse:
    at = pose(STILL, {"q1": (Fraction(3, 5), Fraction(4, 5)), "q2": (Fraction(4, 5), Fraction(3, 5)), "q3": (1, 0)})
    return solve(STILL, [row[3] for row in at])


CASES: dict[str, Callable[[], Inverse]] = {
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
    return CASES[name]()


@cache
def payload_of(name: str) -> Payload:
    """Of a case, accepted; whoever changes it takes a copy."""
    return made(case(name))


# --- accepted ------------------------------------------------------------------------------------------------------
def families(payload: Payload) -> list[Any]:
    over = [s for root in payload.get("roots", ()) for s in root["solutions"]]
    return [s for s in over or payload.get("solutions", ()) if isinstance(s, dict)]


@pytest.mark.parametrize("name", CASES)
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
@given(st.lists(st.fractions(-4, 4, max_denominator=3), min_size=6, max_size=6), st.integers(0, 1))
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


# --- rejected ------------------------------------------------------------------------------------------------------
def _family(p: Payload) -> Any:
    return families(p)[0]


def _range(p: Payload) -> Any:
    return _family(p)["chosen"][0]


def _moved(ends: Any) -> Any:
    return [[str(Fraction(v) + Fraction(1, 1000)) for v in part] for part in ends]


EVERY: dict[str, Callable[[Payload], object]] = {
    "a number of solutions": lambda p: p.update(count=len(families(p))),
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
    "a joint that slides": lambda p: p["arm"]["rows"][0].update(joint="prismatic"),
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


@pytest.mark.parametrize("name", CASES)
def test_changed_certificates_are_rejected(name: str) -> None:
    payload = payload_of(name)
    arcs = _range(payload)[1]
    changes = {**EVERY, **(ARCS if arcs else {}), **(MARKS if "marks" in payload else {})}
    if arcs and arcs[0][0] == arcs[0][1]:
        del changes["the other way round"]
    for what, change in changes.items():
        changed = json.loads(json.dumps(payload))
        change(changed)
        assert not verdict_by("joint positions", changed).accepted, what


def test_a_family_left_out() -> None:
    payload = payload_of("skew wrist")
    for root in payload["roots"]:
        changed = json.loads(json.dumps(payload))
        changed["roots"][payload["roots"].index(root)]["solutions"] = []
        assert not accepted(changed)


@pytest.mark.parametrize("name", ["two arcs", "one arc", "skew wrist", "last axis parallel"])
def test_a_producer_with_wrong_ranges_gets_no_certificate(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(inverse_evidence, "ATTEMPTS", inverse_evidence.ATTEMPTS[:1])
    found = CASES[name]()
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


# --- poses of arms with joints that slide --------------------------------------------------------------------------
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


@pytest.mark.parametrize("name", SLIDING)
@settings(max_examples=3)
@given(st.lists(st.fractions(-4, 4, max_denominator=3), min_size=6, max_size=6))
def test_poses_that_joints_made(name: str, numbers: list[Fraction]) -> None:
    arm = SLIDING[name]
    pairs = [v if j.motion is JointKind.REVOLUTE else 7 * t for v, t, j in zip(pairs_of(numbers), numbers, arm.joints)]
    m = pose(arm, dict(zip((j.name for j in arm.joints), pairs)))
    try:
        found = solve_pose(arm, [row[3] for row in m], [row[:3] for row in m])
    except Unable as error:
        assert "can be chosen" in str(error)
        return
    if not found.free:
        assert any(all(_is(v, w) for v, w in zip(s.values, pairs)) for s in found.solutions)
    made(found)


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


SCARA: dict[str, Callable[[Payload], object]] = {
    "another length of the rod": lambda p: p["solutions"][0].__setitem__(2, [["20", "21"]]),
    "a solution left out": lambda p: p["solutions"].pop(),
    "the count": lambda p: (p["solutions"].pop(), p.update(count=1)),
    "another height": lambda p: p["point"].__setitem__(2, [["301", 1]]),
    "a joint that turns": lambda p: p["arm"]["rows"][2].update(joint="revolute"),
    "a tilt": lambda p: p["arm"]["rows"][0].update(alpha=1),
    "two slides": lambda p: p["arm"]["rows"][0].update(joint="prismatic"),
}


@pytest.mark.parametrize("what", SCARA)
def test_changed_certificates_of_a_scara_are_rejected(what: str) -> None:
    payload = made(solve_pose(SLIDING["scara"], (300, 50, 300), rotation_of((0, 1, 0, 0))))
    SCARA[what](payload)
    assert not verdict_by("joint positions", payload).accepted


def test_a_producer_with_another_length_gets_no_certificate() -> None:
    found = solve_pose(SLIDING["scara"], (300, 50, 300), rotation_of((0, 1, 0, 0)))
    lower = solve_pose(SLIDING["scara"], (300, 50, 299), rotation_of((0, 1, 0, 0)))
    with pytest.raises(Unable, match="no certificate was found"):
        inverse_certificate(replace(found, solutions=lower.solutions))


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


# --- the inequality ------------------------------------------------------------------------------------------------
@settings(max_examples=40)
@given(*[st.integers(-5, 5)] * 3, st.integers(1, 9))
def test_angles_with_a_bounded_wave(a: int, b: int, c: int, square: int) -> None:
    arcs = bounded(*(nested(Surd.rational(v)) for v in (a, b, c, square)))
    ends = [] if arcs is None else [[_direction(end) for end in arc] for arc in arcs]
    for k in range(24):
        angle = k * 2 * pi / 24 + 0.05
        value = abs(a * cos(angle) + b * sin(angle) + c) - sqrt(square)
        if abs(value) > 1e-9:
            held = arcs is None or any((angle - low) % (2 * pi) <= (high - low) % (2 * pi) for low, high in ends)
            assert held == (value < 0)


def _direction(joint: Any) -> float:
    from math import atan2

    c, s = (sum(map(float, ends)) / 2 for ends in joint.intervals() or ())
    return atan2(s, c)
