"""The engine on the corpus: right answers, by equivalence with the expected ones."""

from __future__ import annotations

import pytest

import qe
from experiments.compare import Verdict, compare
from qe.formula.evaluate import holds_at
from qe.formula.syntax import TRUE
from qe.io.text import read, write
from tests.corpus.catalogue import Problem, problems
from tests.corpus.test_expected_answers import points

FAST = [p for p in problems() if "slow" not in p.tags]
SLOW = [p for p in problems() if "slow" in p.tags]


def check(problem: Problem, *, timeout: float) -> None:
    formula, expected = read(problem.formula), read(problem.expected)
    answer = qe.eliminate(formula, timeout=timeout)
    assert answer.status is qe.Status.SOLVED, answer.reason
    found = answer.formula
    assert found is not None and found.is_quantifier_free
    assert set(found.free) <= set(formula.free)
    if not formula.free:
        assert answer.truth is (expected == TRUE)
        return
    assumed = TRUE if problem.assume is None else read(problem.assume)
    for point in points(problem, 60):
        if not holds_at(assumed, point):
            continue
        assert holds_at(found, point) is holds_at(expected, point), (str(found), point)
    try:
        verdict = compare(write(found), problem.expected, problem.assume, seconds=1.0)
    except ImportError:  # without z3 the comparison at points above is all there is
        return
    assert verdict is not Verdict.DIFFERENT, str(found)


@pytest.mark.parametrize("problem", FAST, ids=lambda p: p.id)
def test_problem(problem: Problem) -> None:
    check(problem, timeout=60)


@pytest.mark.deep
@pytest.mark.parametrize("problem", SLOW, ids=lambda p: p.id)
def test_slow_problem(problem: Problem) -> None:
    check(problem, timeout=120)
