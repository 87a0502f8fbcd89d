"""Random formulas: the engine and each of its parts against the reference elimination and z3.

A failure shows the seed and a reduced formula. The fast suite runs a fixed portion; ``make deep`` runs 2,000.
"""

from __future__ import annotations

import random

import pytest

import qe
from qe.errors import BudgetExceeded
from qe.formula.syntax import Formula
from qe.options import Budget
from tests.differential.check import disagreement, reduced
from tests.differential.generate import LARGE, NESTED, SMALL, random_formula
from tests.differential.methods import PARTS, Part

SECONDS = 3.0


def automatic(formula: Formula, budget: Budget) -> Formula:
    """The public function with its default options."""
    answer = qe.eliminate(formula, timeout=budget.remaining())
    if answer.formula is None:
        raise BudgetExceeded(answer.reason or "unable")
    return answer.formula


METHODS: dict[str, Part] = {"auto": automatic, **PARTS}


def check(method: str, seed: str, *, oracle_seconds: float) -> None:
    """Fail with a reduced formula if the method changes the meaning of the random formula of this seed."""
    rng = random.Random(seed)
    formula = random_formula(rng, rng.choice((*SMALL, *NESTED, *LARGE)))

    def fails(candidate: Formula) -> bool:
        try:
            answer = METHODS[method](candidate, Budget(SECONDS))
        except BudgetExceeded:
            return False
        return disagreement(candidate, answer, random.Random(seed), points=3, seconds=oracle_seconds) is not None

    assert not fails(formula), f"{method} changed the meaning of: {reduced(formula, fails)}"


@pytest.mark.parametrize("seed", range(120))
def test_whole_engine(seed: int) -> None:
    check("auto", f"auto {seed}", oracle_seconds=0.3)


@pytest.mark.parametrize("method", sorted(PARTS))
@pytest.mark.parametrize("block", range(6))
def test_parts(method: str, block: int) -> None:
    for seed in range(6 * block, 6 * block + 6):
        check(method, f"parts {seed}", oracle_seconds=0.3)


@pytest.mark.deep
@pytest.mark.parametrize("block", range(100))
def test_two_thousand(block: int) -> None:
    for seed in range(20 * block, 20 * block + 20):
        for method in METHODS:
            check(method, f"deep {seed}", oracle_seconds=1.0)
