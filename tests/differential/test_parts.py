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
from tests.differential.check import Comparison, compare, reduced
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


def check(method: str, seed: str, *, oracle_seconds: float) -> bool:
    """Fail with a reduced formula if the method changes the meaning of the random formula of this seed.

    Whether the method gave an answer, and the oracles could tell something about it.
    """
    rng = random.Random(seed)
    formula = random_formula(rng, rng.choice((*SMALL, *NESTED, *LARGE)))

    def compared(candidate: Formula) -> Comparison:
        try:
            answer = METHODS[method](candidate, Budget(SECONDS))
        except BudgetExceeded:
            return Comparison(0, None)
        return compare(candidate, answer, random.Random(seed), points=3, seconds=oracle_seconds)

    def fails(candidate: Formula) -> bool:
        return compared(candidate).difference is not None

    found = compared(formula)
    assert found.difference is None, f"{method} changed the meaning of: {reduced(formula, fails)}"
    return found.decided > 0


@pytest.mark.parametrize("block", range(10))
def test_whole_engine(block: int) -> None:
    decided = [check("auto", f"auto {seed}", oracle_seconds=0.3) for seed in range(6 * block, 6 * block + 6)]
    assert sum(decided) >= 2


@pytest.mark.parametrize("method", sorted(PARTS))
@pytest.mark.parametrize("block", range(6))
def test_parts(method: str, block: int) -> None:
    decided = [check(method, f"parts {seed}", oracle_seconds=0.3) for seed in range(6 * block, 6 * block + 6)]
    assert sum(decided) >= 2


@pytest.mark.deep
@pytest.mark.parametrize("block", range(100))
def test_two_thousand(block: int) -> None:
    for method in METHODS:
        seeds = range(20 * block, 20 * block + 20)
        assert sum(check(method, f"deep {seed}", oracle_seconds=1.0) for seed in seeds) >= 5, method
