"""Parts that matter on no cell: which are dropped, that nothing changes, and that each step is proved."""

from collections.abc import Mapping

import pytest

import qe
from qe.decomposition.decompose import Tactics, decompose
from qe.elimination.protocol import Context
from qe.engine.redundant_on_cells import without_parts_on_cells
from qe.formula.syntax import FALSE
from qe.io.text import read
from qe.options import Budget, Options
from qe.proof.on_demand import OnDemand
from qe.proof.run_log import RunLog

DROPPED = {
    "a < 0 or b < 0 or a + b < 0": "a < 0 or b < 0",
    "a^2 + b^2 < 1 and a < 1": "a^2 + b^2 < 1",
    "a > 0 and (b > 0 or a + b > 0 and b < 0 or b = 0)": "a > 0 and a + b > 0",
}


def on_cells(text: str, cells_of: str | None = None, *, certify: bool = False) -> tuple[str, bool, RunLog]:
    """By the cells of the whole plane."""
    log, matrix = RunLog(), read(cells_of or text)
    table = decompose(
        matrix, matrix.free, ("",) * len(matrix.free), budget=Budget(), tactics=Tactics(whole_free=True)
    ).table
    shorter, is_whole = without_parts_on_cells(read(text), table, Context(Options(certify=certify), Budget(), log))
    return str(shorter), is_whole, log


@pytest.mark.parametrize("text", DROPPED)
def test_what_is_left_is_equivalent_and_has_no_such_part(text: str) -> None:
    shorter, is_whole, _ = on_cells(text)
    assert (shorter, is_whole) == (DROPPED[text], True)
    assert qe.decide(f"all a, b. ({text}) <-> ({shorter})")


@pytest.mark.parametrize("text", ["a < 0 and b < 0", "a*b < 1 or a > b", "a = 0 or b = 0"])
def test_a_part_that_matters_somewhere_stays(text: str) -> None:
    assert on_cells(text)[:2] == (str(read(text)), True)


def test_what_is_not_known_on_the_cells_may_matter() -> None:
    """Where a >= 0 the sign of b is not looked for: the conjunction is false."""
    both = read("a < 0 and b < 0")
    table = decompose(both, ("a", "b"), ("", ""), budget=Budget()).table
    assert without_parts_on_cells(both, table, Context(Options(), Budget(), RunLog())) == (both, False)


def test_polynomials_that_the_table_does_not_know_are_left_alone() -> None:
    text = "a - b < 3 or a - b < 2"
    assert on_cells(text, "a < 0 and b < 0")[:2] == (str(read(text)), False)


@pytest.mark.parametrize("certify", [False, True])
def test_the_step_says_why(certify: bool) -> None:
    _, _, log = on_cells("a^2 + b^2 < 1 and a < 1", certify=certify)
    step = next(iter(log.steps()))
    assert step.rule == "redundant part"
    nested = step.evidence["proof"]["steps"]  # type: ignore[index]
    assert nested.answer == FALSE
    (inner,) = nested.steps
    assert inner.rule == "cells"
    assert isinstance(inner.evidence["proof"], Mapping if certify else OnDemand)


def test_the_checkers_accept_an_answer_without_such_parts() -> None:
    answer = qe.eliminate("ex x. a*x^2 + b*x + c = 0", check=True)
    assert answer.log is not None
    assert "redundant part" in [step.rule for step in answer.log.steps()]
    assert answer.certificate is not None
    assert qe.verify(answer.certificate).accepted
    assert answer.unchecked_steps == ()
