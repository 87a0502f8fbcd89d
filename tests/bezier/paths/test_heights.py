"""Heights and speeds along paths."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bezier.curves import bernstein as bs
from bezier.curves.curve import Bezier
from bezier.curves.nonnegative import events_of
from bezier.curves.scalar import dot
from bezier.curves.workspace import Workspace, WorkspaceKind
from bezier.paths import heights
from bezier.paths.path import Path, assemble, slowest
from bezier.planner.planning import make_plan
from bezier.problem import PlanMethod, Problem, read_problem
from qe.exact.field import NumberField
from tests.bezier.numbers import control_points, points, unit
from tests.tables import each

DIPPING = """
method = "cubic"
workspace = "hemisphere"
start = ["-21/20", 0, "1/10"]
via = [[-1, "7/10", "7/10"], [1, "7/10", "7/10"]]
goal = ["21/20", 0, "1/10"]
radius = "3/2"
"""
BALL = Workspace(WorkspaceKind.BALL, Fraction(10**6))
ORIGIN = (Fraction(0),) * 3


def problem_of(first, second) -> Problem:
    return Problem(PlanMethod.CUBIC, BALL, ORIGIN, (first, second), ORIGIN, False)


def path_of(*curves: Bezier) -> Path:
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
    found = heights.heights_of(problem.strip, path_of(curve))
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
    found = heights.heights_of(problem_of((1, 1, 1), (Fraction(3, 2), 1, 1)).strip, path_of(curve))
    assert [(i.axis, i.begin.t[0], i.begin.at, i.end.t[0], i.end.at) for i in found.below] == [
        (axis, Fraction(1, 2), "x = 1", Fraction(3, 4), "x = 3/2") for axis in "yz"
    ]
    assert all(i.begin.included and i.end.included for i in found.below)
    line = heights.heights_of(problem_of((0, 1, 1), (9, 1, 1)).strip, path_of(curve)).below[0]
    assert (line.begin.at, line.end.at) == ("x = 0", "end of the curve")


def test_only_positive_heights_count_and_the_lower_via_point_does():
    assert problem_of((1, 0, -1), (2, 5, 5)).strip is None
    strip = problem_of((3, 2, -1), (1, 5, 5)).strip
    assert strip is not None and (strip.low, strip.high, dict(strip.heights)) == (1, 3, {"y": Fraction(2)})


def test_touching_the_strip_at_one_irrational_parameter():
    """x(t) = 2 - (8 t^2 - 1)^2 reaches the plane x = 2 at t = sqrt(2)/4 only."""
    power = (Fraction(1), Fraction(0), Fraction(16), Fraction(0), Fraction(-64))
    curve = Bezier(tuple((c, Fraction(0), Fraction(0)) for c in bs.from_power(power)))
    found = heights.heights_of(problem_of((2, 1, 1), (3, 1, 1)).strip, path_of(curve))
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
    through = path_of(Bezier.of([(-1, 0, 0), (1, 0, 0)]))
    assert heights.remarks(through) == ("the path goes through the origin O (P at t = 1/2), which the paper excludes",)
    # t^2 = 1/2: an irrational parameter; and three coordinates that vanish one after the other only
    half = Bezier.of([(-1, 1, 0), (-1, 1, 0), (1, -1, 0)])
    assert "t = about 0.70710678" in heights.remarks(path_of(half))[0]
    assert heights.remarks(path_of(Bezier.of([(-1, -2, 0), (1, 1, 0)]))) == ()
    assert heights.remarks(path_of(Bezier.of([(0, 0, 0), (1, 1, 0)]))) == ()


@settings(max_examples=20)
@given(control_points(3), st.integers(0, 8))
def test_paths_moved_onto_the_origin_are_noted(control, k):
    curve = Bezier.of(control)
    t = Fraction(k, 8)
    away = curve.point(t)
    moved = Bezier.of([[c - a for c, a in zip(p, away, strict=True)] for p in control])
    hits = heights.through_origin(moved)
    assert any(low <= t <= high for low, high in hits)
    assert bool(heights.remarks(path_of(moved))) == any(h not in (heights.START, heights.END) for h in hits)


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
