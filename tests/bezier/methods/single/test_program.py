"""Method 1 as printed: indices, the identities (2) and (3), problem (4) against elimination and a numerical solver."""

import time
from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.optimize import linprog

import qe
from bezier.input.task import MAX_DEGREE, equally_spaced, least_degree, task
from bezier.methods.single import formula as single_formula
from bezier.methods.single.formula import VALUE, Symbol
from bezier.methods.single.program import choose, curve, dips, lower_of, lowest, objective, program, rows_of, weights_at
from qe.errors import InputError
from qe.formula.evaluate import holds_at
from tests.bezier.made import FLAT, HEIGHTS, axis, has_indices, tasks, unit_task
from tests.tables import each

F = Fraction
THIRDS = st.integers(1, 29).map(lambda k: Fraction(k, 30))


# --- indices -----------------------------------------------------------------------------------------


@given(st.integers(2, 12), THIRDS, THIRDS)
def test_indices_are_those_of_the_paper_or_refused(degree, a, b):
    xs = equally_spaced(degree, F(0), F(1))
    fitting = [
        (p, q)
        for p in range(1, degree)
        for q in range(p, degree)
        if a < b and xs[p] < a <= xs[p + 1] <= xs[q] <= b < xs[q + 1]
    ]
    assert has_indices(degree, a, b) == (fitting[0] if fitting else None)
    if a < b:
        least = least_degree((F(0), F(1)), (a, b))
        assert has_indices(least, a, b) or least == MAX_DEGREE
        assert not any(has_indices(n, a, b) for n in range(2, least))


@each(
    (4, "1/4", "3/4", "no p >= 1, since a = 1/4 is not beyond x_1 = 1/4; the least degree that works is 5"),
    (4, "3/10", "2/5", "no q > p, since no control point has its x between a = 3/10 and b = 2/5"),
    (6, "1/2", "1/2", "not x_0 < a < b < x_n"),
    (6, "1/2", "1", "not x_0 < a < b < x_n"),
    (1, "1/3", "1/2", f"which is not from 2 to {MAX_DEGREE}"),
)
def test_refusals_say_why(degree, a, b, reason):
    with pytest.raises(InputError, match=reason.replace("(", r"\(")):
        unit_task(degree, a, b, axis("y", 0, 0, 1), FLAT)


def test_a_task_needs_a_height_and_a_goal_beyond_the_start():
    with pytest.raises(InputError, match="no positive height"):
        unit_task(6, "2/5", "3/5", FLAT)
    with pytest.raises(InputError, match="no positive height"):
        unit_task(6, "2/5", "3/5", axis("y", 0, 0, 0))
    with pytest.raises(InputError, match="not beyond the start"):
        task(6, (F(1), F(0)), (F(1, 2), F(3, 4)), [axis("y", 0, 0, 1)])
    with pytest.raises(InputError, match="the interval gives p = 2 and q = 3"):
        replace(unit_task(6, "2/5", "3/5", axis("y", 0, 0, 1)), q=4)


# --- the identities ----------------------------------------------------------------------------------


@each(2, 5, 12, 20)
def test_the_identities_are_proved(degree):
    assert single_formula.identities_hold(degree)


def test_another_spacing_is_refuted():
    stated = str(single_formula.linearity(4))
    wrong = stated.replace("(2*x0 + 2*xn)", "(3*x0 + 1*xn)")
    assert wrong != stated and qe.decide(stated) is True and qe.decide(wrong) is False


# --- problem (4) -------------------------------------------------------------------------------------


def satisfies(given_task, of, values):
    """Problem (4), written once more."""
    n, height = given_task.degree, of.height
    sums = [sum(w * v for w, v in zip(weights_at(n, t), values, strict=True)) for t in given_task.times]
    low = [of.start] * given_task.p + [height] * (given_task.q - given_task.p) + [of.goal] * (n - 1 - given_task.q)
    ends = values[0] == of.start and values[-1] == of.goal
    return ends and sums == [height, height] and all(v >= b for v, b in zip(values[1:-1], low, strict=True))


def parts(given_task, of):
    """The equations, their right-hand sides and the bounds of (4) in floating point."""
    forms = [form for form, _ in rows_of(given_task, of)]
    equal, values = [[*map(float, form.gradient)] for form in forms], [-float(form.constant) for form in forms]
    return equal, values, [(float(low), None) for low in lower_of(given_task, of)]


@given(tasks(3, 12))
def test_the_linear_program_against_a_numerical_solver(given_task):
    (of,) = given_task.raised
    chosen = choose(given_task, of)
    assert qe.verify(chosen.outcome.certificate).accepted
    equal, values, bounds = parts(given_task, of)
    numerical = linprog(list(map(float, objective(given_task))), A_eq=equal, b_eq=values, bounds=bounds)
    if not chosen.outcome.optimal:
        assert chosen.values is None and numerical.status == 2
        return
    assert satisfies(given_task, of, chosen.values)
    assert numerical.status == 0 and abs(numerical.fun - float(chosen.outcome.value)) < 1e-6


@settings(max_examples=18)
@given(tasks(3, 5))
def test_elimination_and_the_linear_program_agree(given_task):
    (of,) = given_task.raised
    found = single_formula.eliminate(given_task, of)
    outcome = choose(given_task, of).outcome
    if not outcome.optimal:
        assert qe.decide(f"ex {VALUE}. {found.values}") is False
        return
    for shift, attained in ((F(0), True), (F(-1, 100), False)):
        place = {VALUE: outcome.value + shift}
        assert holds_at(found.values, place) is attained and holds_at(found.least, place) is attained
    assert qe.decide(f"all {VALUE}. ({found.least}) -> {VALUE} = {outcome.value}")


@settings(max_examples=6)
@given(tasks(3, 6), HEIGHTS)
def test_symbols_give_the_optimum_of_every_number(given_task, height):
    (of,) = given_task.raised
    moved = replace(of, height=height)
    outcome = choose(replace(given_task, axes=(moved, FLAT)), moved).outcome
    symbols = {Symbol.HEIGHT, Symbol.START, Symbol.GOAL}
    numbers = {"h": height, "y0": of.start, "yn": of.goal}
    for used in ({Symbol.HEIGHT}, symbols):
        found = single_formula.eliminate(given_task, of, used)
        place = {name: number for name, number in numbers.items() if len(used) > 1 or name == "h"}
        if not outcome.optimal:
            assert not holds_at(found.least, {**place, VALUE: height * (given_task.q - given_task.p)})
        else:
            assert holds_at(found.least, {**place, VALUE: outcome.value})
            assert not holds_at(found.least, {**place, VALUE: outcome.value + 1})


@each(Symbol.A, Symbol.B)
def test_the_ends_of_the_interval_as_symbols(symbol):
    of = axis("y", 0, "1/2", 1)
    given_task = unit_task(4, "3/10", "4/5", of, FLAT)
    found = single_formula.eliminate(given_task, of, {symbol})
    for k in range(1, 5):
        a = F(1, 4) + F(k, 16) if symbol is Symbol.A else F(3, 10)
        b = F(3, 4) + F(k - 1, 16) if symbol is Symbol.B else F(4, 5)
        other = unit_task(4, a, b, of, FLAT)
        assert (other.p, other.q) == (given_task.p, given_task.q)
        value = choose(other, of).outcome.value
        place = {symbol.value: a if symbol is Symbol.A else b}
        assert holds_at(found.least, {**place, VALUE: value})
        assert not holds_at(found.least, {**place, VALUE: value + F(1, 10)})
    outside = {symbol.value: F(1, 5) if symbol is Symbol.A else F(1)}
    assert not holds_at(found.least, {**outside, VALUE: F(1)})


def test_one_optimum_of_many_is_chosen():
    """y3 = h is optimal with any y1, y2, y4, y5 that meet the two equations; the largest |y_i| is made least."""
    of = axis("y", 0, 0, 1)
    given_task = unit_task(6, "2/5", "3/5", of, FLAT)
    chosen = choose(given_task, of)
    level = F(72352, 100000) / F(672768, 1000000)
    assert chosen.outcome.value == 1
    assert chosen.values == (0, level, level, 1, level, level, 0)


def test_the_largest_absolute_value_counts_negative_ones_too():
    of = axis("y", "-9/2", "-7/2", 1)
    inner = choose(unit_task(7, "11/20", "13/20", of, FLAT), of).values[1:-1]
    assert inner[0] == min(inner) == -max(inner)


@given(tasks(4, 7))
def test_the_tie_break(given_task):
    (of,) = given_task.raised
    chosen = choose(given_task, of)
    if chosen.values is None:
        return
    size = given_task.degree - 1
    limit = [
        [float(-(k == size)) or float(side * (j == k)) for k in range(size + 1)]
        for j in range(size)
        for side in (1, -1)
    ]
    for row in limit:
        row[size] = -1.0
    equal, values, bounds = parts(given_task, of)
    equal = [[*row, 0.0] for row in (*equal, map(float, objective(given_task)))]
    values.append(float(chosen.outcome.value))
    best = linprog([0.0] * size + [1.0], limit, [0.0] * len(limit), equal, values, [*bounds, (0.0, None)])
    largest = max(map(abs, chosen.values[1:-1]))
    assert best.status == 0 and abs(best.fun - float(largest)) < 1e-6


def test_speed():
    axes = axis("y", 2, 1, 3), axis("z", 0, 1, 2)
    given_task = task(12, (F(-3), F(3)), (F(-1), F(1)), axes)
    choose(given_task, axes[0])
    begin = time.perf_counter()
    for of in axes:
        choose(given_task, of)
    assert time.perf_counter() - begin < 30  # 0.02 s on a quiet machine


# --- the holes ---------------------------------------------------------------------------------------


def test_a_curve_of_least_sum_dips():
    """A counterexample: (4) with its least sum, and P_y(1/2) < h between t_a = 2/5 and t_b = 3/5."""
    of = axis("y", 0, 0, 1)
    given_task = unit_task(6, "2/5", "3/5", of, FLAT)
    outer = (1 - weights_at(6, F(2, 5))[3]) / (weights_at(6, F(2, 5))[1] + weights_at(6, F(2, 5))[5])
    values = (F(0), outer, F(0), F(1), F(0), outer, F(0))
    assert satisfies(given_task, of, values)
    assert sum(values[i] for i in given_task.middle) == choose(given_task, of).outcome.value
    (dip,) = dips(given_task, curve(given_task, {"y": values}))
    assert F(2, 5) < dip.t < F(3, 5) and dip.value < 1
    assert dip.value == sum(w * v for w, v in zip(weights_at(6, dip.t), values, strict=True))
    assert lowest(given_task, of, F(1, 2)) == values


def test_the_chosen_curve_dips_where_the_goal_is_higher_than_h():
    of = axis("y", "-3/2", 1, "3/4")
    given_task = unit_task(5, "7/10", "9/10", of, FLAT)
    (dip,) = dips(given_task, curve(given_task, {"y": choose(given_task, of).values}))
    assert dip.t == F(4, 5) and dip.value < of.height


@given(tasks(3, 7), st.integers(0, 3))
def test_dips_against_dense_rational_sampling_and_degree_elevation(given_task, more):
    (of,) = given_task.raised
    chosen = choose(given_task, of)
    if chosen.values is None:
        return
    drawn = curve(given_task, {"y": chosen.values})
    found = dips(given_task, drawn)
    low, high = given_task.times
    samples = [drawn.point(low + F(k, 64) * (high - low))[1] for k in range(65)]
    assert found or min(samples) >= of.height
    assert all(low < dip.t < high and drawn.point(dip.t)[1] == dip.value < of.height for dip in found)
    elevated = drawn.elevate(given_task.degree + more)
    assert bool(dips(given_task, elevated)) == bool(found)
    assert elevated.coordinate(0) == equally_spaced(given_task.degree + more, F(0), F(1))


@given(tasks(3, 7))
def test_the_lowest_curve_is_one_of_least_sum(given_task):
    (of,) = given_task.raised
    chosen, middle = choose(given_task, of), sum(given_task.times) / 2
    values = lowest(given_task, of, middle)
    assert (values is None) == (chosen.values is None)
    if values is not None:
        assert satisfies(given_task, of, values)
        assert sum(values[i] for i in given_task.middle) == chosen.outcome.value
        height = weights_at(given_task.degree, middle)
        assert sum(w * (u - v) for w, u, v in zip(height, chosen.values, values, strict=True)) >= 0


@example(unit_task(6, "2/5", "3/5", axis("y", 0, 0, 1), FLAT))
@given(tasks(3, 6))
def test_the_parts_of_the_program(given_task):
    (of,) = given_task.raised
    built = program(given_task, of)
    assert len(built.names) == len(objective(given_task)) == given_task.degree - 1
    assert [i + 1 for i, c in enumerate(objective(given_task)) if c] == list(given_task.middle)


def test_the_documented_lines_run(root, capsys):
    page = (root / "docs" / "single.md").read_text()
    exec(page.split("```python\n")[1].split("```")[0], {})
    assert "v" in capsys.readouterr().out
