"""Linear equations solved for a variable: what is known of the coefficient is the side condition."""

from __future__ import annotations

from typing import Any

import pytest

from qe.kernel.linear_equation import check_linear
from tests.unit.certify.claims import NO_LEMMAS, objection

RULE = check_linear


def by(*solved: list[Any]) -> dict[str, Any]:
    return {"solved": [*solved], "theory": NO_LEMMAS}


@pytest.mark.parametrize(
    ("before", "after", "solved", "given"),
    [
        ("ex x. x = a and x^2 > b", "a^2 > b", [["x", "-a + x", 1]], "true"),
        ("ex x. 2*x + a = 0 and x^3 < b", "-a^3 < 8*b", [["x", "a + 2*x", 1]], "true"),
        ("ex x. a*x = b and x < c", "b < a*c", [["x", "a*x - b", 1]], "a > 0"),
        ("ex x. a*x = b and x < c", "-b < -a*c", [["x", "a*x - b", -1]], "a < 0"),
        ("ex x. a*x = b and x < c", "a*b < a^2*c", [["x", "a*x - b", 0]], "a /= 0"),
        ("ex x. a*x = b and x^2 < c", "b^2 < a^2*c", [["x", "a*x - b", 0]], "a /= 0"),
        ("ex x. a*x = b and x = c", "b = a*c", [["x", "a*x - b", 0]], "a /= 0"),
        ("ex x. a > 0 and a*x = b and x < c", "a > 0 and b < a*c", [["x", "a*x - b", 1]], "true"),  # a conjunct beside
        ("ex x. a*x = b and c > 0", "(a /= 0 or b = 0) and c > 0", [["x", "a*x - b", None]], "true"),
        ("ex x, y. x = a*y and y = b and x > 1", "a*b > 1", [["x", "a*y - x", -1], ["y", "-b + y", 1]], "true"),
        ("ex x, y. x = a*y and y^3 > x", "ex y. y^3 > a*y", [["x", "a*y - x", -1]], "true"),
    ],
)
def test_what_a_linear_equation_leaves(before: str, after: str, solved: list[Any], given: str) -> None:
    assert objection(RULE, before, after, by(*solved), given) == ""


@pytest.mark.parametrize(
    ("before", "after", "solved", "given", "reason"),
    [
        ("ex x. a*x = b and x < c", "b < a*c", [["x", "a*x - b", 1]], "true", "do not exclude"),
        ("ex x. a*x = b and x < c", "b < a*c", [["x", "a*x - b", 1]], "a >= 0", "do not exclude"),
        ("ex x. a*x = b and x < c", "b < a*c", [["x", "a*x - b", -1]], "a < 0", "not what the substitutions"),
        ("ex x. a*x = b and x < c", "b < a*c", [["x", "a*x - b", 0]], "a /= 0", "not what the substitutions"),
        ("ex x. a*x = b and x < c", "b < a*c", [["x", "a*x - b", None]], "a > 0", "may vanish"),
        ("ex x. a*x = b and 1 + a*x <= 0", "a^2*b + a^2 <= 0", [["x", "a*x - b", 0]], "true", "do not exclude"),
        ("ex x. x = a and x^2 > b", "a^2 > b", [["x", "-a + x", -1]], "true", "not the sign of this number"),
        ("ex x. x = a and x^2 > b", "a^2 > b", [["x", "-a + x", 0]], "true", "not the sign of this number"),
        ("ex x. x = a and x^2 > b", "a^2 >= b", [["x", "-a + x", 1]], "true", "not what the substitutions"),
        ("ex x. x = a or x^2 > b", "a^2 > b", [["x", "-a + x", 1]], "true", "no conjunct here"),
        ("ex x. x <= a and x^2 > b", "a^2 > b", [["x", "-a + x", 1]], "true", "no conjunct here"),
        ("ex x. x^2 = a and x > b", "a > b", [["x", "x^2 - a", 1]], "true", "no conjunct here"),
        ("ex y. x = a and y > x", "ex y. y > a", [["x", "-a + x", 1]], "true", "variable of the block"),
        ("all x. x = a and x^2 > b", "a^2 > b", [["x", "-a + x", 1]], "true", "existential block"),
        ("x = a and x^2 > b", "a^2 > b", [["x", "-a + x", 1]], "true", "existential block"),
        ("ex x. x = a and (all a. a > x)", "all a. a > a + 0*b", [["x", "-a + x", 1]], "true", "quantifier inside"),
        ("ex x. x = a and x > root(1, x^2 - b)", "a > root(1, a^2 - b)", [["x", "-a + x", 1]], "true", "root atoms"),
        ("ex x. x = a and x > b", "a > b", [["x", "-a + x"]], "true", "variable of the block, equation, sign"),
        ("ex x. x = a and x > b", "a > b", [["x", "-a + x", True]], "true", "expected 1, -1, 0 or null"),
        ("ex x. x = a and x > b", "a > b", [["x", "-a + x", 2]], "true", "expected 1, -1, 0 or null"),
    ],
)
def test_what_breaks_a_side_condition(before: str, after: str, solved: list[Any], given: str, reason: str) -> None:
    assert reason in objection(RULE, before, after, by(*solved), given)


def test_the_coefficient_may_be_known_outside_only_if_it_means_the_same() -> None:
    """y is bound: what is known of another y does not make the coefficient positive."""
    before, after = "ex x, y. y*x = b and x < c and y < a", "ex y. b < y*c and y < a"
    assert "do not exclude" in objection(RULE, before, after, by(["x", "x*y - b", 1]), "y > 0")
