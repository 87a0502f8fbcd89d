"""What is accepted of derivations that were altered in what they mean is true (``altered_derivations``)."""

from __future__ import annotations

import json
import random
from collections.abc import Callable
from copy import deepcopy

import pytest

from qe.certify.verify import verify
from qe.errors import QEError
from qe.options import Budget
from qe.proof.certificate import Certificate
from tests.certificates.altered_derivations import ALTERATIONS, Data, altered_derivation
from tests.certificates.derivations import CASES, data
from tests.certificates.false_claims import derivation, derivation_by_a_rule, not_equivalent, text_of
from tests.certificates.mutation import lists

TRIES = 25
"""Alterations of one derivation."""


def search(seed: int, wanted: int) -> tuple[int, int]:
    """How many were offered, and how many of them accepted; fails at the first whose claim is seen to be false."""
    rng, offered, accepted = random.Random(seed), 0, 0
    while offered < wanted:
        given = one(rng)
        for _ in range(TRIES if given is not None else 0):
            made = altered_derivation(rng, given or {})
            if made is None:
                continue
            offered += 1
            if is_accepted(text_of(made)):
                accepted += 1
                assert not not_equivalent(rng, made), text_of(made)
    return offered, accepted


def one(rng: random.Random) -> Data | None:
    """A derivation of the list that has all rules, or one of a random question."""
    if rng.random() < 0.5:
        return data(rng.choice(list(CASES.values())))
    found = rng.choice((derivation, derivation_by_a_rule))(rng)
    return None if found is None else json.loads(found.to_json())


def is_accepted(text: str) -> bool:
    try:
        return verify(Certificate.from_json(text), Budget(5)).accepted
    except QEError:
        return False


def test_what_is_accepted_is_true() -> None:
    offered, accepted = search(seed=1, wanted=60)
    assert offered >= 60
    assert accepted


@pytest.mark.deep
@pytest.mark.parametrize("part", range(4))
def test_much_that_is_accepted_is_true(part: int) -> None:
    assert search(seed=100 + part, wanted=1500)[1]


@pytest.mark.parametrize("alteration", ALTERATIONS, ids=lambda alteration: alteration.__name__)
def test_every_alteration_changes_something(alteration: Callable[[random.Random, Data], None]) -> None:
    given, rng = data(CASES["guarded"]), random.Random(3)
    made = [deepcopy(given) for _ in range(8)]
    for copy in made:
        alteration(rng, copy)
    assert any(copy != given for copy in made)


@pytest.mark.parametrize("name", ["guard", "turned", pytest.param("exchanged", marks=pytest.mark.deep)])
def test_an_emptied_list_is_no_internal_error(name: str) -> None:
    """``solved`` without an equation was one, for "linear equation solved under a guard"."""
    given = data(CASES[name])
    for path, _ in lists(given["payload"]):
        made = deepcopy(given)
        node = made["payload"]
        for key in path[:-1]:
            node = node[key]
        node[path[-1]] = []
        is_accepted(text_of(made))
