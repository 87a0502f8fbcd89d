"""Translations and scalings of a block: invariance of every polynomial is the side condition."""

from typing import Any

from tests.tables import each
from tests.unit.certify.claims import NO_LEMMAS
from tests.unit.proving.elaborated import refused

TRANSLATION, SCALING = "translation of the origin", "homogeneous scaling"


def along(variable: str, *weights: tuple[str, str]) -> dict[str, Any]:
    return {"variable": variable, "weights": [list(w) for w in weights]}


def scaled(values: list[int], variable: str, *weights: tuple[str, str]) -> dict[str, Any]:
    return {**along(variable, *weights), "values": values, "theory": NO_LEMMAS}


DIFFERENCE = "ex x, y. (x - y)^2 < a and x - y > b"


def test_the_origin_moves_along_the_diagonal() -> None:
    diagonal = along("x", ("x", "1"), ("y", "1"))
    assert refused(TRANSLATION, DIFFERENCE, "ex y. y^2 < a and -y > b", diagonal) == ""
    inner = "ex x. all y. x - y > a or (ex z. z^2 - 2*z*x + x^2 = b)"
    moved = "all y. -y > a or (ex z. z^2 = b)"
    assert refused(TRANSLATION, inner, moved, along("x", ("x", "2"), ("y", "2"), ("z", "2"))) == ""


@each(
    (DIFFERENCE, "ex y. y^2 < a and -y > b", along("x", ("x", "1"), ("y", "-1")), "not constant along"),
    (DIFFERENCE, "ex y. y^2 < a and -y > b", along("x", ("x", "1")), "not constant along"),
    (DIFFERENCE, "ex y. y^2 < a and -y > b", along("x", ("x", "0"), ("y", "1")), "does not move"),
    (DIFFERENCE, "ex y. y^2 < a and -y > b", along("x", ("y", "1")), "does not move"),
    (DIFFERENCE, "ex y. y^2 < a and y > b", along("x", ("x", "1"), ("y", "1")), "with 0 for the variable"),
    (DIFFERENCE, "y^2 < a and -y > b", along("x", ("x", "1"), ("y", "1")), "with 0 for the variable"),
    (DIFFERENCE, "ex y. y^2 < a and -y > b", along("a", ("a", "1")), "existential block"),
    (DIFFERENCE, "ex y. y^2 < a and -y > b", along("x", ("x", "1"), ("x", "1")), "each once"),
    ("ex x. x - y > b", "-y > b", along("x", ("x", "1"), ("y", "1")), "may move"),  # y is given
    ("all x. x - y > b", "-y > b", along("x", ("x", "1")), "existential block"),
    ("ex x, y. x - y > b and (all y. y^2 > x - x)", "ex y. -y > b", along("x", ("x", "1"), ("y", "1")), ""),
    ("ex x, y. x > root(1, (x - y)^2 - a, x)", "true", along("x", ("x", "1"), ("y", "1")), "root atoms"),
)
def test_what_breaks_a_translation(before: str, after: str, evidence: Any, reason: str) -> None:
    assert refused(TRANSLATION, before, after, evidence), reason


@each("ex x. (ex y. x - y > a) and (ex x. x > b)", "ex x. (ex y. x - y > a) and y > b and x > x - y")
def test_a_name_bound_twice_or_free_and_bound(before: str) -> None:
    assert refused(TRANSLATION, before, "true", along("x", ("x", "1"), ("y", "1")))


CUBES = "ex x, y. x^3 + y^3 > 0 and x^2*y > 0"


def test_a_scale_is_chosen() -> None:
    weights = ("x", "1"), ("y", "1")
    all_values = "(ex y. 1 + y^3 > 0 and y > 0) or (ex y. y^3 > 0 and 0 > 0) or (ex y. -1 + y^3 > 0 and y > 0)"
    assert refused(SCALING, CUBES, all_values, scaled([1, 0, -1], "x", *weights)) == ""
    two = "ex x, y. x^2 = y and x > 0 and y < a - a + 3*x^2"
    assert refused(SCALING, two, "ex y. 1 = y and y < 3", scaled([1], "x", ("x", "1"), ("y", "2"))) == ""
    assert refused(SCALING, two, "ex y. 1 = y and y < 3", scaled([1], "x", ("x", "1/2"), ("y", "1"))) == ""


@each(
    (CUBES, "ex y. 1 + y^3 > 0 and y > 0", scaled([1], "x", ("x", "1"), ("y", "1")), "do not exclude"),
    (CUBES, "ex y. 1 + y^3 > 0 and y > 0", scaled([1], "x", ("x", "1"), ("y", "2")), "not homogeneous"),
    ("ex x. x^2 > a", "1 > a or 0 > a or 1 > a", scaled([1, 0, -1], "x", ("x", "1")), "not homogeneous"),
    ("ex x, y. x > 0 and y = x", "ex y. y = 2", scaled([1], "x", ("x", "1"), ("y", "1")), "with these values"),
    ("ex x, y. x > 0 and y = x", "ex y. y = 1", scaled([1], "x", ("x", "0"), ("y", "1")), "does not move"),
    ("ex x, y. x >= 0 and y = x", "ex y. y = 1", scaled([1], "x", ("x", "1"), ("y", "1")), "do not exclude"),
)
def test_what_breaks_a_scaling(before: str, after: str, evidence: Any, reason: str) -> None:
    assert refused(SCALING, before, after, evidence), reason


def test_a_sign_that_is_known_outside_is_one_of_another_variable() -> None:
    before, after = "ex x, y. x*y > 0 and x^2 > y^2", "ex y. y > 0 and 1 > y^2"
    evidence = scaled([1], "x", ("x", "1"), ("y", "1"))
    assert refused(SCALING, before, after, evidence, given="x > 0")
