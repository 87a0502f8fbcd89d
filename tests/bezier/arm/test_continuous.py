"""Continuous joint motions along paths: all of them, also through places where solutions meet, with certificates."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from math import cos, pi, remainder, sin, sqrt
from random import Random
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from bezier.arm.command import certify
from bezier.arm.continuous import ContinuousMotions, continuous_motions
from bezier.arm.evidence import arm_json, certificates, motions_certificate
from bezier.arm.inverse import solve
from bezier.arm.joint_path import joint_path
from bezier.arm.joint_plan import joint_plan
from bezier.arm.model import Arm
from bezier.arm.path_report import in_words
from bezier.arm.reader import load_arm, read_arm
from bezier.arm.study import study
from bezier.arm.vertical import vertical_arm
from bezier.motion.timelaw import Law, TimeLaw
from bezier.proofs.square_roots import Polynomial, Surd, constant_sign
from qe.errors import Unable
from qe.processes.channel import Channel
from tests.bezier.made import Points, curves_of
from tests.certificates.restated import evidence_of, verdict_by
from tests.tables import each

F = Fraction
TURN = '[[row]]\njoint = "theta1"\nd = 100\n'
TEXTS = {
    # upper arm 120, forearm 90 and 20 beside the first axis: the inner border is a cylinder and two spheres
    "offset elbow": TURN + 'alpha = "pi/2"\n[[row]]\njoint = "theta2"\na = 120\nd = 20\n'
    '[[row]]\njoint = "theta3"\na = 90',
    # links of the same length: folded back, the second joint is free
    "equal links": TURN + 'alpha = "pi/2"\n[[row]]\njoint = "theta2"\na = 100\n[[row]]\njoint = "theta3"\na = 100',
    # a boom that turns and slides along a line that passes 15 from its shoulder: reaches 15 and more
    "boom": TURN + 'alpha = "pi/2"\n[[row]]\njoint = "theta2"\na = 15\nalpha = "pi/2"\n[[row]]\njoint = "out"\n'
    'kind = "prismatic"',
    # a lift and a crank of 100: reaches up to 100 from the first axis
    "crank": TURN + '[[row]]\njoint = "lift"\nkind = "prismatic"\nalpha = "pi/2"\n[[row]]\njoint = "theta3"\na = 100',
}  # fmt: skip


@cache
def arm_of(name: str) -> Arm:
    return read_arm(f'name = "{name}"\nconvention = "standard"\n{TEXTS[name]}') if name in TEXTS else load_arm(name)


def motions_of(name: str, *curves: Points) -> ContinuousMotions:
    found = continuous_motions(arm_of(name), curves_of(*curves))
    assert found is not None
    return found


E, S, C = "ev3-120", "shoulder-3r", "cylindrical"
BY_HAND: list[tuple[str, str, list[Points], int]] = [
    # the EV3 arm: for both signs of the distance two elbows; on the axis both signs meet at opposite θ1
    ("through the axis, theta1 constant, the sign changes", E, [[(-100, 0, 100), (100, 0, 100)]], 4),
    ("a tenth of a millimetre past the axis: simple for all s", E, [[(-100, "1/10", 100), (100, "1/10", 100)]], 4),
    ("through the axis elsewhere than in the middle", E, [[(0, -80, 120), (0, 60, 60)]], 4),
    ("through the axis, aslant", E, [[(-50, -50, 100), (50, 50, 200)]], 4),
    ("ends on the axis: theta1 has a limit", E, [[(100, 0, 100), (0, 0, 100)]], 4),
    ("begins on the axis", E, [[(0, 0, 100), (0, 100, 100)]], 4),
    ("a right angle on the axis: theta1 would jump", E,
     [[(-100, 0, 100), (0, 0, 100)], [(0, 0, 100), (0, 100, 100)]], 0),
    ("half a right angle on the axis", E, [[(-100, 0, 100), (0, 0, 100)], [(0, 0, 100), (80, 80, 100)]], 0),
    ("two curves straight through the axis", E, [[(-100, 0, 100), (0, 0, 100)], [(0, 0, 100), (50, 0, 80)]], 4),
    ("to the axis and back: the same sign", E, [[(-100, 0, 100), (0, 0, 100)], [(0, 0, 100), (-50, 0, 80)]], 4),
    ("a curve with a tangent through the axis", E, [[(-50, 25, 100), (0, -25, 100), (50, 25, 100)]], 4),
    ("touches the axis and returns: the same sign", E, [[(100, 0, 100), (-100, 0, 100), (100, 0, 100)]], 4),
    ("a cusp on the axis: one direction on both sides", E,
     [[(150, -50, 90), (-50, 50, 90), (-50, -50, 90), (150, 50, 90)]], 4),
    ("a triple passage of the axis", E, [[(-50, 0, 90), (50, 0, 90), (-50, 0, 90), (50, 0, 90)]], 4),
    ("twice through the axis: 4, each at both places", E, [[(-40, 0, 100), (80, 0, 100), (-40, 0, 100)]], 4),
    ("leaves what is reached", E, [[(100, 0, 100), (400, 0, 100)]], 0),
    ("begins outside", E, [[(400, 0, 100), (390, 0, 100)]], 0),
    ("leaves and returns", E, [[(100, 0, 100), (600, 0, 100), (100, 0, 100)]], 0),
    ("through the hole of one sign: the other one goes on", E, [[(20, 0, 166), (110, 0, 166)]], 2),
    ("ends in that hole", E, [[(110, 0, 166), (62, 0, 166)]], 2),
    ("begins in that hole", E, [[(62, 0, 166), (110, 0, 166)]], 2),
    ("a billionth outside that hole", E, [[("45.28745459", 0, 150), ("45.28745459", 0, 190)]], 4),
    ("a billionth inside it", E, [[("45.28745460", 0, 150), ("45.28745460", 0, 190)]], 2),
    ("one sign ends, the other one goes on", E, [[(100, 0, 166), (250, 0, 166)]], 2),
    ("one sign begins", E, [[(250, 0, 166), (100, 0, 166)]], 2),
    ("one sign ends and begins again", E, [[(100, 0, 166), (350, 0, 166), (100, 0, 166)]], 2),
    ("far out only one sign", E, [[(300, 0, 166), (319, 0, 166)]], 2),
    # the shoulder arm: everything between the spheres of radii 30 and 210 about (0, 0, 100), two elbows, two signs
    ("the inner tangent: each elbow goes on as either", S, [[(-100, 30, 100), (100, 30, 100)]], 8),
    ("a millimetre outside the inner tangent", S, [[(-100, 31, 100), (100, 31, 100)]], 4),
    ("a millimetre inside", S, [[(-100, 29, 100), (100, 29, 100)]], 0),
    ("the inner tangent on the axis: both rules", S, [[(-100, 0, 130), (100, 0, 130)]], 8),
    ("three inner tangents: 2 signs, 2^4 elbows", S,
     [[(-90, 30, 100), (30, 30, 100)], [(30, 30, 100), (30, -30, 100)], [(30, -30, 100), (-90, -30, 100)]], 32),
    ("a parabola that touches the outer border", S, [[(-100, 110, 100), (0, 310, 100), (100, 110, 100)]], 8),
    ("one that stays inside", S, [[(-100, 110, 100), (0, 308, 100), (100, 110, 100)]], 4),
    ("one that leaves", S, [[(-100, 110, 100), (0, 312, 100), (100, 110, 100)]], 0),
    ("a line that touches the outer border from outside: one point is reached", S,
     [[(-9, 210, 100), (9, 210, 100)]], 0),
    ("touches with order four from outside", S,
     [[(-100, "3910/21", 100), (0, "4910/21", 100), (100, "3910/21", 100)]], 0),
    ("from the border inwards: two begin at one position", S, [[(210, 0, 100), (100, 0, 100)]], 4),
    ("a chord from border to border", S, [[(210, 0, 100), (0, 210, 100)]], 4),
    ("touches the inner border where two curves join: elbows as in one", S,
     [[(-100, 30, 100), (0, 30, 100)], [(0, 30, 100), (100, 30, 100)]], 8),
    ("a kink at the inner border", S, [[(-100, 30, 100), (0, 30, 100)], [(0, 30, 100), (0, 100, 100)]], 8),
    ("through the axis of the shoulder arm", S, [[(100, 0, 200), (-100, 0, 200)]], 4),
    # the cylindrical arm: 20 beside the axis, one position for each sign
    ("touches the inner cylinder: either sign goes on as either", C, [[(100, 20, 200), (-100, 20, 200)]], 4),
    ("a millimetre outside the cylinder", C, [[(100, 21, 200), (-100, 21, 200)]], 2),
    ("a millimetre inside", C, [[(100, 19, 200), (-100, 19, 200)]], 0),
    ("begins on the cylinder", C, [[(20, 0, 200), (100, 0, 200)]], 2),
    # arms with other plane parts
    ("touches the cylinder: signs mix, elbows stay", "offset elbow", [[(-90, 20, 200), (90, 20, 200)]], 8),
    ("touches cylinder and inner sphere in one point: all mix", "offset elbow", [[(-90, 20, 130), (90, 20, 130)]], 16),
    ("touches the outer border: elbows mix", "offset elbow", [[(20, 210, 90), (20, 210, 110)]], 0),
    ("past the end of the boom's reach inwards", "boom", [[(-90, 15, 100), (90, 15, 100)]], 8),
    ("through the boom's axis", "boom", [[(-90, 0, 150), (90, 0, 150)]], 4),
    ("into the boom's hole", "boom", [[(-90, 5, 100), (90, 5, 100)]], 0),
    ("through the crank's axis", "crank", [[(-90, 0, 150), (90, 0, 150)]], 4),
    ("touches the crank's cylinder from inside", "crank", [[(-20, 20, 0), (0, 180, 0), (20, 20, 0)]], 8),
    ("leaves the crank's cylinder", "crank", [[(-90, 0, 150), (101, 0, 150)]], 0),
]  # fmt: skip


CASES = {case: row for case, *row in BY_HAND}


@cache
def motions_by_hand(case: str) -> ContinuousMotions:
    name, curves, _ = CASES[case]
    return motions_of(name, *curves)


@pytest.mark.parametrize("case", CASES)
def test_motions_by_hand(case: str) -> None:
    found, expected = motions_by_hand(case), CASES[case][2]
    assert found.count == expected
    assert len(found.motions) == expected


@each(*CASES, daily=3)
def test_motions_by_hand_are_certified_and_pass_the_solutions_at_samples(case: str) -> None:
    name, curves, expected = CASES[case]
    found = motions_by_hand(case)
    evidence = motions_certificate(found)
    assert qe.verify(evidence).accepted
    assert evidence_of(evidence)["motions"] == expected
    for curve, own in enumerate(curves_of(*curves).values()):
        assert [p.count for p in study(arm_of(name), own).stretches if p.count] or expected == 0
        for arcs in found.arcs:
            if arcs.curve == curve:
                assert solve(arm_of(name), own.point(arcs.sample)).count == len(arcs.labels)


def distance(one: tuple[float, ...], other: tuple[float, ...], turns: list[bool]) -> float:
    steps = zip(one, other, turns, strict=True)
    return max(abs(remainder(a - b, 2 * pi)) if t else abs(a - b) / 100 for a, b, t in steps)


@pytest.mark.parametrize("case", CASES)
def test_what_goes_on_is_near(case: str) -> None:
    """Just before and just after a junction solutions lie close together iff they are said to have the same limit."""
    name, curves, _ = CASES[case]
    found, listed, near = motions_by_hand(case), list(curves_of(*curves).values()), F(1, 10**10)
    plane = vertical_arm(arm_of(name))
    assert plane is not None
    turns = [plane.geometry.chain.turns[0], *plane.turns]
    for junction, one, other in zip(found.junctions, found.arcs, found.arcs[1:]):
        ends = []
        for arcs, step in ((one, -near), (other, near)):
            s = junction.s if arcs.curve == junction.curve else F(0)
            middle = s if isinstance(s, F) else s.interval(80)[0]
            solutions = solve(arm_of(name), listed[arcs.curve].point(middle + step)).solutions
            ends.append({plane.label(x): x.angles for x in solutions})
        assert (set(ends[0]), set(ends[1])) == (set(one.labels), set(other.labels))
        close = {(a, b) for a, p in ends[0].items() for b, q in ends[1].items() if distance(p, q, turns) < 0.01}
        assert close == junction.passes


def near_the_axis(random: Random) -> tuple[str, Points]:
    gap = F(1, 10 ** random.randrange(1, 10))
    angle = random.uniform(-pi, pi)
    u = (F(round(100 * cos(angle))), F(round(100 * sin(angle))))
    beside = (-u[1] * gap / 100, u[0] * gap / 100)
    height = [F(random.randrange(60, 200)) for _ in range(2)]
    points: Points = [(k * u[0] + beside[0], k * u[1] + beside[1], z) for k, z in zip((-1, 1), height)]
    return random.choice(["ev3-120", "ev3-112", "shoulder-3r"]), points


def near_a_border(random: Random) -> tuple[str, Points]:
    """A line beside one of the circles of the border, parallel to its tangent."""
    gap = random.choice([1, -1]) * F(1, 10 ** random.randrange(1, 10))
    length, name = random.choice([(120, "ev3-120"), (112, "ev3-112")])
    a, c, links = 44 * sqrt(2), 104 + 44 * sqrt(2), (8 * sqrt(293), length)
    radius = random.choice([links[0] + links[1], abs(links[0] - links[1])])
    side = random.choice([1, -1]) if radius > 100 else 1
    at = random.uniform(-0.4, 0.4) if radius > 100 else random.uniform(-pi, pi)
    foot = (side * a + radius * cos(at), c + radius * sin(at))
    if foot[0] <= 1:
        return near_a_border(random)
    half = random.choice([15.0, sqrt(radius * abs(gap)) / 2])  # the shorter ones do not cross the border again
    middle = (foot[0] + float(gap) * cos(at), foot[1] + float(gap) * sin(at))
    ends = [(middle[0] - k * sin(at), middle[1] + k * cos(at)) for k in (-half, half)]
    angle = random.uniform(-pi, pi)
    return name, [tuple(F(round(v * 10**12), 10**12) for v in (r * cos(angle), r * sin(angle), z)) for r, z in ends]


def check_random(seed: int) -> bool:
    """Whether the count is constant: then motions are as many as solutions, and the certificate says so."""
    random = Random(seed)
    name, points = (near_the_axis, near_a_border)[seed % 2](random)
    found = motions_of(name, points)
    (curve,) = curves_of(points).values()
    whole = study(arm_of(name), curve)
    evidence = motions_certificate(found)
    assert qe.verify(evidence).accepted and evidence_of(evidence)["motions"] == found.count
    inside = [p for p in whole.specials if p.reasons]
    if inside:
        assert found.count <= max(p.count for p in whole.stretches) and found.junctions
        return False
    assert [p.count for p in whole.stretches] == [found.count]
    return True


@each((range(5), 2), pytest.param(range(1000, 1500), 250, marks=pytest.mark.deep))
def test_random_paths_near_the_axis_and_near_borders(seeds: range, simple: int) -> None:
    assert sum(check_random(seed) for seed in seeds) >= simple


NEAR_THE_AXIS = curves_of([(-100, "1/10", 100), (100, "1/10", 100)])


def test_no_motion_was_said_to_be_proved_below_four_solutions_for_every_s() -> None:
    _, lines, evidence, _ = certify(Channel(print), arm_of(E), NEAR_THE_AXIS)
    text = "\n".join(lines)
    assert "4 solutions for every s in (0, 1)" in text
    assert "4 continuous joint motions from start to goal (proved" in text and "accepted" in text
    assert qe.verify(qe.Certificate.from_json(evidence)).accepted
    data, *_ = certify(Channel(print), arm_of(E), curves_of([(-100, 9, 100), (100, 9, 100)]))
    assert data["motions"]["count"] == 4 and len(data["motions"]["listed"]) == 4 and data["certified"] is True


def test_a_motion_through_the_axis_is_shown_and_kept() -> None:
    line = curves_of([(-100, 0, 100), (100, 0, 100)])
    text = "\n".join(in_words(joint_path(arm_of(E), line)))
    assert "all 4 motions go on through the axis (proved" in text and "motion 4:" in text
    plan = joint_plan(arm_of(E), line, TimeLaw.of(Law.QUINTIC), F(10), 21)
    assert plan.sequence is not None and plan.sequence.run and not plan.sequence.switches
    assert not plan.is_proved and any("no proved bounds" in remark for remark in plan.remarks)


def test_no_motion_through_a_corner_on_the_axis_is_said_to_be_proved() -> None:
    found = joint_path(arm_of(E), curves_of([(-100, 0, 100), (0, 0, 100)], [(0, 0, 100), (0, 100, 100)]))
    text = "\n".join(in_words(found))
    assert found.count == 0 and "no continuous joint motion from start to goal (proved)" in text
    assert "theta1 would have to jump" in text


def test_where_boxes_hold_whole_motions_they_have_their_numbers() -> None:
    found = joint_path(arm_of(E), curves_of([(10, 40, 80), (40, 100, 20)]))
    assert found.motions is not None and len(found.whole_runs) == 4 == found.count
    for run in found.whole_runs:
        motion = next(m for m in found.motions.motions if m.number == run.number)
        (arcs,) = found.motions.arcs
        solution = arcs.solutions[arcs.labels.index(motion.labels[0])]
        branch = run.branch(0)
        assert branch is not None and branch.contains(arcs.sample, solution)


def test_where_the_second_joint_is_free_nothing_is_said_to_be_proved() -> None:
    curve = curves_of([(10, 0, 100), (0, 10, 100), (100, 0, 100)], [(100, 0, 100), (0, 0, 120)])
    found = joint_path(arm_of("equal links"), curve)
    assert found.count is not None
    through = joint_path(arm_of("equal links"), curves_of([(-50, 0, 150), (50, 0, 50)]))
    text = "\n".join(in_words(through))
    assert through.count is None and "is not decided" in text and "at least 0 continuous" in text
    with pytest.raises(Unable, match="second joint is free"):
        motions_of("equal links", [(-50, 0, 150), (50, 0, 50)])


TWISTED = (
    'name = "twisted"\nconvention = "standard"\n[[row]]\njoint = "theta1"\nd = 50\nalpha = "pi/3"\na = 30\n'
    '[[row]]\njoint = "theta2"\nd = 10\na = 80\nalpha = "pi/4"\n[[row]]\njoint = "theta3"\na = 70\nd = 5\n'
)


def test_an_arm_without_such_a_plane_has_as_many_motions_as_simple_solutions() -> None:
    arm = read_arm(TWISTED)
    found = joint_path(arm, curves_of([(60, 60, 60), (61, 62, 63)]))
    assert found.motions is None and not certificates(found)[0][0].startswith("all")
    assert found.count == found.studies[0].stretches[0].count and found.count
    out = joint_path(arm, curves_of([(300, 0, 0), (301, 0, 0)]))
    assert out.count == 0


def test_a_whole_curve_on_the_axis_is_refused() -> None:
    with pytest.raises(Unable, match="on the axis"):
        motions_of(E, [(0, 0, 100), (0, 0, 150)])


@settings(max_examples=60)
@given(
    st.lists(st.fractions(-3, 3, max_denominator=50), min_size=1, max_size=5),
    st.tuples(st.fractions(-3, 3, max_denominator=50), st.fractions("1/1000", 2, max_denominator=1000)),
    st.integers(-1, 1),
)
def test_a_constant_sign_is_proved_iff_there_is_no_zero(roots: list[F], at: tuple[F, F], shift: int) -> None:
    """Factors s - a and s - a ± √2/3; the squares of others, which stay positive, do not matter."""
    low, high = at[0], at[0] + at[1]
    p, inside, side = Polynomial((Surd.rational(2),)), False, 1
    for a in roots:
        zero = Surd.rational(a) + Surd.of([(2, F(shift, 3))])
        p = p * Polynomial((-zero, Surd.rational(1)))
        p = p * Polynomial((Surd.rational(a * a + F(1, 10**6)), Surd.rational(-2 * a), Surd.rational(1)))
        ends = [(Surd.rational(x) - zero).sign() for x in (low, high)]
        inside, side = inside or ends[0] != ends[1] or 0 in ends, side * ends[0]
    assert constant_sign(p, low, high) == (0 if inside else side)


# --- forged certificates ----------------------------------------------------------------------------------------------


def forged(payload: dict[str, Any], **changes: Any) -> bool:
    return verdict_by("joint motions", {**payload, **changes}).accepted


def false(number: int, among: set[int], *, every: bool) -> list[int]:
    """Other numbers: all of these, or the nearest one."""
    others = sorted(among - {number}, key=lambda other: abs(other - number))
    return others if every else others[:1]


def some(listed: list[Any]) -> list[Any]:
    """One of them, in the middle."""
    return listed[len(listed) // 2 :][:1]


@each(*CASES, daily=4)
@each(False, pytest.param(True, marks=pytest.mark.deep))
def test_false_numbers_are_rejected(every: bool, case: str) -> None:
    payload = evidence_of(motions_certificate(motions_by_hand(case)))
    assert forged(payload)
    for key in ("solutions", "through"):
        listed = payload[key]
        assert isinstance(listed, list)
        for k, value in enumerate(listed) if every else some(list(enumerate(listed))):
            for other in false(value, {0, 2, 4, 8}, every=every):
                assert not forged(payload, **{key: [*listed[:k], other, *listed[k + 1 :]]})
        assert not forged(payload, **{key: [*listed, 4]}) and not forged(payload, **{key: None})
    for other in false(payload["motions"], {0, 1, 2, 4, 8, 16}, every=every):
        assert not forged(payload, motions=other)
    places: Any = payload["places"]
    for i, curve in enumerate(places):
        for k, place in enumerate(curve) if every else some(list(enumerate(curve))):
            low, high = F(place["low"]), F(place["high"])
            wrong = [
                {**place, "low": str(high)},
                {**place, "low": str(high + 1), "high": str(high + 2)},
                {**place, "factor": [[["1", 1]]]},
                {**place, "factor": []},
                {**place, "factor": [[[str(-low - (high - low) / 3), 1]], [["1", 1]]]},
            ]
            for one in wrong if every else [wrong[len(case) % len(wrong)]]:
                assert not forged(payload, places=[*places[:i], [*curve[:k], one, *curve[k + 1 :]], *places[i + 1 :]])
            assert not forged(payload, places=[*places[:i], [*curve, place], *places[i + 1 :]])
            if low > 0 and high < 1:
                assert not forged(payload, places=[*places[:i], [*curve[:k], *curve[k + 1 :]], *places[i + 1 :]])


def test_a_certificate_of_another_arm_or_path_is_rejected() -> None:
    payload = evidence_of(motions_certificate(motions_of(E, [(-100, 0, 100), (100, 0, 100)])))
    corner = evidence_of(motions_certificate(motions_of(E, [(20, 0, 166), (110, 0, 166)])))
    assert not forged(payload, curves=corner["curves"]) and not forged(payload, curves=[])
    assert not forged(payload, curves=[[["-100", "1/1000000000", "100"], ["100", "0", "100"]]])
    curves: Any = payload["curves"]
    assert not forged(payload, curves=[*curves, curves[0]], places=[payload["places"], []])
    assert not forged(payload, arm=arm_json(read_arm(TWISTED)))
    assert not forged(payload, arm=arm_json(load_arm("six-joints")))


def test_the_touching_point_has_to_be_touched_exactly() -> None:
    """The parabola that stays a little inside, with the claim of the one that touches."""
    touching = evidence_of(motions_certificate(motions_of(S, [(-100, 110, 100), (0, 310, 100), (100, 110, 100)])))
    for gap in (F(1, 10), F(1, 10**6), F(1, 10**12), F(1, 10**30)):
        for side in (1, -1):
            curve = [[["-100", "110", "100"], ["0", str(310 + side * gap), "100"], ["100", "110", "100"]]]
            assert not forged(touching, curves=curve)
