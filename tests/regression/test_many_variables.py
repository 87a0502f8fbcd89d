"""Formulas in many variables of which every condition has few; roots that a polynomial cannot have."""

from __future__ import annotations

import time

import pytest

import qe
from qe.formula.syntax import FALSE
from qe.io import formats
from tests.tables import each

BOUND = 20.0
"""Seconds of processor time; each takes less than one, and took up to many minutes."""

MANY = {
    "2000 bounds on separate variables": " and ".join(f"x{i} > 0" for i in range(2000)),
    "299 conditions on neighbours": " and ".join(f"x{i}*x{i + 1} < {i}" for i in range(1, 300)),
    "a chain of differences": " and ".join(f"x{i} < x{i + 1}" for i in range(300)),
    "a disjunction": " or ".join(f"x{i}^2 > {i}" for i in range(1, 600)),
    "200 separate quantified variables": f"ex {', '.join(f'x{i}' for i in range(200))}. "
    + " and ".join(f"x{i} > {i}" for i in range(200)),
}


@pytest.mark.parametrize("text", MANY.values(), ids=MANY)
def test_many_variables_take_no_time(text):
    start = time.process_time()
    answer = qe.eliminate(text, process=False)
    assert answer.status is qe.Status.SOLVED and time.process_time() - start < BOUND
    if text.startswith("ex"):
        assert answer.truth is True and answer.witness is not None
        assert all(answer.witness[f"x{i}"] > i for i in range(200))
    else:
        assert answer.formula == formats.read(text, "text")


@each(60, -60, 10**30, 2, 4)
def test_a_root_that_cannot_be_is_false_at_once(k):
    start = time.process_time()
    for relation in ("<", "=", "/=", ">="):
        assert formats.read(f"x {relation} root({k}, x^3 - a)", "text") == FALSE
    assert qe.eliminate(f"x < root({k}, x^3 - a)").truth is False
    assert time.process_time() - start < BOUND


def test_a_root_that_can_be_stays():
    assert str(qe.eliminate("x < root(1, x^3 - a)").formula) == "x^3 - a < 0"
    assert qe.eliminate("ex x. x >= root(3, x^3 - a*x)").formula == formats.read("a > 0", "text")
