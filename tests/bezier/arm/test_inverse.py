"""Inverse kinematics at a point: published solutions, the closed form, what is special, other arms."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from math import hypot, pi, sqrt
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bezier.arm import inverse
from bezier.arm.command import in_words, to_json
from bezier.arm.inverse import solve
from bezier.arm.kinematics import positions
from bezier.arm.reader import load_arm, read_arm, read_exact
from qe.errors import InputError, InternalError, Unable
from tests.bezier.made import arm_text
from tests.tables import each

POINT = (Fraction(599, 66), Fraction(824, 33), Fraction(323, 10))


SHOULDER = arm_text('d = 100; alpha = "pi/2"', "a = 80", "a = 60")
SCARA = arm_text("a = 50", 'a = 40; alpha = "pi/2"', "a = 30")
SKEW = arm_text(
    'alpha = "pi/6"; a = 5; d = 3',
    'a = 20; alpha = "pi/3"; d = 7; theta = "pi/4"',
    'a = 30; alpha = {cos = "3/5", sin = "4/5"}; d = 4',
    convention="modified",
)
ARMS = [load_arm("ev3-120"), read_arm(SHOULDER), read_arm(SCARA), read_arm(SKEW + "[[row]]\na = 25\n")]


def closed_form(x: float, y: float, z: float, length: float) -> int:
    """MATHS: two solutions for each sign of rho inside the annulus."""
    a, top = 44 * sqrt(2), sqrt(18752)
    distances = [hypot(sign * hypot(x, y) - a, z - 104 - a) for sign in (1, -1)]
    return sum(2 for d in distances if abs(top - length) < d < top + length)


def test_the_published_point() -> None:
    found = solve(load_arm("ev3-120"), POINT)
    assert found.count == 4
    cosines = sorted(round(float(sum(s.values[1].cosine) / 2), 12) for s in found.solutions if s.values[1])
    assert cosines == [-0.940394772358, -0.726166272114, -0.50252984126, -0.283151812542]


@given(st.tuples(*[st.fractions(-400, 400, max_denominator=60)] * 3))
def test_the_count_is_that_of_the_closed_form(point: tuple[Fraction, ...]) -> None:
    arm = load_arm("ev3-112")
    x, y, z = point
    if x == y == 0:
        return
    found = solve(arm, point)
    assert found.count == closed_form(float(x), float(y), float(z), 112)
    if found.solutions:
        reached = positions(arm, [s.angles for s in found.solutions])
        assert np.allclose(reached, [float(c) for c in point], atol=1e-9)


@each(
    (("44*sqrt(2) + 8*sqrt(293) + 120", "0", "104 + 44*sqrt(2)"), 1, [True]),
    (("44*sqrt(2) + 8*sqrt(293) - 120", "0", "104 + 44*sqrt(2)"), 3, [True, False, False]),
    (("0", "44*sqrt(2)", "104 + 44*sqrt(2) + 8*sqrt(293) + 120"), 1, [True]),
    (("44*sqrt(2)", "0", "104 + 44*sqrt(2)"), 2, [False, False]),
    (("100", "50", "104 + 44*sqrt(2)"), 4, [False] * 4),
    (("0", "0", "500"), 0, []),
)
def test_borders_and_circle(texts: tuple[str, ...], count: int, multiple: list[bool]) -> None:
    found = solve(load_arm("ev3-120"), [read_exact(t) for t in texts])
    assert found.count == count
    assert sorted(s.multiple for s in found.solutions) == sorted(multiple)
    assert any("singular" in c for c in found.cases) == any(multiple)
    assert any("shoulder" in c for c in found.cases) == (texts[0] == "44*sqrt(2)")


def test_a_hair_beyond_the_border() -> None:
    arm, edge = (
        load_arm("ev3-120"),
        [read_exact(t) for t in ("44*sqrt(2) + 8*sqrt(293) + 120", "0", "104 + 44*sqrt(2)")],
    )
    tiny = Fraction(1, 10**40)
    assert [solve(arm, (edge[0] + d, edge[1], edge[2])).count for d in (-tiny, tiny)] == [2, 0]


def test_on_the_axis_the_first_joint_is_free() -> None:
    found = solve(load_arm("ev3-112"), (0, 0, 200))
    assert found.count is None
    assert found.free == ("theta1",)
    assert [s.values[0] for s in found.solutions] == [None, None]
    assert [round(s.angles[1] or 0, 9) for s in found.solutions] == [0.236922525, 2.14432378]


def test_the_angle_that_the_tangent_misses() -> None:
    """θ7 = pi: t is infinite for the first φ."""
    from bezier.arm.kinematics import position

    arm = load_arm("ev3-120")
    point = position(arm, {"theta1": (1, 0), "theta4": (Fraction(3, 5), Fraction(4, 5)), "theta7": (-1, 0)})
    assert any(abs(abs(s.angles[2] or 0) - pi) < 1e-15 for s in solve(arm, point).solutions)
    assert solve(arm, point).count == 4


def test_limits_of_joints() -> None:
    text = SHOULDER.replace('joint = "q2"', 'joint = "q2"\nlimits = [0, 1.5]')
    arm = read_arm(text)
    found = solve(arm, (80, 60, 120))
    kept = [s.angles[1] for s in found.solutions if s.allowed]
    assert found.count == 4
    assert kept and all(a is not None and 0 <= a <= 1.5 for a in kept)
    assert all(not (0 <= (s.angles[1] or 0) <= 1.5) for s in found.solutions if not s.allowed)


def test_an_angle_on_the_limit_zero_and_one_beyond_half_a_turn() -> None:
    arm = read_arm(SHOULDER.replace('joint = "q1"', 'joint = "q1"\nlimits = [0, 3.5]'))
    by_angle = {round(s.angles[0] or 0, 3): s.allowed for s in solve(arm, (90, 0, 120)).solutions}
    assert by_angle == {0.0: True, 3.142: True}
    beyond = {round(s.angles[0] or 0, 3): s.allowed for s in solve(arm, (-90, -10, 120)).solutions}
    assert sorted(beyond.items()) == [(-3.031, True), (0.111, True)]


def test_a_planar_arm_has_a_family() -> None:
    flat = arm_text("a = 5", "a = 4", "a = 3")
    found = solve(read_arm(flat), (6, 2, 0))
    assert found.count is None and found.is_reachable
    assert solve(read_arm(flat), (6, 2, 1)).count == 0
    assert solve(read_arm(flat), (600, 2, 0)).count == 0


def test_a_planar_arm_at_the_border_of_its_family() -> None:
    """One solution only, at the angle that t misses first: stretched, or folded back."""
    flat = arm_text("a = 1", "a = 1", "a = 10")
    for distance, last in ((12, 0.0), (8, pi)):
        (found,) = solve(read_arm(flat), (distance, 0, 0)).solutions
        assert found.multiple and abs(abs(found.angles[2] or 0) - last) < 1e-15
    assert solve(read_arm(flat), (Fraction(7999, 1000), 0, 0)).count == 0


def test_arms_that_do_not_fit() -> None:
    with pytest.raises(Unable, match="three joints"):
        solve(read_arm(SHOULDER + '[[row]]\njoint = "t4"\na = 3\n'), POINT)
    same = arm_text("", "", "")
    with pytest.raises(Unable, match="one axis"):
        solve(read_arm(same), POINT)


@pytest.mark.parametrize("point", [(1, 2), (1, 2, 3.0), (1, 2, "3"), (True, 0, 0)])
def test_points_are_exact(point: tuple[object, ...]) -> None:
    with pytest.raises(InputError):
        solve(load_arm("ev3-120"), point)


def test_a_wrong_reduction_does_not_pass(monkeypatch: pytest.MonkeyPatch) -> None:
    arm = load_arm("ev3-120")
    right = inverse.general(arm, 0)
    swapped = replace(right, values=(right.values[1], right.values[0], right.values[2]))
    other = inverse.general(load_arm("ev3-112"), 0)
    for wrong in (swapped, other, replace(right, equation=right.equation.derivative(right.ring.index["t"]))):
        monkeypatch.setattr(inverse, "general", lambda arm, turn, wrong=wrong: wrong)
        with pytest.raises(InternalError):
            solve(arm, POINT)


@each(112, 120)
def test_logged_queries(length: int, shared: Path) -> None:
    logged = [
        json.loads(line) for line in (shared / "corpora/ev3" / f"queries_L{length}.jsonl").read_text().splitlines()
    ]
    arm = load_arm(f"ev3-{length}")
    for row in logged[::8]:
        point = [Fraction(row[c]) for c in "xyz"]
        found = solve(arm, point)
        assert found.count == row["real_solutions"], row["id"]
        assert np.allclose(positions(arm, [s.angles for s in found.solutions]), [float(c) for c in point], atol=1e-5)


@pytest.mark.deep
@each("queries_L112", "queries_L120", "points_L120_without_log")
def test_every_logged_query(name: str, shared: Path) -> None:
    arm = load_arm("ev3-112" if "112" in name else "ev3-120")
    for line in (shared / "corpora" / "ev3" / f"{name}.jsonl").read_text().splitlines():
        row = json.loads(line)
        assert solve(arm, [Fraction(row[c]) for c in "xyz"]).count == row["real_solutions"], row["id"]


@each("sqrt(-1)", "sqrt(2", "x", "sqrt", "x*sqrt(2)", "1/(sqrt(4)-2)", "sqrt(2)**2", "__import__('os')", "sqrt(2)" * 9)
def test_no_exact_number(text: str) -> None:
    with pytest.raises(InputError):
        read_exact(text)


def test_exact_numbers() -> None:
    assert read_exact("1/3") == Fraction(1, 3)
    assert read_exact("0.1*sqrt(4)") == Fraction(1, 5) and read_exact("sqrt(sqrt(16))") == 2
    assert float(read_exact("44*sqrt(2) - 8*sqrt(293)/2")) == pytest.approx(44 * sqrt(2) - 4 * sqrt(293))


@each(6, 20, 40, 200)
def test_two_solutions_never_print_alike(places: int) -> None:
    """At 1e-36 mm from the border both lines were the same, and so were both boxes."""
    border = read_exact("44*sqrt(2) + 120 + 8*sqrt(293)") - Fraction(1, 10**places)
    found = solve(load_arm("ev3-120"), (border, Fraction(0), read_exact("44*sqrt(2) + 104")))
    lines = [line.partition(".")[2] for line in in_words(found)[2:]]
    assert len(lines) == found.count == 2 and len(set(lines)) == 2
    first, second = (one["joints"]["theta4"]["box"] for one in to_json(found)["solutions"])
    bounds = [[[Fraction(end) for end in box[key]] for box in (first, second)] for key in ("cos", "sin")]
    assert any(a[1] < b[0] or b[1] < a[0] for a, b in bounds)
