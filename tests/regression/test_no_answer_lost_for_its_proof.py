"""What goes wrong while an answer is proved costs the certificate, never the answer; and the reason is told."""

from __future__ import annotations

import json
from collections.abc import Callable
from itertools import product

import pytest

import qe
from qe.api.verify import judged, with_derivation
from qe.errors import Contradiction, InternalError, Unable
from qe.formula.syntax import FALSE, TRUE
from qe.options import Budget
from qe.proof.on_demand import OnDemand, completed
from qe.proof.step import Step
from tests.tables import each

pytestmark = pytest.mark.faults

OUTSIDE = "all y. ex x. x /= root(2, 2*x^2 + a + y/2 + 2) and 2*a*x = 0"
CUBIC = "ex x. x^3 + a*x + b = 0 and x^2 < c"


def test_names_of_the_prenex_form_of_a_covering_have_a_place_in_its_certificate() -> None:
    answer = qe.eliminate(OUTSIDE, method="coverings", check=True)
    assert (answer.truth, answer.guarantee) == (False, qe.Guarantee.CHECKED)
    assert qe.verify(answer.certificate).accepted


PLACES = (
    "qe.proving.prover.proved",
    "qe.proving.prover.Prover._at",
    "qe.proving.prover.check_derivation",
    "qe.elimination.cad.certificate_for",
    "qe.api.verify._limited",
)
ERRORS = (InternalError("odd"), KeyError("x_1"), RecursionError(), ZeroDivisionError(), MemoryError(), Unable("no"))
QUESTIONS: dict[str, Callable[[], qe.Answer]] = {
    "eliminate": lambda: qe.eliminate(CUBIC, check=True, process=False),
    "coverings": lambda: qe.eliminate("ex x. a*x > 1", check=True, method="coverings", process=False),
    "with_derivation": lambda: with_derivation(qe.eliminate("ex x. a*x^2 + b*x + 1 = 0")),
    "parametric_witnesses": lambda: qe.parametric_witnesses("ex x. a*x > 1", check=True, process=False).answer,
    "region": lambda: qe.region("ex x. a*x > 1", check=True, process=False).answer,  # type: ignore[return-value]
    "minimize": lambda: qe.minimize("x^4 - x*y", "x^2 = y", check=True, process=False).answer,  # type: ignore[union-attr]
}


@pytest.mark.parametrize("place", PLACES)
@each(*QUESTIONS, daily=2)
def test_whatever_breaks_while_a_proof_is_made_or_checked_leaves_the_answer(name, place, monkeypatch):
    plain = QUESTIONS[name]()
    for error in ERRORS:

        def broken(*given: object, error: Exception = error, **named: object) -> object:
            raise error

        with monkeypatch.context() as patch:
            patch.setattr(place, broken)
            answer = QUESTIONS[name]()
        assert answer.formula == plain.formula
        assert answer.certificate is not None or answer.reason, (error, place)


def test_a_refused_certificate_of_an_answer_is_told_and_does_not_end_it() -> None:
    answer = qe.eliminate("ex x. x^2 = a", check=True)
    assert answer.certificate is not None
    text = json.loads(answer.certificate.to_json())
    text["payload"]["answer"] = ["true"]
    guarantee, reason = judged(qe.Certificate(answer.certificate.kind, text["payload"]), Budget())
    assert guarantee is qe.Guarantee.DERIVED and "internal error" in reason and "rejected" in reason


def test_a_contradiction_between_two_methods_is_never_a_reason_only(monkeypatch):
    """An answer that a decomposition refutes is not handed out."""
    from qe.elimination.protocol import Outcome

    monkeypatch.setattr("qe.engine.run._Run.outcome", lambda self, formula: Outcome(FALSE))
    with pytest.raises(Contradiction):
        qe.eliminate("ex x, y. x^2 + y^2 < 1 and x^3 > y", check=True, process=False)


UNCHECKED = (
    CUBIC,  # read off cells
    "ex x. x^4 + a*x^2 + b = 0 and x > 0",
    "ex x, y. x^2 + y^2 = a and x*y = b and x > y",
    "ex x1, x2. f = (x1^2 + x2 - 11)^2 + (x1 + x2^2 - 7)^2 and 0 <= x1 and x1 <= 6 and 0 <= x2 and x2 <= 6",  # deb11#1
)


@pytest.mark.parametrize("text", UNCHECKED)
def test_an_unchecked_answer_gets_its_derivation_later(text):
    found = with_derivation(qe.eliminate(text))
    assert (found.guarantee, found.unchecked_steps, found.reason) == (qe.Guarantee.CHECKED, (), "")
    assert qe.verify(found.certificate, formula=text).accepted


@pytest.mark.parametrize("text", ["ex x. x^2 + a*x + b < 0 and x > c", "all x. ex y. x*y = a or x = 0", UNCHECKED[0]])
def test_an_unchecked_covering_gets_its_derivation_later(text):
    found = with_derivation(qe.eliminate(text, method="coverings"))
    assert (found.guarantee, found.unchecked_steps, found.reason) == (qe.Guarantee.CHECKED, (), "")


def test_what_cannot_be_made_later_is_no_evidence() -> None:
    def unable(budget: Budget) -> dict[str, object]:
        raise Unable("no")

    step = completed(Step("cells", TRUE, FALSE, TRUE, {"proof": OnDemand(unable), "detail": "x"}), Budget())
    assert step.evidence == {"proof": {}, "detail": "x"}


def test_a_missing_certificate_always_has_a_reason_and_no_answer_has_no_guarantee() -> None:
    plain = qe.eliminate("ex x. x^3 + a*x = b")
    assert plain.certificate is not None or plain.reason
    for text in ("ex x. a*x^2 + b*x + c = 0", "ex x. x^5 - x = a and x > b", "a > 0"):
        for check in (False, True):
            for method in ("auto", "vs", "coverings", "roots"):
                answer = qe.eliminate(text, method=method, check=check)
                assert answer.certificate is not None or answer.reason, (text, check, method)
                none = answer.formula is None
                assert (answer.guarantee is qe.Guarantee.NONE) == none == (answer.status is qe.Status.UNABLE)
    limited = qe.eliminate("ex x, y, z. x^7 + a*y^5 + b*z^3 + x*y*z < c and x^3*y > b", timeout=0.05)
    assert limited.formula is None and limited.guarantee is qe.Guarantee.NONE


def test_where_no_lemmas_are_found_the_reason_names_the_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    """Answers of simplification, equations taken apart and Gröbner bases without a proof had no reason."""
    monkeypatch.setattr("qe.proving.prover.refuting", lambda *found: None)
    monkeypatch.setattr("qe.elimination.cad.certificate_for", lambda *found: None)
    monkeypatch.setattr("qe.proving.prover.certificate_for", lambda *found: None)
    questions = ("ex x. x > a and x > b and x < a*b - 1", "ex x, y. x^2 + y^2 = 1 and x*y = a and x^2 - y^2 = b", CUBIC)
    unproved = [qe.eliminate(text, check=True, process=False) for text in questions]
    assert any(answer.certificate is None for answer in unproved)
    for answer in unproved:
        named = all(rule in answer.reason for rule in answer.unchecked_steps)
        assert answer.certificate is not None or (answer.reason and answer.unchecked_steps and named)


def test_the_shadow_of_a_polyhedron_has_a_proof_of_its_own() -> None:
    """Where a proof was asked for, substitution went first, and answered with 290,000 characters or not at all; then
    there was the answer, and no proof of it."""
    sides = enumerate(product((-1, 2), (1, -3), (-2, 3), (1, -1)))
    rows = [f"{a}*u + {b}*v + {c}*w + {d}*x <= {k % 3}*p + {k % 5}*q + {k}" for k, (a, b, c, d) in sides]
    question = f"ex u, v, w, x. {' and '.join(rows)}"
    answer = qe.eliminate(question, check=True)
    assert answer.formula == qe.eliminate(question).formula
    assert answer.certificate is not None and qe.verify(answer.certificate)


def test_a_shadow_too_large_for_steps_is_not_decomposed_in_vain(monkeypatch: pytest.MonkeyPatch) -> None:
    """That took 10 to 15 seconds, and there was no proof in the end."""

    def decomposed(*given: object) -> None:
        raise InternalError("a decomposition")

    for place in ("qe.proving.prover.certificate_for", "qe.elimination.cad.certificate_for"):
        monkeypatch.setattr(place, decomposed)
    monkeypatch.setattr("qe.proving.shadows.MOST_PAIRS", 3)
    answer = qe.eliminate(
        "ex x, y, z. x > a and x > b and x < y and y < z and z < c and x < d", check=True, process=False
    )
    assert qe.equivalent(answer.formula, "a < c and a < d and b < c and b < d", process=False)
    assert (answer.certificate, answer.reason) == (None, "no checked evidence for: projection")
