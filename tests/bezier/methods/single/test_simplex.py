"""Exact linear programs: against a numerical solver, against the independent checker, and on degenerate input."""

import copy
from fractions import Fraction

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.optimize import linprog

import qe
from bezier.methods.single.simplex import Contradiction, LinearOptimum, LinearProgram, LinearRow, certificate, solve
from qe.errors import InternalError, Unable

NUMBER = st.fractions(-3, 3, max_denominator=3)


@st.composite
def programs(draw):
    """A small program with an objective; equations, repeated rows and zero rows included."""
    size = draw(st.integers(1, 5))
    numbers = st.tuples(*[NUMBER] * size)
    rows = draw(st.lists(st.builds(LinearRow, numbers, NUMBER, st.booleans()), max_size=6))
    if rows and draw(st.booleans()):
        rows.append(draw(st.sampled_from(rows)))
    names = tuple(f"x{i}" for i in range(size))
    return LinearProgram(names, draw(numbers), tuple(rows)), draw(numbers)


def numerically(program, cost):
    """The same by a floating-point solver."""

    def part(equation):
        rows = [row for row in program.rows if row.equation is equation]
        return (
            ([list(map(float, row.coefficients)) for row in rows], [float(row.bound) for row in rows])
            if rows
            else (
                None,
                None,
            )
        )

    (upper, bounds), (equal, values) = part(False), part(True)
    limits = [(float(low), None) for low in program.lower]
    return linprog(list(map(float, cost)), upper, bounds, equal, values, limits)


def is_point_of(program, x):
    """Whether x satisfies every row and lower bound, exactly."""
    rows = all(row.at(x) == 0 if row.equation else row.at(x) <= 0 for row in program.rows)
    return rows and all(v >= low for v, low in zip(x, program.lower, strict=True))


@given(programs())
@example((LinearProgram(("x",), (Fraction(0),), (LinearRow((Fraction(0),), Fraction(1), True),)), (Fraction(1),)))
@example((LinearProgram(("x",), (Fraction(0),), (LinearRow((Fraction(1),), Fraction(-1)),)), (Fraction(1),)))
def test_answers_are_proved_and_agree_with_a_numerical_solver(case):
    program, cost = case
    numerical = numerically(program, cost)
    try:
        found = solve(program, [cost])
    except Unable:
        assert numerical.status in (3, 4)
        return
    assert qe.verify(certificate(program, cost, found)).accepted
    if isinstance(found, Contradiction):
        assert numerical.status in (2, 4)
        return
    assert is_point_of(program, found.point)
    assert found.value == sum(c * x for c, x in zip(cost, found.point, strict=True))
    assert numerical.status == 0 and abs(numerical.fun - float(found.value)) < 1e-7


@given(programs(), st.lists(NUMBER, min_size=5, max_size=5))
def test_the_second_objective_decides_among_the_minima_of_the_first(case, second):
    program, cost = case
    second = second[: len(cost)]
    try:
        found = solve(program, [cost, second])
        first = solve(program, [cost])
    except Unable:
        return
    if isinstance(found, Contradiction):
        assert isinstance(first, Contradiction)
        return
    assert found.value == first.value and is_point_of(program, found.point)
    fixed = LinearProgram(program.names, program.lower, (*program.rows, LinearRow(cost, first.value, True)))
    best = solve(fixed, [second])
    assert best.value == sum(c * x for c, x in zip(second, found.point, strict=True))


def test_the_example_on_which_other_pivot_rules_cycle():
    """Beale (1955): degenerate at the origin; the largest-coefficient rule comes back to it for ever."""
    rows = (
        LinearRow(tuple(map(Fraction, ("1/4", "-8", "-1", "9"))), Fraction(0)),
        LinearRow(tuple(map(Fraction, ("1/2", "-12", "-1/2", "3"))), Fraction(0)),
        LinearRow(tuple(map(Fraction, (0, 0, 1, 0))), Fraction(1)),
    )
    program = LinearProgram(("a", "b", "c", "d"), (Fraction(0),) * 4, rows)
    found = solve(program, [tuple(map(Fraction, ("-3/4", "20", "-1/2", "6")))])
    assert found.value == Fraction(-5, 4) and found.point == (1, 0, 1, 0)


def test_altered_proofs_are_rejected():
    program = LinearProgram(
        ("x", "y"), (Fraction(0), Fraction(0)), (LinearRow((Fraction(-1), Fraction(-2)), Fraction(-3)),)
    )
    cost = (Fraction(1), Fraction(1))
    good = certificate(program, cost, solve(program, [cost]))
    assert qe.verify(good).accepted
    for key, place, value in (("multipliers", 0, ["1/3"]), ("point", 0, ["1"])):
        changed = copy.deepcopy(good.payload)
        evidence = changed["steps"][0]["evidence"]
        evidence[key] = [*evidence[key][:place], value, *evidence[key][place + 1 :]]
        assert not qe.verify(qe.Certificate(good.kind, changed)).accepted


def test_an_objective_without_bound_is_refused():
    program = LinearProgram(("x",), (Fraction(0),), ())
    with pytest.raises(Unable, match="without bound"):
        solve(program, [(Fraction(-1),)])
    assert isinstance(solve(program, [(Fraction(1),)]), LinearOptimum)


def test_rows_of_different_lengths_are_refused():
    with pytest.raises(InternalError):
        LinearProgram(("x",), (Fraction(0),), (LinearRow((), Fraction(0)),))


def test_the_limit_stops_the_work():
    def stop():
        raise Unable("stopped")

    program = LinearProgram(("x",), (Fraction(0),), (LinearRow((Fraction(-1),), Fraction(-1)),))
    with pytest.raises(Unable, match="stopped"):
        solve(program, [(Fraction(1),)], check=stop)
