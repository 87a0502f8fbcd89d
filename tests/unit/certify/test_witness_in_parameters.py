"""Blocks that terms in the parameters satisfy, wherever what is known holds."""

from __future__ import annotations

from typing import Any

import pytest

from qe.certify.witness_in_parameters import check_witness_in_parameters
from tests.unit.certify.claims import NO_LEMMAS, line, objection


def by(*equations: tuple[str, str]) -> dict[str, Any]:
    return {"equations": [[name, line(text)] for name, text in equations], "theory": NO_LEMMAS}


MIDDLE = ("x", "a + b - 2*x")


@pytest.mark.parametrize(
    ("before", "given", "evidence"),
    [
        ("ex x. x > a and x < b", "a < b", by(MIDDLE)),
        ("ex x. x >= a", "true", by(("x", "a - x"))),
        ("ex x, y. y > x and x > a", "true", by(("y", "x - y + 1"), ("x", "a - x + 1"))),
        ("ex x, y. y = 2*x and x = a", "true", by(("y", "2*x - y"), ("x", "a - x"))),
    ],
)
def test_terms_that_satisfy_the_block(before: str, given: str, evidence: Any) -> None:
    assert objection(check_witness_in_parameters, before, "true", evidence, given) == ""


@pytest.mark.parametrize(
    ("before", "after", "given", "evidence", "reason"),
    [
        ("ex x. x > a and x < b", "true", "true", by(MIDDLE), "do not exclude"),
        ("ex x. x > a and x < b", "true", "a <= b", by(MIDDLE), "do not exclude"),
        ("ex x. x > a and x < b", "true", "a < b", by(("x", "a - x")), "do not exclude"),
        ("ex x. x > a and x < b", "true", "a < b", by(), "a variable of the block is left"),
        ("ex x. x > a and x < b", "a < b", "a < b", by(MIDDLE), "block that holds"),
        ("all x. x > a or x < b", "true", "a < b", by(MIDDLE), "block that holds"),
        ("ex x, y. y = 2*x and x = a", "true", "true", by(("x", "a - x"), ("y", "2*x - y")), "is left"),
        ("ex x. x > a", "true", "true", by(("x", "a*x - 1")), "a number as its coefficient"),
        ("ex x. x > a", "true", "true", by(("b", "b - x")), "a variable of the block"),
        ("ex x. x^2 > a", "true", "x > a", by(("x", "x - 1")), "do not exclude"),  # of another x
    ],
)
def test_terms_that_do_not(before: str, after: str, given: str, evidence: Any, reason: str) -> None:
    assert reason in objection(check_witness_in_parameters, before, after, evidence, given)
