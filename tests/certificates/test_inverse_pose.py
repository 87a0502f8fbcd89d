"""Certificates of joint positions at poses, and for joints that slide: right ones are accepted, others are not."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from math import sqrt
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bezier.arm import inverse_evidence, pose
from bezier.arm.inverse import Inverse, solve
from bezier.arm.inverse_evidence import inverse_certificate
from bezier.arm.kinematics import position
from bezier.arm.model import JointKind
from bezier.arm.pose import rotation_of, solve_pose
from bezier.arm.reader import load_arm
from bezier.certify.nested_roots import Nested, Place, nested, turns
from bezier.certify.square_roots import ONE, Polynomial, Surd
from qe.certify.claims import claim_of
from qe.errors import Unable
from tests.bezier.arm.test_pose import BACKWARDS, SIX, at_the_pose_of, pairs_of
from tests.bezier.arm.test_prismatic import ARMS, IDS, pair
from tests.bezier.arm.test_wrist import PUMA, STANDARD
from tests.certificates.restated import evidence_of, verdict_by
from tests.certificates.test_inverse_position import accepted

PLANAR, CYLINDER = load_arm("planar-3r"), load_arm("cylindrical")
Change = Callable[[dict[str, Any]], object]


def made(found: Inverse) -> dict[str, Any]:
    payload: dict[str, Any] = evidence_of(inverse_certificate(found))
    assert payload["count"] == found.count and accepted(payload)
    return payload


# --- accepted ----------------------------------------------------------------------------------------------------
TANGENTS = st.lists(st.fractions(-4, 4, max_denominator=3), min_size=6, max_size=6)


@pytest.mark.parametrize("arm", [SIX, BACKWARDS, PUMA, STANDARD, PLANAR], ids=["six", "back", "puma", "skew", "plane"])
@settings(max_examples=2)
@given(TANGENTS)
def test_poses_that_joints_made(arm: Any, tangents: list[Fraction]) -> None:
    try:
        found = at_the_pose_of(arm, pairs_of(tangents)[: len(arm.joints)])
    except Unable as error:
        assert "can be chosen" in str(error)
        return
    made(found)


@pytest.mark.parametrize("arm", ARMS, ids=IDS)
@settings(max_examples=2)
@given(st.lists(st.integers(-7, 7), min_size=3, max_size=3), st.integers(-1, 1))
def test_points_of_arms_with_joints_that_slide(arm: Any, numbers: list[int], aside: int) -> None:
    values = [pair(k) if j.motion is JointKind.REVOLUTE else Fraction(7 * k, 2) for k, j in zip(numbers, arm.joints)]
    point = position(arm, dict(zip((j.name for j in arm.joints), values)))
    try:
        found = solve(arm, [c + 20 * aside for c in point])
    except Unable as error:
        assert "slide along one direction" in str(error)
        return
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
    assert made(solve(CYLINDER, (10, 2, 150)))["count"] == 0


def test_a_wrist_that_does_not_reach_the_rotation_over_an_arm_that_reaches_the_point() -> None:
    payload = made(solve_pose(STANDARD, (90, 30, 70), rotation_of((1, 1, 0, 0))))
    assert any(not root["solutions"] for root in payload["roots"]) or payload["count"] == 8
    payload["roots"] = [root for root in payload["roots"] if root["solutions"]]
    assert accepted(payload) == (payload["count"] == 8), "a root without solutions has to be listed, too"


def test_what_it_claims() -> None:
    at_pose = inverse_certificate(solve_pose(PLANAR, (120, 90, 0), rotation_of((2, 0, 0, 1))))
    at_point = inverse_certificate(solve(CYLINDER, (100, 20, 150)))
    first, *rest = claim_of(at_pose).words
    assert first.startswith("the sentence  ex c1_1, s1_1, c2_1, s2_1, c3_1, s3_1, c1_2, s1_2, c2_2, s2_2, c3_2, s3_2. ")
    assert "all c1, s1, c2, s2, c3, s3. (not (c1^2 + s1^2 - 1 = 0 and" in first
    assert rest == ["is true", "by joint positions"] and at_pose.trusts == ("joint positions",)
    assert "ex c1_1, s1_1, d2_1, d3_1, c1_2, s1_2, d2_2, d3_2. " in claim_of(at_point).words[0]


# --- rejected ----------------------------------------------------------------------------------------------------
def _slide(p: dict[str, Any], by: Fraction) -> None:
    for solution in (s for root in p["roots"] for s in root["solutions"]):
        solution[1][0] = [str(Fraction(end) + by) for end in solution[1][0]]


def _larger(p: dict[str, Any]) -> None:
    for solution in p.get("solutions") or [s for root in p["roots"] for s in root["solutions"]]:
        for joint in solution:
            joint[:] = [["-1", "1"] for _ in joint]


EVERY: dict[str, Change] = {
    "another length": lambda p: p["arm"]["rows"][1].update(a="123"),
    "another place": lambda p: p["point"].__setitem__(0, [["121", 1]]),
    "the count": lambda p: p.update(count=p["count"] + 1),
    "large boxes": _larger,
    "another field": lambda p: p.update(more=1),
    "no count": lambda p: p.pop("count"),
    "joints that slide": lambda p: p["arm"]["rows"][0].update(joint="prismatic"),
    "another kind of joint": lambda p: p["arm"]["rows"][0].update(joint="screw"),
}
POSE: dict[str, Change] = EVERY | {
    "another rotation": lambda p: p.update(rotation=[[[["1", 1]], [], []], [[], [["1", 1]], []], [[], [], [["1", 1]]]]),
    "no rotation": lambda p: p["rotation"][0].__setitem__(0, [["2", 1]]),
    "a reflection": lambda p: p["rotation"].reverse(),
    "null": lambda p: p.update(rotation=None),
    "two rows": lambda p: p["rotation"].pop(),
}
PARALLEL: dict[str, Change] = POSE | {
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
}
CASES: dict[str, tuple[Callable[[], Inverse], dict[str, Change]]] = {
    "six": (lambda: solve_pose(SIX, (120, 90, 200), rotation_of((2, 1, -1, 1))), PARALLEL),
    "planar": (lambda: solve_pose(PLANAR, (120, 90, 0), rotation_of((2, 0, 0, 1))), PARALLEL),
    "wrist": (lambda: solve_pose(PUMA, (400, 200, 300), rotation_of((2, 1, -1, 1))), POSE | OVER_ROOTS),
    "slides": (
        lambda: solve(CYLINDER, (100, 20, 150)),
        EVERY | OVER_ROOTS | {"a shifted box": lambda p: _slide(p, Fraction(1, 100))},
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_changed_certificates_are_rejected(name: str) -> None:
    find, changes = CASES[name]
    payload = made(find())
    for what, change in changes.items():
        changed = json.loads(json.dumps(payload))
        change(changed)
        verdict = verdict_by("joint positions", changed)
        assert not verdict.accepted, what
    assert len(changes) > 10


@pytest.mark.parametrize("name", CASES)
def test_a_producer_that_loses_or_moves_a_solution_gets_no_certificate(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(inverse_evidence, "ATTEMPTS", inverse_evidence.ATTEMPTS[:1])
    monkeypatch.setattr(pose, "TURNS", pose.TURNS[:1])
    found = CASES[name][0]()
    lost = replace(found, solutions=found.solutions[1:])
    moved = replace(found, solutions=(found.solutions[1], *found.solutions[1:]))
    shifted = replace(found, point=(found.point[0] + Fraction(1, 1000), *found.point[1:]))
    for wrong in (lost, moved, shifted):
        with pytest.raises(Unable, match="no certificate was found"):
            inverse_certificate(wrong)


# --- the arithmetic ----------------------------------------------------------------------------------------------
def root(value: Nested) -> Nested:
    return max(value.square_roots(), key=lambda v: v.sign())


def test_roots_of_constants_are_told_apart() -> None:
    two, three = (root(nested(Surd.rational(k))) for k in (2, 3))
    assert (two * three - root(nested(Surd.rational(6)))).sign() == 0
    assert (two - three).sign() == -1 and (two * two - nested(Surd.rational(2))).sign() == 0


def test_a_nested_root_that_is_none() -> None:
    """sqrt(3 + 2 sqrt 2) = 1 + sqrt 2, and a number that is larger by 10^-200."""
    two = root(nested(Surd.rational(2)))
    whole = root(nested(Surd.rational(3)) + two.by(Surd.rational(2)))
    gap = whole - two - nested(ONE)
    assert gap.sign() == 0
    assert (gap + nested(Surd.rational(Fraction(1, 10**200)))).sign() == 1


@settings(max_examples=20)
@given(st.lists(st.integers(-3, 3), min_size=6, max_size=6))
def test_signs_over_a_root_of_a_polynomial(k: list[int]) -> None:
    """t = sqrt 2 + sqrt 3 as a root of t^4 - 10 t^2 + 1."""
    one, zero = ONE, Surd(())
    place = Place.of(Polynomial((one, zero, Surd.rational(-10), zero, one)), (Fraction(3), Fraction(4)))
    t = nested(place.value(Polynomial((zero, one))))
    m = root(t * t + t.unit)
    value = t.unit.by(Surd.rational(k[0])) + t.by(Surd.rational(k[1])) + (t * t * t).by(Surd.rational(k[2]))
    value = value * m.by(Surd.rational(k[3])) + t.by(Surd.rational(k[4])) + m.by(Surd.rational(k[5]))
    x = sqrt(2) + sqrt(3)
    y = sqrt(x * x + 1)
    near = (k[0] + k[1] * x + k[2] * x**3) * y * k[3] + k[4] * x + k[5] * y
    assert value.sign() == (0 if abs(near) < 1e-9 else 1 if near > 0 else -1)
    assert (value * value - value * value).sign() == 0


def test_zero_over_a_root_that_intervals_do_not_tell() -> None:
    one, zero = ONE, Surd(())
    squared = Polynomial((Surd.rational(-2), zero, one)) * Polynomial((Surd.rational(5), one))
    place = Place.of(squared, (Fraction(1), Fraction(2)))  # sqrt 2, though the modulus is not irreducible
    gap = nested(place.value(Polynomial((Surd.rational(-2), zero, one))))
    assert gap.sign() == 0 and next(iter(gap.square_roots())).sign() == 0


def test_turns() -> None:
    found: Sequence[Any] = list(turns(*(nested(Surd.rational(v)) for v in (1, 2, 2, 1))))
    assert len(found) == 2
    for joint in found:
        assert (joint.c + joint.s.by(Surd.rational(2)) - joint.w.by(Surd.rational(2))).sign() == 0
        assert (joint.c * joint.c + joint.s * joint.s - joint.w * joint.w).sign() == 0
    assert len(list(turns(*(nested(Surd.of([(d, Fraction(v))])) for d, v in ((1, 1), (1, 1), (2, 1), (1, 1)))))) == 1
    assert not list(turns(*(nested(Surd.rational(v)) for v in (1, 1, 3, 1))))
