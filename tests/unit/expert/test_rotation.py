"""Blocks that only look at lengths and angles: one coordinate is 0, another not negative."""

from __future__ import annotations

from typing import Any

from qe.expert.rotation import check_rotation
from tests.tables import each
from tests.unit.certify.claims import objection


def turn(zero: str, half: str, *plane: tuple[str, str, str]) -> dict[str, Any]:
    return {"zero": zero, "half": half, "plane": [list(p) for p in plane]}


def by(*turns: dict[str, Any]) -> dict[str, Any]:
    return {"turns": list(turns)}


XY = ("x", "y", "1")
DISC = "ex x, y. x^2 + y^2 > a and x^2 + y^2 < b"
ANGLE = "ex x, y, z, c. x^2 + y^2 = a and x*z + y*c = b and z^2 + c^2 = 1"
SPACE = "ex x, y, z. x^2 + y^2 + z^2 = a and z > b"


@each(
    (DISC, "ex x. x >= 0 and x^2 > a and x^2 < b", by(turn("y", "x", XY))),
    (DISC, "ex y. y >= 0 and y^2 > a and y^2 < b", by(turn("x", "y", XY))),
    ("all x, y. x^2 + y^2 > a", "all x. x < 0 or x^2 > a", by(turn("y", "x", XY))),
    (
        ANGLE,
        "ex x, z, c. x >= 0 and x^2 = a and x*z = b and z^2 + c^2 = 1",
        by(turn("y", "x", XY, ("z", "c", "1"))),
    ),
    (SPACE, "ex x, z. x >= 0 and x^2 + z^2 = a and z > b", by(turn("y", "x", XY))),
    (
        "ex x, y, z. x^2 + y^2 + z^2 = a",
        "ex x. x >= 0 and x^2 = a",
        by(turn("z", "y", ("y", "z", "1")), turn("y", "x", XY)),
    ),
    (
        "ex x, y. x^2 + y^2 < a and (ex z, c. x*z + y*c > b)",
        "ex x. x >= 0 and x^2 < a and (ex z, c. x*z > b)",
        by(turn("y", "x", XY, ("z", "c", "1"))),
    ),
)
def test_turned_into_an_axis(before: str, after: str, turns: Any) -> None:
    assert objection(check_rotation, before, after, turns) == ""


@each(
    (DISC, "ex x. x^2 > a and x^2 < b", by(turn("y", "x", XY)), "not the block with 0"),
    (DISC, "ex x. x > 0 and x^2 > a and x^2 < b", by(turn("y", "x", XY)), "not the block with 0"),
    (DISC, "ex x. x <= 0 and x^2 > a and x^2 < b", by(turn("y", "x", XY)), "not the block with 0"),
    ("ex x, y. x^2 - y^2 > a", "ex x. x >= 0 and x^2 > a", by(turn("y", "x", XY)), "not constant along"),
    ("ex x, y. x^2 + 2*y^2 > a", "ex x. x >= 0 and x^2 > a", by(turn("y", "x", XY)), "not constant along"),
    (ANGLE, "true", by(turn("y", "x", XY)), "not constant along"),  # the other vector must turn, too
    (ANGLE, "true", by(turn("y", "x", XY, ("z", "c", "-1"))), "not constant along"),
    (ANGLE, "true", by(turn("y", "x", XY, ("z", "c", "2"))), "not constant along"),
    (DISC, "true", by(turn("y", "x", ("x", "y", "2"))), "turned into each other alone"),
    (SPACE, "true", by(turn("y", "x", XY, ("y", "z", "1"))), "turned into each other alone"),
    (DISC, "true", by(turn("y", "y", XY)), "turned into each other alone"),
    (DISC, "true", by(turn("a", "x", ("x", "a", "1"))), "one quantifier binds"),
    (DISC, "true", by(turn("y", "x", XY, XY)), "each pair once"),
    (DISC, "true", by(turn("y", "x", XY, ("y", "x", "1"))), "each pair once"),
    (DISC, "true", by(turn("y", "x", ("x", "y", "0"))), "each pair once"),
    (DISC, "true", by(turn("y", "x", ("x", "x", "1"))), "two variables"),
    ("ex x. b > 0 and (ex y. x^2 + y^2 > a)", "true", by(turn("y", "x", XY)), "one quantifier binds"),
    ("x^2 + y^2 > a", "true", by(turn("y", "x", XY)), "expected a block"),
    ("ex x, y. x^2 + y^2 > a and (ex x. x > b)", "true", by(turn("y", "x", XY)), "bound twice"),
    ("ex x, y. x > root(1, x^2 + y^2 - a, x)", "true", by(turn("y", "x", XY)), "not constant along"),
)
def test_what_breaks_a_rotation(before: str, after: str, turns: Any, reason: str) -> None:
    assert reason in objection(check_rotation, before, after, turns)


def test_the_earlier_sign_is_kept_only_where_it_is_not_moved() -> None:
    """The second turn moves y, so that y >= 0 is lost."""
    before = "ex x, y, z. x^2 + y^2 + z^2 = a and (ex b, c. b*x > 0)"
    assert objection(check_rotation, before, "true", by(turn("z", "y", ("y", "z", "1")))) != ""
    twice = by(turn("z", "y", ("y", "z", "1")), turn("y", "x", XY))
    three = "ex x, y, z. x^2 + y^2 + z^2 = a"
    assert objection(check_rotation, three, "ex x. x >= 0 and x^2 = a", twice) == ""
    assert objection(check_rotation, three, "ex x. x^2 = a", twice) != ""
    after = "ex x, c. c >= 0 and x >= 0 and x^2 + c^2 = a"
    apart = by(turn("z", "c", ("c", "z", "1")), turn("y", "x", XY))
    assert objection(check_rotation, "ex x, y, z, c. x^2 + y^2 + (z^2 + c^2) = a", after, apart) == ""


def test_equations_are_constant_together() -> None:
    """The equations x = 0, y = 0 turn into each other: the sum of their squares is constant."""
    both = "ex x, y, z. x*z = 0 and y*z = 0 and z > a"
    assert objection(check_rotation, both, "ex x, z. x >= 0 and x*z = 0 and z > a", by(turn("y", "x", XY))) == ""
    one = "ex x, y, z. x*z = 0 and y*z > 0 and z > a"
    assert "not constant" in objection(check_rotation, one, "true", by(turn("y", "x", XY)))
