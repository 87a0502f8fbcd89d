"""A comparison that some value of its variable meets, whatever the others are."""

from __future__ import annotations

from typing import Any

import pytest

from qe.certify.value_taken import check_value_taken
from tests.unit.certify.claims import NO_LEMMAS, objection


def by(variable: str = "x") -> dict[str, Any]:
    return {"variable": variable, "theory": NO_LEMMAS}


@pytest.mark.parametrize(
    ("before", "after", "given"),
    [
        ("ex x. x = a and b > 0", "b > 0", "true"),
        ("ex x. x^3 + a*x < b", "true", "true"),
        ("ex x, y. x^3 - y = 0 and y > b", "ex y. y > b", "true"),
        ("ex x. a*x^3 = b and a /= 0", "a /= 0", "true"),
        ("ex x. a*x > b", "true", "a < 0"),
        ("ex x. a*x^2 > b and a > 0", "a > 0", "true"),
        ("ex x. a*x^2 >= b and a > 0", "a > 0", "true"),
        ("ex x. a*x^2 < b and a < 0", "a < 0", "true"),
        ("ex x. a*x^2 <= b and a < 0", "a < 0", "true"),
        ("ex x. a*x^2 /= b and a < 0", "a < 0", "true"),
        ("ex x. a*x^2 + b*x /= c and a /= 0", "a /= 0", "true"),
    ],
)
def test_a_comparison_that_can_be_met(before: str, after: str, given: str) -> None:
    assert objection(check_value_taken, before, after, by(), given) == ""


@pytest.mark.parametrize(
    ("before", "after", "given", "reason"),
    [
        ("ex x. a*x > b", "true", "true", "do not exclude"),
        ("ex x. a*x^2 > b and a < 0", "a < 0", "true", "do not exclude"),
        ("ex x. a*x^2 > b and a >= 0", "a >= 0", "true", "do not exclude"),
        ("ex x. a*x^2 < b and a > 0", "a > 0", "true", "do not exclude"),
        ("ex x. a*x^2 <= b and a > 0", "a > 0", "true", "do not exclude"),
        ("ex x. a*x^2 + x /= b", "true", "true", "do not exclude"),
        ("ex x. x^2 = b", "true", "true", "need not vanish"),
        ("ex x. x > a and x < b", "true", "true", "one comparison with x"),
        ("ex x. x > a or x < b", "true", "true", "one comparison with x"),
        ("ex x. x = a and b > 0", "true", "true", "not the block without"),
        ("ex x, y. x = a and y > b", "y > b", "true", "not the block without"),
        ("all x. x = a and b > 0", "b > 0", "true", "an existential block"),
        ("ex y. x = a and y > 0", "ex y. y > 0", "true", "a variable of the existential block"),
        ("ex x, y. y*x > b", "true", "y > 0", "do not exclude"),  # of another y
    ],
)
def test_what_need_not_be_met(before: str, after: str, given: str, reason: str) -> None:
    assert reason in objection(check_value_taken, before, after, by(), given)
