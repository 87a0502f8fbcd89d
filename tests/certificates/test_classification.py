"""Derivations by the rule "classification": accepted for right partitions, rejected in every entry that is altered."""

from __future__ import annotations

import json
from contextlib import suppress
from fractions import Fraction
from itertools import product
from typing import Any

import pytest

import qe
from qe.certify.claims import claim_of
from qe.certify.verify import verify, verify_json
from qe.errors import CertificateRejected, InternalError, QEError, Unable
from qe.expert.classification import read_question, sentence
from qe.groebner.counting import RealRootClassification
from qe.proof.entry import Entry
from tests.certificates.mutation import EVIDENCE, PLACE, evidence_in, replaced, without

ROOT_2 = qe.RealAlgebraic.from_root([-2, 0, 1], 1, 2)


def classified(polys: list[str], variables: str, **more: Any) -> RealRootClassification:
    return qe.real_root_classification(polys, variables, process=False, check=True, **more)


CUBIC = classified(["x^3 + p*x + q"], "x")
QUADRATIC = classified(["a*x^2 + b*x + c"], "x")
POSITIVE = classified(["x^2 - a"], "x", positive=["x - 1"], nonzero=["a - 1"])
IRRATIONAL = classified(["x^2 - w*a"], "x", constants={"w": -ROOT_2})


def data(found: RealRootClassification) -> dict[str, Any]:
    assert found.certificate is not None
    read: dict[str, Any] = json.loads(found.certificate.to_json())
    return read


@pytest.mark.parametrize(
    ("polys", "variables", "more"),
    [
        (["x^2 + y^2 - r", "x*y - 1"], "x y", {}),
        (["a*x + y - 1", "x + a*y - 1"], "x, y", {}),
        (["(x - a)^2"], "x", {}),
        (["x^2 + 1", "a*x"], "x", {}),
        (["x - a", "y - b"], "x y", {"equal": ["a - b"], "positive": ["x + y"]}),
        (["a*x - 1"], "x", {"constants": {"w": ROOT_2}, "equal": ["a^2 - w*a"]}),
        (["x^2 - 2"], "x", {}),
    ],
)
def test_accepted(polys: list[str], variables: str, more: dict[str, Any]) -> None:
    found = classified(polys, variables, **more)
    assert found.certificate is not None
    assert verify_json(found.certificate.to_json()).accepted


def test_the_claim_in_words() -> None:
    for found, wanted in (
        (CUBIC, "count - 3 = 0 and p < 0 and 4*p^3 + 27*q^2 < 0"),
        (QUADRATIC, "not (c = 0 and b = 0 and a = 0) and "),  # else there are infinitely many complex solutions
        (POSITIVE, "count - 1 = 0 and a - 1 > 0"),
        (IRRATIONAL, "w^2 - 2 = 0 and w + 3 >= 0 and w <= 0"),
    ):
        assert found.certificate is not None
        before, after, rules = claim_of(found.certificate).words
        assert before.startswith("the formula  ") and wanted in after and rules.startswith("by classification")


def test_the_sentence_is_true() -> None:
    """At points: the number of solutions is the one that the condition says."""
    assert POSITIVE.certificate is not None
    claim = claim_of(POSITIVE.certificate).equivalence
    assert claim is not None
    for a, count in product((-1, 0, 1, 2), range(4)):
        place = f"a = {a} and count = {count}"
        one, other = (qe.decide(f"ex a, count. ({place}) and ({part})", process=False) for part in claim)
        assert one is other is (a != 1 and count == (a > 1)), (a, count)


def wrong(content: dict[str, Any], **other: Any) -> None:
    """The content with other entries is no proof any more, nor where it claims what they say."""
    evidence = {**evidence_in(content), **other}
    verdict = verify_json(replaced(content, EVIDENCE, evidence))
    assert not verdict.accepted and verdict.step != "digest"
    with suppress(QEError, ValueError, TypeError, AssertionError, InternalError):
        made = qe.Certificate.step("classification", (), *sentence(Entry(evidence, "evidence")), evidence)
        verdict = verify_json(made.to_json())
        assert not verdict.accepted and verdict.step.startswith(PLACE), "accepted"


@pytest.mark.parametrize("found", [CUBIC, QUADRATIC, POSITIVE, IRRATIONAL])
def test_classes_cannot_be_changed(found: RealRootClassification) -> None:
    content = data(found)
    classes = evidence_in(content)["classes"]
    for k, (count, condition) in enumerate(classes):
        others = classes[:k] + classes[k + 1 :]
        wrong(content, classes=others)
        wrong(content, classes=[*others, [7, condition]])
        wrong(content, classes=[*others, [count, False]])
        wrong(content, classes=[*others, [count, True]])
        wrong(content, classes=[*classes, [count, condition]])
        if others:
            (first, its), *rest = others
            wrong(content, classes=[*rest, [count, its], [first, condition]])


@pytest.mark.parametrize("found", [CUBIC, QUADRATIC, POSITIVE, IRRATIONAL])
def test_proofs_belong_to_their_cases(found: RealRootClassification) -> None:
    content = data(found)
    proofs = evidence_in(content)["proofs"]
    assert proofs
    for k, proof in enumerate(proofs):
        wrong(content, proofs=proofs[:k] + proofs[k + 1 :])
        wrong(content, proofs=[*proofs[:k], proof, *proofs[k:]])
        bundle = {"kind": "bundle", "certificates": [{"label": "a", "kind": "derivation", "payload": proof}]}
        wrong(content, proofs=[*proofs[:k], bundle, *proofs[k + 1 :]])
    if len(proofs) > 1:
        wrong(content, proofs=proofs[::-1])


@pytest.mark.parametrize(
    ("found", "changed"),
    [
        (CUBIC, {"polynomials": ["x^3 + q*x + p"]}),
        (CUBIC, {"polynomials": ["x^3 + p*x - 2*q"]}),
        (CUBIC, {"polynomials": []}),
        (CUBIC, {"variables": ["p"], "parameters": ["x", "q"]}),
        (CUBIC, {"variables": ["x", "x"]}),
        (CUBIC, {"variables": ["x", "p"]}),
        (CUBIC, {"variables": []}),
        (CUBIC, {"positive": ["x"]}),
        (QUADRATIC, {"equal": ["a"]}),
        (QUADRATIC, {"nonzero": ["a"]}),
        (POSITIVE, {"nonzero": []}),
        (POSITIVE, {"positive": []}),
        (POSITIVE, {"positive": ["x + 1"]}),
        (IRRATIONAL, {"constants": [["w", "w^2 - 2", "1", "2"]]}),
        (IRRATIONAL, {"constants": [["w", "w^2 - 2", "-2", "2"]]}),
        (IRRATIONAL, {"constants": [["w", "w^2 - 2", "2", "1"]]}),
        (IRRATIONAL, {"constants": [["w", "w^2 - 2", "3", "4"]]}),
        (IRRATIONAL, {"constants": [["w", "w^2 - 3", "-2", "-1"]]}),
        (IRRATIONAL, {"constants": [["w", "w + 1", "-1", "-1"]]}),
        (IRRATIONAL, {"constants": [["w", "w^2 - a", "-2", "-1"]]}),
        (IRRATIONAL, {"constants": []}),
    ],
)
def test_the_question_cannot_be_changed(found: RealRootClassification, changed: dict[str, Any]) -> None:
    wrong(data(found), **changed)


@pytest.mark.parametrize(
    ("minimal", "low", "high"),
    [
        ("4*w^2 - 9*w + 5", "1", "3/2"),
        ("w^2 - 2", "-2", "2"),
        ("w^2 - 2", "2", "3"),
        ("w - 1", "2", "2"),
        ("w - 1", "2", "0"),
    ],
)
def test_constants_are_single_numbers(minimal: str, low: str, high: str) -> None:
    payload = {**evidence_in(data(IRRATIONAL)), "constants": [["w", minimal, low, high]]}
    with pytest.raises(CertificateRejected, match="one root in the interval"):
        read_question(Entry(payload, "payload"))


def test_a_class_too_few_is_a_false_sentence() -> None:
    question, classes, _ = read_question(Entry(evidence_in(data(CUBIC)), "evidence"))
    for k in range(len(classes)):
        sentences = question.sentences([*classes[:k], *classes[k + 1 :]], lambda: None)
        assert not all(qe.decide(s, process=False) for s in sentences)


def test_missing_entries_and_digests() -> None:
    content = data(QUADRATIC)
    for name in evidence_in(content):
        assert not verify_json(without(content, EVIDENCE, name)).accepted
    text = qe.Certificate.from_json(json.dumps({**content, "digest": "0" * 64}))
    assert verify(text).step == "digest"


def test_beyond_the_limits() -> None:
    with pytest.raises(Unable, match="complex solutions"):
        classified(["x^9 - a"], "x")


def test_counts_at_points_agree_with_the_classes() -> None:
    for p in range(-4, 3):
        for q in range(-3, 4):
            count = CUBIC.at([p, q])
            assert count == len(CUBIC.system.solutions_at([p, q]))
    assert POSITIVE.at([Fraction(3, 2)]) == 1 and POSITIVE.at([0]) == 0
