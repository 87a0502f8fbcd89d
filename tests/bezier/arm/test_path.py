"""Whole paths: exact places, branches, runs, their certificates, and the chains of motions that hold one solution."""

from __future__ import annotations

import json
from fractions import Fraction
from math import cos, pi, sin
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bezier.arm.command import certify
from bezier.arm.critical import AlongCurve, Reason
from bezier.arm.evidence import certificates
from bezier.arm.follow import ONE, ZERO, follow, whole
from bezier.arm.inverse import solve
from bezier.arm.joint_path import JointPath, joint_path
from bezier.arm.kinematics import positions
from bezier.arm.motion_chain import piece as proved_piece
from bezier.arm.motion_chain import solved
from bezier.arm.reader import load_arm, natural_spline, read_route
from bezier.arm.study import study
from bezier.curves.curve import Bezier
from bezier.proofs.arm_rows import ArmChain
from bezier.proofs.course import Course, coefficients
from bezier.proofs.square_roots import STILL, Surd
from bezier.proofs.square_roots import ZERO as ZERO_SURD
from qe.certify.verify import verify, verify_json
from qe.errors import InputError, Unable
from tests.certificates.restated import evidence_of, verdict_by
from tests.enough import sized
from tests.tables import each

ARM = load_arm("ev3-120")
STRAIGHT = Bezier.of([(10, 40, 80), (40, 100, 20)])
HOLE = Bezier.of([(20, 0, 166), (110, 0, 166)])
CUBIC = Bezier.of([(10, 40, 80), (60, 60, 120), (90, 20, 150), (40, 100, 20)])


@pytest.fixture(scope="module")
def straight() -> JointPath:
    return joint_path(ARM, {"line": STRAIGHT})


def test_the_published_line_can_be_followed(straight: JointPath) -> None:
    (found,) = straight.studies
    assert found.is_reachable
    assert [(p.low, p.high, p.count) for p in found.stretches] == [(0, 1, 4)]
    assert [round(float(s), 6) for s in found.shared] == [0.756424, 0.993797]
    assert len(straight.whole_runs) == 4


def test_the_other_published_line() -> None:
    found = study(ARM, Bezier.of([(50, 25, 100), (40, 100, 20)]))
    assert found.is_reachable and [p.count for p in found.stretches] == [4]
    assert [round(float(s), 12) for s in found.shared] == [0.792322431164, 0.994716564351]


@each("D1_leaves_outside", "D2_through_hole", "D3_high")
def test_lines_over_the_border(name: str, shared: Path) -> None:
    case = json.loads((shared / "corpora" / "ev3" / "paths_L120.json").read_text())[name]
    found = study(ARM, Bezier.of([case["start"], case["goal"]]))
    assert [p.count for p in found.stretches] == case["solutions_between"]
    for special, border in zip(found.specials[1:-1], case["borders_crossed"], strict=True):
        assert abs(Fraction(special.s.interval(90)[0]) - Fraction(border["s"])) < Fraction(1, 10**24)
        assert special.reasons == (Reason.MERGE,)
    assert found.is_reachable == (0 not in case["solutions_between"])


def test_solutions_come_and_go_at_the_hole() -> None:
    found = joint_path(ARM, {"line": HOLE})
    ends = sorted((round(float(b.low), 2), round(float(b.high), 2)) for b in found.branches[0])
    assert ends == [(0.0, 0.28), (0.0, 0.28), (0.0, 1.0), (0.0, 1.0), (0.66, 1.0), (0.66, 1.0)]
    assert [s.inverse.count for s in found.studies[0].specials] == [4, 3, 3, 4]


def test_across_the_axis() -> None:
    found = study(ARM, Bezier.of([(-50, 0, 100), (50, 0, 100)]))
    middle = next(p for p in found.specials if p.s == Fraction(1, 2))
    assert Reason.AXIS in middle.reasons and middle.inverse.free == ("theta1",)
    assert found.is_reachable


def test_along_the_axis_is_out_of_reach() -> None:
    with pytest.raises(Unable, match="everywhere along the curve"):
        study(ARM, Bezier.of([(0, 0, 100), (0, 0, 200)]))


@settings(max_examples=8)
@given(
    st.lists(st.tuples(*[st.integers(-250, 250)] * 3), min_size=2, max_size=2), st.lists(st.fractions(0, 1), max_size=5)
)
def test_the_number_of_solutions_between_the_places(points: list[tuple[int, ...]], samples: list[Fraction]) -> None:
    curve = Bezier.of(points)
    try:
        found = study(ARM, curve)
    except Unable:
        return
    for s in samples:
        count = solve(ARM, curve.point(s)).count
        inside = [p for p in found.stretches if p.low < s < p.high]
        assert all(p.count == count for p in inside)


@each(
    pytest.param(Bezier.of([(-1, 5, 357), (11, -63, 420), (-5, -60, 411)]), marks=pytest.mark.deep),
    Bezier.of([(-100, Fraction(1, 10), 100), (100, Fraction(1, 10), 100)]),
)
def test_a_curve_close_to_the_axis_takes_few_boxes(curve: Bezier) -> None:
    """At 0.14 mm from the axis the boxes of four motions were 32 562 and took 23 s; at 0.1 mm there were none."""
    found = joint_path(ARM, {"close": curve})
    assert found.count == len(found.covering_runs)
    assert sum(len(b.pieces) for b in found.branches[0]) < 1500
    assert all(verify(c).accepted for _, c in certificates(found))


@sized(2, 8, st.integers(-60, 60), st.integers(0, 3), st.integers(20, 200))
def test_boxes_grow_with_the_logarithm_of_the_distance_to_the_axis(y: int, power: int, z: int) -> None:
    """Before, with its inverse."""
    distance = Fraction(1, 10**power)
    try:
        found = joint_path(ARM, {"close": Bezier.of([(-60, y + distance, z), (60, distance - y, z + 5)])})
    except Unable:
        return
    for run in found.covering_runs:
        assert sum(len(branch.pieces) for _, branch in run.parts) < 250 + 150 * power


@each(STRAIGHT, CUBIC)
def test_branches_are_solutions(curve: Bezier) -> None:
    for solution in solve(ARM, curve.point(ZERO)).solutions:
        branch = whole(ARM, curve, solution, ZERO, (ZERO, ONE))
        assert branch is not None and (branch.low, branch.high) == (0, 1)
        marks = [Fraction(k, 7) for k in range(8)]
        reached = positions(ARM, [branch.at(s) for s in marks])
        assert np.allclose(reached, [[float(c) for c in curve.point(s)] for s in marks], atol=0.4)
        assert all(sum(branch.contains(s, x) for x in solve(ARM, curve.point(s)).solutions) == 1 for s in marks)
        h = Fraction(1, 1000)
        for s in marks[1:-1]:
            slope = (np.array(branch.at(s + h)) - np.array(branch.at(s - h))) / float(2 * h)
            bounds = branch.piece(s).velocity
            assert all(low - 0.3 <= v <= high + 0.3 for v, (low, high) in zip(slope, bounds))


def test_bounds_of_the_derivatives_hold() -> None:
    """Second differences of exact solutions lie within the bounds of the acceleration."""
    start = solve(ARM, CUBIC.point(ZERO)).solutions[0]
    pieces = follow(ARM, CUBIC, [a for a in start.angles if a is not None], ZERO, ONE)
    for piece in pieces[::6]:
        h = (piece.high - piece.low) / 4
        middle = (piece.low + piece.high) / 2
        near = np.array([float(v) for v in piece.at(middle)])
        values = []
        for s in (middle - h, middle, middle + h):
            found = [np.array(x.angles, dtype=float) for x in solve(ARM, CUBIC.point(s)).solutions]
            values.append(
                min(
                    (x + 2 * np.pi * np.round((near - x) / 2 / np.pi) for x in found), key=lambda x: abs(x - near).max()
                )
            )
        first = (values[2] - values[0]) / float(2 * h)
        second = (values[2] - 2 * values[1] + values[0]) / float(h * h)
        assert all(low - 1e-6 <= v <= high + 1e-6 for v, (low, high) in zip(first, piece.velocity))
        assert all(low - 1e-3 <= v <= high + 1e-3 for v, (low, high) in zip(second, piece.acceleration))


def test_curves_in_a_row_make_one_motion() -> None:
    first, second = CUBIC.split()
    found = joint_path(ARM, {"P": first, "Q": second})
    assert len(found.whole_runs) == 4
    assert verify(certificates(found)[0][1]).accepted
    with pytest.raises(InputError, match="begin where"):
        joint_path(ARM, {"P": second, "Q": first})


def test_a_spline_goes_through_its_points() -> None:
    points = [
        (Fraction(10), Fraction(40), Fraction(80)),
        (Fraction(60), Fraction(60), Fraction(99)),
        (Fraction(40), Fraction(100), Fraction(20)),
    ]
    first, second = natural_spline(points)
    assert (first.points[0], first.points[-1], second.points[-1]) == tuple(points)
    assert all(first.derivative(k, ONE) == second.derivative(k, ZERO) for k in (1, 2))
    assert first.derivative(2, ZERO) == second.derivative(2, ONE) == (0, 0, 0)


@each(
    ("", "[[curve]]"),
    ("[[curve]]\npoints = [[1, 2, 3]]\n", "2 to 40 points"),
    ("[[curve]]\npoints = [[1, 2, 3], [1, 2]]\n", "points[1]"),
    ("[[curve]]\npoints = [[1, 2, 3], [1, 2, 4]]\nspline = 1\n", "true or false"),
    ('[[curve]]\npoints = [[1, 2, 3], [1, 2, 4]]\nname = ""\n', "a name of its own"),
    ("[[curve]]\nfoo = 1\npoints = [[1, 2, 3], [1, 2, 4]]\n", "unknown key"),
)
def test_bad_paths(text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        read_route(text)
    assert message in str(caught.value)


def test_curves_have_to_be_in_space_and_rational() -> None:
    with pytest.raises(InputError, match="dimension 3"):
        AlongCurve(ARM, Bezier.of([(1, 2), (3, 4)]))


# --- certificates --------------------------------------------------------------------------------
@pytest.fixture(scope="module")
def payload(straight: JointPath) -> dict:
    label, certificate = certificates(straight)[0]
    assert label == "motion 1, the whole path"
    assert verify(certificate).accepted
    assert verify_json(certificate.to_json()).accepted
    return evidence_of(certificate)


def moved(value: str, by: Fraction) -> str:
    return str(Fraction(value) + by)


CHANGES = {
    "another arm": lambda p: p["arm"]["rows"][7].update(a="121"),
    "another convention": lambda p: p["arm"].update(convention="standard"),
    "another angle": lambda p: p["arm"]["rows"][1].update(theta=4),
    "another curve": lambda p: p["curves"][0][1].__setitem__(0, "41"),
    "another centre": lambda p: p["pieces"][3]["centre"].__setitem__(
        1, moved(p["pieces"][3]["centre"][1], Fraction(1, 10))
    ),
    "another slope": lambda p: p["pieces"][2]["slope"].__setitem__(2, moved(p["pieces"][2]["slope"][2], Fraction(1))),
    "a box too small": lambda p: p["pieces"][2]["radius"].__setitem__(0, "1/100000000000000"),
    "a box too large": lambda p: p["pieces"][2].update(radius=["3", "3", "3"]),
    "a piece left out": lambda p: p["pieces"].pop(4),
    "a gap": lambda p: p["pieces"][4].update(low=moved(p["pieces"][4]["low"], Fraction(1, 1000))),
    "no piece": lambda p: p.update(pieces=[]),
    "a curve that is not there": lambda p: p["pieces"][0].update(curve=1),
    "no radius": lambda p: p["pieces"][0].update(radius=["0", "1", "1"]),
    "an empty interval": lambda p: p["pieces"][0].update(low=p["pieces"][0]["high"]),
    "two joints": lambda p: p["arm"]["rows"][0].update(joint=None),
    "a kind of joint": lambda p: p["arm"]["rows"][0].update(joint="ball"),
    "a cosine": lambda p: p["arm"]["rows"][0].update(theta=["1/2", "1/2"]),
    "a float": lambda p: p["pieces"][0].update(low=0.0),
    "another field": lambda p: p.update(more=1),
}


@pytest.mark.parametrize("what", CHANGES)
def test_changed_certificates_are_rejected(payload: dict, what: str) -> None:
    changed = json.loads(json.dumps(payload))
    CHANGES[what](changed)
    verdict = verdict_by("joints along curves", changed)
    assert not verdict.accepted and verdict.decided
    assert verdict.step.startswith("payload")


def test_another_branch_does_not_join(straight: JointPath) -> None:
    """Pieces of two branches, each right, are not one motion."""
    one, other = (evidence_of(c) for _, c in certificates(straight)[:2])
    half = [p for p in one["pieces"] if Fraction(p["high"]) <= Fraction(1, 2)]
    rest = [p for p in other["pieces"] if Fraction(p["low"]) >= Fraction(1, 2)]
    verdict = verdict_by("joints along curves", {**one, "pieces": [*half, *rest]})
    assert "piece before" in verdict.reason or "one before" in verdict.reason


def test_the_producer_refuses_wide_steps(straight: JointPath) -> None:
    """The whole line in one piece cannot be proved."""
    branch = straight.branches[0][0]
    course = Course(ARM.chain, coefficients(STRAIGHT.points))
    assert proved_piece(course, ZERO, ONE, branch.at(Fraction(1, 2))) is None


def test_the_command() -> None:
    said, _, evidence, _ = certify(None, ARM, {"line": STRAIGHT})  # type: ignore[arg-type]
    assert said["reachable"] and said["certified"]
    assert said["curves"][0]["intervals"][0]["solutions"] == 4
    assert verify_json(evidence).accepted
    away = {"line": Bezier.of([(400, 0, 100), (390, 0, 100)])}
    words = "\n".join(certify(None, ARM, away)[1])  # type: ignore[arg-type]
    assert "NOT reachable" in words and "no continuous joint motion from start to goal (proved)" in words


F = Fraction
ALONG = (STILL[0], (Surd.rational(2), ZERO_SURD, ZERO_SURD))
"""A link of length 2."""

SCARA = ArmChain((STILL, ALONG, ALONG, STILL), (True, True, False))
"""Two links that turn in the plane, and a slide across it."""


def end(a: float, b: float, c: float) -> tuple[float, float, float]:
    return 2 * cos(a) + 2 * cos(a + b), 2 * sin(a) + 2 * sin(a + b), c


POWERS = ((F(3), F(1, 10)), (F(1, 2), F(0), F(1, 10)), (F(1), F(-1)))
"""(3 + s/10, 1/2 + s^2/10, 1 - s)."""
LINE = Course(SCARA, POWERS)


def target(s: float) -> tuple[float, ...]:
    return tuple(sum(float(c) * s**k for k, c in enumerate(coordinate)) for coordinate in POWERS)


def test_a_solution_is_one() -> None:
    for s in (F(0), F(1), F(-2)):
        found = solved(LINE, s, (0.0, 1.0, 0.0))
        assert found is not None
        assert end(*found) == pytest.approx(target(float(s)), abs=1e-12)
    assert solved(Course(SCARA, ((F(9),), (F(0),), (F(0),))), F(0), (0.1, 1.0, 0.0)) is None  # out of reach
    assert solved(LINE, F(0), (0.0, 0.0, 0.0)) is None  # stretched out: singular


@each((F(-1, 20), F(1, 20)), (F(1), F(21, 20)))
def test_a_piece_encloses_the_solutions_and_their_derivatives(low: Fraction, high: Fraction) -> None:
    found = proved_piece(LINE, low, high, (-0.5, 1.2, 1.0))
    assert found is not None and (found.low, found.high) == (low, high)
    step = F(1, 1000)
    for k in range(1, 10):
        s = low + (high - low) * F(k, 10)
        before, here, after = (solved(LINE, s + d * step, found.near(s)) for d in (-1, 0, 1))
        assert before is not None and here is not None and after is not None
        assert [float(x) for x in found.at(s)] == pytest.approx(found.near(s))
        for j in range(3):
            assert abs(here[j] - found.near(s)[j]) <= found.inner[j] + 1e-15 and found.inner[j] < found.radius[j]
            speed, push = (after[j] - before[j]) / 0.002, (after[j] - 2 * here[j] + before[j]) / 1e-6
            assert found.velocity[j][0] - 1e-5 <= speed <= found.velocity[j][1] + 1e-5
            assert found.acceleration[j][0] - 1e-3 <= push <= found.acceleration[j][1] + 1e-3


def test_no_piece_where_solutions_may_meet_or_are_far_apart() -> None:
    assert proved_piece(LINE, F(-4), F(4), (-0.5, 1.2, 1.0)) is None  # too long for one box
    edge = Course(SCARA, ((F(4), F(1)), (F(0),), (F(0),)))
    assert proved_piece(edge, F(-1, 10), F(1, 10), (0.0, 0.1, 0.0)) is None  # leaves the reach at s = 0


def test_turns_are_about_z_and_in_order() -> None:
    quarter = solved(Course(SCARA, ((F(0),), (F(4),), (F(5),))), F(0), (pi / 2 - 0.01, 0.02, 4.0))
    assert quarter is None or end(*quarter) == pytest.approx((0, 4, 5), abs=1e-6)
    bent = solved(Course(SCARA, ((F(2),), (F(2),), (F(-3),))), F(0), (0.1, 1.5, 0.0))
    assert bent == pytest.approx([0.0, pi / 2, -3.0])
