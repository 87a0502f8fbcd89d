"""The whole engine against z3 on random formulas; ``make deep`` offers a hundred thousand."""

from __future__ import annotations

import pytest

pytest.importorskip("z3")

from tests.differential.against_z3 import block
from tests.tables import each


@each(0, 40)
def test_no_answer_differs(first: int) -> None:
    counts, wrong = block([f"z3 {i}" for i in range(first, first + 40)])
    assert not wrong
    assert counts["agree"] >= 15


AT_THE_LIMIT = {"sharing 3", "sharing 5"}
"""Problems whose whole time goes by without an answer: `make deep` asks them."""


@each("alternations", "linear", "local", "terms", "levels", "sharing")
def test_no_answer_of_a_family_differs(family: str) -> None:
    counts, wrong = block([seed for i in range(6) if (seed := f"{family} {i}") not in AT_THE_LIMIT])
    assert not wrong
    assert counts["agree"] >= 2


@pytest.mark.deep
@each("alternations", "linear", "local", "terms", "levels", "sharing")
@pytest.mark.parametrize("first", range(0, 5000, 1000))
def test_no_answer_of_a_family_differs_in_thousands(family: str, first: int) -> None:
    counts, wrong = block([f"{family} {i}" for i in range(first, first + 1000)])
    assert not wrong
    assert counts["agree"] >= 200


@pytest.mark.deep
@pytest.mark.parametrize("first", range(0, 100_000, 1000))
def test_no_answer_differs_in_a_hundred_thousand(first: int) -> None:
    counts, wrong = block([f"z3 {i}" for i in range(first, first + 1000)])
    assert not wrong
    assert counts["agree"] >= 200
