"""Blocks that amount to equations, beside others: two circles that are one."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe

ONTO = "(all x, y. x^2 + y^2 = 2 or (x - a)^2 + (y - b)^2 /= c)"
ONCE_MORE = "(all x, y. x^2 + y^2 /= 2 or (x - a)^2 + (y - b)^2 = c)"
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
