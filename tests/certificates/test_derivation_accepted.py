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
from tests.certificates.coverings import QUESTIONS as COVERINGS
from tests.certificates.derivations import CASES, certificate
from tests.certificates.test_steps_of_methods import FORMS
from tests.certificates.test_witnesses_and_equations import CONTROL
from tests.tables import each


@pytest.mark.parametrize("name", list(CASES)[::4])
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


@pytest.mark.parametrize("text", list(CASES.values())[::6])
def test_the_answer_is_the_one_without_the_check(text: str) -> None:
    checked, plain = qe.eliminate(text, check=True), qe.eliminate(text)
    assert checked.formula == plain.formula
    assert checked.guarantee is Guarantee.CHECKED


EMPTY = ("x^3 + y^3 < 1 and x*y > 2 and x > 0", "x^4 + y^4 + x*y + 1 < 0")
VS, SIGNS = {"method": "vs", "without": "distribution"}, {"without": "cubic"}  # so that substitution sees the whole
COVERED, CRITICAL = {"method": "coverings"}, {"method": "critical"}
UNIVERSAL = "critical values of a universal block"
QUESTIONS: list[tuple[dict[str, str], str | None, tuple[str, ...]]] = [
    (
        VS,
        None,
        (
            "ex x. a*x^2 + b*x + c = 0",
            "ex x. a*x + b = 0 and c*x + d > 0",
            "ex x, y. x^2 + y^2 = 1 and y = a*x + b",
            "ex x. ((a*x = b and x > 1 and x < 2 or x = 5) and x < c)",
            "ex x, y. x > a and y > x and y < b and x*y > 1",
            "ex x. x^4 + a*x^2 + b <= 0",
            "ex x. x^2 - a < 0 and x^2 - 2*x + b < 0",
            "ex x. (x - a)^2 <= 1 and (x - b)^2 <= 1 and x > c",
            "ex x, y. c > 0 and x*c > 1 and y^2 < c and x + y = 0",
            "ex x, y. x*y - 2*a + 3 < 0",
            "all x. x^2 + a*x + b > 0",
            "ex x. x^4 - a*x^2 < 0 and b*x^2 > 1",
            # a point under conditions that contradict themselves had no condition that it is real (a plane and a ball)
            "ex x, y. c^2*(x - p)^2 + c^2*(y - q)^2 + (c*s - d)^2 <= c^2*r^2",
        ),
    ),
    (
        {},
        None,
        (
            "ex x. a*x^3 + b*x^2 + c*x + d = 0 and x > 0",
            "ex x. x^3 + a*x + b = 0 and c*x + d > 0",
            "ex x. x^3 + a*x + b < 0 and x > c and x < d",
            "ex x. x^3 + a*x^2 + b*x + c <= 0 and x >= 0 and x <= 1",
            "ex x. a*x^3 + b*x + c > 0 and x^2 < d",
            "all x. x^3 + a*x + b > 0 or x < c",
            # there was an internal error: the chain of elimination began with 0 (Hong, Liska & Steinberg)
            "all c. -1 <= c and c <= 1 -> a^2*(1 + 2*c - 2*c^3 - c^4) + c^2 + 2*c + 1 <= 4",
            # quantifiers whose names clash
            "x > 0 and (ex x. x^3 = a*x + 1 and x > 1)",
            "ex x. x > a and (ex x. x^2 = b and x < 2)",
            "all x. x > a or (ex a. a*x > 1)",
            "x > 0 and (ex x. x < root(2, x^2 - y))",
            "x > 0 and (ex x. x > 0 and (ex x. x^2 = y and (ex y. y > x)))",
            "ex x, y. (x - a)^2 + (y - b)^2 <= 1 and x^2 + 4*y^2 <= 1",
            CONTROL,
            "ex x, y. x = 2*y and 3*y + z = 1 and x*y < z",
            "ex x. 2*x = a and (x^3 > b or not x = c)",
        ),
    ),
    (
        SIGNS,
        "roots by signs",
        (*FORMS, "all x. a*x^4 + b*x + c /= 0 or x >= 2", "ex x. c*x^3 + b*x + a > 0 and x < 1"),
    ),
    (SIGNS | {"method": "roots"}, "roots by signs", ("ex x. x^3 + a*x + b = 0 and c*x + d > 0",)),
    (
        COVERED,
        "covering",
        (*COVERINGS, *(f"ex x, y. {body}" for body in EMPTY), *(f"all x, y. not ({b})" for b in EMPTY)),
    ),
    (
        CRITICAL,
        UNIVERSAL,
        (
            "all t. 0 <= t and t <= 1 -> (a - t)^2 + (b - t^2)^2 <= 4",
            "all t. 0 < t and t < 1 -> (1 - t)^2*a + 2*t*(1 - t)*b + t^2 >= 0",
            "all t. 0 <= t and t <= 1 -> a*t - b <= 1 and b*t - a <= t^2",
            "all t. -1 <= t and t <= 2 -> a*t^2 - t <= 1",
            "all t. 0 <= t and t <= 1 -> t*(1 - t)^2*(a^2 + t*b - 1) <= 0",
        ),
    ),
    (
        CRITICAL,
        "constant along directions",
        ("all x. -1 <= x and x <= 1 -> -m <= a + b*x + x^2 and a + b*x + x^2 <= m",),
    ),
]
"""Options, a rule that is used with them, and questions."""


@each(*((options, rule, text) for options, rule, texts in QUESTIONS for text in texts), daily=2)
def test_every_step_of_an_answer_is_checked(options: dict[str, str], rule: str | None, text: str) -> None:
    """And the answer is the one without the check, and the certificate, read again, is about the question."""
    answer = qe.eliminate(text, check=True, process=False, **options)
    assert answer.guarantee is Guarantee.CHECKED and answer.unchecked_steps == ()
    assert rule is None or rule in [step.rule for step in answer.derivation.steps]
    assert answer.certificate is not None
    assert qe.verify(Certificate.from_json(answer.certificate.to_json()), formula=text).accepted
    assert qe.eliminate(text, process=False, **options).formula == answer.formula


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
    with pytest.raises(qe.InputError, match="certificate of version 4"):
        Certificate.from_json(made.to_json().replace('"version":3', '"version":4'))


def test_the_document() -> None:
    text = (Path(__file__).parents[2] / "docs" / "certificates.md").read_text().replace("```", "")
    test = doctest.DocTestParser().get_doctest(text, {}, "certificates", "docs/certificates.md", 0)
    runner = doctest.DocTestRunner()
    runner.run(test)
    assert runner.tries > 3
    assert runner.failures == 0
