"""Method 1: closed forms, and the simplex method."""

from __future__ import annotations

import copy
import time
from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.optimize import linprog

import qe
from bezier.curves.scalar import dot
from bezier.curves.workspace import Workspace, WorkspaceKind
from bezier.input.task import Task, task
from bezier.methods.single import formula as single_formula
from bezier.methods.single.closed import TOLERANCE, NoCurve, ProvedCurve, close
from bezier.methods.single.cuts import CutKind, Model, violated
from bezier.methods.single.formula import VALUE
from bezier.methods.single.program import choose, curve, dips, linear_program, solve, weights_at
from qe.convex.system import ConvexSystem
from qe.errors import InputError, Unable
from qe.exact.quadratic_form import Quadratic
from qe.proof.multipliers import FormRelation
from tests.bezier.made import FLAT, axis, stays, tasks, unit_task
from tests.tables import each

F = Fraction
SPACE = st.sampled_from(WorkspaceKind)
RATIO = st.sampled_from([F(1), F(101, 100), F(21, 20), F(6, 5), F(2)])


def ball_for(given_task: Task, ratio, kind) -> Workspace:
    """The paper's radius, its square times ``ratio``."""
    model = Model.of(given_task, Workspace(kind, F(1)))
    return Workspace(kind, ratio * max(dot(p, p) for p in (*model.ends, *model.via)))


def check_curve(given_task, workspace, found):
    """Everything that is claimed of a curve, at exact sample points and by the other tests of whole curves."""
    low, high = given_task.times
    for k in range(129):
        point = found.curve.point(F(k, 128))
        assert dot(point, point) <= workspace.radius_squared
        between = found.curve.point(low + F(k, 128) * (high - low))
        for of in given_task.raised:
            assert between[1 + given_task.axes.index(of)] >= of.height
    assert not dips(given_task, found.curve) and stays(found.curve, workspace.conditions)
    for of in given_task.raised:
        row = found.curve.coordinate(1 + given_task.axes.index(of))
        assert all(row[i] >= given_task.lower_bound(of, i) for i in range(1, given_task.degree))
        assert all(found.curve.point(t)[1 + given_task.axes.index(of)] == of.height for t in given_task.times)
    total = sum(row[i] for row in found.values.values() for i in given_task.middle)
    assert found.bound <= found.value == total
    assert found.value - found.bound <= 3 * TOLERANCE * max(abs(found.bound), F(1, 10))


@settings(max_examples=20)
@given(tasks(3, 7, both=True), RATIO, SPACE)
def test_what_is_found_is_proved(given_task, ratio, kind):
    workspace = ball_for(given_task, ratio, kind)
    found = close(given_task, workspace)
    assert qe.verify(found.certificate).accepted
    if isinstance(found, ProvedCurve):
        check_curve(given_task, workspace, found)


@settings(max_examples=25)
@given(tasks(3, 6), st.sampled_from([F(11, 10), F(6, 5), F(3, 2)]))
def test_no_cut_excludes_a_curve(given_task, ratio):
    """Every curve that satisfies the conditions satisfies the cuts found against other curves, in a smaller ball."""
    workspace = ball_for(given_task, ratio, WorkspaceKind.BALL)
    inner = close(given_task, replace(workspace, radius_squared=workspace.radius_squared * F(20, 21)))
    outer = close(given_task, workspace)
    if isinstance(inner, NoCurve):
        return
    assert isinstance(outer, ProvedCurve)
    point = [v for of in given_task.raised for v in inner.values[of.name][1:-1]]
    assert is_point_of(Model.of(given_task, workspace).program(outer.cuts), (*point, F(0)))


def check_against_elimination(given_task, ratio):
    """The bound is a lower bound of all sums that exact elimination of t gives, and the sum found is one of them."""
    workspace = ball_for(given_task, ratio, WorkspaceKind.BALL)
    sums = qe.eliminate(single_formula.closed(given_task, workspace).formula).formula
    found = close(given_task, workspace)
    if isinstance(found, NoCurve):
        assert qe.decide(f"ex {VALUE}. {sums}") is False
        return
    assert qe.decide(f"all {VALUE}. {VALUE} = {found.value} -> ({sums})")
    assert qe.decide(f"all {VALUE}. ({sums}) -> {VALUE} >= {found.bound}")


@each("6/5", "3/2", "8/5")
def test_against_exact_elimination_of_t(squared):
    """No curve, a curve that the ball bounds, and one that it does not."""
    given_task = unit_task(4, "2/5", "7/10", axis("y", 0, "1/2", 1), FLAT)
    model = Model.of(given_task, Workspace(WorkspaceKind.BALL, F(1)))
    check_against_elimination(given_task, F(squared) / max(dot(p, p) for p in (*model.ends, *model.via)))


@pytest.mark.deep
@settings(max_examples=60)
@given(tasks(3, 4), st.sampled_from([F(1), F(11, 10), F(5, 4)]))
def test_many_against_exact_elimination_of_t(given_task, ratio):
    check_against_elimination(given_task, ratio)


def test_the_ball_moves_the_optimum():
    """With the paper's radius all four given points are on the sphere; (4) as printed leaves, the repair touches."""
    given_task = task(6, (F(-3), F(3)), (F(-1), F(1)), [axis("y", 0, 0, 2), axis("z", 0, 0, 2)])
    workspace = Workspace(WorkspaceKind.HEMISPHERE, F(9))
    printed = curve(given_task, {of.name: choose(given_task, of).values for of in given_task.raised})
    assert not dips(given_task, printed) and not stays(printed, workspace.conditions)
    found = close(given_task, workspace)
    check_curve(given_task, workspace, found)
    assert found.is_optimal and found.value == F(2027, 160)
    assert {cut.kind for cut in found.cuts} == {CutKind.HEIGHT, CutKind.START, CutKind.GOAL}


def test_a_bound_close_to_the_sum():
    axes = axis("y", "7/4", "1/4", "11/4"), axis("z", 0, "1/2", 3)
    given_task = task(7, (F(-4), F(4)), (F(-2), F(1)), axes)
    workspace = Workspace(WorkspaceKind.BALL, F(33229, 1600))
    found = close(given_task, workspace)
    check_curve(given_task, workspace, found)
    assert not found.is_optimal and found.bound > sum(choose(given_task, of).outcome.value for of in axes)
    assert all(v.denominator < 10**12 for row in found.values.values() for v in row)


def test_a_dip_that_no_curve_of_the_degree_avoids():
    given_task = unit_task(5, "7/10", "9/10", axis("y", "-3/2", 1, "3/4"), FLAT)
    found = close(given_task, Workspace(WorkspaceKind.BALL, F(1000)))
    assert isinstance(found, NoCurve) and qe.verify(found.certificate).accepted
    assert {cut.kind for cut in found.cuts} <= {CutKind.HEIGHT}


def test_heights_that_leave_no_slack():
    """All y are forced to h = start = goal, so P_y = h for all t, and yet the ball has room."""
    axes = axis("y", "3/2", "3/2", "3/2"), axis("z", 0, "1/2", 2)
    given_task = task(5, (F(-3), F(3)), (F(-7, 4), F(1)), axes)
    found = close(given_task, Workspace(WorkspaceKind.BALL, F(2323, 200)))
    assert isinstance(found, ProvedCurve) and set(found.values["y"]) == {F(3, 2)}


def test_altered_bounds_are_rejected():
    given_task = task(6, (F(-3), F(3)), (F(-1), F(1)), [axis("y", 0, 0, 2), axis("z", 0, 0, 2)])
    good = close(given_task, Workspace(WorkspaceKind.HEMISPHERE, F(9))).certificate
    for key in ("multipliers", "point"):
        changed = copy.deepcopy(good.payload)
        evidence = changed["steps"][0]["evidence"]
        evidence[key] = [["1"], *evidence[key][1:]]
        assert not qe.verify(qe.Certificate(good.kind, changed)).accepted


@given(st.lists(st.fractions(-2, 2, max_denominator=5), min_size=1, max_size=8))
def test_violated_parameters_are_proved_and_complete(b):
    found = violated(tuple(b))
    drawn = [
        sum(w * c for w, c in zip(row, b, strict=True)) for row in (weights_at(len(b) - 1, F(k, 50)) for k in range(51))
    ]
    assert all(0 <= t <= 1 for t in found) and (found or min(drawn) >= 0)
    for t in found:
        assert sum(w * c for w, c in zip(weights_at(len(b) - 1, t), b, strict=True)) < 0


def test_the_limit_stops_the_work():
    def stop():
        raise Unable("stopped")

    with pytest.raises(Unable, match="stopped"):
        close(unit_task(6, "2/5", "3/5", axis("y", 0, 0, 1), FLAT), Workspace(WorkspaceKind.BALL, F(2)), check=stop)


def test_ends_below_the_table_are_refused():
    given_task = unit_task(6, "2/5", "3/5", axis("y", 0, 0, 1), axis("z", -1, 0))
    with pytest.raises(InputError, match="z >= 0"):
        close(given_task, Workspace(WorkspaceKind.HEMISPHERE, F(9)))
    assert isinstance(close(given_task, Workspace(WorkspaceKind.BALL, F(9))), ProvedCurve)


def test_given_points_outside_the_ball():
    given_task = unit_task(6, "2/5", "3/5", axis("y", 0, 0, 1), FLAT)
    for squared in (F(9, 10), F(11, 10)):  # P(1) and P(t_b), or only P(t_b), are outside
        found = close(given_task, Workspace(WorkspaceKind.BALL, squared))
        assert isinstance(found, NoCurve) and qe.verify(found.certificate).accepted


def test_a_parameter_beside_a_point_on_the_sphere_stays_in_the_curve():
    """P(t_b) is on the sphere and t_b close to 1: the condition is not asked for beyond t = 1."""
    given_task = unit_task(40, "1/2", "99/100", axis("y", 0, 0, 1), FLAT)
    model = Model.of(given_task, Workspace(WorkspaceKind.BALL, F(1) + F(99, 100) ** 2))
    assert model.touches == (False, False, False, True)
    wild = curve(given_task, {"y": (F(0), *[F(2)] * 39, F(0))})
    assert 0 <= model.ball_cut(wild, F(99, 100)).t <= 1


def test_speed():
    axes = axis("y", 0, 0, 2), axis("z", 0, 0, 2)
    begin = time.perf_counter()
    close(task(6, (F(-3), F(3)), (F(-1), F(1)), axes), Workspace(WorkspaceKind.HEMISPHERE, F(9)))
    assert time.perf_counter() - begin < 30  # 0.03 s on a quiet machine


NUMBER = st.fractions(-3, 3, max_denominator=3)


def row(gradient, bound, equation=False):
    """gradient . x <= bound, or = bound."""
    return Quadratic.linear(gradient, -bound), FormRelation.EQ if equation else FormRelation.LE


@st.composite
def programs(draw):
    """A small program; equations, repeated rows and zero rows included."""
    size = draw(st.integers(1, 5))
    numbers = st.tuples(*[NUMBER] * size)
    rows = draw(st.lists(st.builds(row, numbers, NUMBER, st.booleans()), max_size=6))
    if rows and draw(st.booleans()):
        rows.append(draw(st.sampled_from(rows)))
    return linear_program([f"x{i}" for i in range(size)], draw(numbers), rows, draw(numbers))


def numerically(program):
    """The same by a floating-point solver."""

    def part(relation):
        forms = [f for f, r in zip(program.forms, program.relations, strict=True) if r is relation]
        return ([list(map(float, f.gradient)) for f in forms] or None, [-float(f.constant) for f in forms] or None)

    free = [(None, None)] * len(program.names)
    return linprog(
        list(map(float, program.objective.gradient)), *part(FormRelation.LE), *part(FormRelation.EQ), bounds=free
    )


def is_point_of(program, x):
    """Whether x satisfies every row and lower bound, exactly."""
    values = [(form.value(x), r) for form, r in zip(program.forms, program.relations, strict=True)]
    return all(value == 0 if r is FormRelation.EQ else value <= 0 for value, r in values)


ONE, NONE = Fraction(1), Fraction(0)


@given(programs())
@example(linear_program(["x"], (ONE,), [row((NONE,), ONE, True)], (NONE,)))
@example(linear_program(["x"], (ONE,), [row((ONE,), -ONE)], (NONE,)))
def test_answers_are_proved_and_agree_with_a_numerical_solver(program):
    numerical = numerically(program)
    try:
        found = solve(program)
    except Unable:
        assert numerical.status in (3, 4)
        return
    assert qe.verify(found.certificate).accepted
    if not found.optimal:
        assert numerical.status in (2, 4)
        return
    assert is_point_of(program, found.point)
    assert numerical.status == 0 and abs(numerical.fun - float(found.value)) < 1e-7


@given(programs(), st.lists(NUMBER, min_size=5, max_size=5))
def test_the_second_objective_decides_among_the_minima_of_the_first(program, second):
    other = Quadratic.linear(second[: len(program.names)])
    try:
        found, first = solve(program, [other.gradient]), solve(program)
    except Unable:
        return
    assert found.optimal is first.optimal
    if found.optimal:
        assert found.value == first.value and is_point_of(program, found.point)
        forms = *program.forms, Quadratic.linear(program.objective.gradient, -first.value)
        relations = *program.relations, FormRelation.EQ
        best = solve(ConvexSystem(program.names, other, forms, relations))
        assert best.value == other.value(found.point)


def test_the_example_on_which_other_pivot_rules_cycle():
    """Beale (1955): degenerate at the origin; the largest-coefficient rule comes back to it for ever."""
    rows = [
        row(tuple(map(Fraction, ("1/4", "-8", "-1", "9"))), NONE),
        row(tuple(map(Fraction, ("1/2", "-12", "-1/2", "3"))), NONE),
        row(tuple(map(Fraction, (0, 0, 1, 0))), ONE),
    ]
    cost = tuple(map(Fraction, ("-3/4", "20", "-1/2", "6")))
    found = solve(linear_program("abcd", cost, rows, (NONE,) * 4))
    assert found.value == Fraction(-5, 4) and found.point == (1, 0, 1, 0)


def test_altered_proofs_are_rejected():
    rows = [row((Fraction(-1), Fraction(-2)), Fraction(-3))]
    good = solve(linear_program("xy", (ONE, ONE), rows, (NONE, NONE))).certificate
    assert qe.verify(good).accepted
    for key, place, value in (("multipliers", 0, ["1/3"]), ("point", 0, ["1"])):
        changed = copy.deepcopy(good.payload)
        evidence = changed["steps"][0]["evidence"]
        evidence[key] = [*evidence[key][:place], value, *evidence[key][place + 1 :]]
        assert not qe.verify(qe.Certificate(good.kind, changed)).accepted


def test_an_objective_without_bound_is_refused():
    with pytest.raises(Unable, match="without bound"):
        solve(linear_program("x", (-ONE,), [], (NONE,)))
    assert solve(linear_program("x", (ONE,), [], (NONE,))).optimal


def test_the_limit_stops_the_simplex_method():
    def stop():
        raise Unable("stopped")

    with pytest.raises(Unable, match="stopped"):
        solve(linear_program("x", (ONE,), [row((-ONE,), -ONE)], (NONE,)), check=stop)
