"""Numbers as SMT-LIB models print them."""

from __future__ import annotations

from fractions import Fraction

from qe.cli.smt_values import written
from qe.exact.algebraic import RealAlgebraic
from qe.io import smtlib
from tests.tables import each


@each(
    (0, "0.0"),
    (7, "7.0"),
    (-7, "(- 7.0)"),
    (Fraction(2, 3), "(/ 2.0 3.0)"),
    (Fraction(-2, 3), "(- (/ 2.0 3.0))"),
    (RealAlgebraic.rational(Fraction(1, 2)), "(/ 1.0 2.0)"),
)
def test_rational_numbers(number: object, text: str) -> None:
    assert written(number) == text


@each(0, 1, 2)
def test_an_irrational_number_is_read_back(index: int) -> None:
    """The roots of x^3 - 3x + 1, each between its neighbours' bounds."""
    low, high = [(-2, -1), (0, 1), (1, 2)][index]
    number = RealAlgebraic.from_root([1, -3, 0, 1], low, high)
    text = f"(declare-const y Real)(assert (= y {written(number)}))"
    formula = smtlib.read(text)
    import qe

    assert qe.equivalent(formula, f"y^3 - 3*y + 1 = 0 and y > {low} and y < {high}")
