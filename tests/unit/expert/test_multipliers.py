"""The rule "multipliers": the evidence must be about the very sentence of the step."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import pytest

from qe.certify.claims import claim_of
from qe.certify.verify import verify
from qe.convex.optimum import minimize
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.io.text import read
from qe.proof.certificate import Certificate
from tests.unit.certify.claims import objection


@lru_cache
def optimum(text: str, objective: str = "0", names: str = "x y") -> Certificate:
    ring = Ring.of(tuple(names.split()))
    goal = convert(read(f"{objective} = 0"), ring)
    return minimize(getattr(goal, "poly", ring.constant(0)), convert(read(text), ring)).certificate


def multipliers(text: str, names: str = "x y") -> Any:
    return optimum(text, names=names).evidence_for("multipliers")


def with_constant(evidence: Any, value: str) -> Any:
    """The evidence with a further constraint without variables, which it does not use."""
    problem, zero = evidence["problem"], ["0"]
    constraints = [*problem["constraints"], {"terms": [[value, [0, 0]]], "relation": "<="}]
    faces = [{**face, "weights": [*face["weights"], "0"]} for face in evidence["faces"]]
    more = {"multipliers": [*evidence["multipliers"], zero], "values": [*evidence["values"], [value]], "faces": faces}
    return {**evidence, **more, "problem": {**problem, "constraints": constraints}}


EMPTY = "x^2 + y^2 <= 1 and x > 1"


@pytest.mark.parametrize(
    ("before", "after", "evidence", "reason"),
    [
        (f"ex x, y. {EMPTY}", "false", multipliers(EMPTY), ""),
        (f"ex x, y. {EMPTY} and x^3 < y", "false", multipliers(EMPTY), ""),  # more conjuncts
        ("all x, y. x^2 + y^2 > 1 or x <= 1", "true", multipliers(EMPTY), ""),
        (f"ex x, y. {EMPTY}", "false", with_constant(multipliers(EMPTY), "-1"), ""),  # which holds: no conjunct
        (f"ex x, y. {EMPTY}", "false", with_constant(multipliers(EMPTY), "1"), "not a conjunct"),
        (f"ex x, y. {EMPTY}", "true", multipliers(EMPTY), "a sentence of one block"),
        (f"ex x. {EMPTY}", "false", multipliers(EMPTY), "a sentence of one block"),
        ("ex x, y. x^2 + y^2 <= 1 and x >= 1", "false", multipliers(EMPTY), "not a conjunct"),
        (f"ex x, y. {EMPTY} or y > 7", "false", multipliers(EMPTY), "not a conjunct"),
        (f"ex x. all y. {EMPTY}", "false", multipliers(EMPTY), "not a conjunct"),
        ("ex x, y. x^2 + y^2 <= 1 and x > 0", "false", multipliers("x^2 + y^2 <= 1 and x > 0"), "about"),
        ("ex x. x^2 < 0", "false", multipliers("u^2 < 0", "u"), "a sentence of one block"),
    ],
)
def test_a_contradiction_of_conjuncts(before: str, after: str, evidence: Any, reason: str) -> None:
    found = objection("multipliers", before, after, evidence)
    assert reason in found and bool(found) is bool(reason), found


SAID = [
    (optimum("x + y >= 1", "x^2 + y^2"), "value = 1/2 and x = 1/2 and y = 1/2"),
    (optimum("x + y >= 1", "x + y"), "value = 1"),
    (optimum("x > 1", "x"), "value = 1"),
    (optimum("y > 1", "x"), "true"),
    (optimum(EMPTY, "x"), "false"),
]


@pytest.mark.parametrize(("certificate", "answer"), SAID)
def test_what_an_optimum_says_is_what_is_checked(certificate: Certificate, answer: str) -> None:
    claim = claim_of(certificate)
    assert verify(certificate).accepted and claim.equivalence is not None
    assert str(claim.equivalence[1]) == answer


@pytest.mark.parametrize(("certificate", "other"), [(c, o) for c, a in SAID for o, _ in SAID if o != c])
def test_evidence_for_one_sentence_proves_no_other(certificate: Certificate, other: Certificate) -> None:
    payload: Any = certificate.payload
    step = {**payload["steps"][0], "evidence": other.evidence_for("multipliers")}
    assert not verify(Certificate(certificate.kind, {**payload, "steps": [step]})).accepted


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("value = 1", "value = 2"),
        ("x > value", "x >= value"),
        ("x < below", "x <= below"),
        ("value >= below", "value > below"),
        ("1 < x", "1 <= x"),
    ],
)
def test_another_infimum_is_not_proved(old: str, new: str) -> None:
    certificate = optimum("x > 1", "x", "x")
    claim = claim_of(certificate)
    assert claim.equivalence is not None
    texts = [str(f) for f in claim.equivalence]
    assert any(old in text for text in texts)
    before, after = (read(text.replace(old, new)) for text in texts)
    evidence = certificate.evidence_for("multipliers")
    same = [read(text) for text in texts]
    assert verify(Certificate.step("multipliers", (), *same, evidence)).accepted
    verdict = verify(Certificate.step("multipliers", (), before, after, evidence))
    assert verdict.decided and not verdict.accepted
    assert verdict.step in ("payload.steps[0].before", "payload.steps[0].after")


def test_a_weight_that_is_zero_at_a_root_of_a_reducible_polynomial_is_not_positive() -> None:
    """With theta = sqrt 2, 1*x + (theta^2 - 1)*(-x) + (theta^2 - 2)*(x - 1) is 0 and says nothing of x < 1."""

    def condition(relation: str, *terms: list[Any]) -> dict[str, Any]:
        return {"terms": list(terms), "relation": relation}

    strict = condition("<", ["1", [1]], ["-1", [0]])
    constraints = [condition("<=", ["1", [1]]), condition("<=", ["-1", [1]]), strict]
    evidence = {
        "problem": {"variables": ["x"], "minimise": [], "constraints": constraints},
        "status": "infeasible",
        "field": {"minimal_polynomial": ["10", "-2", "-5", "1"], "interval": ["1", "3/2"]},
        "faces": [],
        "point": [["0"]],
        "multipliers": [["1"], ["-1", "0", "1"], ["-2", "0", "1"]],
        "derived": [],
        "values": [["0"], ["0"], ["-1"]],
    }
    assert "reducible" in objection("multipliers", "ex x. x <= 0 and -x <= 0 and x < 1", "false", evidence)
