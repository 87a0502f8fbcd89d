"""Rule "comprehensive Gröbner system" with parameters: its steps are proved by decompositions, wrong ones are not."""

from __future__ import annotations

from dataclasses import replace

import pytest

import qe
import qe.elimination.cgs as cgs
from qe.api.input import read_formula
from qe.elimination.protocol import Context
from qe.errors import InternalError
from qe.exact.ring import Ring
from qe.formula.block import Block
from qe.formula.build import conj, neg
from qe.formula.syntax import FALSE, TRUE, Formula
from qe.kernel.step import Claim
from qe.options import Budget, Options
from qe.proof.derivation import moved
from qe.proof.entry import Entry, Json
from qe.proof.run_log import RunLog
from qe.proof.step import Step
from qe.proving.prover import Prover

QUESTIONS = {
    "one inequality": "ex x. x^2 + a*x + b = 0 and x > 0",
    "closed": "ex x. x^2 = a and x >= b",
    "inequation": "ex x. x^3 + a*x = 0 and x /= 0",
    "two cases": "ex x. a*x^2 + b*x + 1 = 0 and a < b",
    "no Hankel matrix": "ex x, y. x^2 + y^2 = r and x*y = 1",
    "two conjunctions": "ex x. x^2 = a and x > 0 or x^2 = b and x < 1",
    "universal": "all x. x^2 /= a or x < b",
    "no solution": "ex x. x^2 + 1 = 0 and a*x = 1",
    "a line of solutions": "ex x, y. a*x + b*y = 0 and x^2 + y^2 = 1 and x > 0",
    "a curve of solutions": "ex x, y. x*y = a and x > 0",
    "nothing bound": "ex x. a*x = 0 and x > b",
    "no equation": "ex x. x^2 + a*x + 1 < 0 and x > 0",
}


def step(text: str) -> Claim:
    """What the method says about a block, without its evidence."""
    log, problem = RunLog(), Block.of(read_formula(text))
    assert problem is not None
    cgs.ComprehensiveGroebner().run(problem, Context(Options(), Budget(60), log))
    (found,) = log.steps()
    ring = Ring.of(found.before.ring.names)  # type: ignore[union-attr]
    return claim(found.rule, moved(found.before, ring), moved(found.after, ring), ring)


def claim(rule: str, before: Formula, after: Formula, ring: Ring, evidence: Json = None) -> Claim:
    return Claim(rule, before, after, ring, Entry(evidence, "evidence"), "step")


def proved(said: Claim) -> Json | None:
    """The evidence of a step, which the checker has accepted."""
    prover = Prover(said.ring, Options(), Budget(60))
    found = prover.own(Step(said.rule, said.before, said.after), ())
    return None if found is None else found[1]


@pytest.mark.parametrize("text", QUESTIONS.values(), ids=QUESTIONS)
def test_right_steps_are_proved_and_others_are_not(text: str) -> None:
    said = step(text)
    if not said.after.is_quantifier_free:  # a variable is left; then the whole question is decomposed
        assert not is_proved(said) and qe.eliminate(text, method="cgs", check=True).guarantee is qe.Guarantee.CHECKED
        return
    assert proved(said) is not None
    for wrong in (neg(said.after), FALSE, TRUE):
        if wrong != said.after:
            assert not is_proved(replace(said, after=wrong))


def test_a_step_about_something_else() -> None:
    said, other = step(QUESTIONS["closed"]), step(QUESTIONS["one inequality"])
    wrong = replace(said, before=other.before, ring=other.ring)
    assert not is_proved(replace(wrong, after=moved(said.after, wrong.ring)))
    free = moved(read_formula("x > 0"), said.ring)
    assert not is_proved(replace(said, after=conj([said.after, free])))


def is_proved(said: Claim) -> bool:
    """Whether a step has accepted evidence; a decomposition may contradict it, too."""
    try:
        return proved(said) is not None
    except InternalError:
        return False


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("ex x, y. x^2 + y^2 = a and x*y = b", "2*b <= a and -2*b <= a"),
        ("ex x, y. x^2 + y^2 = a and y > b", "b^2 < a or a >= 0 and b < 0"),
        ("ex x, y, u, v. x + u = a and y + v = 0 and x^2 + y^2 = 1 and u^2 + v^2 = 1", "a^2 <= 4"),
    ],
)
def test_answers_with_parameters_are_checked(text: str, expected: str) -> None:
    found = qe.eliminate(text, method="cgs", check=True, process=False)
    assert found.guarantee is qe.Guarantee.CHECKED and qe.equivalent(found.formula, expected)
