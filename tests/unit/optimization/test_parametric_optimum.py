"""Optima as functions of parameters: cases, and agreement with the optimum at single parameter values."""

import json
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from tests.tables import each


@each(
    ("x^2 + b*x + c", "true", "b, c", ["(4*c - b^2)/4 at x = -b/2"]),
    ("a*x^2 + x", "true", "a", ["unbounded if a <= 0", "-1/(4*a) at x = -1/(2*a) if a > 0"]),
    ("x", "x^2 + y^2 <= r", "r", ["-sqrt(r) at x = -sqrt(r), y = 0 if r >= 0"]),
    (
        "x^4 + a*x^2",
        "true",
        "a",
        ["-a^2/4 at x = -sqrt(-a/2) or x = sqrt(-a/2) if a <= 0", "0 at x = 0 if a >= 0"],
    ),
    ("x", "x > a and x < 1", "a", ["a (not attained) if a < 1"]),
    ("x", "x^2 < 0 and a = a", "a", ["no point meets the constraints"]),
    ("max(x, a)", "x >= 0", "a", ["0 at x = 0 if a <= 0", "a at 0 <= x <= a if a >= 0"]),
    ("x/y", "x > a and y > 0", "a", ["unbounded if a < 0", "0 (not attained) if a >= 0"]),
    ("a*x", "true", "a", ["unbounded if a /= 0", "0 at any x if a = 0"]),
    ("a", "a > 0", "a", ["a if a > 0"]),
    # nine cases before, some with y = -sqrt((2*a*c*x - 2*a^2*x^2 - b^2*x^2)/a^2)
    (
        "x^2 + y^2",
        "a*x + b*y = c",
        "a, b, c",
        [
            "c^2/(a^2 + b^2) at x = a*c/(a^2 + b^2), y = b*c/(a^2 + b^2) if b /= 0",
            "0 at x = 0, y = 0 if c = 0",
            "c^2/a^2 at x = c/a, y = 0 if a /= 0 and b = 0",
        ],
    ),
    (
        "x^4 - 3*x",
        "x >= b",
        "b",
        ["-cbrt(2187/256) at x = cbrt(3/4) if 4*b^3 <= 3", "b^4 - 3*b at x = b if 4*b^3 >= 3"],
    ),
    ("(x - a)^2 + y^2", "y = b*x", "a, b", ["a^2*b^2/(b^2 + 1) at x = a/(b^2 + 1), y = a*b/(b^2 + 1)"]),
    ("abs(x - a)", "ex y. y^2 = x", "a", ["-a at x = 0 if a <= 0", "0 at x = a if a > 0"]),
)
def test_cases(objective, constraints, parameters, printed):
    assert str(qe.minimize(objective, constraints, parameters=parameters)).splitlines() == printed


def test_cases_that_differ_in_values_beyond_the_optimum_are_one():
    """For a <= 0 and for a > 0 "unbounded" stood on a line of its own, since the least values differ."""
    found = qe.optimum("x^2 - a*x", "x >= 0", parameters="a")
    assert str(found) == "least: 0 at x = 0 if a <= 0\n-a^2/4 at x = a/2 if a > 0\ngreatest: unbounded"
    assert str(qe.optimum("x + a", "0 <= x <= 1", parameters="a").least) == "a at x = 0"


def test_points_where_the_equation_of_the_value_vanishes():
    """All y were said to have the least value of x^2 + y^2 on 0 = 0, as (a^2 + b^2)*value = c^2 holds for every value
    there."""
    found = qe.minimize("x^2 + y^2", "a*x + b*y = c", parameters="a, b, c")
    (case,) = [case for case in found if [str(r) for r in case.ranges] == ["a = 0", "b = 0", "c = 0"]]
    assert qe.equivalent(" or ".join(" and ".join(map(str, place)) for place in case.minimisers), "x = 0 and y = 0")
    assert str(found.at({"a": 0, "b": 0, "c": 0})) == "GlobalOptimum(0 at x = 0, y = 0)"


QUESTIONS = (
    ("a*x^2 + b*x", "-1 <= x <= 1", "a, b"),
    ("a*x + b*y", "x^2 + y^2 <= 1", "a, b"),
    ("x^2 + a*x*y + y^2", "x + y = b", "a, b"),
    ("(x - a)^2 + (y - b)^2", "x*y = 0", "a, b"),
    ("a*x", "b*x = 0", "a, b"),
    # where points are on curves they are said by pieces; of several such places of a only the first one was said
    ("x*y", "x*y = a^2 - 3", "a"),
    ("b^2 - a*x", "2*x*y <= 3*a", "a, b"),
)


@each(*QUESTIONS)
def test_what_is_stated_are_the_cases(objective, constraints, parameters):
    """Under each condition the points are those of the cases there, and every case is under one."""
    found = qe.minimize(objective, constraints, parameters=parameters)

    def formula(value, attained, points, conditions):
        places = " or ".join(f"({' and '.join(p for p in point if 'any' not in p) or 'true'})" for point in points)
        where = " and ".join(f"({c})" for c in conditions) or "true"
        kind = f"value = {value} and kind = {int(attained)}" if value else "value = 0 and kind = 2"
        return f"({where}) and {kind} and ({places or 'true'})"

    stated, cases = (" or ".join(formula(*one) for one in some) for some in (found.stated, [c.stated for c in found]))
    assert qe.equivalent(stated, cases)


def test_the_greatest_value():
    found = qe.maximize("x^3 - a*x", "x^2 <= 1", parameters="a")
    assert [str(case.ranges[0]) for case in found] == ["a < 3/4", "a = 3/4", "3/4 < a <= 3", "a > 3"]
    assert [len(case.minimisers) for case in found] == [1, 2, 1, 1]
    assert all(case.attained for case in found)
    assert [str(case.value) for case in found] == ["1 - a", "1 - a", "sqrt(12*a^3)/9", "a - 1"]
    apart = qe.maximize("x", "x = 0 or x = a and a > 1", parameters="a")
    assert [str(apart.at({"a": a}).value) for a in (1, 2)] == ["0", "2"]
    proved = qe.maximize("x^3 - a*x", "x^2 <= 1", parameters="a", check=True)
    assert proved.certificate is not None and qe.verify(proved.certificate).accepted


def test_the_points_as_a_formula():
    """Also where signs do not tell the ends apart, and where they are not attained."""
    disc = qe.maximize("x", "x^2 + y^2 <= r", parameters="r")
    assert not disc.minimisers.is_quantifier_free
    assert qe.equivalent(disc.minimisers, "y = 0 and x >= 0 and x^2 = r")
    assert str(qe.minimize("x", "x > a and x < 1", parameters="a").minimisers) == "false"
    assert qe.equivalent(qe.minimize("x", "x >= a and x < 1", parameters="a").minimisers, "x = a and a < 1")


def value_of(text, **numbers):
    """The number that a printed root function is at these parameters."""
    fixed = " and ".join(f"{name} = {number}" for name, number in numbers.items())
    (point,) = qe.region(f"{fixed} and result = {text}").sample_points()
    return point["result"]


@settings(max_examples=4, deadline=None)
@given(st.integers(-3, 3), st.integers(-2, 2), st.integers(0, 2), st.fractions(-3, 3, max_denominator=4), st.booleans())
def test_at_every_parameter_it_is_the_optimum_there(p, q, k, m, least):
    objective = f"x^3 + ({p})*m*x + ({q})"
    constraints = f"{-k} <= x and x < 2 and x*m <= 1"
    optimum = qe.minimize if least else qe.maximize
    everywhere = optimum(objective, constraints, parameters="m")
    here = optimum(objective.replace("m", f"({m})"), constraints.replace("m", f"({m})"), method="elimination")
    there = everywhere.at({"m": m})
    assert (there.status, there.value, there.attained) == (here.status, here.value, here.attained)
    fixed = f"m = {m}"

    def holds(case):
        ranges = " and ".join(map(str, case.ranges)).replace("m any", "true")
        return qe.decide(f"ex m. {fixed} and ({ranges})")

    inside = [case for case in everywhere if holds(case)]
    if here.value is None:
        assert not inside or inside[0].value is None
        return
    assert len(inside) == 1 and inside[0].attained is here.attained
    assert value_of(str(inside[0].value), m=m) == here.value
    # the pieces, their formula, and the minimisers at the number itself are the same points
    given_by_pieces = " or ".join(" and ".join(map(str, place)) for place in inside[0].minimisers) or "false"
    of_pieces = f"{fixed} and ({given_by_pieces})"
    assert qe.equivalent(of_pieces, f"{fixed} and ({here.minimisers})")
    assert qe.equivalent(f"{fixed} and ({everywhere.minimisers})", f"{fixed} and ({here.minimisers})")
    assert qe.equivalent(str(there.minimisers), str(here.minimisers))
    assert there.attained == bool(there.point)


TERMS = ["abs(x - m)", "max(x, m*x)", "x/(x^2 + m^2 + 1)", "min(x^2, (x - m)^2 + 1)", "m*x^2 - x", "sqrt(x^2 + m^2)"]


@settings(max_examples=4, deadline=None)
@given(st.sampled_from(TERMS), st.integers(-2, 1), st.integers(1, 3), st.fractions(-2, 2, max_denominator=3))
def test_terms_that_are_no_polynomials(term, low, width, m):
    constraints = f"x > {low} and x <= {low + width}"
    everywhere = qe.minimize(term, constraints, parameters="m")
    here = qe.minimize(term.replace("m*", f"({m})*").replace("m^", f"({m})^").replace("- m", f"- ({m})"), constraints)
    there = everywhere.at({"m": m})
    assert (there.value, there.attained) == (here.value, here.attained)
    if here.attained and not hasattr(here, "multipliers"):
        assert qe.equivalent(str(there.minimisers), str(here.minimisers))


def test_two_parameters():
    found = qe.minimize("a*x + b*y", "x >= 0 and y >= 0 and x + y <= 1", parameters="a, b")
    assert len(found) == 9
    assert str(found.at({"a": -1, "b": -2})) == "GlobalOptimum(-2 at x = 0, y = 1)"
    (edge,) = [case for case in found if [str(r) for r in case.ranges] == ["a < 0", "b = a"]]
    assert [str(r) for r in edge.minimisers[0]] == ["0 <= x <= 1", "y = 1 - x"]


def test_an_irrational_parameter():
    root = qe.minimize("x", "x^2 = 2").value
    found = qe.minimize("x^2 - a*x", "x >= 0", parameters="a")
    assert (str(found.at({"a": -root}).value), str(found.at({"a": -root}).point["x"])) == ("-1/2", "sqrt(2)/2")
    assert found.at({"a": root}).value == 0
    assert str(found.at({"a": root}).minimisers) == "x = 0"


def test_points_that_are_too_much_work_are_left_to_single_parameters(monkeypatch):
    monkeypatch.setattr("qe.optimization.minimisers.MOST_WORK", 1)
    found = qe.minimize("x^4 - a*x^2", parameters="a")
    assert [str(case) for case in found] == ["0 if a <= 0", "-a^2/4 if a > 0"]
    assert [case.minimisers for case in found] == [None, None]
    assert found.to_dict()["cases"][0]["minimisers"] is None
    assert qe.equivalent(str(found.at({"a": 8}).minimisers), "x^2 = 4")


def test_for_machines_and_for_print():
    found = qe.minimize("x^2 - a*x", "x > 0", parameters="a")
    assert json.loads(found.to_json()) == {
        "parameters": ["a"],
        "variable": "value",
        "cases": [
            {"where": ["a <= 0"], "value": "0", "attained": False, "minimisers": []},
            {"where": ["a > 0"], "value": "-a^2/4", "attained": True, "minimisers": [["x = a/2"]]},
        ],
    }
    assert found.to_latex() == (
        "\\begin{cases}\n0\\ (\\text{not attained}) & a \\leq 0 \\\\\n"
        "\\frac{-a^{2}}{4}\\ \\text{at}\\ x = \\frac{a}{2} & a > 0\n\\end{cases}"
    )
    roots = qe.minimize("x", "x^2 - x <= r and x^3 < s", parameters="r, s").to_latex()
    assert "\\frac{1 - \\sqrt{4\\,r + 1}}{2}" in roots
    assert "\\operatorname{root}_{1}" in qe.minimize("x", "x^3 + x = c", parameters="c").to_latex()


@each(
    ("any^2 + a*any", "a", r"\frac{-a^{2}}{4}\ \text{at}\ \mathrm{any} = \frac{-a}{2} & "),
    ("a*`b c`^2 + y*0", "a", r"0\ \text{at}\ \mathrm{b\ c} \in \mathbb{R} & a = 0"),
)
def test_odd_names_in_latex(objective, parameters, line):
    """A variable of the name any was taken for the word."""
    assert line in qe.minimize(objective, parameters=parameters).to_latex()


@each(
    ({}, "a value for each of a expected"),
    ({"a": 1, "b": 2}, "a value for each of a expected"),
    ({"a": "x"}, "an exact number for a expected"),
    (3, "a mapping from names to values expected"),
)
def test_parameters_that_are_refused(given, message):
    with pytest.raises(qe.InputError, match=message):
        qe.minimize("x^2 - a*x", parameters="a").at(given)


def test_limits_hold_at_a_point():
    found = qe.minimize("x^2 - a*x", parameters="a")
    assert found.at({"a": 3}, process=False).value == found.at({"a": 3}, timeout=60).value == Fraction(-9, 4)


def test_a_parameter_twice_is_refused():
    with pytest.raises(qe.InputError, match="parameters: each name once expected, a found twice"):
        qe.minimize("x", "x > a", parameters="a, a")


def test_a_parameter_may_be_called_value():
    found = qe.minimize("1/x", "x^3 >= value and x > 0 and x <= 2", parameters="value")
    assert (found.variable, str(found.cases[0])) == ("value_", "1/2 at x = 2 if value <= 8")
