"""Limits of joints along motions that boxes do not hold: through the axis and through places where solutions meet."""

from __future__ import annotations

import json
from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from math import tau
from pathlib import Path
from random import Random

import pytest

from bezier.arm.command import certify
from bezier.arm.continuous import ContinuousMotion
from bezier.arm.evidence import certificates, without_certificate
from bezier.arm.inverse import solve
from bezier.arm.joint_path import JointPath, joint_path
from bezier.arm.joint_plan import joint_plan
from bezier.arm.kinematics import wrapped
from bezier.arm.model import Arm, JointKind
from bezier.arm.reader import load_arm
from bezier.arm.vertical import vertical_arm
from bezier.certify.joint_motions import Label
from bezier.motion.timelaw import Law, TimeLaw
from qe.processes.channel import Channel
from tests.bezier.arm.arms import Limits, Points, curves_of, limited
from tests.tables import each

F = Fraction
E, S, C = "ev3-120", "shoulder-3r", "cylindrical"
THROUGH: Points = [(-100, 0, 100), (100, 0, 100)]
TANGENT: Points = [(-100, 30, 100), (100, 30, 100)]


# θ1 is 0 or π along the line through the axis, for two elbows each
@each(
    ((-1, 1), 2),
    ((0, 1), 2),
    ((-1, 0), 2),
    (("1/1000000000", 1), 0),
    ((-1, "-1/1000000000"), 0),
    (("3.141592653", "3.141592654"), 2),
    (("3.141592654", "3.141592655"), 0),
    ((3, 6), 2),
    ((3, "6.2831"), 2),
    ((3, "6.2832"), 4),
    ((-3, 3), 2),
    ((-4, 3), 4),
    ((1, 2), 0),
    ((0, 7), 4),
    ((-20, -10), 4),
)
def test_a_side_of_the_axis_is_allowed_or_forbidden(limits: Limits, kept: int) -> None:
    plan = joint_plan(limited(load_arm(E), limits), curves_of(THROUGH), TimeLaw.of(Law.QUINTIC), F(10), 11)
    found = plan.path
    assert found.count == 4 and found.allowed_count == kept and found.is_reachable is (kept > 0)
    assert plan.is_followed is (kept > 0)
    assert limits is not None
    if plan.sequence is not None:
        assert plan.sequence.run in found.kept_numbers and not plan.sequence.switches
        low, high = (float(F(str(v))) for v in limits)
        assert all(low - 1e-9 <= q[0] <= high + 1e-9 for q in plan.sequence.angles)


def test_limits_were_left_aside_through_the_axis() -> None:
    """All 4 motions were counted, and no word said of those that θ1 forbids."""
    arm, curves = limited(load_arm(E), (-1, 1)), curves_of(THROUGH)
    text, _ = certify(Channel(print), arm, curves, json=False)
    assert "4 continuous joint motions from start to goal (proved" in text
    assert "2 of them within the limits of the joints for all s (decided exactly)" in text
    assert "one of the number of all motions, limits left aside" in text
    assert text.count("that it keeps the limits is decided, and not certified") == 2
    data = json.loads(certify(Channel(print), arm, curves, json=True)[0])
    assert (data["motions"]["count"], data["motions"]["count_within_limits"]) == (4, 2)
    beyond = {str(m["number"]) for m in data["motions"]["listed"] if m["beyond_limits"]}
    assert len(beyond) == 2 and {*data["without_certificate"]} == {"1", "2", "3", "4"} - beyond


@each(
    (0, 7, 2),
    (0, "6.2831", 0),
    (0, "6.2832", 2),
    ("-6.2832", 0, 2),
    (-3, 4, 0),
    ("-3.1415", "3.1415", 0),
    ("-3.1416", "3.1416", 2),
    (-7, 7, 4),
)
def test_a_turn_round_the_axis_and_into_it(low: str, high: str, kept: int) -> None:
    """θ1 turns from 0 to 2π for one sign of the distance, from -π to π for the other one: every angle may be allowed
    without a motion."""
    ring = [(100, 0), (0, 100), (-100, 0), (0, -100), (100, 0), (0, 0)]
    curves = curves_of(*([(*a, 100), (*b, 100)] for a, b in pairwise(ring)))
    found = joint_path(limited(load_arm(E), (low, high)), curves)
    assert found.is_reachable and found.count == 4 and found.allowed_count == kept
    assert found.is_stopped is (kept == 0)


def test_an_elbow_is_forbidden_on_one_side_of_a_tangent() -> None:
    """8 motions mix two elbows at the inner border; each elbow has one sign of θ3."""
    free = joint_path(limited(load_arm(S)), curves_of(TANGENT))
    assert free.count == free.allowed_count == 8
    bent = joint_path(limited(load_arm(S), None, None, (0, 4)), curves_of(TANGENT))
    assert bent.count == 8 and bent.allowed_count == judged(bent).count(True) == 2
    assert len(bent.limited.listed) == 8 if bent.limited is not None else False


def test_closeness_that_boxes_do_not_tell_is_said_in_data_and_by_joints(tmp_path: Path) -> None:
    """Only the text of certify-path said it."""
    from bezier.planner.arm import joints

    curves = curves_of([(150, 20, 120), (170, 60, 150), (150, 90, 120)])
    free = joint_path(limited(load_arm(E)), curves)
    run = free.whole_runs[0]
    start = next(
        x for x in solve(free.arm, curves["curve 0"].point(F(0))).solutions if run.parts[0][1].contains(F(0), x)
    )
    value = start.refined(0, 200)
    assert value is not None
    close = F(value.ends[0]) - F(1, 10**25)
    arm = limited(load_arm(E), (close, close + 3))
    found = joint_path(arm, curves)
    missing = without_certificate(found, certificates(found))
    assert (
        found.allowed_count and missing and set(missing.values()) == {"a joint comes closer to a limit than boxes tell"}
    )
    data = json.loads(certify(Channel(print), arm, curves, json=True)[0])
    assert data["without_certificate"] == missing
    law = TimeLaw.of(Law.QUINTIC)
    places = {"file": "path.toml", "folder": tmp_path, "target": tmp_path}
    text, is_followed = joints(Channel(print), arm, curves, law=law, duration=F(50), samples=4, **places)
    assert is_followed and all(f"none of motion {n}: a joint comes closer" in text for n in missing)
    assert json.loads((tmp_path / "joints.json").read_text())["without_certificate"] == missing


# --- against sampled motions ------------------------------------------------------------------------------------------


Sampled = dict[Label, list[float]]


def sampled(found: JointPath) -> list[tuple[int, Sampled]]:
    """The solutions by their labels at some parameters of each arc, more near the ends, where solutions meet."""
    plane, listed = vertical_arm(found.arm), list(found.curves.values())
    assert plane is not None and found.motions is not None
    rows = []
    for k, arcs in enumerate(found.motions.arcs):
        low, high = (s if isinstance(s, F) else s.interval(60)[0] for s in (arcs.low, arcs.high))
        for t in (F(-1) + F(1, 10**4), *(F(n, 6) for n in range(-5, 6)), F(1) - F(1, 10**4)):
            s = (low + high) / 2 + (high - low) / 2 * t * (3 - t * t) / 2
            solutions = solve(found.arm, listed[arcs.curve].point(s)).solutions
            rows.append((k, {plane.label(x): [float(a) for a in x.angles if a is not None] for x in solutions}))
    return rows


def along(found: JointPath, motion: ContinuousMotion, samples: list[tuple[int, Sampled]]) -> list[list[float]]:
    """The joints of a motion at these parameters, angles without jumps."""
    rows = list[list[float]]()
    for k, by_label in samples:
        row = by_label[motion.labels[k]]
        if rows:
            pairs = zip(found.arm.joints, rows[-1], row, strict=True)
            row = [a + wrapped(b - a) if j.motion is JointKind.REVOLUTE else b for j, a, b in pairs]
        rows.append(row)
    return rows


def judged(found: JointPath) -> list[bool | None]:
    """Whether each motion keeps the limits, by samples."""
    assert found.motions is not None
    samples = sampled(found)
    return [keeps(found.arm, along(found, motion, samples)) for motion in found.motions.motions]


def keeps(arm: Arm, rows: Sequence[Sequence[float]]) -> bool | None:
    """Whether a sampled motion, full turns added, is between the limits; None where that is close."""
    verdicts = []
    for k, joint in enumerate(arm.joints):
        if joint.limits is None:
            continue
        low, high = min(r[k] for r in rows), max(r[k] for r in rows)
        shifts = [0.0] if joint.motion is JointKind.PRISMATIC else [tau * n for n in range(-9, 10)]
        ends = tuple(map(float, joint.limits))
        spare = max(min(low + x - ends[0], ends[1] - high - x) for x in shifts)
        verdicts.append(None if abs(spare) < 0.02 else spare > 0)
    return False if False in verdicts else None if None in verdicts else True


ROUND = [(90, 0), (90, 90), (-90, 90), (-90, -90), (90, -90), (90, 0), (0, 0), (-40, 0)]
PATHS: list[tuple[str, list[Points]]] = [
    (E, [THROUGH]),
    (E, [[(-50, -50, 100), (50, 50, 200)]]),
    (E, [[(-50, 25, 100), (0, -25, 100), (50, 25, 100)]]),
    (E, [[(100, 0, 100), (-100, 0, 100), (100, 0, 100)]]),
    (E, [[(150, -50, 90), (-50, 50, 90), (-50, -50, 90), (150, 50, 90)]]),
    (E, [[(100, 0, 166), (350, 0, 166), (100, 0, 166)]]),
    (E, [[(-100, "1/100000", 100), (100, "1/100000", 100)]]),
    (E, [[(10, 40, 80), (40, 100, 20)]]),
    (
        E,
        [[(*a, 100), (*b, 120)] if k % 2 else [(*a, 120), (*b, 100)] for k, (a, b) in enumerate(pairwise(ROUND))],
    ),
    (S, [TANGENT]),
    (S, [[(-100, 0, 130), (100, 0, 130)]]),
    (S, [[(100, 0, 200), (-100, 0, 200)]]),
    (C, [[(100, 20, 200), (-100, 20, 200)]]),
    (C, [[(100, 21, 200), (-100, 21, 260)]]),
]


def check_random(seed: int) -> int:
    """Random limits along a path; how many motions were judged."""
    random = Random(seed)
    name, curves = PATHS[seed % len(PATHS)]
    limits: list[Limits] = []
    for joint in load_arm(name).joints:
        low = random.choice([random.uniform(-7, 4), -3, 0, random.uniform(-3.2, 0)])
        wide = random.choice(
            [random.uniform(0.5, 3), random.uniform(2, 6), random.uniform(5, 9), random.uniform(9, 14)]
        )
        ends = (
            (low, low + wide) if joint.motion is JointKind.REVOLUTE else (30 * low + 100, 30 * (low + 3 * wide) + 100)
        )
        listed = (round(F(ends[0]), 3), round(F(ends[1]), 3))
        limits.append(listed if random.random() < 0.6 else None)
    found = joint_path(limited(load_arm(name), *limits), curves_of(*curves))
    assert found.motions is not None and found.limited is not None and found.count == found.motions.count
    verdicts = judged(found)
    for verdict, motion in zip(verdicts, found.motions.motions, strict=True):
        assert verdict is None or verdict is not bool(found.limited.listed[motion.number].excesses), (seed, motion)
    kept = sum(not k.excesses for k in found.limited.listed.values())
    assert found.limited.count == kept and found.allowed_count == kept and (found.is_reachable or not kept)
    for run in found.covering_runs:  # what boxes hold is judged on its own
        assert bool(run.excesses) == bool(found.limited.listed[run.number].excesses)
    assert found.kept_numbers == {n for n, k in found.limited.listed.items() if not k.excesses}
    return sum(verdict is not None for verdict in verdicts)


@each((range(1, len(PATHS), 2), 20), pytest.param(range(500), 1000, marks=pytest.mark.deep))
def test_motions_within_random_limits_are_those_of_samples(seeds: range, judged_at_least: int) -> None:
    assert sum(check_random(seed) for seed in seeds) >= judged_at_least
