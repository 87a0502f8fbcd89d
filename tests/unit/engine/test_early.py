"""Blocks first: parts that say equations of few variables are eliminated before what stands beside them."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.engine.early import BOUND, FREE, early_parts, equations
from qe.formula.syntax import Exists
from qe.formula.traverse import conjuncts
from qe.io.text import read

INSIDE = "(all x, y. x^2 + y^2 /= 2 or (x - a)^2 + (y - b)^2 <= c)"
AROUND = "(all x, y. x^2 + y^2 >= 2 or (x - a)^2 + (y - b)^2 < c)"
ONTO = "(all x, y. x^2 + y^2 = 2 or (x - a)^2 + (y - b)^2 /= c)"
ONCE_MORE = "(all x, y. x^2 + y^2 /= 2 or (x - a)^2 + (y - b)^2 = c)"
REST = "(all u. ex v, w. v^3 + u*v = a + w and w^3 + b*v = c)"


def body(text: str) -> Exists:
    formula = read(text)
    assert isinstance(formula, Exists)
    return formula


def test_the_small_blocks_come_first() -> None:
    formula = body(f"ex a, b, c. c > 0 and {ONTO} and {REST} and {ONCE_MORE}")
    found = early_parts(formula.body)
    assert found is not None
    assert [str(p) for p in conjuncts(found[0])] == [str(read(ONTO)), str(read(ONCE_MORE))]
    assert len(conjuncts(found[1])) == 2


@pytest.mark.parametrize(
    "text",
    [
        f"ex a, b, c. c > 0 and {ONTO} and {ONCE_MORE}",  # nothing else is quantified
        f"ex a, b, c. c > 0 and {ONTO} and {REST}",  # one block alone
        f"ex a, b, c. {ONTO} and {REST} and (all x. x > a or x < b)",  # two about different variables
        "ex a, b, c, d. (all x. a*x > b or c*x < d) and (all x. a*x + b*x > c + d) and (ex u, v, w. u*v*w = a)",  # four
        "ex a. (all x, y, z. x*y*z > a) and (ex x, y, z. x + y + z > a) and (ex u. all v. u*v > a)",  # of three
        "ex a. (all x. x > 1 or x < 2) and (ex x. x > 3) and (ex u. all v. u*v > a)",  # about nothing
    ],
)
def test_what_is_left_as_it_stands(text: str) -> None:
    assert early_parts(body(text).body) is None
    assert (BOUND, FREE) == (2, 3)


def test_equations_bind_a_variable_of_the_block() -> None:
    formula = read("a = 1 and b = 2 and c > 3 and d = b")
    assert [str(e) for e in equations(formula, ("b",))] == ["b - 2 = 0", "b - d = 0"]
    assert not list(equations(formula, ("c", "x")))


SAME = f"{ONTO} and {ONCE_MORE}"


@pytest.mark.parametrize(
    ("question", "truth"),
    [
        (f"ex a, b, c. {SAME} and (all u. ex v. v^3 + u*v = a + c - 2)", True),
        (f"ex a, b, c. {SAME} and (ex u. all v. v^2 + u*v > c)", False),
        (f"all a, b, c. not ({SAME}) or (all u. ex v. v^3 + u*v = b)", True),
        (f"all a, b, c. not ({SAME}) or (ex u. all v. v^2 + u*v > c)", False),
    ],
)
def test_two_circles_that_are_one(question: str, truth: bool) -> None:
    """The circles are the same iff a = b = 0 and c = 2."""
    answer = qe.eliminate(question, process=False)
    assert answer.truth is truth


def test_with_parameters() -> None:
    answer = qe.eliminate(f"ex a, b, c. {SAME} and (ex u. all v. v^2 + u*v + d > c) and a <= d", process=False)
    assert answer.formula is not None
    assert qe.decide(f"all d. ({answer.formula}) <-> d > 2", process=False)


def test_the_steps_say_so_and_are_proved() -> None:
    question = f"all a, b, c. not ({SAME}) or (ex u. all v. v^2 + u*v + d > c)"
    answer = qe.eliminate(question, process=False, check=True)
    assert qe.decide(f"all d. ({answer.formula}) <-> d > 2", process=False)
    assert answer.unchecked_steps == ()


@settings(deadline=None, max_examples=10, derandomize=True)
@given(st.integers(-3, 3), st.integers(-3, 3), st.sampled_from([">", ">=", "=", "/=", "<"]))
def test_answers_are_those_without_it(p: int, q: int, relation: str) -> None:
    """Lines through two points, with another condition beside."""
    text = (
        f"ex a, b. (all x. x /= {p} or a*x + b = {q}) and (all x. x /= {p + 1} or a*x + b = {q})"
        f" and (ex u. all v. v^2 + a*u*v + b {relation} c)"
    )
    with_it, without = qe.eliminate(text, process=False), qe.eliminate(text, process=False, without="equations")
    assert qe.decide(f"all c. ({with_it.formula}) <-> ({without.formula})", process=False)
