"""Quantifiers moved inside: parts of a conjunction must not share a variable of the block."""

from __future__ import annotations

import pytest

from qe.certify.miniscoping import check_miniscoping
from tests.unit.certify.claims import objection

RULE = check_miniscoping


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("ex x. x > a or x^2 < b", "(ex x. x > a) or (ex x. x^2 < b)"),
        ("ex x. x > a or b > 0", "b > 0 or (ex x. x > a)"),
        ("ex x. x > a or b > 0", "(ex x. x > a) or (ex x. b > 0)"),
        ("ex x, y. x > a and y^2 < b", "(ex x. x > a) and (ex y. y^2 < b)"),
        ("(ex x. x > a) and (ex y. y^2 < b)", "ex x, y. x > a and y^2 < b"),
        ("ex x, y. x > a and y^2 < b and c > 0", "c > 0 and (ex y. y^2 < b) and (ex x. x > a)"),
        ("ex x, y, z. x > a and y > z", "(ex x. x > a) and (ex y, z. y > z)"),
        ("ex x. x > a and (ex y. y > b)", "(ex x. x > a) and (ex y. y > b)"),
    ],
)
def test_parts_without_a_common_variable(before: str, after: str) -> None:
    assert objection(RULE, before, after) == ""


@pytest.mark.parametrize(
    ("before", "after", "reason"),
    [
        ("ex x. x > a and x^2 < b", "(ex x. x > a) and (ex x. x^2 < b)", "share a variable"),
        ("ex x, y. x > a and y > x", "(ex x. x > a) and (ex y. y > x)", "share a variable"),  # x is free there
        ("ex x, y. x > a and y^2 < b", "(ex x. x > a) or (ex y. y^2 < b)", "not the conjuncts"),
        ("ex x, y. x > a and y^2 < b", "ex x. x > a", "not the conjuncts"),
        ("ex x, y. x > a and y^2 < b", "(ex x. x > a) and (all y. y^2 < b)", "share a variable"),
        ("ex x, y. x > a and y^2 < b", "(ex x. x > a) and (ex y. y^2 <= b)", "not the conjuncts"),
        ("ex x. x > a or x^2 < b", "(ex x. x > a) and (ex x. x^2 < b)", "each part of the disjunction"),
        ("ex x. x > a or b > 0", "b > 0", "each part of the disjunction"),
        ("ex x. x > a or b > 0", "x > a or b > 0", "each part of the disjunction"),
        ("ex x. x > a or b > 0", "b >= 0 or (ex x. x > a)", "each part of the disjunction"),
        ("ex x. x > a or x^2 < b", "ex x. x > a", "each part of the disjunction"),
        ("all x. x > a and x^2 < b", "(all x. x > a) and (all x. x^2 < b)", "existential block"),
    ],
)
def test_other_parts(before: str, after: str, reason: str) -> None:
    found = objection(RULE, before, after)
    assert reason in found or (reason == "share a variable" and "not the conjuncts" in found)


def test_there_is_no_evidence_to_give() -> None:
    assert objection(RULE, "ex x. x > a or x^2 < b", "(ex x. x > a) or (ex x. x^2 < b)", {"theory": 1})
