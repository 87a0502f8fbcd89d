"""Universal blocks by pieces that look at few parameters: proved in these alone; altered directions are refused."""

from __future__ import annotations

import functools
import json
import random
from dataclasses import replace
from fractions import Fraction

import pytest

import qe
import qe.elimination.critical.apart as apart
from qe.api.input import read_formula
from qe.elimination.critical.method import ConvexUniversal
from qe.elimination.protocol import Context
from qe.formula.block import Block
from qe.options import Budget, Options
from qe.proof.run_log import RunLog
from qe.proof.step import Step
from tests.certificates.altered_derivations import steps
from tests.certificates.test_broken_producers import accepted

RULE = "constant along directions"
BAND = "all x. -1 <= x and x <= 1 -> -m <= a + b*x + x^2 and a + b*x + x^2 <= m"


@functools.cache
def example(text: str) -> str:
    answer = qe.eliminate(text, method="critical", check=True, process=False)
    assert RULE in [step.rule for step in answer.derivation.steps]
    assert answer.guarantee is qe.Guarantee.CHECKED and not answer.unchecked_steps and answer.certificate is not None
    return answer.certificate.to_json()


def test_random_pieces_are_accepted():
    rng = random.Random(5)
    for _ in range(2):
        p, q, r = (rng.choice((-2, -1, 1, 2, 3)) for _ in range(3))
        text = f"all x. 0 <= x and x <= 1 -> {p}*a + {q}*m + b*x <= x^2 and a*x + {r}*m*x + b <= 2"
        whole = json.loads(example(text))
        assert any(step["rule"] == "no exception" for step in steps(whole["payload"]))


def steps_of(text: str) -> list[Step]:
    """The steps of the rule as the method logs them."""
    problem, log = Block.of(read_formula(text)), RunLog()
    assert problem is not None
    assert ConvexUniversal().run(problem, Context(Options(), Budget(20), log)) is not None
    return [step for step in log.steps() if step.rule == RULE]


def test_altered_directions_are_refused():
    for step in steps_of(BAND):
        proof = step.evidence["proof"]
        ((name, vector),) = proof["directions"]
        (first, *others), doubled = vector, [[v, w if v == name else 2 * w] for v, w in vector]
        for directions in ([], [[name, doubled]], [[name, others]], [[name, [first]]], [["x", vector]]):
            altered = {"proof": {**proof, "directions": directions}}
            assert not accepted(replace(step, evidence=altered)), directions


def test_another_formula_of_the_same_form_is_refused():
    one, other = steps_of(BAND)
    assert not accepted(replace(one, after=other.after)) and not accepted(replace(other, after=one.after))


def test_pieces_that_are_not_constant_are_not_proved(monkeypatch: pytest.MonkeyPatch):
    """A producer that takes any direction for one of the null space."""
    assert all(accepted(step) for step in steps_of(BAND))
    monkeypatch.setattr(apart, "kernel_vector", lambda c, rows: dict.fromkeys(c, Fraction(1)) if len(c) > 2 else None)
    assert [accepted(step) for step in steps_of(BAND)] == [False, False]
