"""Projections of polyhedra in the language of the kernel: true ones are steps, false ones cannot be."""

from tests.tables import each
from tests.unit.proving.elaborated import is_a_step_and_no_other_is, refused

RULE = "projection"
SQUARE = "ex x. x >= a and x >= b and x <= 1 and x <= c"
SHADOWS = [
    (SQUARE, "a <= 1 and a <= c and b <= 1 and b <= c"),
    (SQUARE.replace(">=", ">"), "a < 1 and a < c and b < 1 and b < c"),
    (SQUARE.replace("x >= a", "x > a"), "a < 1 and a < c and b <= 1 and b <= c"),
    ("ex x. 3*x < 2*a and 2*x < b and x < c and 5*x >= 1 and 7*x > 1", "10*a > 3 and 5*b > 2 and 5*c > 1"),
    (
        "ex x, y, z. x + y = a and x - z <= 2*y and z < b and x > 3*z and y >= 0 and y <= c",
        "c >= 0 and 4*c > a and 3*c > a - b",
    ),
    ("ex x, y. x > a and y < b", "true"),
    ("ex x, y. x > a and y < b and 2*a <= b", "2*a <= b"),
    ("ex x, y. x >= a and y >= x and y <= a and a <= b", "a <= b"),
    ("ex x, y. x + y <= 1 and x >= a + 1 and y > 0 and a >= 0", "false"),
    ("ex x. x = a and x = a + 1", "false"),
    ("ex x, y. x = y and x - y = a and y = 3", "a = 0"),
    ("all x. x < a or x > b", "a > b"),
    ("all x, y. x < a or y < x or x + 2*y > c or y - x > 1", "3*a > c"),
]
WRONG = [
    (SQUARE, "a <= 1 and a <= c and b <= 1"),
    (SQUARE, "a <= 1 and a <= c and b <= 1 and b < c"),
    (SQUARE.replace("x >= a", "x > a"), "a <= 1 and a <= c and b <= 1 and b <= c"),
    ("ex x, y. x > a and y < b and 2*a <= b", "true"),
    ("ex x. x >= a and x^2 <= b and x <= c", "a <= c"),
    ("ex x. x >= a and x /= b and x <= c", "a < c"),
    ("all x. x < a or x > b", "a >= b"),
    ("a <= b", "a <= b and a <= b + 1"),
]


@each(*SHADOWS)
def test_a_shadow_is_a_step_and_nothing_else_is(before: str, after: str) -> None:
    assert is_a_step_and_no_other_is(RULE, before, after, {})


@each(*WRONG)
def test_what_a_polyhedron_does_not_throw_is_no_step(before: str, after: str) -> None:
    assert refused(RULE, before, after)
