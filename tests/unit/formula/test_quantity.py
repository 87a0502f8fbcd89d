"""Quantifiers that count: against their meaning on a line, in text and QEPCAD."""

from __future__ import annotations

import random
import re

import pytest

import qe
from qe.formula.quantity import infinitely_many
from qe.formula.syntax import Exists
from qe.io.text import read
from tests.differential.generate import Shape, random_formula
from tests.tables import each


@each(
    ("infinitely many x. x^2 <= a", "a > 0"),
    ("infinitely many x. a*x^2 + b*x + c = 0", "a = 0 and b = 0 and c = 0"),
    ("there are infinitely many x > 0: x^2 < a", "a > 0"),
    ("all but finitely many x. x^2 + a > 0", "a >= 0"),
    ("for almost all x. a*x /= 0", "a /= 0"),
    ("almost all x > 0. x > a", "a <= 0"),
    ("exactly 2 x. a*x^2 + b*x + c = 0", "a /= 0 and b^2 - 4*a*c > 0"),
    ("exactly one x > 0, x^2 = a", "a > 0"),
    ("exactly 0 x. x^2 = a", "a < 0"),
    ("exists unique x. x^2 = a", "a = 0"),
    ("there are exactly 3 x. x^3 + p*x + q = 0", "4*p^3 + 27*q^2 < 0"),
    ("exactly 1 x. sqrt(x) = a", "a >= 0"),
    ("connected x. x^2 >= a", "a <= 0"),
    ("connected x. a*x^2 + b*x + c > 0", "a <= 0 or 4*a*c - b^2 > 0"),
    ("connected x. x^2 < a", "true"),
    ("exactly 2 x. infinitely many y. (x^2 - a)*y = 0", "a > 0"),
    ("ex y. infinitely many x. x < y and x^2 < a", "a > 0"),
    ("not (exactly 1 x. x^2 = a)", "a /= 0"),
    ("at least two x: x^2 + a*x + 1 = 0", "a^2 > 4"),
    ("there are at least 2 x in [0, 1] such that x^2 + a*x + 1/8 = 0", "a^2 > 1/2 and -9/8 <= a <= 0"),
    ("at least 2 x. x^2 <= a", "a > 0"),
    ("at least 3 x. 0*x = a", "a = 0"),
    ("at most one x: x^2 = a", "a <= 0"),
    ("at most 2 x. a*x^2 + b*x + c = 0", "a /= 0 or b /= 0 or c /= 0"),
    ("at most 0 x. x^2 = a", "a < 0"),
    ("at least 0 x. x^2 = a", "true"),
    ("not (at most 1 x. sqrt(x) = a)", "false"),
)
def test_what_they_mean(text: str, said: str) -> None:
    assert qe.equivalent(qe.eliminate(text), said)


@each(
    ("(F x)[ x^2 <= a ]", "a > 0"),
    ("(G x)[ x^2 /= a ]", "true"),
    ("(C x)[ x^2 >= a ]", "a <= 0"),
    ("(A y)(X 1 x)[ x^3 = y ]", "true"),
    ("[]\n(a,x)\n1\n(X 2 x)[ x^2 = a ].\nfinish", "a > 0"),
    ("[]\n(a,x)\n1\n(F x)[ x^2 <= a ].\nassume [ a > -1 ]\nfinish", "a > 0"),
)
def test_in_qepcad(text: str, said: str) -> None:
    assert qe.equivalent(qe.eliminate(text, format="qepcad").formula, said, assuming="a > -1")


LONG = {0, 10, 22}
"""These take nine tenths of the time."""


@pytest.mark.parametrize("seed", [pytest.param(k, marks=[pytest.mark.deep] * (k in LONG)) for k in range(25)])
def test_the_interior_form_says_what_an_interval_says(seed: int) -> None:
    """Infinitely many: with an interval of them, and by the theorem; the others by those."""
    body = re.sub(r"\ba\b", "x", str(random_formula(random.Random(seed), Shape(1, 0, 3, 3))))
    given = body if seed % 2 else f"({body}) and x^2 <= a or a = a*x"
    form = qe.eliminate(f"infinitely many x. {given}").formula
    interval = qe.eliminate(f"ex l, h. l < h and all x. l < x and x < h -> ({given})").formula
    assert qe.equivalent(form, interval)
    assert qe.equivalent(f"almost all x. {given}", f"not (infinitely many x. not ({given}))")
    other = re.sub(r"\bx\b", "y", given)
    pair = f"(ex x, y. x < y and ({given}) and ({other}))"
    assert qe.equivalent(f"exactly 0 x. {given}", f"all x. not ({given})")
    assert qe.equivalent(f"exactly 1 x. {given}", f"(ex x. {given}) and not {pair}")
    assert qe.equivalent(f"at least 2 x. {given}", pair) and qe.equivalent(f"at most 1 x. {given}", f"not {pair}")
    assert qe.equivalent(f"(exactly 0 x. {given}) or (exactly 1 x. {given}) -> (connected x. {given})", "true")


def test_a_body_with_quantifiers_is_said_with_an_interval() -> None:
    formula = read("infinitely many x. all y. x*y <= a*y")
    assert qe.decide("all a. " + str(formula)) is False and not formula.is_quantifier_free
    inner = read("a > 0 and x < 1")
    assert isinstance(infinitely_many("x", inner, []), Exists) and infinitely_many("z", inner, []) == inner


@each(
    ("infinitely many x, y. x > y", "one variable expected"),
    ("exactly 30 x. x > 0", "at most 20"),
    ("at most 30 x. x > 0", "at most 20"),
    ("∃! x, y. x > y", "one variable expected"),
    ("exactly 2 x. ex x. x > 0", "bound once more"),
    ("connected x. x > root(1, x^3 - a, x)", "root"),
)
def test_mistakes(text: str, part: str) -> None:
    with pytest.raises(qe.ParseError, match=part):
        read(text)


def test_the_words_are_names_elsewhere() -> None:
    assert set(read("connected + exactly > almost and infinitely = many").free) >= {"connected", "almost", "many"}
