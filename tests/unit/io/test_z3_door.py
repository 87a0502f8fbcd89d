"""Formulas from z3, by its own printer."""

import pytest

import qe
from qe.errors import InputError
from qe.io.z3_door import from_z3
from tests.tables import each

z3 = pytest.importorskip("z3")
X, Y = z3.Reals("x y")


@each(
    (X > Y, "x > y"),
    ([X > 0, Y > X], "x > 0 and y > x"),
    (z3.And(X * X == 2, z3.Not(Y < X)), "x^2 = 2 and y >= x"),
    (z3.Exists([Y], Y * Y == X), "x >= 0"),
    (z3.Implies(z3.Bool("p"), X > 0), "p > 0 -> x > 0"),
)
def test_expressions(given: object, text: str) -> None:
    assert qe.equivalent(from_z3(given), text)


def test_what_a_solver_holds() -> None:
    solver = z3.Solver()
    solver.add(X > 0, X < Y)
    assert qe.equivalent(from_z3(solver), "x > 0 and x < y")


@each(3, [], "x > 0", [X > 0, 1], X + Y, z3.Int("n") > 0)
def test_what_is_refused(given: object) -> None:
    with pytest.raises(InputError):
        from_z3(given)
