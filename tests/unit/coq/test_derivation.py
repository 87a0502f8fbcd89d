"""Derivations for Coq: every step is a lemma, what is believed has a name, and Coq accepts the right alone."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

import qe
from qe.coq.export import to_coq
from qe.proof.certificate import Certificate, Kind
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


@pytest.mark.deep
@needs_coq
def test_coq_accepts_ten(tmp_path: Path) -> None:
    texts = [*PROVED, *BELIEVED]
    assert len(texts) >= 10
    assert accepted_by_coq(bundle(texts), tmp_path)


@pytest.mark.deep
@needs_coq
@pytest.mark.parametrize(
    ("right", "wrong"),
    [(r"(Theorem main : .*) <(?= 0\)\.)", r"\1 <="), (r"tm \(2\)", "tm (3)"), (r"\(Sp (\d+) 1 ", r"(Sp \1 4 ")],
)
def test_coq_refuses_what_is_altered(right: str, wrong: str, tmp_path: Path) -> None:
    written = to_coq(certificate(PROVED[0]))
    altered = re.sub(right, wrong, written, count=1)
    assert altered != written
    assert not accepted_by_coq(altered, tmp_path)
