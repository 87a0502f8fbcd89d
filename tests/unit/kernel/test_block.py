"""What stands under a block is replaced by what has the same truth, or the block is spread over cases."""

from __future__ import annotations

from typing import Any

import pytest

from qe.kernel.block import check_block
from tests.unit.certify.claims import NO_LEMMAS, objection

NONE = {"theory": NO_LEMMAS}
PRODUCT = {
    "theory": {
        "polynomials": ["a*x", "a", "x"],
        "lemmas": [{"identity": [["1", [[0, 1]]], ["-1", [[1, 1], [2, 1]]]]}],
        "cases": [],
    }
}
"""a*x is the product of a and x."""


@pytest.mark.parametrize(
    ("before", "after", "evidence"),
    [
        ("a > 0 and a >= 0", "a > 0", NONE),
        ("a < 0 or a = 0 or a > 0", "true", NONE),
        ("ex x. a*x = 0", "(ex x. a = 0) or (ex x. x = 0)", PRODUCT),
        ("ex x, y. a*x = 0 and y > 1", "(ex y. a = 0 and y > 1) or (ex x, y. x = 0 and y > 1)", PRODUCT),
        ("all x. a*x /= 0", "a /= 0 and (all x. x /= 0)", PRODUCT),
        ("ex x. (x >= 0 and b > 0)", "(ex x. x > 0 and b > 0) or (ex x. x = 0 and b > 0)", NONE),
    ],
)
def test_cases_of_a_body(before: str, after: str, evidence: Any) -> None:
    assert objection(check_block, before, after, evidence) == ""


@pytest.mark.parametrize(
    ("before", "after", "evidence"),
    [
        ("a > 0 and a >= 0", "a >= 0", NONE),
        ("ex x. a*x = 0", "(ex x. a = 0) or (ex x. x = 0)", NONE),  # the lemma is missing
        ("ex x. a*x = 0", "ex x. x = 0", PRODUCT),  # a case is missing
        ("ex x. a*x > 0", "(ex x. a > 0) or (ex x. x > 0)", PRODUCT),
        ("ex x. x >= 0 and b > 0", "ex x. x > 0 and b > 0", NONE),
        ("all x. a*x /= 0", "a /= 0 or (all x. x /= 0)", PRODUCT),
        ("ex x. x > 0 and a > 0", "all x. x > 0 and a > 0", NONE),
        ("a > 0", "b > 0", NONE),
        ("ex x. x > 0", "all x. x > 0", NONE),
    ],
)
def test_other_bodies(before: str, after: str, evidence: Any) -> None:
    assert "do not exclude that it is wrong" in objection(check_block, before, after, evidence)


def test_a_variable_of_the_block_is_not_let_out() -> None:
    """ex x (x > 0 and a > 0) is no condition on the x outside."""
    found = objection(check_block, "ex x. x > 0 and a > 0", "x > 0 and a > 0", NONE)
    assert "free in what becomes of it" in found


def test_what_is_known_of_the_same_name_outside_says_nothing_inside() -> None:
    """The x that is known to be negative is not the one that is sought."""
    before, after = "ex x. x > 0 or a > 0", "a > 0"
    assert objection(check_block, before, after, NONE, given="x < 0")
    assert objection(check_block, "ex x. x > b or a > 0", "ex x. x > b", NONE, given="a < 0") == ""


@pytest.mark.parametrize("evidence", [{}, {"theory": NO_LEMMAS, "more": 1}, {"theory": None}, {"theory": {}}])
def test_the_evidence_is_a_theory(evidence: Any) -> None:
    assert objection(check_block, "a > 0", "a >= 0 and a /= 0", evidence)
