"""Optima as functions of parameters: cases, and agreement with the optimum at single parameter values."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe


@pytest.mark.parametrize(
    ("objective", "constraints", "parameters", "printed"),
    [
        ("x^2 + b*x + c", "true", "b, c", ["(-b^2 + 4*c)/4 if b any, c any"]),
        ("a*x^2 + x", "true", "a", ["unbounded if a < 0", "unbounded if a = 0", "-1/(4*a) if 0 < a"]),
        ("x", "x^2 + y^2 <= r", "r", ["-sqrt(r) if 0 <= r"]),
        ("x^4 + a*x^2", "true", "a", ["-a^2/4 if a <= 0", "0 if 0 < a"]),
        ("x", "x > a and x < 1", "a", ["a (not attained) if a < 1"]),
        ("x", "x^2 < 0 and a = a", "a", ["no point meets the constraints"]),
    ],
)
def test_cases(objective, constraints, parameters, printed):
    assert str(qe.minimize(objective, constraints, parameters=parameters)).splitlines() == printed


def test_the_greatest_value():
    found = qe.maximize("x^3 - a*x", "x^2 <= 1", parameters="a")
    assert [str(case.ranges[0]) for case in found] == ["a <= 3/4", "3/4 < a <= 3", "3 < a"]
    assert [case.attained for case in found] == [True, True, True]
    assert qe.verify(found.certificate).accepted


def is_in(one, number):
    """Whether a number lies in the range of the only parameter, exactly."""
    above = one.lower is None or one.lower.value < number or (one.lower_closed and one.lower.value == number)
    below = one.upper is None or number < one.upper.value or (one.upper_closed and one.upper.value == number)
    return above and below


@settings(max_examples=5, deadline=None)
@given(st.integers(-3, 3), st.integers(-2, 2), st.integers(0, 2), st.fractions(-3, 3, max_denominator=4))
def test_at_every_parameter_it_is_the_optimum_there(p, q, k, m):
    objective = f"x^3 + ({p})*m*x + ({q})"
    constraints = f"{-k} <= x and x < 2 and x*m <= 1"
    everywhere = qe.minimize(objective, constraints, parameters="m")
    here = qe.minimize(objective.replace("m", f"({m})"), constraints.replace("m", f"({m})"))
    values = qe.region(everywhere.values, order=("m", everywhere.variable)).fibre({"m": m})
    if here.value is None:
        assert not values or values[0].lower is None
        return
    assert values[0].lower == here.value and values[0].lower_closed is here.attained
    inside = [case for case in everywhere if is_in(case.ranges[0], m)]
    assert len(inside) == 1 and inside[0].attained is here.attained


def test_a_parameter_twice_is_refused():
    with pytest.raises(qe.InputError, match="parameters: variables of the problem expected, each once"):
        qe.minimize("x", "x > a", parameters="a, a")


def test_a_parameter_may_be_called_value():
    assert str(qe.minimize("x", "x^3 >= value", parameters="value").cases[0].attained) == "True"
