"""Limits of joints along whole paths: what samples miss, what touches, and what certificates say of it."""

from __future__ import annotations

import random
from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from math import tau
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bezier.arm.command import certify, in_words
from bezier.arm.evidence import ALL, certificates
from bezier.arm.follow import Branch
from bezier.arm.inverse import solve
from bezier.arm.joint_path import JointPath, joint_path
from bezier.arm.joint_plan import joint_plan
from bezier.arm.kinematics import positions
from bezier.arm.model import Arm, JointKind
from bezier.arm.reader import load_arm
from bezier.arm.study import ends_of, study
from bezier.curves.curve import Bezier
from bezier.motion.timelaw import Law, TimeLaw
from qe.certify.verify import verify
from qe.errors import Unable
from qe.proof.certificate import Certificate
from tests.bezier.arm.arms import Limits, limited
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
    text, _ = certify(None, CYLINDER, dict(found.curves), json=False)  # type: ignore[arg-type]
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


@each((4, 4), *(pytest.param(100 + part, 50, marks=pytest.mark.deep) for part in range(8)))
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
    text, is_followed = joints(None, CYLINDER, curves, **wanted, **places)  # type: ignore[arg-type]
    assert (
        not is_followed
        and "(none of motions held by boxes" in text
        and "lift &gt; 250" in (tmp_path / "joints.html").read_text()
    )
