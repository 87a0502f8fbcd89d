"""Inequations beside an open condition: conditions on their coefficients take their place."""

from __future__ import annotations

import pytest

from qe.kernel.open_block import check_inequations
from tests.unit.certify.claims import objection

RULE = check_inequations


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("ex x, y. x*y < 1 and a*x + b*y /= 0", "ex x, y. x*y < 1 and (b /= 0 or a /= 0)"),
        ("ex x. (x > a or x < b) and x /= c and a >= 0", "ex x. (x > a or x < b) and a >= 0"),
        ("ex x. x^2 /= a and a*x /= b and x > 0", "ex x. x > 0 and (a /= 0 or b /= 0)"),
        ("ex x. x > 0 and x /= a and (ex y. y^2 = b)", "ex x. x > 0 and (ex y. y^2 = b)"),
    ],
)
def test_conditions_on_coefficients(before: str, after: str) -> None:
    assert objection(RULE, before, after) == ""


@pytest.mark.parametrize(
    ("before", "after", "reason"),
    [
        ("ex x. x >= a and x /= b", "ex x. x >= a", "open set"),
        ("ex x. (x > a or x = b) and x /= b", "ex x. x > a or x = b", "open set"),
        ("ex x. not (x > a and x > b) and x /= b", "ex x. not (x > a and x > b)", "open set"),
        ("ex x. (ex y. y^2 = x) and x /= b", "ex x. ex y. y^2 = x", "open set"),
        ("ex x. x > root(1, x^2 - a) and x /= b", "ex x. x > root(1, x^2 - a)", "open set"),
        ("ex x. a*x /= b and x > 0", "ex x. x > 0", "not what the theorem gives"),
        ("ex x. a*x /= b and x > 0", "ex x. x > 0 and a /= 0", "not what the theorem gives"),
        ("ex x. a*x /= b and x > 0", "x > 0 and (a /= 0 or b /= 0)", "not what the theorem gives"),
        ("all x. x /= a or x > 0", "all x. x > 0", "existential block"),
    ],
)
def test_what_breaks_a_side_condition(before: str, after: str, reason: str) -> None:
    assert reason in objection(RULE, before, after)


def test_there_is_no_evidence_to_give() -> None:
    assert objection(RULE, "ex x. x /= a", "true", {"theory": None})
