"""Elimination sets: what virtual substitution does is accepted; altered evidence and broken producers are rejected."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.elimination.vs import plan
from qe.formula.build import conj, convert, disj
from qe.formula.syntax import Formula
from qe.io.text import read
from qe.kernel.elimination_points import implies
from qe.proof.derivation import moved
from qe.proving.prover import Prover
from tests.certificates.elimination_claims import (
    RING,
    accepted,
    claimed,
    evidence_for,
    examined,
)


def test_points_that_two_equations_share_have_the_guards_with_which_they_were_tried(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """0 and infinity are tried for more than one reason, of which the engine needed another than the checker first."""
    monkeypatch.setattr(Prover, "_tabulated", lambda self, step: None)
    both, neither = "f*x = c and f*x = 0 and d > 0", "(f*x /= c or f*x /= 0 or d <= 0)"
    text = f"ex x. (a <= 0 or b = 0) and (x <= g and {neither} or {both} and x > g)"
    answer = qe.eliminate(f"{text} or a > 0 and (x > g or {both}) and ({neither} or x <= g) and b /= 0", check=True)
    assert answer.unchecked_steps == ()


def test_a_shifted_variable_that_is_positive_is_not_said_to_be_nonnegative() -> None:
    formula = convert(read("x > 0 and x^2 - a /= 0 and b >= 0"), RING)
    found = plan.choose(formula, frozenset({RING.index["x"]}), strict=False)
    assert found is not None
    assert found.exponent == 2
    assert found.formula == convert(read("x > 0 and x - a /= 0 and b >= 0"), RING)


@settings(max_examples=8, deadline=None)
@given(st.integers(0, 10**6))
def test_what_is_accepted_is_true_and_what_is_produced_is_accepted(seed: int) -> None:
    examined(seed, 2)


@pytest.mark.deep
def test_no_altered_claim_that_is_false_is_accepted() -> None:
    looked, right = examined(20_260, 1_200)
    assert looked > 10_000
    assert right < looked / 2


def over_ring(text: str) -> Formula:
    return convert(read(text), RING)


def _set_of(text: str) -> tuple[Formula, Formula, dict[str, Any]]:
    found = evidence_for(over_ring(text))
    assert found is not None
    return found["body"], claimed(found["body"], found["evidence"]), found["evidence"]


def test_the_answer_must_be_the_disjunction_of_the_points() -> None:
    body, after, evidence = _set_of("a*x + b > 0 and x < 1")
    assert accepted(body, after, evidence)
    assert not accepted(body, disj((after, over_ring("a = 3"))), evidence)
    assert not accepted(body, conj((after, over_ring("a < 3"))), evidence)


@pytest.mark.parametrize("text", ["x^2 + a*x + b < 0 and x > a", "x^2 = a and x > 1", "x >= a and x <= b"])
def test_no_point_can_be_left_out_that_is_needed(text: str) -> None:
    body, after, evidence = _set_of(text)
    assert accepted(body, after, evidence)
    rejected = 0
    for k in range(len(evidence["points"])):
        fewer = {**evidence, "points": evidence["points"][:k] + evidence["points"][k + 1 :]}
        rejected += not accepted(body, claimed(body, fewer), fewer)
    assert rejected == len(evidence["points"])


@pytest.mark.parametrize(
    ("strong", "weak", "expected"),
    [
        ("a > 0 and b > 0", "a > 0", True),
        ("a > 0", "a > 0 or b > 0", True),
        ("(a > 0 or b > 0) and a < 2", "b > 0 or a > 0", True),
        ("a > 0 and (b > 0 or a > 2)", "a > 0 and b > 0 or a > 2", False),
        ("a > 0 or b > 0", "a > 0", False),
        ("a >= 0", "a > 0", False),
    ],
)
def test_implication_by_shape(strong: str, weak: str, expected: bool) -> None:
    assert implies(over_ring(strong), over_ring(weak)) is expected


def test_an_equation_of_high_degree_before_one_that_is_solved_is_no_hindrance() -> None:
    text = "x^3 + b*x - a = 0 and 2*x^2 + a*x + b = 0"
    found = evidence_for(moved(read(text), RING))
    assert found is not None
    body, evidence = found["body"], found["evidence"]
    assert accepted(body, claimed(body, evidence), evidence)
    for k in range(len(evidence["points"])):
        fewer = {**evidence, "points": evidence["points"][:k] + evidence["points"][k + 1 :]}
        assert not accepted(body, claimed(body, fewer), fewer)
