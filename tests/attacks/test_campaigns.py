"""No false claim about a step is accepted, every rule and method fires, and the answers on the way are right."""

from __future__ import annotations

import random

import pytest

from qe.certify.registry import RULES as CHECKERS
from qe.engine.strategy import STRATEGY, Scope
from qe.io.text import read
from tests.attacks import attack
from tests.attacks.campaign import ATTACKED, Counts, campaign
from tests.attacks.near_misses import CAPTURES, OTHERS, NearMiss
from tests.attacks.rules import METHODS, PRIMITIVES, RULES
from tests.attacks.true_steps import taken_alone

FIRED, CLAIMS = 1, 3
"""For each rule on every day: questions on which it fires, and false claims."""
MANY_FIRED, MANY_CLAIMS = 200, 345
"""The same in the deep tests: 20 000 false claims in all."""

ONLY_METHODS = [name for name in METHODS if name not in RULES]

STEPS = {
    "linear equation solved": "a > 0 and (ex x, y. a*x = b and y < x and (x > 1 or x*y > b))",
    "linear equation solved under a guard": "ex x, y. a*x = b and x^3 > y and y > 1",
    "nested blocks of one kind gathered": "ex x. x > a and (ex y. x*y = b and y > 1)",
}


def checked(counts: Counts, fired: int, claims: int) -> None:
    """Nothing false is accepted, no answer is wrong, and there is enough of everything."""
    assert not counts.holes and not counts.crashes and not counts.wrong
    assert counts.fired >= fired and counts.claims.total() >= claims
    assert len(counts.unproved) * 10 <= counts.fired


def test_every_rule_has_an_attacker_and_every_method_its_questions() -> None:
    made_of = {rule for rules in PRIMITIVES.values() for rule in rules}
    assert set(ATTACKED) <= {*RULES, *PRIMITIVES} <= {*ATTACKED, *made_of}
    assert set(METHODS) == {attempt.load().name for attempt in STRATEGY if attempt.scope is not Scope.QUESTION}


@pytest.mark.parametrize("rule", ATTACKED)
def test_it_fires_and_its_false_claims_are_refused(rule: str) -> None:
    checked(campaign(rule, 3, FIRED, CLAIMS), FIRED, CLAIMS)


@pytest.mark.parametrize("method", ONLY_METHODS)
def test_the_method_is_used(method: str) -> None:
    checked(campaign(method, 1, FIRED, 0), FIRED, 0)


@pytest.mark.deep
@pytest.mark.parametrize("rule", ATTACKED)
def test_it_fires_often_and_many_false_claims_are_refused(rule: str) -> None:
    counts = campaign(rule, 2, MANY_FIRED, MANY_CLAIMS)
    checked(counts, MANY_FIRED, MANY_CLAIMS)
    assert counts.compared >= MANY_FIRED / 2


@pytest.mark.deep
@pytest.mark.parametrize("method", ONLY_METHODS)
def test_the_method_is_used_often(method: str) -> None:
    checked(campaign(method, 2, MANY_FIRED, 0), MANY_FIRED, 0)


@pytest.mark.parametrize("near_miss", (*CAPTURES, *OTHERS), ids=lambda near_miss: near_miss.__name__)
def test_a_checker_that_accepts_everything_is_caught(near_miss: NearMiss, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each near miss makes claims that are false, and offers them; names that clash are refused before any checker."""
    monkeypatch.setattr(attack, "RULES", dict.fromkeys(CHECKERS, lambda claim, context, limits: None))
    rng, claims = random.Random(near_miss.__name__), []
    for rule, text in STEPS.items():
        (step,) = (s for s in taken_alone(read(text), rule) if s.rule == rule)
        found = (attack.false_claim(rng, step, near_miss) for _ in range(4))
        claims += [(step, false) for false in found if false is not None]
    assert claims
    accepted = [attack.accepted_evidence(step, false) is not None for step, false in claims]
    assert any(accepted) or near_miss in CAPTURES
