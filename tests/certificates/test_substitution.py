"""Substitution certificates: linear equations eliminate a block, and nothing altered passes."""

from __future__ import annotations

import json

import pytest

import qe
from qe.certify.verify import verify_json
from qe.exact.ring import Ring
from qe.formula.build import convert, exists
from qe.io.text import read
from qe.proof.entry import poly_to_text
from tests.certificates.mutation import leaves, lists, replaced, without

CONTROL = (
    "ex px, py, rx, ry. px = 2*ax - qx and py = 2*ay - qy and 3*rx + 3*qx = 4 and -2*ry = 2*qy - by"
    " and px^2 + py^2 <= r^2 and rx^2 + ry^2 <= r^2 and qx^2 + qy^2 < r^2"
)


def test_every_altered_entry_is_rejected() -> None:
    answer = qe.eliminate(CONTROL)
    assert answer.certificate is not None
    whole = json.loads(answer.certificate.to_json())
    assert whole["payload"]["steps"][0]["rule"] == "linear equation solved" and verify_json(json.dumps(whole)).accepted
    for path, value in leaves(whole):
        for other in (f"{value}1", str(value)[1:], f"-{value}", f"{value} + 1", None):
            assert not verify_json(replaced(whole, path, other, signed=False)).accepted
            if path[0] != "digest":
                assert not verify_json(replaced(whole, path, other)).accepted, (path, other)
    for path, content in lists(whole):
        for index in range(len(content)):
            assert not verify_json(without(whole, path, index)).accepted, (path, index)


@pytest.mark.parametrize(
    ("matrix", "solved", "answer"),
    [
        ("a*x = 1 and a < 2", "a*x - 1", "a < 2"),  # the pivot is no constant: x = 1/a has no value at a = 0
        ("x^2 = a and a < 2", "x^2 - a", "a < 2"),  # the equation is quadratic
        ("x = a or a < 2", "x - a", "true"),  # the equation is under a disjunction
        ("x <= a and a < 2", "x - a", "a < 2"),  # an inequation is no equation
    ],
)
def test_unsound_steps_are_rejected(matrix: str, solved: str, answer: str) -> None:
    ring = Ring.of(("a", "x"))
    body, claimed = (convert(read(text), ring) for text in (matrix, answer))
    poly = convert(read(f"{solved} = 0"), ring).poly  # type: ignore[attr-defined]
    theory = {"polynomials": [], "lemmas": [], "cases": []}
    for sign in (1, -1, 0, None):
        evidence = {"solved": [["x", poly_to_text(poly), sign]], "theory": theory}
        made = qe.Certificate.step("linear equation solved", ring.names, exists(("x",), body), claimed, evidence)
        verdict = qe.verify(made)
        assert not verdict.accepted and verdict.step.startswith("payload.steps[0]"), verdict


def test_a_negative_multiple_turns_no_inequality_round() -> None:
    answer = qe.eliminate("ex x. 2*x + a = 0 and x^3 < b and x >= c")
    assert qe.equivalent(answer.formula, "-a^3 < 8*b and -a >= 2*c")
    assert answer.certificate is not None and qe.verify(answer.certificate).accepted
