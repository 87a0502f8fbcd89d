"""A block goes into one of its disjunctions."""

from __future__ import annotations

import pytest

from qe.certify.distribution import check_distribution
from tests.unit.certify.claims import objection

BLOCK = "ex x. (x = a or x = b) and x > c and (x < 1 or x > 2)"
FIRST = "(ex x. x > c and (x < 1 or x > 2) and x = a) or (ex x. x > c and (x < 1 or x > 2) and x = b)"
SECOND = "(ex x. (x = a or x = b) and x > c and x < 1) or (ex x. (x = a or x = b) and x > c and x > 2)"


@pytest.mark.parametrize(
    ("before", "after", "accepted"),
    [
        (BLOCK, FIRST, True),
        (BLOCK, SECOND, True),
        (BLOCK, "(ex x. x > c and (x < 1 or x > 2) and x = a)", False),
        (BLOCK, "(ex x. (x < 1 or x > 2) and x = a) or (ex x. (x < 1 or x > 2) and x = b)", False),
        (BLOCK, BLOCK, False),
        ("ex x. x = a or x = b", "(ex x. x = a) or (ex x. x = b)", True),
        ("ex x. (x = a or b > 0) and c > x", "(ex x. c > x and x = a) or (ex x. c > x and b > 0)", True),
        ("all x. x = a or x = b", "(all x. x = a) or (all x. x = b)", False),
        ("ex x. x > a and x < b", "(ex x. x > a) and (ex x. x < b)", False),
        ("ex x. (x > a and x < b) or x > c", "(ex x. x > a and x < b) or (ex x. x > c)", True),
    ],
)
def test_one_disjunction_is_taken_apart(before: str, after: str, accepted: bool) -> None:
    assert (objection(check_distribution, before, after) == "") is accepted


def test_there_is_no_evidence() -> None:
    assert objection(check_distribution, BLOCK, FIRST, {"theory": {}})
