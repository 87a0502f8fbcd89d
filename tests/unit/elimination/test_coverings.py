"""Coverings as a method: sentences of one block, with values or with a proof."""

from __future__ import annotations

import pytest

from qe.certify.verify import verify
from qe.elimination.coverings import Coverings
from qe.elimination.protocol import Context, Outcome, Problem
from qe.errors import BudgetExceeded
from qe.formula.syntax import FALSE, TRUE
from qe.io.text import read
from qe.options import Budget, Options
from qe.proof.run_log import RunLog

METHOD = Coverings()


def problem(text: str) -> Problem:
    found = Problem.of(read(text))
    assert found is not None
    return found


def run(text: str, options: Options, budget: Budget | None = None) -> tuple[Outcome, RunLog]:
    log = RunLog()
    return METHOD.run(problem(text), Context(options, budget or Budget(), log)), log


def test_what_suits() -> None:
    assert METHOD.suits(problem("ex x. x^2 = 2"), Options()) and METHOD.suits(problem("all x. x^2 > 2"), Options())
    assert METHOD.suits(problem("ex x. x^2 = a"), Options()) is None
    assert METHOD.suits(problem("ex x. all y. x < y^2"), Options()) is None


@pytest.mark.parametrize("text", ["ex x, y. x^2 + y^2 = 4 and x*y > 1", "all x, y. x^2 + y^2 /= 4 or x*y <= 1"])
@pytest.mark.parametrize("order", [None, ("y", "x"), ("y",)])
def test_values(text: str, order: tuple[str, ...] | None) -> None:
    found, _ = run(text, Options(order=order))
    assert found.formula == (TRUE if text[0] == "e" else FALSE) and found.witness is not None
    assert verify(problem(text).witnessed(found.witness)).accepted


@pytest.mark.parametrize("text", ["ex x, y. x^2 + y^2 < 1 and x*y > 1", "all x, y. x^2 + y^2 >= 1 or x*y <= 1"])
def test_a_covering_is_evidence_where_it_is_asked_for(text: str) -> None:
    for certify in (True, False):
        found, log = run(text, Options(certify=certify))
        assert found.formula == (FALSE if text[0] == "e" else TRUE) and found.witness is None
        (step,) = log.steps()
        assert step.rule == "covering" and ("proof" in step.evidence) is certify


def test_no_condition_and_no_work() -> None:
    context = Context(Options(), Budget(), RunLog())
    assert [METHOD.run(Problem(("x",), c), context).witness for c in (TRUE, FALSE)] == [{}, None]
    with pytest.raises(BudgetExceeded):
        run("ex x, y. x^2 + y^2 < 1 and x*y > 1", Options(), Budget(0.0))
