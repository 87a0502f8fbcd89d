"""Exponents divided by a common factor: the sign of the variable is the side condition."""

from typing import Any

from tests.tables import each
from tests.unit.certify.claims import NO_LEMMAS
from tests.unit.proving.elaborated import refused

RULE = "degree shift"


def by(exponent: Any, variable: Any = "x") -> dict[str, Any]:
    return {"variable": variable, "exponent": exponent, "theory": NO_LEMMAS}


@each(
    ("ex x. x^4 + a < 0 and x^2 > b", "ex x. x >= 0 and x^2 + a < 0 and x > b", 2),
    ("ex x. x^6 + a*x^3 + b = 0", "ex x. x^2 + a*x + b = 0", 3),
    ("ex x. x^3 < a and x < 0", "ex x. x < a and x < 0", 3),  # the sign of x is that of x^3
    ("ex x. x^2 = a and x > 0 and b < 1", "ex x. x >= 0 and x = a and x > 0 and b < 1", 2),
    ("ex x, y. x^2*y = a and y^3 < b", "ex x, y. x >= 0 and x*y = a and y^3 < b", 2),
    ("ex x. ex y. y > 0 and x^2 = y", "ex x, y. x >= 0 and y > 0 and x = y", 2),
)
def test_exponents_are_divided(before: str, after: str, exponent: int) -> None:
    assert refused(RULE, before, after, by(exponent)) == ""


@each(
    ("ex x. x^4 + a < 0", "ex x. x^2 + a < 0", 2, "not what the shift"),  # without x >= 0
    ("ex x. x^4 + a < 0", "ex x. x > 0 and x^2 + a < 0", 2, "not what the shift"),
    ("ex x. x^6 = a", "ex x. x >= 0 and x^2 = a", 3, "not what the shift"),  # for odd exponents it is wrong
    ("ex x. x^3 = a", "ex x. x = a", 2, "not all exponents"),
    ("ex x. x^4 + x^2 = a", "ex x. x >= 0 and x + x^2 = a", 4, "not all exponents"),
    ("ex x. x^2 = a and x < 0", "ex x. x >= 0 and x = a and x < 0", 2, "do not exclude"),
    ("ex x. x^2 = a", "ex x. x >= 0 and x = a", 1, "at least 2"),
    ("all x. x^2 = a", "all x. x >= 0 and x = a", 2, "existential block"),
    ("ex y. y^2 = x^2", "ex y. y^2 = x", 2, "existential block"),  # x is not bound here
    ("ex x. x^2 = a and (all x. x^2 > b)", "ex x. x >= 0 and x = a and (all x. x > b)", 2, "quantifier inside"),
    ("ex x. x^2 = a and x > root(1, x^2 - b)", "ex x. x >= 0 and x = a and x > root(1, x - b)", 2, "root atoms"),
)
def test_what_breaks_a_side_condition(before: str, after: str, exponent: int, reason: str) -> None:
    assert refused(RULE, before, after, by(exponent)), reason


def test_the_sign_of_another_variable_of_the_same_name_is_not_known() -> None:
    before, after = "ex x. x^2 = a and x > b", "ex x. x >= 0 and x = a and x > b"
    assert refused(RULE, before, after, by(2))
    bare = "ex x. x^2 = a and x < 0", "ex x. x >= 0 and x = a and x < 0"
    assert refused(RULE, *bare, by(2), given="x > 0")


@each(by("2"), by(2, "y"), by(2, 7), by(2, "q"))
def test_malformed_evidence(evidence: Any) -> None:
    assert refused(RULE, "ex x. x^2 = a", "ex x. x >= 0 and x = a", evidence)
