"""Goals: all names in one ring, and the values that are taken as a formula."""

from __future__ import annotations

from fractions import Fraction

import pytest

import qe
from qe.errors import InputError
from qe.exact.ring import Ring
from qe.io.text import read
from qe.optimization.values import Goal
from qe.options import Budget

RING = Ring.of(("x", "y"))
X, Y = RING.var("x"), RING.var("y")


def test_names_come_into_one_ring() -> None:
    goal = Goal.of(X * Y, Fraction(1, 3), read("x > a and z = 1"), ["a"])
    assert goal.parameters == ("a",) and goal.value == "value" and goal.variables == ("x", "y", "z")
    assert goal.objective.ring.names[:2] == ("a", "value")
    ring = goal.objective.ring
    assert goal.equation == 3 * ring.var("value") - ring.var("x") * ring.var("y")


def test_a_taken_name_is_avoided() -> None:
    goal = Goal.of(X, Fraction(1), read("value > x and value_ < 1"))
    assert goal.value == "value__" and "value" in goal.variables


@pytest.mark.parametrize("parameters", [["b"], ["a", "a"], ["x", "q"]])
def test_strange_parameters(parameters: list[str]) -> None:
    with pytest.raises(InputError, match="variables of the problem expected, each once"):
        Goal.of(X, Fraction(1), read("x > a"), parameters)


@pytest.mark.parametrize(
    ("objective", "scale", "conditions", "values"),
    [
        (X, 1, "0 < x and x <= 3", "0 < value and value <= 3"),
        (X * X, -2, "-1 <= x and x < 2", "-8 < value and value <= 0"),
        (X + Y, Fraction(1, 2), "x^2 + y^2 <= 2", "-1 <= value and value <= 1"),
        (X, 1, "x > 0 and x < 0", "false"),
    ],
)
def test_the_values_that_are_taken(objective: object, scale: Fraction, conditions: str, values: str) -> None:
    goal = Goal.of(objective, Fraction(scale), read(conditions))  # type: ignore[arg-type]
    found, answer = goal.values(Budget(60), check=False)
    assert qe.equivalent(found, values) and answer.formula == found


def test_with_parameters() -> None:
    found, _ = Goal.of(X, Fraction(1), read("x^2 <= a"), ["a"]).values(Budget(60), check=False)
    assert qe.equivalent(found, "value^2 <= a")
