"""Answers as people write them: intervals from left to right, conditions on single variables first."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

import qe
from qe.formula.evaluate import holds_at
from qe.io.text import read
from qe.simplifier.presented import presented

ROOT = st.fractions(-3, 3, max_denominator=2)
FACTOR = st.one_of(ROOT.map(lambda r: f"(x - ({r}))"), st.sampled_from(("(x^2 + 1)", "(x^2 - 2)")))
ATOM = st.builds(
    lambda factors, relation: f"{'*'.join(factors)} {relation} 0",
    st.lists(FACTOR, min_size=1, max_size=3),
    st.sampled_from(("<", "<=", "=", "/=", ">", ">=")),
)
FORMULA = st.recursive(ATOM, lambda inner: st.builds("({} {} {})".format, inner, st.sampled_from(("and", "or")), inner))


@given(FORMULA)
def test_the_same_holds_at_every_point(text: str) -> None:
    formula = read(text)
    shown = presented(formula)
    for point in (Fraction(k, 8) for k in range(-28, 29)):
        assert holds_at(formula, {"x": point}) == holds_at(shown, {"x": point})
    assert presented(shown) == shown


@pytest.mark.parametrize(
    ("asked", "answer"),
    (
        ("ex x. x^2 + k*x + 1 = 0", "k <= -2 or k >= 2"),
        ("all x, y. x^2 + a*x*y + y^2 >= 0", "-2 <= a <= 2"),
        ("ex x. x^2 = m^3 - m", "-1 <= m <= 0 or m >= 1"),
        ("m > 5 or m = 3 or m < 1 and m > 0", "0 < m < 1 or m = 3 or m > 5"),
        ("m >= 3 or m <= 3/2", "m <= 3/2 or m >= 3"),
        ("ex x. x^2 + 2*a = a^2", "a <= 0 or a >= 2"),
        ("ex x. x^2 = a^2 - 2", "a^2 >= 2"),
        ("ex x. x*(a^2 - 1) = 1", "a /= -1 and a /= 1"),
        ("a > 0 and a /= 1", "a > 0 and a /= 1"),
        ("0 <= x1 <= x2 and x10 = 1 and x4 = 5", "x4 = 5 and x10 = 1 and 0 <= x1 <= x2"),
        ("ex x. a*x^2 + b*x + c = 0", "c = 0 or a*c < 0 or b /= 0 and b^2 - 4*a*c >= 0"),
    ),
)
def test_answers_are_written_in_order(asked: str, answer: str) -> None:
    found = qe.eliminate(asked, check=True)
    assert str(found.formula) == answer
    assert found.guarantee is qe.Guarantee.CHECKED
