"""No certificate of a false claim is accepted: claims of every kind, made at random, and altered derivations."""

from __future__ import annotations

import json
import random
from collections.abc import Callable, Iterator
from copy import deepcopy

import pytest

from qe.certify.verify import verify
from qe.errors import QEError
from qe.options import Budget
from qe.proof.certificate import Certificate
from tests.certificates.altered_derivations import ALTERATIONS, altered_derivation
from tests.certificates.derivations import CASES, data
from tests.certificates.false_claims import KINDS as OLDER
from tests.certificates.false_claims import Data, derivation, derivation_by_a_rule, not_equivalent, other_claim, text_of
from tests.certificates.false_claims_of_arms import (
    branch,
    classification,
    inverse,
    leaves_the_branch,
    motions,
    other_motions,
    other_numbers,
    other_positions,
    other_solutions,
    solutions,
)
from tests.certificates.mutation import lists, replaced
from tests.tables import each

KINDS = {
    **OLDER,
    "solutions": (solutions, other_solutions),
    "branch": (branch, leaves_the_branch),
    "inverse": (inverse, other_positions),
    "motions": (motions, other_motions),
    "classification": (classification, other_numbers),
}
DEEP = {
    "derivation": 6000,
    "cells": 7000,
    "substitution": 2000,
    "witness": 5000,
    "optimum": 1000,
    "containment": 1500,
    "clearance": 1500,
    "derivation by a rule": 8000,
    "solutions": 2000,
    "branch": 1000,
    "inverse": 400,
    "motions": 2000,
    "classification": 1600,
}
PARTS = 4
TRIES = 30
"""Alterations of one certificate."""


def true_certificates(rng: random.Random, kind: str) -> Iterator[Data]:
    """Certificates as they are made, all accepted."""
    make, _ = KINDS[kind]
    while True:
        certificate = make(rng)
        verdict = verify(certificate, Budget(20)) if certificate is not None else None
        if certificate is not None and verdict is not None and verdict.decided:  # a busy machine leaves some undecided
            assert verdict.accepted, verdict
            yield json.loads(certificate.to_json())


def false_claims(kind: str, seed: int, wanted: int) -> Iterator[str]:
    """Certificates of false claims, signed."""
    rng, found = random.Random(seed), 0
    is_false = KINDS[kind][1]
    for whole in true_certificates(rng, kind):
        assert not is_false(rng, whole), "the claim of a certificate as it is made seems to be false"
        for _ in range(TRIES):
            other = other_claim(rng, whole)
            if _is_false(rng, kind, other):
                yield text_of(other)
                found += 1
                if found == wanted:
                    return


def _is_false(rng: random.Random, kind: str, data: Data) -> bool:
    """Whether the claim can be read, and is false."""
    try:
        return KINDS[kind][1](rng, data)
    except (QEError, ValueError, LookupError, TypeError, ArithmeticError, AttributeError, StopIteration):
        return False  # nothing is claimed


def accepted(text: str) -> bool:
    """Whether the checker accepts a certificate as text."""
    try:
        return verify(Certificate.from_json(text), Budget(5)).accepted
    except QEError:
        return False


def search(kind: str, seed: int, wanted: int) -> int:
    """How many false claims were offered; fails at the first that is accepted."""
    tries = 0
    for text in false_claims(kind, seed, wanted):
        tries += 1
        assert not accepted(text), text
    return tries


@pytest.mark.parametrize("kind", KINDS)
def test_false_claims_are_refused(kind: str) -> None:
    wanted = 3 if kind in ("optimum", "inverse", "classification") else 5
    assert search(kind, 1, wanted) == wanted


@pytest.mark.deep
@pytest.mark.parametrize("part", range(PARTS))
@pytest.mark.parametrize("kind", KINDS)
def test_many_false_claims_are_refused(kind: str, part: int) -> None:
    wanted = DEEP[kind] // PARTS
    assert search(kind, 1000 + part, wanted) == wanted


TRIES_OF_DERIVATIONS = 25
"""Alterations of one derivation."""


def search_of_derivations(seed: int, wanted: int) -> tuple[int, int]:
    """How many were offered, and how many of them accepted; fails at the first whose claim is seen to be false."""
    rng, offered, count = random.Random(seed), 0, 0
    while offered < wanted:
        given = one(rng)
        for _ in range(TRIES_OF_DERIVATIONS if given is not None else 0):
            made = altered_derivation(rng, given or {})
            if made is None:
                continue
            offered += 1
            if accepted(text_of(made)):
                count += 1
                assert not not_equivalent(rng, made), text_of(made)
    return offered, count


def one(rng: random.Random) -> Data | None:
    """A derivation of the list that has all rules, or one of a random question."""
    if rng.random() < 0.5:
        return data(rng.choice(list(CASES.values())))
    found = rng.choice((derivation, derivation_by_a_rule))(rng)
    return None if found is None else json.loads(found.to_json())


def test_what_is_accepted_is_true() -> None:
    offered, count = search_of_derivations(seed=1, wanted=60)
    assert offered >= 60 and count


@pytest.mark.deep
@pytest.mark.parametrize("part", range(4))
def test_much_that_is_accepted_is_true(part: int) -> None:
    assert search_of_derivations(seed=100 + part, wanted=1500)[1]


@pytest.mark.parametrize("alteration", ALTERATIONS, ids=lambda alteration: alteration.__name__)
def test_every_alteration_changes_something(alteration: Callable[[random.Random, Data], None]) -> None:
    given, rng = data(CASES["guarded"]), random.Random(3)
    made = [deepcopy(given) for _ in range(8)]
    for copy in made:
        alteration(rng, copy)
    assert any(copy != given for copy in made)


@each(("guard", 1), ("turned", 4), *(pytest.param(name, 1, marks=pytest.mark.deep) for name in ("turned", "exchanged")))
def test_an_emptied_list_is_no_internal_error(name: str, step: int) -> None:
    """``solved`` without an equation was one, for "linear equation solved under a guard"."""
    given = data(CASES[name])
    for path, _ in list(lists(given["payload"]))[::step]:
        accepted(replaced(given, ("payload", *path), []))
