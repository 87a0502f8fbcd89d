"""Rotations of the axes: steps that they are, and steps that look like it."""

from typing import Any


def turn(zero: str, half: str, *plane: tuple[str, str, str]) -> dict[str, Any]:
    return {"zero": zero, "half": half, "plane": [list(p) for p in plane]}


def by(*turns: dict[str, Any]) -> dict[str, Any]:
    return {"turns": list(turns)}


XY = ("x", "y", "1")
DISC = "ex x, y. x^2 + y^2 > a and x^2 + y^2 < b"
ANGLE = "ex x, y, z, c. x^2 + y^2 = a and x*z + y*c = b and z^2 + c^2 = 1"
SPACE = "ex x, y, z. x^2 + y^2 + z^2 = a and z > b"
TWICE = by(turn("z", "y", ("y", "z", "1")), turn("y", "x", XY))
THREE = "ex x, y, z. x^2 + y^2 + z^2 = a"
BOTH = "ex x, y, z. x*z = 0 and y*z = 0 and z > a"
ONE = "ex x, y, z. x*z = 0 and y*z > 0 and z > a"

TURNED: list[tuple[str, str, Any]] = [
    (DISC, "ex x. x >= 0 and x^2 > a and x^2 < b", by(turn("y", "x", XY))),
    (DISC, "ex y. y >= 0 and y^2 > a and y^2 < b", by(turn("x", "y", XY))),
    ("all x, y. x^2 + y^2 > a", "all x. x < 0 or x^2 > a", by(turn("y", "x", XY))),
    (
        ANGLE,
        "ex x, z, c. x >= 0 and x^2 = a and x*z = b and z^2 + c^2 = 1",
        by(turn("y", "x", XY, ("z", "c", "1"))),
    ),
    (SPACE, "ex x, z. x >= 0 and x^2 + z^2 = a and z > b", by(turn("y", "x", XY))),
    (THREE, "ex x. x >= 0 and x^2 = a", TWICE),
    (
        "ex x, y, z, c. x^2 + y^2 + (z^2 + c^2) = a",
        "ex x, c. c >= 0 and x >= 0 and x^2 + c^2 = a",
        by(turn("z", "c", ("c", "z", "1")), turn("y", "x", XY)),
    ),
    # The equations x = 0, y = 0 turn into each other: the sum of their squares is constant.
    (BOTH, "ex x, z. x >= 0 and x*z = 0 and z > a", by(turn("y", "x", XY))),
]

NOT_TURNED: list[tuple[str, str, Any, str]] = [
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
    # The second turn moves y, so that y >= 0 is lost.
    (THREE, "ex x. x^2 = a", TWICE, ""),
    ("ex x, y, z. x^2 + y^2 + z^2 = a and (ex b, c. b*x > 0)", "true", by(turn("z", "y", ("y", "z", "1"))), ""),
    (ONE, "true", by(turn("y", "x", XY)), "not constant"),
]
"""With the reason of the checker that looks at the whole step."""
