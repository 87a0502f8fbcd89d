"""A formula that is true or false everywhere is found out; for most a few points show that it is neither."""

import pytest

import qe
from qe import api
from qe.engine.constant import constant_value
from qe.formula.syntax import FALSE, TRUE

BALLS = "(x+2)^2 + (y-6)^2 + (z-6)^2 <= 27 and x^2 + y^2 + z^2 <= 27 and (x-2)^2 + (y-6)^2 + (z-6)^2 <= 27"


def never(sentence):
    raise AssertionError("a point should have settled it")


@pytest.mark.parametrize("text", [BALLS, "x > 0", "x^2 < 2", "(x - 100)^2 <= 1", "x = y", f"not ({BALLS})"])
def test_a_point_shows_that_it_is_neither(text):
    assert constant_value(api.read_formula(text), never) is None


ALWAYS = [("x^2 + y^2 >= 0", TRUE), ("x^2 + 1 < 0", FALSE), ("x^2 - x + 1 > 0", TRUE)]


@pytest.mark.parametrize(("text", "value"), ALWAYS)
def test_always_the_same(text, value):
    found = constant_value(api.read_formula(text), lambda s: qe.decide(s, method="cad"))
    assert found == value


def test_a_far_exception_is_found():
    formula = api.read_formula("x /= 1000")
    assert constant_value(formula, lambda s: qe.decide(s, method="cad")) is None


def test_text_is_read_once(monkeypatch):
    read = []
    original = api.read_formula
    monkeypatch.setattr(api, "read_formula", lambda *given: read.append(given) or original(*given))
    assert str(qe.eliminate("ex x. x^2 = a").formula) == "a >= 0"
    assert len(read) == 1
