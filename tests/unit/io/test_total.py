"""Values outside domains: what a lowering notes of them, and what they are at a point."""

from fractions import Fraction

import pytest

from qe.errors import InputError
from qe.exact.ring import Ring
from qe.formula.syntax import TRUE
from qe.io.cases import Case
from qe.io.terms import Value
from qe.io.total import Fill, Total

RING = Ring.of(("x", "y"))
X, Y = RING.var("x"), RING.var("y")


def case(top: object, den: int = 1, *below: object) -> Case:
    return Case((), Value(top, den, 1), below)  # type: ignore[arg-type]


def test_a_weakened_formula_is_no_answer() -> None:
    assert Total().checked(TRUE) is TRUE and Total(unclear=True).checked(TRUE) is TRUE
    with pytest.raises(InputError, match="x/0 is any function"):
        Total(weakened=True).checked(TRUE)


def test_arguments_and_values_at_a_point() -> None:
    total = Total(values={"u": ("/", (case(3 * X**2 - Y, 2), case(X * Y, 1, (Y, 2)))), "v": ("sqrt", (case(-X),))})
    point = {"x": Fraction(2), "y": Fraction(4), "u": Fraction(7), "v": Fraction(-1)}
    assert total.at(point) == [("/", Fraction(4), 7), ("/", Fraction(1, 2), 7), ("sqrt", Fraction(-2), -1)]
    assert total.at({"x": Fraction(2), "u": Fraction(7)}) == [("sqrt", Fraction(-2), 0)]  # y is not known
    zero = {**point, "y": Fraction(0)}
    assert total.at(zero) == [("/", Fraction(6), 7), ("sqrt", Fraction(-2), -1)]  # the second argument is none there


def test_a_new_attempt_forgets_the_last() -> None:
    total = Total(frozenset("x"), Fill.CONSTANT, {"u": ("/", ())}, weakened=True, unclear=True)
    total.begin()
    assert total == Total(frozenset("x"), Fill.CONSTANT)
