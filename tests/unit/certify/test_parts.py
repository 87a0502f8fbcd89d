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
from qe.formula.syntax import FALSE, TRUE, Formula, Relation
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


@pytest.mark.parametrize("claimed", [TRUE, read("a < 0"), read("b > 0"), read("a >= 0")])
def test_a_part_claimed_true_that_is_not_proved_is_rejected(claimed: Formula) -> None:
    """Both by the composition and, where that agrees, by the cells."""
    whole = data(CELLS, 120)
    cells, written = whole["payload"]["proofs"][0]["payload"], formula_to_json(convert(claimed, RING))
    whole["payload"]["true"] = written
    assert said(whole) == "payload.true"
    for k, name in enumerate(("true", "false")):  # of the negation, as the block was decomposed
        whole["payload"][name] = cells["parts"][k] = written
    assert said(whole).startswith("payload.proofs[0].payload.parts[")


def test_exchanged_parts_are_rejected() -> None:
    whole = data(CELLS, 120)
    payload = whole["payload"]
    payload["true"], payload["false"] = payload["false"], payload["true"]
    assert said(whole) == "payload.true"
    payload["proofs"][0]["payload"]["parts"].reverse()
    assert said(whole).startswith("payload.proofs[0].payload.parts[")


@pytest.mark.parametrize("truth", [True, False])
def test_an_open_cell_given_a_truth_value_is_rejected(truth: bool) -> None:
    whole = data(CELLS, 120)
    cells = [whole["payload"]["proofs"][0]["payload"]["root"]]
    changed = 0
    for _ in range(2):  # the levels of a and b
        cells = [below for cell in cells if "stack" in cell for below in cell["stack"]["cells"]]
        for cell in cells:
            if cell["truth"] is None and "stack" not in cell:
                cell["truth"] = truth
                changed += 1
    assert changed and said(whole)


def test_open_cells_need_parts_and_an_answer_has_none() -> None:
    leaf = data(CELLS, 120)["payload"]["proofs"][0]
    header = {"format": "bezier-qe certificate", "version": 2}
    assert said({**header, **leaf}) == ""
    with_answer = {**leaf, "payload": {**leaf["payload"], "answer": True}}
    assert said({**header, **with_answer}) == "payload.parts"
    plain = {**leaf, "payload": {k: v for k, v in leaf["payload"].items() if k != "parts"}}
    assert said({**header, "version": 1, **plain}).endswith(".truth")


def test_a_part_without_its_proof_is_rejected() -> None:
    for k in range(2):
        whole = data(MIXED, 300)
        del whole["payload"]["proofs"][k]
        assert said(whole) in ("payload.true", "payload.false")


def test_another_question_is_rejected() -> None:
    whole = data(CELLS, 120)
    other = convert(read(CELLS.replace("> 0", ">= 0")), RING)
    whole["payload"]["question"] = formula_to_json(other, quantified=True)
    assert said(whole) in ("payload.true", "payload.false")


def test_no_internal_error_where_an_answered_part_stands_beside_decided_cells() -> None:
    found = partly(read(MIXED), Options(), Budget(work=300), Limits())
    assert str(found.proved_false).startswith("a <= 0")


def test_parts_of_the_wrong_truth_value_are_rejected(monkeypatch: pytest.MonkeyPatch) -> None:
    """A producer that mistakes true for false."""
    right = anytime._where
    monkeypatch.setattr(anytime, "_where", lambda table, truth: right(table, not truth))
    found = parts(read(CELLS), 120).certificate
    assert found is not None and verify(found).step.startswith("payload.proofs[0].payload.parts[")


def test_a_checked_question_has_checked_parts() -> None:
    hard = "ex x, y. x^3 + a*x*y + b = 0 and y^3 + b*x = a and x > 0 and x^5*y + a*y^4 < b"
    answer = eliminate(f"(ex z. z < 0 and z^2 = a) or ({hard})", timeout=3, anytime=True, check=True)
    if answer.formula is None:  # else the machine is fast
        assert answer.partial is not None
        if answer.partial.is_checked:  # else it is slow
            assert answer.partial.certificate is not None and not answer.partial.reason
        else:
            assert answer.partial.reason
