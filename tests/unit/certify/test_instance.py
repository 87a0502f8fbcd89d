"""Existential sentences that numbers satisfy."""

from __future__ import annotations

from typing import Any

import pytest

from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.io.text import read
from qe.kernel.sentence import check_sentence
from qe.proof.certificate import Certificate, Kind
from qe.proof.entry import formula_to_json
from tests.unit.certify.claims import objection


def witness(matrix: str, *values: Any, order: tuple[str, ...] = ("x", "y")) -> dict[str, Any]:
    body = formula_to_json(convert(read(matrix), Ring.of(order)))
    payload = {"order": list(order), "matrix": body, "values": list(values)}
    return {"certificate": Certificate(Kind.WITNESS, payload).to_data()}


BODY = "x > 1 and x = 2*y"
ROOT = {"polynomial": "x^2 - 2", "interval": ["1", "2"]}


@pytest.mark.parametrize(
    ("before", "after", "evidence", "accepted"),
    [
        (f"ex x, y. {BODY}", "true", witness(BODY, "2", "1"), True),
        (f"ex y, x. {BODY}", "true", witness(BODY, "2", "1"), True),
        (f"ex y, x. {BODY}", "true", witness(BODY, "1", "2", order=("y", "x")), True),
        (f"ex x, y. {BODY}", "true", witness(BODY, "2", "2"), False),
        (f"ex x, y. {BODY}", "false", witness(BODY, "2", "1"), False),
        (f"ex x, y. {BODY} and x > 3", "true", witness(BODY, "2", "1"), False),
        (f"ex x. {BODY}", "true", witness(BODY, "2", "1"), False),  # y is free
        (f"all x, y. {BODY}", "true", witness(BODY, "2", "1"), False),
        ("ex x. x^2 = 2", "true", witness("x^2 - 2 = 0", ROOT, order=("x",)), True),
    ],
)
def test_numbers_for_the_block(before: str, after: str, evidence: Any, accepted: bool) -> None:
    assert (objection(check_sentence, before, after, evidence) == "") is accepted


def test_only_a_witness_counts() -> None:
    body = {"order": ["x"], "variables": ["x"], "matrix": formula_to_json(read("x = 0"))}
    other = Certificate(Kind.SUBSTITUTION, {**body, "solved": [["x", "x"]], "answer": formula_to_json(read("true"))})
    evidence = {"certificate": other.to_data()}
    assert "expected a point" in objection(check_sentence, "ex x. x = 0", "true", evidence)
