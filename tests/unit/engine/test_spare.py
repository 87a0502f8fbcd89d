"""A complete answer that is long is taken after all where the next method does not end in little work."""

from fractions import Fraction

import pytest

import qe
from qe.engine import run as engine
from qe.formula.evaluate import holds_at
from qe.io.text import read
from qe.proof.run_log import RunLog

QUESTION = (
    "all p, q. a^2 + b^2 <= 1 and a >= 0 and b >= 0 and ((a - p)^2 + (b - q)^2 <= 1 and (a + p)^2 + (b + q)^2 <= 1 and"
    " a - p >= 0 and a + p >= 0 and b - q >= 0 and b + q >= 0 -> p = 0 and q = 0)"
)
EXTREME = "a >= 0 and b >= 0 and (a^2 + b^2 = 1 or a = 0 and b = 0)"
"""The extreme points of a quarter of a disc: the points that are no midpoint of two others."""


@pytest.mark.parametrize("work", [50, engine.SPARE])
def test_extreme_points_of_a_quarter_disc(monkeypatch: pytest.MonkeyPatch, work: int) -> None:
    """Decomposition would need 300,000 cells; substitution ends in 200 units of work with 40 atoms."""
    monkeypatch.setattr(engine, "SPARE", work)
    answer = qe.eliminate(QUESTION, process=False)
    assert qe.decide(f"all a, b. ({answer.formula}) <-> ({EXTREME})")
    assert "vs for p, q: its answer is long, but known" in answer.explanation
    assert [step.rule for step in answer.derivation.steps].count("elimination set") == 1


def test_the_next_method_is_taken_where_it_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    """The same long answer stays unused if decomposition ends, and none of its steps is left."""
    monkeypatch.setattr("qe.engine.strategy.SMALL_ATOMS", 0)
    answer = qe.eliminate("ex x, y. x^2 + y^2 < 1 and x*y > a and x + y > b", process=False)
    assert "its answer is long" in answer.explanation
    assert "elimination set" not in [step.rule for step in answer.derivation.steps]


def test_a_long_answer_is_not_lost_where_no_method_is_left() -> None:
    """With ``method="vs"`` nothing came after it, and the question was not answered."""
    question = "ex x. a*x^3 + b*x^2 + c*x + d = 0 and x > 0 and x < 2"
    answer = qe.eliminate(question, method="vs", process=False)
    assert answer.formula is not None and "its answer is long, but known" in answer.explanation
    points = {(1, 0, 0, -1): True, (1, 0, 0, 1): False, (-1, 3, -3, 1): True, (0, 0, 1, -1): True, (0, 0, 0, 0): True}
    for values, expected in points.items():
        assert holds_at(answer.formula, dict(zip("abcd", map(Fraction, values), strict=True))) is expected


def test_a_long_answer_in_many_variables_is_taken_at_once() -> None:
    """Decomposition, which was asked for a shorter one, did not end in 15 s; the answer took 0.1 s."""
    answer = qe.eliminate("ex x. a*x^3 + b*x^2 + c*x + d = 0 and p*x^2 + q*x + r < 0", process=False)
    assert "vs, cubic for x: a short try" in answer.explanation and "cad" not in answer.explanation


def test_steps_are_left_out_and_taken_up_again() -> None:
    log = RunLog()
    one, two = read("x > 0"), read("x > 1")
    mark = log.mark()
    log.step("first", one, two)
    log.switch("first", "why not")
    left_out = log.forget_steps(mark)
    assert [s.rule for s in left_out] == ["first"]
    assert not list(log.steps())
    log.take_up(left_out)
    assert [s.rule for s in log.steps()] == ["first"]
    assert len(log.entries) == 2
