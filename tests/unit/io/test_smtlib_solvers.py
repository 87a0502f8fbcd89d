"""Formulas from z3, by its own printer."""

from typing import Any

import pytest

import qe
from qe.errors import InputError
from qe.io.smtlib import from_z3
from tests.tables import each

z3 = pytest.importorskip("z3")
X, Y = z3.Reals("x y")


def held_by(solver: Any, *conditions: object) -> object:
    solver.add(*conditions)
    return solver


@each(
    (X > Y, "x > y"),
    ([X > 0, Y > X], "x > 0 and y > x"),
    (z3.And(X * X == 2, z3.Not(Y < X)), "x^2 = 2 and y >= x"),
    (z3.Exists([Y], Y * Y == X), "x >= 0"),
    (z3.Implies(z3.Bool("p"), X > 0), "p > 0 -> x > 0"),
    (z3.Exists([X], z3.And(X * X == Y, X > 1)), "y > 1"),
    ([X > 0, z3.Or(Y < X, z3.Not(Y < 2))], "x > 0 and (y < x or y >= 2)"),
    (held_by(z3.Solver(), X > 0, X < Y), "x > 0 and x < y"),
    (held_by(z3.Optimize(), X > Y), "x > y"),
    (z3.Optimize(), "true"),
)
def test_what_it_says(given: object, text: str) -> None:
    assert qe.equivalent(from_z3(given), text) and qe.equivalent(qe.from_z3(given), text)
    assert qe.equivalent(given, text) and qe.equivalent(text, given)


@each(
    (3, "z3"),
    ([], "z3"),
    ("x > 0", "z3"),
    ([X > 0, 1], "z3"),
    (X + Y, "Boolean"),
    (z3.Int("n") > 0, "Int"),
)
def test_what_is_refused(given: object, said: str) -> None:
    with pytest.raises(InputError, match=said) as caught:
        from_z3(given)
    assert "\n" not in str(caught.value)
