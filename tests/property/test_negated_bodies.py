"""A method takes a block whose body is a negation for what it says: not (A or B) is as good as not A and not B."""

from __future__ import annotations

import random
from dataclasses import replace

import pytest

from qe.elimination.protocol import Context, Outcome
from qe.engine.strategy import STRATEGY, Attempt
from qe.errors import Unable
from qe.formula.block import Block
from qe.formula.evaluate import holds_at
from qe.formula.normal import nnf, rename_apart
from qe.formula.syntax import Constant, Formula, Not
from qe.options import Budget, Options
from qe.proof.run_log import RunLog
from tests.differential.generate import SMALL, Shape, random_formula, random_point

METHODS = tuple({attempt.method: replace(attempt, work=2_000) for attempt in STRATEGY}.values())
SHAPES = (SMALL[0], SMALL[1], SMALL[3], Shape(0, 2, 2, 4), Shape(1, 2, 1, 3))
SEEDS = range(24)


def outcome(attempt: Attempt, problem: Block) -> Outcome | None:
    """What the method makes of the problem, None where it does not take it."""
    method = attempt.load()
    if method.suits(problem, Options()) is None:
        return None
    try:
        return method.run(problem, Context(Options(), Budget(work=attempt.work), RunLog()))
    except Unable:
        return None


def problems(seed: int) -> tuple[Block, Block] | None:
    """A block over a body in negation normal form, and over the negation of the negated body."""
    plain = nnf(rename_apart(random_formula(random.Random(seed), SHAPES[seed % len(SHAPES)])))
    problem = Block.of(plain)
    if problem is None or not problem.is_flat:
        return None
    body = nnf(problem.body, negate=True)
    return None if isinstance(body, Constant) else (problem, replace(problem, body=Not(body)))


def value(formula: Formula, seed: int, question: Formula) -> bool:
    point = random_point(random.Random(seed), question)
    return formula.value if isinstance(formula, Constant) else holds_at(formula, point)


@pytest.mark.parametrize("attempt", METHODS, ids=lambda attempt: attempt.method)
def test_a_negated_body_has_the_answer_of_its_normal_form(attempt: Attempt) -> None:
    for seed in SEEDS:
        both = problems(seed)
        if both is None:
            continue
        plain, other = (outcome(attempt, problem) for problem in both)
        if plain is None or other is None:
            continue
        if plain.formula.is_quantifier_free and other.formula.is_quantifier_free:
            for point in range(8):
                asked = both[0].formula
                assert value(plain.formula, point, asked) == value(other.formula, point, asked), seed
