"""Numbers that are not algebraic: bounds, and what the doors make of them."""

from __future__ import annotations

from fractions import Fraction

import mpmath
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.formula.evaluate import holds_at
from qe.formula.numbers import bounds_of_numbers
from qe.io.text import read
from qe.spelling import NUMBERS, PI
from tests.tables import each

DIGITS = "3.14159265358979323846264338327950288419716939937510"


def test_bounds_are_of_the_numbers_that_occur() -> None:
    assert bounds_of_numbers(read("x > 1")) == read("true")
    bounds = bounds_of_numbers(read("x > pi"), read("y < ℯ"))
    assert bounds.free == NUMBERS[:2]
    assert holds_at(bounds, {PI: Fraction(DIGITS), "ℯ": Fraction("2.71828182845904523536028747")})
    assert not holds_at(bounds, {PI: Fraction("3.14159265358979"), "ℯ": Fraction("2.71828182845904523536028747")})


@each(
    ("pi > 3", True),
    ("pi = 22/7", False),
    ("22/7 - pi > 0.001", True),
    (f"pi > {DIGITS}", True),
    (f"pi > {DIGITS}6", False),  # a bound with as many digits as the text would say neither
    ("all r. r^2 - pi*r + 3 > 0", True),
    ("ex x. x > pi and x^2 < 9.87", True),
    ("ex x. x > pi and x^2 < 9.8696", False),
    ("ex x. x^3 - pi*x + 1 = 0 and x > 1", True),
    ("pi^2 = 10", False),
    ("ℯ < pi and ℯ^2 > 7.389", True),
)
def test_sentences(text: str, truth: bool) -> None:
    assert qe.decide(text) is truth
    assert qe.eliminate(text, check=True).truth is truth


def test_a_chain_of_small_numbers_comes_closer_to_pi_than_its_coefficients_show() -> None:
    """The sentence was not decided: the first bounds have about 28 digits, the last convergents share more with pi."""
    quotients = [3, 7, 15, 1, 292, *map(int, "1112131"), 14, *map(int, "211222")]
    quotients += [2, 1, 84, 2, 1, 1, 15, 3, 13, 1, 4, 2, 6, 6, 99, 1, 2, 2, 6, 3, 5, 1, 1, 6, 8, 1, 7, 1, 2, 3, 7, 1, 2]
    for size in (len(quotients) - 1, len(quotients)):
        last = size - 1
        chain = " and ".join(f"x{i}*x{i + 1} = {q}*x{i + 1} + 1" for i, q in enumerate(quotients[:last]))
        names = ", ".join(f"x{i}" for i in range(size))
        sentence = f"ex {names}. {chain} and x{last} = {quotients[last]} and pi < x0"
        assert qe.decide(sentence) is (size % 2 == 0)
        assert qe.eliminate(sentence).truth is (size % 2 == 0)


@each(
    ("ex r. r > 0 and pi*r^2 = a and r < 2", "a > 0 and a < 4*pi"),
    ("x > 3 and x > pi", "x > pi"),
    ("ex x. x^2 + b*x + pi = 0", "b^2 >= 4*pi"),
    ("pi/abs(x) <= 1", "x >= pi or x <= -pi"),
    ("x < root(2, x^2 - pi)", "x < 0 or x^2 < pi"),
)
def test_answers(text: str, expected: str) -> None:
    answer = qe.eliminate(text, check=True)
    assert answer.guarantee is qe.Guarantee.CHECKED
    assert qe.equivalent(answer, expected)
    assert not qe.equivalent(answer, expected.replace("pi", "(pi + 1)"))
    assert qe.equivalent(str(answer), answer)


def test_solutions_and_words() -> None:
    assert str(qe.solve("x^2 = pi")) == "x = -sqrt(pi) or\nx = sqrt(pi)"
    assert qe.solve("x^2 < pi*y and y < pi", check=True).guarantee is qe.Guarantee.CHECKED
    assert str(qe.eliminate("-pi/2 < a and 3*a <= 2*pi + 1")) == "-pi/2 < a <= (2*pi + 1)/3"
    assert qe.eliminate(sp.pi < sp.Abs(sp.Symbol("m"))).to_sympy() == sp.Or(
        sp.Symbol("m") > sp.pi, sp.Symbol("m") < -sp.pi
    )
    assert qe.solve(sp.Eq(sp.Symbol("x"), sp.E)).to_sympy() == sp.Eq(sp.Symbol("x"), sp.E)


@each(
    ("2*pi*r^2 + 2*pi*r*h", "pi*r^2*h = 1 and r > 0 and h > 0", "cbrt(54*pi) at r = sqrt(value/(6*pi)), h = 2*r"),
    ("x^2 - pi*x", "true", "-pi^2/4 at x = pi/2"),
    ("x", "x^2 > pi and x > 1/2", "sqrt(pi) (not attained)"),
    ("x", "x > pi and x < 3", "no point meets the constraints"),
    (
        "Minimize[{x^2 - a*x*Pi, x < 2}, {x}]",
        "true",
        "-pi^2*a^2/4 at x = pi*a/2 if a < 4/pi\n4 - 2*pi*a (not attained) if a >= 4/pi",
    ),
)
def test_optima(objective: str, constraints: str, expected: str) -> None:
    assert str(qe.minimize(objective, constraints)) == expected


@settings(max_examples=20)
@given(st.lists(st.integers(-9, 9), min_size=6, max_size=6), st.integers(-400, 400))
def test_an_answer_holds_where_the_question_does(c: list[int], hundredths: int) -> None:
    """The question at a rational x by forty digits of pi, the answer by an enclosure of its own."""
    text = f"{c[0]}*x^2 + {c[1]}*pi*x + {c[2]} > 0 and {c[3]}*x + {c[4]}*pi^2 < {c[5]}"
    answer, x = qe.eliminate(text), Fraction(hundredths, 100)
    with mpmath.workdps(40):
        first = c[0] * x * x + mpmath.mpf(c[1]) * mpmath.pi * x.numerator / x.denominator + c[2]
        second = mpmath.mpf(c[3]) * x.numerator / x.denominator + c[4] * mpmath.pi**2 - c[5]
        expected = first > 0 and second < 0
    assert holds_at(answer.formula, {"x": x, PI: Fraction(DIGITS)}) is bool(expected)
