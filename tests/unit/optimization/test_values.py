"""Goals: all names in one ring, and the values that are taken as a formula."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction

import pytest

import qe
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom
from qe.formula.syntax import Relation
from qe.io.text import read
from qe.optimization.values import Goal, Objective, new_name
from qe.options import Budget
from tests.tables import each

RING = Ring.of(("x", "y"))
X, Y = RING.var("x"), RING.var("y")


def goal_of(poly: Poly, scale: Fraction | int, conditions: str, parameters: Iterable[str] = ()) -> Goal:
    read_conditions = read(conditions)
    return Goal.of(Objective.of(poly, scale, new_name(RING.names, read_conditions.free)), read_conditions, parameters)


def test_names_come_into_one_ring() -> None:
    goal = goal_of(X * Y, Fraction(1, 3), "x > a and z = 1", ["a"])
    assert goal.parameters == ("a",) and goal.value == "value" and set(goal.variables) == {"x", "y", "z"}
    assert goal.ring.names[:2] == ("a", "value")
    value, x, y = map(goal.ring.var, ("value", "x", "y"))
    assert goal.graph == atom(3 * value - x * y, Relation.EQ)


def test_a_taken_name_is_avoided() -> None:
    goal = goal_of(X, 1, "value > x and value_ < 1")
    assert goal.value == "value__" and "value" in goal.variables


@each(["b"], ["a", "a"], ["x", "q"])
def test_strange_parameters(parameters: list[str]) -> None:
    with pytest.raises(qe.InputError, match="parameters: "):
        qe.minimize("x", "x > a", parameters=parameters)


@each(
    (X, 1, "0 < x and x <= 3", "0 < value and value <= 3"),
    (X * X, -2, "-1 <= x and x < 2", "-8 < value and value <= 0"),
    (X + Y, Fraction(1, 2), "x^2 + y^2 <= 2", "-1 <= value and value <= 1"),
    (X, 1, "x > 0 and x < 0", "false"),
)
def test_the_values_that_are_taken(objective: Poly, scale: Fraction, conditions: str, values: str) -> None:
    goal = goal_of(objective, scale, conditions)
    found, answer = goal.values(Budget(60), check=False)
    assert qe.equivalent(found.formula, values) and answer.formula == found.formula
    assert goal.proved(found, Budget(60), check=False).formula == found.formula


def test_with_parameters() -> None:
    found, _ = goal_of(X, 1, "x^2 <= a", ["a"]).values(Budget(60), check=False)
    assert qe.equivalent(found.formula, "value^2 <= a")
