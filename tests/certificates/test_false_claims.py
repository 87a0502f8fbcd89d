"""No certificate of a false claim is accepted: claims of every kind, made at random (``false_claims``)."""

from __future__ import annotations

import json
import random
from collections.abc import Iterator

import pytest

from qe.certify.verify import verify
from qe.errors import QEError
from qe.options import Budget
from qe.proof.certificate import Certificate
from tests.certificates.false_claims import KINDS as OLDER
from tests.certificates.false_claims import Data, other_claim, text_of
from tests.certificates.false_claims_of_arms import (
    branch,
    inverse,
    leaves_the_branch,
    other_positions,
    other_solutions,
    solutions,
)
from tests.certificates.false_claims_of_classifications import classification, other_numbers
from tests.certificates.false_claims_of_motions import motions, other_motions

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
    for data in true_certificates(rng, kind):
        assert not is_false(rng, data), "the claim of a certificate as it is made seems to be false"
        for _ in range(TRIES):
            other = other_claim(rng, data)
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
