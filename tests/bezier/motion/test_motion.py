"""Motions along paths, and the heights and speeds of paths."""

from __future__ import annotations

import csv
import io
from fractions import Fraction
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bezier.curves import bernstein as bs
from bezier.curves.curve import Bezier
from bezier.curves.nonnegative import events_of
from bezier.curves.scalar import dot, same
from bezier.curves.workspace import Workspace, WorkspaceKind
from bezier.input.toml_table import Table
from bezier.motion.motion import Timing, in_time, motion_csv, motion_of, quality_of, read_timing, state, summary_lines
from bezier.motion.timelaw import Law, TimeLaw
from bezier.paths import heights
from bezier.paths.path import Path, assemble, slowest
from bezier.planner.planning import make_plan
from bezier.problem import PlanMethod, Problem, read_problem
from qe.errors import InputError
from qe.exact.field import NumberField
from tests.bezier.made import control_points, points, unit
from tests.tables import each

HALF, QUARTER = Fraction(1, 2), Fraction(1, 4)
BALL = Workspace(WorkspaceKind.BALL, Fraction(10**6))
LAWS = [TimeLaw.of(Law.CUBIC), TimeLaw.of(Law.QUINTIC), TimeLaw.of(Law.TRAPEZOID), TimeLaw.of(Law.TRAPEZOID, HALF)]


def path_of(*rows, durations=None):
    curves = dict(zip("PQR", map(Bezier.of, rows), strict=False))
    return assemble(curves, {}, BALL, durations=durations)


LINE = path_of([(0, 0, 0), (2, 0, 0)], [(2, 0, 0), (4, 0, 0)])


@pytest.mark.parametrize("law", LAWS)
def test_a_law_goes_from_start_to_goal_without_turning_back(law):
    ends = [law.derivatives(Fraction(t)) for t in (0, 1)]
    assert [e[:2] for e in ends] == [(0, 0), (1, 0)]
    values = [law.derivatives(Fraction(k, 40))[0] for k in range(41)]
    assert all(a < b for a, b in pairwise(values))
    for before, after, at in zip(law.polynomials, law.polynomials[1:], law.breaks[1:], strict=False):
        for order in (0, 1):
            assert _derivative(before, order, at) == _derivative(after, order, at)


def _derivative(polynomial, order, t):
    for _ in range(order):
        polynomial = polynomial.derivative()
    return polynomial(t)


@each((Law.CUBIC, 1.5, 6.0), (Law.QUINTIC, 1.875, 10 / 3**0.5), (Law.TRAPEZOID, 4 / 3, 16 / 3))
def test_extremes_on_a_straight_path_are_those_of_the_law(law, speed, acceleration):
    found = motion_of(LINE, Timing(law, QUARTER, Fraction(3))).largest
    for enclosure, value in zip(found.values(), (4 * speed / 3, 4 * acceleration / 9), strict=True):
        assert float(enclosure.low) <= value * (1 + 1e-12) and value * (1 - 1e-12) <= float(enclosure.high)
        assert enclosure.high - enclosure.low < Fraction(1, 10**18)


def test_passages_split_the_time_where_the_curves_meet():
    assert motion_of(LINE, Timing(Law.QUINTIC, QUARTER, Fraction(3))).trajectory.breaks == (0, Fraction(3, 2), 3)
    three = path_of(*[[(k, 0, 0), (k + 1, 0, 0)] for k in range(3)], durations={"P": Fraction(2)})
    law, moved = TimeLaw.of(Law.TRAPEZOID), motion_of(three, Timing(Law.TRAPEZOID, QUARTER, Fraction(1))).trajectory
    assert {Fraction(1, 4), HALF, Fraction(3, 4)} < {*moved.breaks} and len(moved.breaks) == 6
    assert any(abs(law.derivatives(t)[0] - Fraction(3, 4)) < Fraction(1, 10**20) for t in moved.breaks)
    assert in_time(three, None).breaks == (0, 2, 3, 4)


@settings(max_examples=15, deadline=None)
@given(control_points(3, 4), control_points(3, 4), st.sampled_from(LAWS[:3]))
def test_no_sample_is_faster_than_the_extremes_say(first, second, law):
    path = path_of(first, [first[-1], *second[1:]])
    kinds = {3: Law.CUBIC, 5: Law.QUINTIC}
    timing = Timing(kinds.get(law.polynomials[0].degree, Law.TRAPEZOID), QUARTER, Fraction(1))
    motion = motion_of(path, timing)
    speed, push = motion.largest.values()
    for k in range(21):
        _, _, (_, velocity, acceleration) = state(path, motion, Fraction(k, 20))
        assert dot(velocity, velocity) <= speed.high**2
        assert dot(acceleration, acceleration) <= push.high**2


def test_the_least_duration_keeps_the_limits_and_no_shorter_one_does():
    limits = {"max_speed": Fraction(2), "max_acceleration": Fraction(1)}
    duration = motion_of(LINE, Timing(Law.QUINTIC, QUARTER, None, limits)).duration
    assert abs(float(duration) - (40 / 3**0.5) ** 0.5) < 1e-5  # the acceleration limit decides
    for share, kept in ((Fraction(1), True), (Fraction(99, 100), False)):
        motion = motion_of(LINE, Timing(Law.QUINTIC, QUARTER, duration * share, limits))
        assert motion.kept["max_acceleration"] is kept and motion.kept["max_speed"]


def test_a_limit_that_is_just_reached_is_kept_and_one_next_to_it_is_not():
    for less, kept in ((Fraction(0), True), (Fraction(1, 10**30), False)):
        limits = {"max_speed": 6 - less}  # the largest speed for T = 1 with the cubic law
        motion = motion_of(LINE, Timing(Law.CUBIC, QUARTER, Fraction(1), limits))
        assert motion.kept == {"max_speed": kept} and motion.keeps_limits is kept
        assert ("EXCEEDED" in motion.reason) is not kept


def test_velocity_is_continuous_where_the_joins_are():
    path = path_of([(-2, 0, 0), (-1, 1, 0), (0, 1, 0)], [(0, 1, 0), (1, 1, 0), (2, 0, 0)])
    motion = motion_of(path, Timing(Law.QUINTIC, QUARTER, Fraction(10)))
    name, u, (place, velocity, _) = state(path, motion, HALF)
    assert (name, u) == ("P", 1) and same(place, (0, 1, 0))
    assert same(velocity, (Fraction(3, 4), 0, 0))  # P'(1) = (2, 0, 0), sigma' = 2 * 15/8 / 10


@pytest.mark.parametrize("law", [Law.CUBIC, Law.QUINTIC, Law.TRAPEZOID])
def test_velocity_and_acceleration_are_the_derivatives_of_the_position(law):
    path = path_of(
        [(-2, 0, 0), (-1, 3, 1), (0, 1, 0)], [(0, 1, 0), (1, -1, 0), (2, 0, 4)], durations={"P": Fraction(2)}
    )
    motion = motion_of(path, Timing(law, QUARTER, Fraction(3)))
    step = Fraction(1, 10**4)
    for tau in (Fraction(1, 5), Fraction(2, 5), Fraction(17, 20)):
        before, here, after = (state(path, motion, t)[2] for t in (tau - step, tau, tau + step))
        seconds = step * 3
        for i in range(3):
            velocity = (after[0][i] - before[0][i]) / (2 * seconds)
            acceleration = (after[0][i] - 2 * here[0][i] + before[0][i]) / seconds**2
            assert abs(velocity - here[1][i]) < Fraction(1, 1000)
            assert abs(acceleration - here[2][i]) < Fraction(1, 100)


def test_the_table_of_the_motion():
    motion = motion_of(LINE, Timing(Law.QUINTIC, QUARTER, Fraction(10)))
    lines = [line for line in motion_csv(LINE, motion).splitlines() if not line.startswith("#")]
    rows = list(csv.DictReader(io.StringIO("\n".join(lines))))
    assert len(rows) == 151 and rows[0]["time"] == "0" and rows[-1]["time"] == "10"
    assert (rows[75]["x"], rows[75]["vx"], rows[75]["ax"]) == ("2", "0.75", "0")
    assert rows[-1]["segment"] == "Q" and rows[-1]["u"] == "1"


def test_quality_of_a_path():
    quality = quality_of(LINE, None)
    assert abs(float(quality.length) - 4) < 1e-5 and quality.motion is None
    still = path_of([(1, 1, 1)] * 3)
    assert quality_of(still, None).curvatures == {"P": None}


@each(
    ("timing = 3", "timing: expected a table [timing], found 3"),
    ('[timing]\nlaw = "jerky"\nduration = 1', 'timing.law: expected "cubic" or "quintic" or "trapezoid"'),
    ("[timing]\nduration = 0", "timing.duration: expected a number above zero, found 0"),
    ("[timing]\nmax_speed = -1", "timing.max_speed: expected a number above zero, found -1"),
    ('[timing]\nlaw = "cubic"', "timing.duration: expected a duration, max_speed or max_acceleration"),
    ('[timing]\nramp = "1/4"\nduration = 1', 'timing.ramp: expected this key with law = "trapezoid" only'),
    ('[timing]\nlaw = "trapezoid"\nramp = 0.6\nduration = 1', "timing.ramp: expected at most 1/2, found 3/5"),
    ('[timing]\nlaw = "least"\nmax_speed = 1', "timing.max_acceleration: expected this limit with law"),
    ('[timing]\nlaw = "least"\nmax_acceleration = 1\nduration = 2', "timing.duration: expected no such key with law"),
    ("[timing]\nspeed = 1", "timing.speed: expected one of the keys law, ramp, duration"),
)
def test_bad_tables_get_one_clear_line(text, said):
    with pytest.raises(InputError) as error:
        read_timing(Table.parse(text, "f.toml"))
    assert said in str(error.value) and "\n" not in str(error.value)


def test_a_timing_survives_json():
    text = '[timing]\nlaw = "trapezoid"\nramp = "1/3"\nmax_speed = 0.5'
    timing = read_timing(Table.parse(text, "f.toml"))
    assert timing is not None
    assert read_timing(Table({"timing": timing.to_json()})) == timing
    assert read_timing(Table({})) is None


def test_a_cusp_is_said_in_words():
    text = 'method = "cubic"\nstart = [-1, 2, 0]\nvia = [[-3, 0, 0], [3, 0, 0]]\ngoal = [1, 2, 0]\nradius = 3\n'
    plan = make_plan(read_problem(text))
    assert summary_lines(plan.quality) == ["length 17.0008 mm, largest curvature unbounded at a cusp (P)"]


DIPPING = """
method = "cubic"
workspace = "hemisphere"
start = ["-21/20", 0, "1/10"]
via = [[-1, "7/10", "7/10"], [1, "7/10", "7/10"]]
goal = ["21/20", 0, "1/10"]
radius = "3/2"
"""
ORIGIN = (Fraction(0),) * 3


def problem_of(first, second) -> Problem:
    return Problem(PlanMethod.CUBIC, BALL, ORIGIN, (first, second), ORIGIN, False)


def raised_path_of(*curves: Bezier) -> Path:
    return assemble(dict(zip("PQR", curves, strict=False)), {}, BALL)


def below(item: heights.Below, t: Fraction) -> bool | None:
    """Whether t lies in a stretch; None where t is too near to an irrational end to tell."""
    if item.begin.t[0] < t < item.begin.t[1] or item.end.t[0] < t < item.end.t[1]:
        return None
    after = t > item.begin.t[1] or (item.begin.included and t == item.begin.t[0] == item.begin.t[1])
    before = t < item.end.t[0] or (item.end.included and t == item.end.t[0] == item.end.t[1])
    return after and before


def test_outer_curves_of_the_best_path_dip_into_the_strip():
    """P of the best path of (7) comes back over x = -1 for t in (0.103, 0.287), with z down to 0.086."""
    plan = make_plan(read_problem(DIPPING))
    assert plan.path is not None and not plan.heights.hold
    assert {(i.curve, i.axis) for i in plan.heights.below} == {("P", "y"), ("P", "z"), ("R", "y"), ("R", "z")}
    first = plan.heights.below[0]
    assert first.begin.t[0] < first.begin.t[1] < Fraction(103, 1000) and first.begin.at == first.end.at == "x = -1"
    assert Fraction(287, 1000) < first.end.t[0] < first.end.t[1] < Fraction(288, 1000)
    assert float(plan.path.curves["P"].point(first.begin.t[0])[2]) == pytest.approx(0.0866, abs=1e-3)
    lines = heights.summary_lines(plan.heights)
    assert "DOES NOT HOLD" in lines[0] and len(lines) == 5 and "0.1024" in lines[1] and "0.2871" in lines[1]
    assert heights.heights_of(plan.problem.strip, plan.path) == plan.heights


@settings(max_examples=20)
@given(control_points(3), points(), points())
def test_stretches_agree_with_dense_sampling(control, first, second):
    curve = Bezier.of(control)
    problem = problem_of(first, second)
    strip = problem.strip
    found = heights.heights_of(problem.strip, raised_path_of(curve))
    if strip is None:
        assert found.hold and all(min(a, b) <= 0 for a, b in zip(first[1:], second[1:], strict=True))
        return
    for k in range(41):
        t = Fraction(k, 40)
        at = curve.point(t)
        for axis, height in strip.heights.items():
            expected = strip.low <= at[0] <= strip.high and at["xyz".index(axis)] < height
            told = [below(item, t) for item in found.below if item.axis == axis]
            assert None in told or any(told) == expected, (axis, t)


def test_every_end_says_what_happens_there():
    curve = Bezier.of([(0, 0, 0), (1, 0, 0), (2, 0, 0)])
    found = heights.heights_of(problem_of((1, 1, 1), (Fraction(3, 2), 1, 1)).strip, raised_path_of(curve))
    assert [(i.axis, i.begin.t[0], i.begin.at, i.end.t[0], i.end.at) for i in found.below] == [
        (axis, Fraction(1, 2), "x = 1", Fraction(3, 4), "x = 3/2") for axis in "yz"
    ]
    assert all(i.begin.included and i.end.included for i in found.below)
    line = heights.heights_of(problem_of((0, 1, 1), (9, 1, 1)).strip, raised_path_of(curve)).below[0]
    assert (line.begin.at, line.end.at) == ("x = 0", "end of the curve")


def test_only_positive_heights_count_and_the_lower_via_point_does():
    assert problem_of((1, 0, -1), (2, 5, 5)).strip is None
    strip = problem_of((3, 2, -1), (1, 5, 5)).strip
    assert strip is not None and (strip.low, strip.high, dict(strip.heights)) == (1, 3, {"y": Fraction(2)})


def test_touching_the_strip_at_one_irrational_parameter():
    """x(t) = 2 - (8 t^2 - 1)^2 reaches the plane x = 2 at t = sqrt(2)/4 only."""
    power = (Fraction(1), Fraction(0), Fraction(16), Fraction(0), Fraction(-64))
    curve = Bezier(tuple((c, Fraction(0), Fraction(0)) for c in bs.from_power(power)))
    found = heights.heights_of(problem_of((2, 1, 1), (3, 1, 1)).strip, raised_path_of(curve))
    (item,) = (i for i in found.below if i.axis == "y")
    assert item.begin.t == item.end.t and item.sample is None and item.begin.included
    assert "at t = about 0.35355" in heights.in_words(item)


@each(Fraction(1, 3), Fraction(2, 7), Fraction(1, 1000), Fraction(999, 1000))
@each(False, True)
def test_roots_at_the_ends_of_a_curve_were_isolated_for_ever(field, other):
    """A root at t = 0 or 1 beside an inner one: the interval next to the end never left it."""
    one = NumberField.from_root([-2, 0, 1], 1, 2).rational(1) if field else Fraction(1)
    product = bs.power_multiply((Fraction(0), one), (-one, one))
    product = bs.power_multiply(product, (-one * other * other, one * 0, one))
    form = bs.from_power(product)
    found = events_of([form])
    assert len(found) == 3
    low, high = found[1].t
    assert 0 < low <= other <= high < 1
    assert [event.signs for event in found] == [(0,)] * 3


def test_a_path_through_the_origin_is_noted():
    through = raised_path_of(Bezier.of([(-1, 0, 0), (1, 0, 0)]))
    assert heights.remarks(through) == ("the path goes through the origin O (P at t = 1/2), which the paper excludes",)
    # t^2 = 1/2: an irrational parameter; and three coordinates that vanish one after the other only
    half = Bezier.of([(-1, 1, 0), (-1, 1, 0), (1, -1, 0)])
    assert "t = about 0.70710678" in heights.remarks(raised_path_of(half))[0]
    assert heights.remarks(raised_path_of(Bezier.of([(-1, -2, 0), (1, 1, 0)]))) == ()
    assert heights.remarks(raised_path_of(Bezier.of([(0, 0, 0), (1, 1, 0)]))) == ()


@settings(max_examples=20)
@given(control_points(3), st.integers(0, 8))
def test_paths_moved_onto_the_origin_are_noted(control, k):
    curve = Bezier.of(control)
    t = Fraction(k, 8)
    away = curve.point(t)
    moved = Bezier.of([[c - a for c, a in zip(p, away, strict=True)] for p in control])
    hits = heights.through_origin(moved)
    assert any(low <= t <= high for low, high in hits)
    assert bool(heights.remarks(raised_path_of(moved))) == any(h not in (heights.START, heights.END) for h in hits)


@given(control_points(2, 5), unit, st.sampled_from([Fraction(1), Fraction(1, 3)]))
def test_no_parameter_is_slower(points, t, duration):
    curve = Bezier.of(points)
    found = slowest(curve, duration)
    velocity = curve.derivative(1, t)
    speed_squared = dot(velocity, velocity) / duration**2
    assert speed_squared >= found.least.low**2
    if found.stops:
        assert found.least.low == found.least.high == 0
    else:
        assert found.least.low > 0 and found.least.high - found.least.low <= found.least.high / 1000


def test_the_least_speed_is_reached():
    curve = Bezier.of([(0, 0, 0), (1, 0, 0), (1, 1, 0)])  # P' = (2 - 2t, 2t, 0), slowest at t = 1/2 with sqrt(2)
    least = slowest(curve).least
    assert least.low**2 <= 2 <= least.high**2


def test_stops():
    there_and_back = Bezier.of([(0, 0, 0), (1, 1, 1), (0, 0, 0)])
    assert slowest(there_and_back).stops == ((Fraction(1, 2), Fraction(1, 2)),)
    cusp_at_the_end = Bezier.of([(0, 0, 0), (1, 0, 0), (2, 3, 4), (2, 3, 4)])
    assert slowest(cusp_at_the_end).stops == ((1, 1),)
    assert slowest(Bezier.of([(1, 2, 3), (1, 2, 3)])).stops == ((0, 1),)
