"""Certificates of parts: what is decided is accepted; a part that claims more, or another truth, is rejected."""

from __future__ import annotations

import json
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.api.eliminate import eliminate, verify
from qe.certify.verify import verify_json
from qe.engine import anytime
from qe.engine.anytime import partly
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, convert, disj, exists, forall
from qe.formula.syntax import FALSE, Formula, Relation
from qe.io.text import read
from qe.options import Budget, Options
from qe.processes.limits import Limits
from qe.proof.certificate import Certificate, digest
from qe.proof.entry import formula_to_json
from qe.proof.partial import Partial
from tests.strategies import polynomials

RING = Ring.of(("a", "b", "x", "y"))
ATOMS = st.builds(atom, polynomials(RING, max_degree=2, max_terms=3), st.sampled_from(tuple(Relation)))
BLOCKS = st.builds(
    lambda kind, join, parts: kind(("x", "y"), join(parts)),
    st.sampled_from([exists, forall]),
    st.sampled_from([conj, disj]),
    st.lists(ATOMS, min_size=1, max_size=3),
)
MIXED = "(ex z. z < 0 and z^2 = a) and (ex x, y. x^2 + y^2 <= 1 and a*x + b*y^2 >= 2)"
CELLS = "all x, y. x^4 + y^4 + a*x*y + b > 0"


def parts(question: Formula, work: int) -> Partial:
    return partly(question, Options(certify=True), Budget(work=work), Limits())


def data(text: str, work: int) -> dict[str, Any]:
    found = parts(read(text), work).certificate
    assert found is not None
    return json.loads(found.to_json())  # type: ignore[no-any-return]


def said(whole: dict[str, Any]) -> str:
    """Where a certificate is rejected, under a right digest."""
    whole["digest"] = digest(whole)
    verdict = verify_json(json.dumps(whole))
    assert verdict.decided
    return "" if verdict.accepted else verdict.step


@settings(max_examples=25)
@given(st.lists(BLOCKS, min_size=1, max_size=2), st.sampled_from([disj, conj]), st.sampled_from([30, 120, 400]))
def test_what_is_decided_is_accepted(blocks: list[Formula], join: Any, work: int) -> None:
    question = join(blocks)
    found = parts(question, work).certificate
    if found is not None:
        verdict = verify(Certificate.from_json(found.to_json()), formula=question)
        assert verdict.accepted or not verdict.decided, verdict


SHARED = "(ex x. x^3 + a*x + b = 0 and x > 1) and (ex x, y. x^2 + a*y^2 < b and x*y > 1)"
"""Two blocks bind one name."""


@pytest.mark.parametrize(("text", "work"), [(CELLS, 120), (MIXED, 300), (SHARED, 700)])
def test_something_is_decided_and_something_is_open(text: str, work: int) -> None:
    found = parts(read(text), work)
    assert disj((found.proved_true, found.proved_false)) != FALSE and found.open != FALSE
    assert found.certificate is not None and verify(found.certificate, formula=read(text)).accepted
    assert verify(found.certificate, formula=read("ex x. x^2 = a")).step == "claim"


def member(whole: dict[str, Any], label: str) -> dict[str, Any]:
    """The derivation that the question is true, or false, where something holds."""
    return next(m["payload"] for m in whole["certificates"] if m["label"] == label)  # type: ignore[no-any-return]


def where(derivation: dict[str, Any], condition: Any, truth: bool) -> None:
    """Let the derivation claim another condition, in all its entries."""
    step = derivation["steps"][0]
    question = derivation["start"][-1]
    derivation["start"] = ["and", condition, question]
    step["context"], step["at"] = [condition], [1]
    derivation["answer"] = condition if truth else False


def inside(derivation: dict[str, Any]) -> dict[str, Any]:
    """The derivation by cells of which the parts are made."""
    return derivation["steps"][0]["evidence"]["proofs"][0]  # type: ignore[no-any-return]


@pytest.mark.parametrize("truth", [True, False])
@pytest.mark.parametrize("claimed", [read("a < 0"), read("b > 0"), read("a >= 0"), read("a + b > 0")])
def test_a_part_that_is_not_proved_is_rejected(claimed: Formula, truth: bool) -> None:
    """By the composition and, where that agrees, by the cells."""
    whole = data(CELLS, 120)
    label, condition = str(truth).lower(), formula_to_json(convert(claimed, RING))
    derivation = member(whole, label)
    where(derivation, condition, truth)
    assert ".evidence.proofs" in said(whole)
    for proof in derivation["steps"][0]["evidence"]["proofs"]:  # of the question, or of its negation
        where(proof, condition, proof["answer"] is not False)
    assert "proofs[0]" in said(whole)


def test_exchanged_parts_are_rejected() -> None:
    whole = data(CELLS, 120)
    one, other = (member(whole, label) for label in ("true", "false"))
    one["steps"], other["steps"] = other["steps"], one["steps"]
    assert said(whole)


@pytest.mark.parametrize("truth", [True, False])
@pytest.mark.parametrize("part", ["true", "false"])
def test_an_open_cell_given_a_truth_value_is_rejected(truth: bool, part: str) -> None:
    whole = data(CELLS, 120)
    cells = [inside(member(whole, part))["steps"][0]["evidence"]["cells"]["root"]]
    changed = 0
    for _ in range(2):  # the levels of a and b
        cells = [below for cell in cells if "stack" in cell for below in cell["stack"]["cells"]]
        for cell in cells:
            if cell["truth"] is None and "stack" not in cell:
                cell["truth"] = truth
                changed += 1
    assert changed and said(whole)


def test_open_cells_prove_nothing_without_a_condition() -> None:
    derivation = inside(member(data(CELLS, 120), "true"))
    header = {"format": "bezier-qe certificate", "version": 3, "kind": "derivation"}
    assert said({**header, "payload": derivation}) == ""
    step, truth = derivation["steps"][0], derivation["steps"][0]["after"]
    plain = {**derivation, "start": step["before"], "answer": truth, "steps": [{**step, "at": [], "context": []}]}
    assert said({**header, "payload": plain}).endswith((".truth", ".after"))


@pytest.mark.parametrize("part", ["true", "false"])
def test_a_part_without_its_proof_is_rejected(part: str) -> None:
    whole = data(MIXED, 300)
    if any(m["label"] == part for m in whole["certificates"]):
        proofs = member(whole, part)["steps"][0]["evidence"]["proofs"]
        for k in range(len(proofs)):
            other = json.loads(json.dumps(whole))
            del member(other, part)["steps"][0]["evidence"]["proofs"][k]
            if not said(other):  # a proof that only the other part needs
                assert member(other, part)["answer"] == member(whole, part)["answer"]
        proofs.clear()
        assert ".evidence.proofs" in said(whole)


def test_another_question_is_rejected() -> None:
    whole = data(CELLS, 120)
    other = formula_to_json(convert(read(CELLS.replace("> 0", ">= 0")), RING), quantified=True)
    for label in ("true", "false"):
        derivation = member(whole, label)
        derivation["start"][-1] = derivation["steps"][0]["before"] = other
    assert ".evidence.proofs" in said(whole)


def test_no_internal_error_where_an_answered_part_stands_beside_decided_cells() -> None:
    found = partly(read(MIXED), Options(), Budget(work=300), Limits())
    assert str(found.proved_false).startswith("a <= 0")


def test_parts_of_the_wrong_truth_value_are_rejected(monkeypatch: pytest.MonkeyPatch) -> None:
    """A producer that mistakes true for false."""
    right = anytime._where
    monkeypatch.setattr(anytime, "_where", lambda table, truth: right(table, not truth))
    found = parts(read(CELLS), 120).certificate
    assert found is not None and "proofs[0].steps[0]" in verify(found).step


def test_a_checked_question_has_checked_parts() -> None:
    hard = "ex x, y. x^3 + a*x*y + b = 0 and y^3 + b*x = a and x > 0 and x^5*y + a*y^4 < b"
    answer = eliminate(f"(ex z. z < 0 and z^2 = a) or ({hard})", timeout=3, anytime=True, check=True)
    if answer.formula is None:  # else the machine is fast
        assert answer.partial is not None
        if answer.partial.is_checked:  # else it is slow
            assert answer.partial.certificate is not None and not answer.partial.reason
        else:
            assert answer.partial.reason
