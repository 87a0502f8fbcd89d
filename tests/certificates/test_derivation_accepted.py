"""Steps that the engine makes are accepted, its derivations with them, and what they claim is what was asked."""

from __future__ import annotations

import doctest
from pathlib import Path

import pytest

import qe
from qe.certify.claims import claim_of
from qe.certify.verify import verify
from qe.proof.answer import Guarantee
from qe.proof.certificate import Certificate, Kind
from tests.certificates.derivations import CASES, certificate


@pytest.mark.parametrize("name", list(CASES)[::2])
def test_it_is_about_the_question(name: str) -> None:
    text = CASES[name]
    assert qe.verify(certificate(text), formula=text).accepted
    verdict = qe.verify(certificate(text), formula="ex x. x^3 = a + 7")
    assert not verdict.accepted
    assert verdict.step == "claim"


def test_the_same_up_to_names_and_order() -> None:
    made = certificate("ex x, y. x = a*y and y = b + 1 and x > 3")
    assert qe.verify(made, formula="ex u, v. v = b + 1 and u > 3 and u = a*v").accepted
    assert not qe.verify(made, formula="ex u, v. v = b + 1 and u >= 3 and u = a*v").accepted
    assert not qe.verify(made, formula="all u, v. v = b + 1 and u > 3 and u = a*v").accepted
    assert not qe.verify(made, formula="ex u, v. v = c + 1 and u > 3 and u = a*v").accepted


@pytest.mark.parametrize("text", ["all x. x^2 > 1", "all x, y, z, u, v. x^2 + y^2 + z^2 + u^2 + v^2 > -1"])
def test_universal_sentences_are_claimed_as_asked(text: str) -> None:
    answer = qe.eliminate(text, check=True)
    assert answer.guarantee is Guarantee.CHECKED
    assert answer.certificate is not None
    words = claim_of(answer.certificate).words
    assert words[0].startswith("the sentence  all x")
    assert words[1] == f"is {answer.formula}"


@pytest.mark.parametrize("text", list(CASES.values())[::3])
def test_the_answer_is_the_one_without_the_check(text: str) -> None:
    checked, plain = qe.eliminate(text, check=True), qe.eliminate(text)
    assert checked.formula == plain.formula
    assert checked.guarantee is Guarantee.CHECKED


def test_what_is_not_checked_is_named() -> None:
    """Critical values of a block with a constraint of degree 3 are beyond the checkers."""
    answer = qe.eliminate("ex x, y. x^2 = 2 and y^3 = 3 and a = x*y", check=True)
    if answer.unchecked_steps:
        assert answer.certificate is None or answer.certificate.kind != Kind.DERIVATION
    else:
        assert answer.certificate is not None
        assert answer.certificate.kind == Kind.DERIVATION


def test_versions() -> None:
    made = certificate(CASES["names"])
    assert '"version":3' in made.to_json()
    assert '"version":3' in qe.eliminate("ex x. x^2 = 2").certificate.to_json()  # type: ignore[union-attr]
    assert '"version":3' in Certificate.bundle([("one", made)]).to_json()
    assert verify(Certificate.from_json(Certificate.bundle([("one", made)]).to_json())).accepted
    with pytest.raises(qe.InputError, match="certificate version 4"):
        Certificate.from_json(made.to_json().replace('"version":3', '"version":4'))


def test_the_document() -> None:
    text = (Path(__file__).parents[2] / "docs" / "certificates.md").read_text().replace("```", "")
    test = doctest.DocTestParser().get_doctest(text, {}, "certificates", "docs/certificates.md", 0)
    runner = doctest.DocTestRunner()
    runner.run(test)
    assert runner.tries > 3
    assert runner.failures == 0
