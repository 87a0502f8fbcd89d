"""A formula that is true or false everywhere is found out; for most a few points show that it is neither."""

import qe
from qe.api.input import read_formula
from qe.engine.constant import constant_value
from qe.formula.syntax import FALSE, TRUE
from qe.io import formats
from tests.tables import each

BALLS = "(x+2)^2 + (y-6)^2 + (z-6)^2 <= 27 and x^2 + y^2 + z^2 <= 27 and (x-2)^2 + (y-6)^2 + (z-6)^2 <= 27"


def never(sentence):
    raise AssertionError("a point should have settled it")


@each(BALLS, "x > 0", "x^2 < 2", "(x - 100)^2 <= 1", "x = y", f"not ({BALLS})")
def test_a_point_shows_that_it_is_neither(text):
    assert constant_value(read_formula(text), never) is None


ALWAYS = [("x^2 + y^2 >= 0", TRUE), ("x^2 + 1 < 0", FALSE), ("x^2 - x + 1 > 0", TRUE)]


@each(*ALWAYS)
def test_always_the_same(text, value):
    found = constant_value(read_formula(text), lambda s: qe.decide(s, method="cad"))
    assert found == value


def test_a_far_exception_is_found():
    formula = read_formula("x /= 1000")
    assert constant_value(formula, lambda s: qe.decide(s, method="cad")) is None


def test_text_is_read_once(monkeypatch):
    read = []
    original = formats.read_posed
    monkeypatch.setattr(
        formats, "read_posed", lambda *given, **keywords: read.append(given) or original(*given, **keywords)
    )
    assert str(qe.eliminate("ex x. x^2 = a").formula) == "a >= 0"
    assert len(read) == 1


def test_a_large_answer_without_solutions_is_asked_about_by_its_question():
    """The answer to a triangle inequality is of degree 10 in two variables; its question has no solution at all."""
    text = (
        "ex w, b, c, h. (w^2 = 3 and w > 0 and b >= 0 and c >= 0 and h >= 0 and y /= 0 and b^2 = (x - 1)^2 + y^2"
        " and c^2 = x^2 + y^2 and h^2 = y^2 and (1 + b + c)^2 < 6*w*h)"
    )
    assert qe.eliminate(text).formula == FALSE


def test_an_answer_that_holds_somewhere_is_not_asked_about():
    wide = read_formula("x^30*y^30 > x^2 + y^2 + 1")
    assert constant_value(wide, never, wide) is None


def test_equations_of_an_answer_are_taken_apart():
    """A sixth root of unity that is none of lower order: one factor of its equations is right."""
    powers = {0: ("1", "0")}
    real, imaginary = "1", "0"
    for k in range(1, 7):
        real, imaginary = f"(a*({real}) - b*({imaginary}))", f"(b*({real}) + a*({imaginary}))"
        powers[k] = real, imaginary
    lower = " and ".join(f"({powers[k][0]} /= 1 or {powers[k][1]} /= 0)" for k in range(1, 6))
    answer = qe.eliminate(f"{powers[6][0]} = 1 and {powers[6][1]} = 0 and {lower}")
    assert str(answer.formula) == "a = 1/2 and 4*b^2 = 3"
    kept = qe.eliminate("x*y = 0 and x + y > 1")
    assert qe.equivalent(kept.formula, "x*y = 0 and x + y > 1")


@each(
    "x^2 + y^2 + z^2 <= 25 and (x - 7)^2 + y^2 + (z - 1)^2 <= 9 and (x - 5)^2 + (y - 5)^2 + z^2 < 16",
    "(x - 100)^2 + (y + 70)^2 <= 4 and (x - 103)^2 + (y + 70)^2 <= 4 and y < -703/10",
    "x >= 1000 and y >= 1000 and x + y <= 2001",
)
def test_the_conditions_pull_a_point_into_a_convex_set(text):
    assert constant_value(formats.read(text), never) is None


@each("x^2 + y^2 <= 1 and (x - 3)^2 + y^2 <= 1", "x > 5*10^400 and x < 0", "x^2 + y^2 < 0 and x > 7")
def test_nothing_pulls_a_point_into_an_empty_set(text):
    assert constant_value(formats.read(text), lambda sentence: False) is FALSE
