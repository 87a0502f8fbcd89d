"""Rule "sphere seen along a form": the open ball shows nothing of a form that vanishes."""

from typing import Any

from tests.unit.proving.elaborated import refused

RULE = "sphere seen along a form"

OPEN = "ex x, y. x^2 + y^2 < 1 and a*x + b*y >= c"


def by(sphere: list[Any]) -> dict[str, Any]:
    return {"sphere": sphere, "variables": ["x", "y"], "form": "a*x + b*y"}


def test_an_open_ball_needs_a_form_that_does_not_vanish() -> None:
    """At a = b = 0 the block says c <= 0, and x^2 < a^2 + b^2 nothing."""
    after = "ex x. x^2 - a^2 - b^2 < 0 and x >= c"
    assert refused(RULE, OPEN, after, by(["atom", "x^2 + y^2 - 1", "<"]))


def test_the_square_of_the_radius_has_a_number_before_it() -> None:
    """a*x^2 + a*y^2 < 1 is no ball where a <= 0."""
    after = "ex x. a*x^2 - a^2 - b^2 < 0 and x >= c"
    before = "ex x, y. a*x^2 + a*y^2 < 1 and a*x + b*y >= c"
    assert refused(RULE, before, after, by(["atom", "a*x^2 + a*y^2 - 1", "<"]))


def test_products_of_the_variables_are_in_no_sphere() -> None:
    before = "ex x, y. x^2 + x*y + y^2 < 1 and a*x + b*y >= c"
    said = refused(RULE, before, "ex x. x >= c", by(["atom", "x^2 + x*y + y^2 - 1", "<"]))
    assert said
