"""Limits of joints along whole paths: what samples miss, what touches, and motions that boxes do not hold."""

from __future__ import annotations

import json
import random
from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from math import tau
from pathlib import Path
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bezier.arm.command import certify, in_words
from bezier.arm.continuous import ContinuousMotion
from bezier.arm.evidence import ALL, certificates, without_certificate
from bezier.arm.follow import Branch
from bezier.arm.inverse import solve
from bezier.arm.joint_path import JointPath, joint_path
from bezier.arm.joint_plan import joint_plan
from bezier.arm.kinematics import positions, wrapped
from bezier.arm.model import Arm, JointKind
from bezier.arm.reader import load_arm
from bezier.arm.study import ends_of, study
from bezier.arm.vertical import vertical_arm
from bezier.curves.curve import Bezier
from bezier.motion.timelaw import Law, TimeLaw
from bezier.proofs.joint_motions import Label
from qe.certify.verify import verify
from qe.errors import Unable
from qe.processes.channel import Channel
from qe.proof.certificate import Certificate
from tests.bezier.made import Limits, Points, curves_of, limited
from tests.tables import each

CYLINDER = load_arm("cylindrical")
NAMES = ("cylindrical", "shoulder-3r", "ev3-120")


def path(arm: Arm, *points: Sequence[object]) -> JointPath:
    return joint_path(arm, {"curve": Bezier.of([tuple(map(Fraction, p)) for p in points])})


def of_motions(found: JointPath) -> list[tuple[str, Certificate]]:
    return [(label, certificate) for label, certificate in certificates(found) if label != ALL]


def all_accepted(found: JointPath) -> bool:
    listed = of_motions(found)
    return len(listed) == sum(not r.excesses for r in found.runs) and all(verify(c).accepted for _, c in listed)


def test_a_path_outside_all_limits_is_not_reachable() -> None:
    """ "every point can be reached" was said of it, with two motions and their certificates."""
    found = path(CYLINDER, (900, 0, 100), (900, 100, 900))
    assert not found.is_reachable and not found.whole_runs and of_motions(found) == [] and found.allowed_count == 0
    text = "\n".join(certify(None, CYLINDER, dict(found.curves))[1])  # type: ignore[arg-type]
    assert "NOT reachable within the limits of the joints from s = 0 on" in text
    assert "reach > 300, its limit, for curve s in (0, 1)" in text and "none of them within the limits" in text
    assert "accepted (none of motions held by boxes, within the limits; one of the number of all motions" in text
    assert in_words(solve(CYLINDER, (900, 0, 100)))[-1] == "no joint position is within the limits of the joints"


@each(("1e-9", False), ("-1e-9", True), ("0", True), ("14", False))
def test_what_happens_between_two_samples_counts(beyond: str, keeps: bool) -> None:
    """The lift is highest halfway, 250 mm and ``beyond``; samples were all that was looked at."""
    top = Fraction(600) + 2 * Fraction(beyond)
    curve = {"curve": Bezier.of([(20, -300, 100), (20, -200, top), (20, -300, 100)])}
    plan = joint_plan(CYLINDER, curve, TimeLaw.of(Law.QUINTIC), Fraction(50), 4)
    found = plan.path
    assert found.is_reachable is keeps and len(found.whole_runs) == keeps and all_accepted(found)
    assert plan.is_followed is keeps
    if not keeps:
        (gap,) = found.studies[0].gaps
        away = Fraction(beyond) / (1000 + 4 * Fraction(beyond))  # the lift is 250 + b - (1000 + 4 b) (s - 1/2)²
        for place in (gap.low, gap.high):
            low, high = ends_of(place, 200)
            assert low <= high and abs((sum((low, high)) / 2 - Fraction(1, 2)) ** 2 - away) < Fraction(1, 10**40)


@pytest.mark.parametrize("end", [(30, -200, 350), (20, -200, 100), (20, -200, 350)])
def test_a_path_along_a_limit_keeps_it(end: tuple[int, int, int]) -> None:
    start = (20, -300, end[2] if end[2] == 350 else 100)
    found = path(CYLINDER, start, end)
    assert found.is_reachable and len(found.whole_runs) == 1 and all_accepted(found)


def test_an_angle_stays_at_its_limit_0() -> None:
    """θ1 = 0 on the whole line: sine and cosine are rational at this limit alone."""
    arm = limited(load_arm("ev3-120"), (Fraction(0), Fraction(3)), None, None)
    found = path(arm, (160, 0, 150), (180, 0, 170))
    assert found.is_reachable and all_accepted(found) and len(found.whole_runs) == 2
    assert not path(arm, (160, "-1e-9", 150), (180, 0, 170)).whole_runs


def test_full_turns_bring_an_angle_between_its_limits() -> None:
    """θ2 = -2.9 is 3.38 within [-1/2, 7/2]: the certificate is about this one."""
    arm = load_arm("shoulder-3r")
    point = positions(arm, [[0.3, 3.38, 0.4]])[0]
    start = tuple(Fraction(round(float(c))) for c in point)
    found = path(arm, start, [c + 1 for c in start])
    assert any(run.turns[1] for run in found.whole_runs) and all_accepted(found)
    plan = joint_plan(arm, found.curves, TimeLaw.of(Law.QUINTIC), Fraction(50), 5)
    assert plan.sequence is not None and all(-0.5 <= q[1] <= 3.5 for q in plan.sequence.angles)


def test_a_motion_of_more_than_a_turn_is_beyond_its_limits() -> None:
    """Every single angle is allowed where the limits are more than a turn apart; a motion is not."""
    arm = limited(CYLINDER, (Fraction(-33, 10), Fraction(33, 10)), None, None)
    turn = [(0, -200), (200, -200), (200, 0), (200, 200), (0, 200), (-200, 200), (-200, 0), (-200, -200), (0, -200)]
    curves = {f"c{k}": Bezier.of([(*a, 100), (*b, 100)]) for k, (a, b) in enumerate(pairwise(turn))}
    again = joint_path(arm, {**curves, "more": Bezier.of([(0, -200, 100), (200, -200, 100)])})
    assert again.is_reachable and not again.whole_runs
    once = joint_path(arm, dict(list(curves.items())[:6]))
    assert len(once.whole_runs) == 1 and all_accepted(once)


def test_a_sequence_prefers_a_motion_within_the_limits() -> None:
    """The other motion changes the joints less, but passes a limit between two samples."""
    arm = limited(load_arm("ev3-120"), None, None, None)
    free = path(arm, (10, 40, 80), (40, 100, 20))
    plan = joint_plan(arm, free.curves, TimeLaw.of(Law.QUINTIC), Fraction(50), 6)
    assert plan.sequence is not None and plan.sequence.run is not None
    best = next(r for r in free.runs if r.number == plan.sequence.run)
    middle = Fraction(best.branch(0).at(Fraction(1, 2))[1])  # type: ignore[union-attr]
    for limits in ((middle, Fraction(20)), (Fraction(-20), middle)):
        bound = limited(arm, None, limits, None)
        found = joint_plan(bound, free.curves, TimeLaw.of(Law.QUINTIC), Fraction(50), 6)
        if found.path.whole_runs:
            assert found.sequence is not None
            assert found.sequence.run in [r.number for r in found.path.whole_runs]
        assert found.is_followed is bool(found.path.whole_runs)


@settings(max_examples=12)
@given(st.randoms(use_true_random=False))
def test_solutions_within_the_limits_are_counted_for_every_s(rng: random.Random) -> None:
    choices = [Fraction(v) for v in ("-3", "-2", "-1", "0", "1/2", "1", "2", "3", "7/2", "5", "7")]
    arm = load_arm(rng.choice(NAMES))
    limits: list[Limits] = []
    for joint in arm.joints:
        ends = sorted(rng.sample(choices, 2))
        scale = 1 if joint.motion is JointKind.REVOLUTE else 60
        limits.append(rng.choice((None, (scale * ends[0], scale * ends[1]))))
    try:
        found = study(limited(arm, *limits), curve_near(arm, rng))
    except Unable:
        return
    for _ in range(6):
        s = Fraction(rng.randrange(1, 1000), 1000)
        (part,) = (p for p in found.within if ends_of(p.low)[1] < s < ends_of(p.high)[0])
        assert solve(found.arm, found.curve.point(s)).allowed_count == part.count


def curve_near(arm: Arm, rng: random.Random) -> Bezier:
    """A curve near a point that the arm reaches; sometimes in the plane y = 0 or at one height."""
    q = [rng.uniform(-3, 3) if j.motion is JointKind.REVOLUTE else rng.uniform(40, 300) for j in arm.joints]
    centre = [round(float(c)) for c in positions(arm, [q])[0]]
    points = [[c + rng.randint(-60, 60) for c in centre] for _ in range(rng.choice((2, 3, 3, 4)))]
    still = rng.choice((None, None, None, 1, 2))
    return Bezier.of(
        [tuple(Fraction(centre[2] * (k == 2) if k == still else c) for k, c in enumerate(p)) for p in points]
    )


def greatest(arm: Arm, curve: Bezier, branch: Branch, joint: int) -> Fraction | None:
    """The greatest value of a joint along a branch to about 1e-12, where that lies within the curve."""

    def value(s: Fraction) -> Fraction:
        (solution,) = (x for x in solve(arm, curve.point(s)).solutions if branch.contains(s, x))
        refined = solution.refined(joint, 100)
        assert refined is not None
        exact = refined.ends[0]
        turns = round((branch.at(s)[joint] - float(exact)) / tau) if refined.pair is not None else 0
        return exact + turns * 2 * Fraction("3.14159265358979323846264338327950288")

    grid = [Fraction(k, 32) for k in range(33)]
    values = [value(s) for s in grid]
    k = values.index(max(values))
    if k in (0, 32):
        return None
    low, high = grid[k - 1], grid[k + 1]
    while high - low > Fraction(1, 1 << 24):
        a, b = (2 * low + high) / 3, (low + 2 * high) / 3
        a, b = Fraction(round(a * 2**40), 2**40), Fraction(round(b * 2**40), 2**40)
        low, high = (a, high) if value(a) < value(b) else (low, b)
    return value((low + high) / 2)


def close_passes(rng: random.Random) -> int:
    """A path whose joint stays below a limit by 1e-1 to 1e-9 and passes another one by as much; how many were tried."""
    arm = limited(load_arm(rng.choice(NAMES)))
    joint, curve = rng.randrange(3), curve_near(arm, rng)
    try:
        free = joint_path(arm, {"curve": curve})
    except Unable:
        return 0
    if not free.whole_runs:
        return 0
    run = rng.choice(free.whole_runs)
    turns = arm.joints[joint].motion is JointKind.REVOLUTE
    top = greatest(arm, curve, run.parts[0][1], joint)
    if top is None or abs(top) > 20:
        return 0
    for side in (1, -1):
        limit = Fraction(round((top + side * Fraction(1, 10 ** rng.randint(1, 9))) * 10**13), 10**13)
        limits: list[Limits] = [None] * 3
        limits[joint] = (limit - (6 if turns else 2000), limit)
        found = joint_path(limited(arm, *limits), {"curve": curve})
        mine = next(r for r in found.runs if r.parts[0][1] == run.parts[0][1])
        passed = [e for e in mine.excesses if e.limit == limit]
        assert bool(passed) == (side < 0), (curve, limits)
        assert all_accepted(found), (curve, limits)
        if passed:  # the exact place: the joint is at its limit there
            assert all(0 <= ends_of(e.low)[0] <= ends_of(e.high)[1] <= 1 for e in passed)
    return 2


@each((4, 1), *(pytest.param(100 + part, 50, marks=pytest.mark.deep) for part in range(8)))
def test_closeness_to_a_limit_is_decided(seed: int, paths: int) -> None:
    rng, tried = random.Random(seed), 0
    while tried < paths:
        tried += close_passes(rng)


def test_the_files_of_a_path_beyond_its_limits(tmp_path: Path) -> None:
    """A page and data are written, without certificates."""
    from bezier.planner.arm import joints

    curves = path(CYLINDER, (20, -300, 100), (20, -200, 700), (20, -300, 100)).curves
    wanted = {"law": TimeLaw.of(Law.QUINTIC), "duration": Fraction(50), "samples": 4}
    places = {"file": "path.toml", "folder": tmp_path, "target": tmp_path}
    _, lines, is_followed = joints(None, CYLINDER, curves, **wanted, **places)  # type: ignore[arg-type]
    assert (
        not is_followed
        and "(none of motions held by boxes" in "\n".join(lines)
        and "lift &gt; 250" in (tmp_path / "joints.html").read_text()
    )


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
    daily=2,
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
    data, lines, *_ = certify(Channel(print), arm, curves)
    text = "\n".join(lines)
    assert "4 continuous joint motions from start to goal (proved" in text
    assert "2 of them within the limits of the joints for all s (decided exactly)" in text
    assert "one of the number of all motions, limits left aside" in text
    assert text.count("that it keeps the limits is decided, and not certified") == 2
    assert (data["motions"]["count"], data["motions"]["count_within_limits"]) == (4, 2)
    beyond = {str(m["number"]) for m in data["motions"]["listed"] if m["beyond_limits"]}
    assert len(beyond) == 2 and {*data["without_certificate"]} == {"1", "2", "3", "4"} - beyond


@each(
    (0, "6.2831", 0),
    (0, "6.2832", 2),
    *(
        pytest.param(*row, marks=pytest.mark.deep)
        for row in (("-3.1416", "3.1416", 2), (-7, 7, 4), (0, 7, 2), ("-6.2832", 0, 2), (-3, 4, 0))
    ),
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
    data = certify(Channel(print), arm, curves)[0]
    assert data["without_certificate"] == missing
    law = TimeLaw.of(Law.QUINTIC)
    places = {"file": "path.toml", "folder": tmp_path, "target": tmp_path}
    _, lines, is_followed = joints(Channel(print), arm, curves, law=law, duration=F(50), samples=4, **places)
    text = "\n".join(lines)
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


@each((range(1, len(PATHS), 9), 3), pytest.param(range(500), 1000, marks=pytest.mark.deep))
def test_motions_within_random_limits_are_those_of_samples(seeds: range, judged_at_least: int) -> None:
    assert sum(check_random(seed) for seed in seeds) >= judged_at_least
