"""Substitution certificates: linear equations eliminate a block, and nothing altered passes."""

from __future__ import annotations

import json

import pytest

import qe
from qe.certify.verify import verify_json
from qe.proof.certificate import Kind
from tests.certificates.mutation import leaves, lists, replaced, without

CONTROL = (
    "ex px, py, rx, ry. px = 2*ax - qx and py = 2*ay - qy and 3*rx + 3*qx = 4 and -2*ry = 2*qy - by"
    " and px^2 + py^2 <= r^2 and rx^2 + ry^2 <= r^2 and qx^2 + qy^2 < r^2"
)


@pytest.mark.parametrize(
    "text", [CONTROL, "ex x, y. x = 2*y and 3*y + z = 1 and x*y < z", "ex x. 2*x = a and (x^3 > b or not x = c)"]
)
def test_an_answer_by_linear_equations_is_certified(text: str) -> None:
    answer = qe.eliminate(text, check=True)
    assert answer.certificate is not None and answer.certificate.kind.value in ("substitution", "cells")
    assert answer.guarantee is qe.Guarantee.CHECKED


def test_every_altered_entry_is_rejected() -> None:
    answer = qe.eliminate(CONTROL)
    assert answer.certificate is not None
    whole = json.loads(answer.certificate.to_json())
    assert whole["kind"] == "substitution" and verify_json(json.dumps(whole)).accepted
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
        # the pivot is no constant: x = 1/a has no value at a = 0
        (["and", ["atom", "a*x - 1", "="], ["atom", "a - 2", "<"]], [["x", "a*x - 1"]], ["atom", "a - 2", "<"]),
        # the equation is quadratic
        (["and", ["atom", "x^2 - a", "="], ["atom", "a - 2", "<"]], [["x", "x^2 - a"]], ["atom", "a - 2", "<"]),
        # the equation is under a disjunction
        (["or", ["atom", "-a + x", "="], ["atom", "a - 2", "<"]], [["x", "-a + x"]], True),
        # an inequation is no equation
        (["and", ["atom", "-a + x", "<="], ["atom", "a - 2", "<"]], [["x", "-a + x"]], ["atom", "a - 2", "<"]),
    ],
)
def test_unsound_steps_are_rejected(matrix: list[object], solved: list[list[str]], answer: object) -> None:
    payload = {"order": ["a", "x"], "variables": ["x"], "matrix": matrix, "solved": solved, "answer": answer}
    verdict = qe.verify(qe.Certificate(Kind.SUBSTITUTION, payload))
    assert not verdict.accepted and verdict.step.startswith("payload.solved"), verdict


def test_a_negative_multiple_turns_no_inequality_round() -> None:
    answer = qe.eliminate("ex x. 2*x + a = 0 and x^3 < b and x >= c")
    assert qe.equivalent(answer.formula, "-a^3 < 8*b and -a >= 2*c")
    assert answer.certificate is not None and qe.verify(answer.certificate).accepted
