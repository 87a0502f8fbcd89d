"""Certificates of solutions and of classifications: accepted where these are right, rejected in every altered entry."""

from __future__ import annotations

import json
from contextlib import suppress
from fractions import Fraction
from itertools import product
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.api.input import read_formula
from qe.certify.claims import claim_of
from qe.certify.verify import verify, verify_json
from qe.errors import CertificateRejected, InternalError, QEError, Unable
from qe.exact.quotient import PositiveDimensional
from qe.exact.ring import Poly, Ring
from qe.expert.classification import read_question, sentence
from qe.formula.build import convert
from qe.formula.syntax import FALSE, Or, Relation
from qe.groebner.counting import RealRootClassification
from qe.groebner.evidence import solutions_certificate
from qe.proof.entry import Entry
from tests.certificates.mutation import EVIDENCE, PLACE, evidence_in, replaced, without
from tests.tables import each
from tests.unit.proving.elaborated import refused

RING = Ring.of(("w", "y", "x"))
w, y, x = (RING.gen(i) for i in range(3))
ROOT_2 = qe.RealAlgebraic.from_root([-2, 0, 1], 1, 2)
CERTIFICATE = solutions_certificate(
    [x**2 + y**2 - w - 3, x * y - 1, x + y - w], [(x, Relation.GT)], constants={0: ROOT_2}
)
CIRCLE = solutions_certificate([x**2 + y**2 - 4, x * y - 1], [(x - 1, Relation.NE), (y + 2, Relation.GE)])
DATA: dict[str, Any] = json.loads(CIRCLE.to_json())


def verdict(text: str) -> Any:
    return verify(qe.Certificate.from_json(text))


def count(certificate: qe.Certificate) -> int:
    return len(certificate.evidence_for("solutions")["solutions"])


@pytest.mark.parametrize(
    ("equations", "conditions", "expected"),
    [
        ([x**2 + y**2 - 4, x * y - 1], [], 4),
        ([x**2 + y**2 - 4, x * y - 1], [(x, Relation.GT)], 2),
        ([(x - y) ** 2, x**2 + y**2 - 2], [(x, Relation.GE), (y - 1, Relation.NE)], 0),
        ([(x - y) ** 2, x**2 + y**2 - 2], [(x, Relation.GE)], 1),
        ([x**2 + y**2 + 1, x - y], [], 0),
        ([x - 1, x - 2], [], 0),
        ([x**2 - x, y**3 - y], [(x - y, Relation.NE)], 4),
        ([(10**9 * x - 1) * (10**9 * x - 2), y - x], [], 2),
    ],
)
def test_counts(equations: list[Poly], conditions: list[tuple[Poly, Relation]], expected: int) -> None:
    certificate = solutions_certificate(equations, conditions)
    assert count(certificate) == expected
    assert verdict(certificate.to_json()).accepted


def test_constants_are_told_from_their_conjugates() -> None:
    certificate = solutions_certificate([x**2 - w, y - x], constants={0: ROOT_2})
    assert count(certificate) == 2 and qe.verify(certificate).accepted
    assert count(CERTIFICATE) == 0 and qe.verify(CERTIFICATE).accepted


def test_the_claim_in_words() -> None:
    from qe.certify.claims import claim_of

    words, found = claim_of(CIRCLE).words, claim_of(CIRCLE).equivalence
    assert words[0].startswith("the formula  ") and "x^2 + y^2 = 4" in words[0]
    assert found is not None and isinstance(found[1], Or) and len(found[1].args) == 4 and words[2] == "by solutions"
    assert claim_of(CERTIFICATE).words[1].startswith("is equivalent to  false")


def altered() -> list[tuple[tuple[str | int, ...], Any]]:
    """Paths and other values that make the certificate wrong."""
    base = EVIDENCE
    found: list[tuple[tuple[str | int, ...], Any]] = [
        ((*base, "order"), ["y", "x"]),
        ((*base, "order", 0), "z"),
        ((*base, "order"), ["x", "x"]),
        ((*base, "equations", 0), "x^2 + y^2 - 5"),
        ((*base, "equations", 0), "x^2 + y^2 - 4 + 0"),
        ((*base, "equations", 1), "x*y + 1"),
        ((*base, "equations", 1), "x - x"),
        ((*base, "conditions", 0, 0), "y + 1*x"),
        ((*base, "conditions", 0, 1), ">"),
        ((*base, "conditions", 0, 1), "<"),
        ((*base, "conditions", 1, 0), "y"),
        ((*base, "weights"), [1]),
        ((*base, "weights", 0), 0),
        ((*base, "weights", 0), 10**9),
        ((*base, "weights", 0), True),
        ((*base, "form"), [1, 1]),
        ((*base, "form"), [0, 0]),
        ((*base, "form"), [0, "1"]),
        ((*base, "solutions"), []),
        ((*base, "solutions"), DATA["payload"]["steps"][0]["evidence"]["solutions"] * 2),
        ((*base, "kind"), 3),
    ]
    for k, solution in enumerate(DATA["payload"]["steps"][0]["evidence"]["solutions"]):
        place = (*base, "solutions", k)
        polynomial, interval = solution["field"]["minimal_polynomial"], solution["field"]["interval"]
        for i, c in enumerate(polynomial):
            found.append(((*place, "field", "minimal_polynomial", i), str(int(c) + 1)))
        found.append(((*place, "field", "interval"), interval[::-1]))
        found.append(((*place, "field", "interval"), ["-9", "9"]))
        found.append(((*place, "field", "interval"), ["7", "8"]))
        other = DATA["payload"]["steps"][0]["evidence"]["solutions"][k - 1]
        found.append(((*place, "field"), other["field"]))
        found.append((place, other))
        for j, numbers in enumerate(solution["values"]):
            for i, c in enumerate(numbers):
                found.append(((*place, "values", j, i), "17" if c != "17" else "18"))
            found.append(((*place, "values", j), numbers[:-1]))
        found.append(((*place, "values"), solution["values"][::-1]))
    return found


@pytest.mark.parametrize(("path", "value"), altered(), ids=lambda v: str(v)[:40])
def test_every_altered_entry_is_rejected(path: tuple[str | int, ...], value: Any) -> None:
    found = verdict(replaced(DATA, path, value))
    assert not found.accepted and found.decided, found


@pytest.mark.parametrize("name", ["equations", "conditions", "solutions"])
def test_nothing_can_be_left_out(name: str) -> None:
    strict = solutions_certificate([x**2 + y**2 - 4, x * y - 1], [(x, Relation.GT)])
    data = json.loads(strict.to_json())
    for k in range(len(data["payload"]["steps"][0]["evidence"][name])):
        assert not verdict(without(data, (*EVIDENCE, name), k)).accepted


def test_a_solution_that_is_none_is_not_listed() -> None:
    # x = 0 satisfies the equation, not the condition: a certificate that lists it is rejected where it stands
    data = json.loads(solutions_certificate([x * (x - 1)]).to_json())
    assert verdict(replaced(data, (*EVIDENCE, "conditions"), [["x", "/="]])).step.startswith(f"{PLACE}.solutions[0]")


def test_infinitely_many_solutions_have_no_certificate() -> None:
    with pytest.raises(PositiveDimensional):
        solutions_certificate([x * y - 1])
    assert not verdict(replaced(DATA, (*EVIDENCE, "equations"), ["x*y - 1"])).accepted


def test_numbers_of_solutions_at_points_have_certificates() -> None:
    found = qe.real_root_classification(["x^2 + b*x + c"], "x", positive=["x"])
    for point in ([-3, 2], [0, -1], [0, 1], [ROOT_2, 0], [-2, 1]):
        certificate = found.certificate_at(point, timeout=60)
        assert count(certificate) == found.at(point) and qe.verify(certificate).accepted
    system = qe.comprehensive_groebner(["w*x - a", "x^2 - b"], "x", constants={"w": ROOT_2})
    certificate = system.certificate_at([2, 2])
    assert count(certificate) == 1 and qe.verify(certificate).accepted
    assert count(system.certificate_at([2, 3])) == 0


@st.composite
def systems(draw: st.DrawFn) -> list[Poly]:
    c = st.integers(-3, 3)
    first = x**2 + draw(c) * x * y + draw(c) * y + draw(c)
    second = y ** draw(st.integers(1, 3)) + draw(c) * x + draw(c)
    return [first, second, *([draw(c) * x * y + draw(c)] if draw(st.booleans()) else [])]


@settings(max_examples=25)
@given(systems(), st.sampled_from([Relation.GT, Relation.GE, Relation.NE]), st.integers(-2, 2))
def test_both_counts_agree(polys: list[Poly], relation: Relation, shift: int) -> None:
    """The checker's basis, quotient and signature against isolation, where solutions may be multiple."""
    try:
        certificate = solutions_certificate(polys, [(x - y + shift, relation)])
    except Unable:
        return
    assert verdict(certificate.to_json()).accepted


FALSE_SENTENCES = [
    "ex x, y. x^2 + y^2 = 1 and x*y = 1",
    "ex x, y. x^2 + y^2 = 1 and x*y = 0 and x + y > 2",
    "ex x, y. (x^2 + y^2 = 2 and x*y = 1 and x + y > 3) or (x^2 + y^2 = 3 and x^3 = y and x + y > 4)",
]


@pytest.mark.parametrize("text", FALSE_SENTENCES)
def test_false_sentences_of_the_method_cgs_are_proved_by_counts(text: str) -> None:
    answer = qe.eliminate(text, method="cgs", check=True, timeout=60)
    assert answer.formula is not None and str(answer.formula) == "false" and answer.guarantee is qe.Guarantee.CHECKED
    assert answer.certificate is not None
    data = json.loads(answer.certificate.to_json())
    (step,) = data["payload"]["steps"]
    place = ("payload", "steps", 0, "evidence", "steps")
    inner = [(k, made) for k, made in enumerate(step["evidence"]["steps"]) if made["rule"] == "solutions"]
    assert inner
    for k, _ in inner:
        assert not verdict(without(data, place, k)).accepted
        # one that proves something else, and one with a solution, which refutes nothing
        for foreign in (x**2 + 1, x**2 - 1):
            evidence = solutions_certificate([foreign]).evidence_for("solutions")
            assert not verdict(replaced(data, (*place, k, "evidence"), evidence)).accepted
    assert not verdict(replaced(data, ("payload", "answer"), True)).accepted


@pytest.mark.parametrize(
    ("text", "refuted", "accepted"),
    [
        ("ex x. x^2 + 1 = 0", [x**2 + 1], True),
        ("ex x. x^2 + 1 = 0 and x > y", [x**2 + 1], False),  # not a sentence
        ("ex x. x^2 = 1", [x**2 - 1], False),  # the certificate lists solutions
        ("ex x. x^2 + 1 = 0 or x = 1", [x**2 + 1], False),
        ("ex x. x^2 + 2 = 0", [x**2 + 1], False),
        ("ex x. x > 1 and (x^2 + 1 = 0 or x^2 + 1 = 0 and x < 2)", [x**2 + 1], True),
    ],
)
def test_what_refutes_a_sentence(text: str, refuted: list[Poly], accepted: bool) -> None:
    formula = convert(read_formula(text), Ring.of(("x", "y")))
    evidence: Any = {"systems": [solutions_certificate(refuted).evidence_for("solutions")]}
    assert (refused("comprehensive Gröbner system", formula, FALSE, evidence) == "") is accepted


@pytest.mark.parametrize("relation", [[], [">"], {}, None, True, 1, "", "<", "="])
def test_an_unknown_relation_is_refused_and_breaks_nothing(relation: Any) -> None:
    path = (*EVIDENCE, "conditions", 0, 1)
    found = verdict(replaced(DATA, path, relation))
    assert not found.accepted and found.decided and found.step.startswith(f"{PLACE}.conditions[0]")


def test_the_list_that_is_claimed_is_the_list_that_is_checked() -> None:
    """Each other list, in the answer and in the step, with the evidence of the right one."""
    start, answer = DATA["payload"]["start"], DATA["payload"]["answer"]
    others = [answer[:-1], [*answer, ["atom", "x", "="]], ["or", *answer[1:3]], True, False, start]
    for other in others:
        whole = json.loads(json.dumps(DATA))
        whole["payload"]["answer"] = whole["payload"]["steps"][0]["after"] = other
        found = verdict(replaced(whole, ("version",), 3))
        assert found.decided and found.step == "payload.steps[0].after", found
    for other in (start[:-1], ["and", *start[1:], ["atom", "x", ">"]], True):
        whole = json.loads(json.dumps(DATA))
        whole["payload"]["start"] = whole["payload"]["steps"][0]["before"] = other
        found = verdict(replaced(whole, ("version",), 3))
        assert found.decided and found.step == "payload.steps[0].before", found


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


def test_the_claim_of_classifications_in_words() -> None:
    for found, wanted in (
        (CUBIC, "count = 3 and p < 0 and 4*p^3 + 27*q^2 < 0"),
        (QUADRATIC, "not (c = 0 and b = 0 and a = 0) and "),  # else there are infinitely many complex solutions
        (POSITIVE, "count = 1 and a > 1"),
        (IRRATIONAL, "w^2 = 2 and -3 <= w <= 0"),
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


@each(CUBIC, QUADRATIC, POSITIVE, IRRATIONAL, daily=2)
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
