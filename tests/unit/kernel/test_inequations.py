"""Inequations beside an open condition: conditions on their coefficients take their place."""

from __future__ import annotations

import pytest

from qe.kernel.open_block import check_inequations
from tests.unit.certify.claims import objection
from tests.unit.proving.elaborated import refused

RULE, ONLY = check_inequations, "only asked to be no root"


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


@pytest.mark.parametrize(
    ("before", "after", "reason"),
    [
        ("ex x. a*x /= b and c > 0", "(a /= 0 or b /= 0) and c > 0", ""),
        ("ex x, y. a*x + b*y /= 0", "a /= 0 or b /= 0", ""),
        ("all x. a*x = b", "a = 0 and b = 0", ""),
        ("ex x. x /= a", "true", ""),
        ("ex x. a*x /= b", "a /= 0", "not shown"),
        ("ex x. a*x /= b and x > c", "a /= 0 or b /= 0", "more is asked"),
        ("ex x. a*x = b", "a = 0 and b = 0", "more is asked"),
        ("a /= 0", "a /= 0", "expected a block"),
    ],
)
def test_no_root_is_all_that_is_asked(before: str, after: str, reason: str) -> None:
    found = refused(ONLY, before, after)
    assert reason in found and bool(found) is bool(reason)


def test_what_is_known_of_a_variable_of_that_name_says_nothing() -> None:
    assert refused(ONLY, "ex x. a*x /= b", "a /= 0 or x > 0", given="x > 0")
    assert refused(ONLY, "ex x. a*x /= b", "a /= 0", given="b = 0") == ""
    assert objection(RULE, "ex x. x /= a", "true", {"theory": None})  # there is no evidence to give
