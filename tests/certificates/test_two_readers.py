"""The two readers on certificates that both read, as they are made and altered: one says what the other does."""

from __future__ import annotations

import random
import re

import pytest

from qe.certify.verify import verify_json
from qe.proof.certificate import Certificate
from tests.certificates.derivations import CASES, certificate
from tests.certificates.false_claims import cells, derivation, optimum, other_claim, substitution, text_of, witness
from tests.certificates.test_false_claims import true_certificates
from tests.certificates.test_plain import said, said_plainly

KINDS = [f.__name__ for f in (derivation, cells, substitution, witness, optimum)]
STRICTER = re.compile(r"payload\.factors|payload\.field\.interval")
"""Where the first reader wants more than the claim needs: projections in full, and bounds of an irrational number that
keep a derivative away from 0. The second one looks at the cells and counts roots instead."""

STRICTER_REASONS = re.compile(
    "is not a product of listed factors|both free and bound|bound once more inside|is bound where it is seen"
)
"""Also of names: the second one resolves them to their quantifiers, where the first asks that none can be mistaken."""


def agree(text: str) -> bool:
    """Whether neither accepts what the other rejects, but for what only the first asks for."""
    first, second = said(text), said_plainly(text)
    if (first, second) == ("rejected", "accepted"):
        verdict = verify_json(text)
        return bool(STRICTER.match(verdict.step) or STRICTER_REASONS.search(verdict.reason))
    return (first, second) != ("accepted", "rejected")


def compare(kind: str, seed: int, most: int) -> int:
    """How many certificates both decided; fails where they differ."""
    rng, both = random.Random(seed), 0
    for data in true_certificates(rng, kind):
        first = said_plainly(text_of(data))
        assert first != "rejected", text_of(data)
        if first == "undecided":
            continue
        for _ in range(20):
            text = text_of(other_claim(rng, data))
            assert agree(text), text
            both += "undecided" not in (said(text), said_plainly(text))
            if both >= most:
                return both
    return both


@pytest.mark.parametrize("kind", KINDS)
def test_altered_certificates(kind: str) -> None:
    assert compare(kind, 3, 12) == 12


@pytest.mark.deep
@pytest.mark.parametrize("kind", KINDS)
def test_many_altered_certificates(kind: str) -> None:
    assert compare(kind, 4, 1500) == 1500


def test_derivations_of_all_rules_are_not_rejected() -> None:
    """Those with other rules than cases and signs are beyond the second reader, and it says so."""
    verdicts = {
        name: said_plainly(certificate(text).to_json())
        for name, text in [*list(CASES.items())[::4], ("universal", CASES["universal"])]
    }
    assert set(verdicts.values()) == {"accepted", "undecided"}


def test_what_both_refuse() -> None:
    empty = Certificate.bundle([]).to_json()
    assert (said(empty), said_plainly(empty)) == ("rejected", "rejected")
    nested = Certificate.bundle([("inner", Certificate.bundle([]))]).to_json()
    assert (said(nested), said_plainly(nested)) == ("rejected", "rejected")


@pytest.mark.parametrize("listed", [["x"], ["x", "x"], ["2*x"], ["-x"], ["1"]])
def test_polynomials_of_lemmas_have_one_spelling_and_are_listed_once(listed: list[str]) -> None:
    step = {
        "rule": "signs",
        "at": [],
        "context": [],
        "before": ["atom", "x", ">"],
        "after": ["atom", "x", ">"],
    }
    evidence = {"theory": {"polynomials": listed, "lemmas": [], "cases": []}}
    payload = {"order": ["x"], "start": step["before"], "steps": [{**step, "evidence": evidence}]}
    whole = {"format": "bezier-qe certificate", "version": 2, "kind": "derivation"}
    text = text_of({**whole, "payload": {**payload, "answer": step["after"]}})
    verdict = "accepted" if listed == ["x"] else "rejected"
    assert (said(text), said_plainly(text)) == (verdict, verdict)


@pytest.mark.parametrize(
    ("matrix", "verdict"),
    [
        (["atom", "x^2 - x", ">"], "accepted"),
        (["atom", "-x + x^2", ">"], "rejected"),
        (["atom", "2*x^2 - 2*x", ">"], "rejected"),
        (["atom", "-x^2 + x", "<"], "rejected"),
        (["atom", "x*x - x", ">"], "rejected"),
        (["atom", "x^2 - x^1", ">"], "rejected"),
        (["atom", "x*y + x^2", ">"], "rejected"),
        (["atom", "y*x", ">"], "rejected"),
        (["or", ["atom", "x^2 - x", ">"]], "rejected"),
        (["and"], "rejected"),
        (["atom", "1", ">"], "rejected"),
    ],
)
def test_formulas_have_one_spelling(matrix: object, verdict: str) -> None:
    payload = {"order": ["x", "y"], "matrix": matrix, "values": ["2", "1"]}
    text = text_of({"format": "bezier-qe certificate", "version": 1, "kind": "witness", "payload": payload})
    assert (said(text), said_plainly(text)) == (verdict, verdict)


def test_an_irrational_field_at_a_rational_point() -> None:
    """A root given by an interval of no length: both read it, whatever the degree of the polynomial."""
    field = {"minimal_polynomial": ["0", "1", "1"], "interval": ["0", "0"]}
    problem = {"variables": ["x"], "minimise": [["1", [1]]], "constraints": []}
    payload = {
        "problem": problem,
        "status": "unbounded",
        "field": field,
        "faces": [],
        "point": [["0"]],
        "direction": ["-1"],
    }
    whole = {"format": "bezier-qe certificate", "version": 1, "kind": "optimum", "payload": payload}
    assert (said(text_of(whole)), said_plainly(text_of(whole))) == ("accepted", "accepted")
    field["interval"] = ["1", "1"]
    assert (said(text_of(whole)), said_plainly(text_of(whole))) == ("rejected", "rejected")
