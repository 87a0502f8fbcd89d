"""Derivations for Coq: every step is a lemma, what is believed has a name, and Coq accepts the right alone."""

import re
import shutil
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest

import qe
from qe.coq.export import to_coq
from qe.formula.build import conj, exists
from qe.kernel.boolean import Goal
from qe.kernel.step import Claim
from qe.kernel.terms import terms_goals
from qe.proof.certificate import Certificate, Kind
from qe.proof.entry import Entry, formula_to_json
from qe.proving.lemmas import refuting
from tests.tables import each
from tests.unit.certify.claims import NO_LEMMAS, RING, formula, limits
from tests.unit.coq.test_export import accepted_by_coq

PROVED = [
    "ex x. x*y = 1 and x > 2",
    "not (all x. x /= 2*a or x^2 > b)",
    "ex x, y. x*y = 1 and x = a and (y > b or y = 2)",
    "ex x. (x = a or x = b^2) and x > c",
    "all x. x = a + b and a > 0 or x /= a + b or b > 1",
    "ex x, y. x*y*a = 1 and x = a and y > 0",
    "all x, y. x /= y^2 + a or y /= b or x > 0",
]
"""Nothing of these is believed but what Coq's real numbers rest on."""

BELIEVED = {
    "ex x. a*x^2 + b*x + c = 0 and x > 1": "elimination_set",
    "all x. x^3 + a*x + b /= c": "root",
    "ex x, y. (x - a)^2 + (y - b)^2 <= 1 and x^2 + y^2 <= 1": "theorem",
}


def certificate(text: str) -> Certificate:
    found = qe.eliminate(text, check=True, process=False).certificate
    assert found is not None
    assert found.kind == Kind.DERIVATION, found.kind
    return found


def axioms(text: str) -> list[str]:
    return re.findall(r"^Axiom main\w*?_axiom[0-9]+_(\w+)", text, re.MULTILINE)


@pytest.mark.parametrize("text", PROVED)
def test_a_derivation_is_written_whole(text: str) -> None:
    written = to_coq(certificate(text))
    assert not axioms(written)
    assert "\nTheorem main : " in written
    assert written.rstrip().endswith("Print Assumptions main.")


@pytest.mark.parametrize("text", BELIEVED)
def test_what_rests_on_a_theorem_that_is_not_proved_has_its_name(text: str) -> None:
    assert BELIEVED[text] in axioms(to_coq(certificate(text)))


def test_odd_names_do_not_get_out() -> None:
    written = to_coq(certificate("ex `*) Admitted. (*`. `*) Admitted. (*`*y = 1 and `*) Admitted. (*` > 2"))
    assert "Admitted" not in written


needs_coq = pytest.mark.skipif(shutil.which("coqc") is None, reason="coqc is not installed")


def bundle(texts: list[str]) -> str:
    return to_coq(Certificate.bundle([(str(k), certificate(text)) for k, text in enumerate(texts)]))


@needs_coq
def test_coq_accepts_two_small_ones(tmp_path: Path) -> None:
    assert accepted_by_coq(bundle(PROVED[:2]), tmp_path)


def one_step(rule: str, before: str, after: str, evidence: dict[str, Any]) -> Certificate:
    """A derivation of one step, which the kernel accepts."""
    start, answer = formula(before), formula(after)
    sides = {key: formula_to_json(f, quantified=True) for key, f in (("before", start), ("after", answer))}
    step = {"rule": rule, "at": [], **sides, "context": [], "evidence": evidence}
    made = Certificate.derivation(RING.names, start, [step], answer)
    assert qe.verify(made).accepted
    return made


def theory(goals: Sequence[Goal]) -> Any:
    return refuting(goals, RING, limits())


def comparisons_refuted() -> Certificate:
    atoms = [formula(text) for text in ("x > 1", "x < -1")]
    sentence = exists(["x"], conj(atoms))
    step = {"rule": "signs", "at": [], "before": formula_to_json(sentence, quantified=True), "after": False}
    steps = [{**step, "context": [], "evidence": {"theory": theory([tuple(atoms)])}}]
    refuted = [{"atoms": [formula_to_json(a) for a in atoms], "steps": steps}]
    body = "x > 1 and (y > 0 or x < -1) and (y < 0 or x < -1)"
    return one_step("signs", f"ex x, y. {body}", "false", {"theory": {**NO_LEMMAS, "refuted": refuted}})


def images_divided_by_squares() -> Certificate:
    """a^2*(x - 1) > 0, which the kernel divides by a^2."""
    before, after = "ex x. a*x > 1 and a /= 0", "ex x. x > 1 and a /= 0"
    evidence: dict[str, Any] = {"there": [["x", "x", "a"]], "back": [["x", "a*x", "1"]], "theory": NO_LEMMAS}
    claim = Claim("terms", formula(before), formula(after), RING, Entry(evidence, ""), "")
    return one_step("terms", before, after, {**evidence, "theory": theory(terms_goals(claim, ()))})


BY_HAND = pytest.mark.parametrize("made", [comparisons_refuted, images_divided_by_squares])


@BY_HAND
def test_steps_by_signs_are_proved(made: Callable[[], Certificate]) -> None:
    assert not axioms(to_coq(made()))


@pytest.mark.deep
@needs_coq
@BY_HAND
def test_coq_accepts_steps_by_signs(made: Callable[[], Certificate], tmp_path: Path) -> None:
    assert accepted_by_coq(to_coq(made()), tmp_path)


@pytest.mark.deep
@needs_coq
def test_coq_accepts_ten(tmp_path: Path) -> None:
    texts = [*PROVED, *BELIEVED]
    assert len(texts) >= 10
    assert accepted_by_coq(bundle(texts), tmp_path)


@pytest.mark.deep
@needs_coq
@each((r"(Theorem main : .*) <(?= 0\)\.)", r"\1 <="), (r"tm \(2\)", "tm (3)"), (r"\(Sp (\d+) 1 ", r"(Sp \1 4 "))
def test_coq_refuses_what_is_altered(right: str, wrong: str, tmp_path: Path) -> None:
    written = to_coq(certificate(PROVED[0]))
    altered = re.sub(right, wrong, written, count=1)
    assert altered != written
    assert not accepted_by_coq(altered, tmp_path)
