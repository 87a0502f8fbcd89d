"""Steps of rules that are no primitives, in the language of the kernel: true ones are, false ones cannot be."""

from typing import Any

import qe
from tests.tables import each
from tests.unit.certify.claims import NO_LEMMAS, line
from tests.unit.proving.elaborated import refused

Step = tuple[str, str, str, Any, str]
"""Rule, before, after, evidence, and what is given."""


def by(*equations: tuple[str, str]) -> dict[str, Any]:
    return {"equations": [[name, line(text)] for name, text in equations], "theory": NO_LEMMAS}


WITNESS, APART = "witness in the parameters", "disjuncts with equations apart"
BLOCK = "ex x. (x = a or x = b) and x > c and (x < 1 or x > 2)"
FIRST = "(ex x. x > c and (x < 1 or x > 2) and x = a) or (ex x. x > c and (x < 1 or x > 2) and x = b)"
SECOND = "(ex x. (x = a or x = b) and x > c and x < 1) or (ex x. (x = a or x = b) and x > c and x > 2)"
MIDDLE = ("x", "a + b - 2*x")

VALUE_TAKEN = [
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
]
VALUE_NOT_TAKEN = [
    ("ex x. a*x > b", "true", "true"),
    ("ex x. a*x^2 > b and a < 0", "a < 0", "true"),
    ("ex x. a*x^2 > b and a >= 0", "a >= 0", "true"),
    ("ex x. a*x^2 < b and a > 0", "a > 0", "true"),
    ("ex x. a*x^2 <= b and a > 0", "a > 0", "true"),
    ("ex x. a*x^2 + x /= b", "true", "true"),
    ("ex x. x^2 = b", "true", "true"),
    ("ex x. x > a and x < b", "true", "true"),
    ("ex x. x > a or x < b", "true", "true"),
    ("ex x. x = a and b > 0", "true", "true"),
    ("ex x, y. x = a and y > b", "y > b", "true"),
    ("all x. x = a and b > 0", "b > 0", "true"),
    ("ex x, y. y*x > b", "true", "y > 0"),
]
PARABOLA = [
    ("ex x, y. x^2 + a*x + y <= 0 and y > b", "ex y. 4*y - a^2 <= 0 and y > b"),
    ("ex x, y. x^2 + a*x + y = 0 and y > b", "ex y. 4*y - a^2 <= 0 and y > b"),
    ("ex x, y. x^2 + a*x + y < 0 and y > b", "ex y. 4*y - a^2 < 0 and y > b"),
    ("ex x. 1 - x^2 > a", "a < 1"),
]
NO_PARABOLA = [
    ("ex x, y. x^2 + a*x + y < 0 and y > b", "ex y. 4*y - a^2 <= 0 and y > b"),
    ("ex x, y. x^2 + a*x + y > 0 and y > b", "ex y. 4*y - a^2 > 0 and y > b"),
    ("ex x, y. x^2 + a*x + y <= 0 and y > x", "ex y. 4*y - a^2 <= 0 and y > b"),
    ("ex x, y. c*x^2 + a*x + y <= 0 and y > b", "ex y. 4*c*y - a^2 <= 0 and y > b"),
]
FREE = {"variable": "x", "theory": NO_LEMMAS}
TAKEN = "value that is taken"
ALONE = "square of a variable alone"
SQUARE = "ex x, y. x^2 + a*x + y <= 0 and y > b"

POSITION = "affine coordinates"


def values(*steps: tuple[str, dict[str, str]]) -> dict[str, Any]:
    """Linear forms that are the values of variables, one after the other."""
    return {"values": [[name, [[v, c] for v, c in form.items()]] for name, form in steps]}


TRUE_STEPS: list[Step] = [
    (ALONE, SQUARE, "ex y. 4*y - a^2 <= 0 and y > b", {"variable": "x"}, "true"),
    (ALONE, SQUARE.replace("<=", "<"), "ex y. 4*y - a^2 < 0 and y > b", {"variable": "x"}, "true"),
    (ALONE, SQUARE.replace("a*x", "y*x"), "ex y. 4*y - y^2 <= 0 and y > b", {"variable": "x"}, "true"),
    (WITNESS, "ex x. x > a and x < b", "true", by(MIDDLE), "a < b"),
    (WITNESS, "ex x. x >= a", "true", by(("x", "a - x")), "true"),
    (WITNESS, "ex x, y. y > x and x > a", "true", by(("y", "x - y + 1"), ("x", "a - x + 1")), "true"),
    (WITNESS, "ex x, y. y = 2*x and x = a", "true", by(("y", "2*x - y"), ("x", "a - x")), "true"),
    (APART, BLOCK, FIRST, {}, "true"),
    (APART, BLOCK, SECOND, {}, "true"),
    (APART, "ex x. x = a or x = b", "(ex x. x = a) or (ex x. x = b)", {}, "true"),
    (
        POSITION,
        "ex x, y. (3*x - y + 1)^2 < a and (2*y - 1)^3 > b",
        "ex x, y. x^2 < a and y^3 > b",
        values(("x", {"x": "1/3", "y": "1/3", "1": "-1/3"}), ("y", {"y": "1/2", "1": "1/2"})),
        "true",
    ),
    (
        POSITION,
        "all x. x + 1 > a or -x > b",
        "all x. -x > a or x + 1 > b",
        values(("x", {"x": "-1", "1": "-1"})),
        "true",
    ),
    *((TAKEN, before, after, FREE, given) for before, after, given in VALUE_TAKEN),
    *((ALONE, before, after, {"variable": "x"}, "true") for before, after in PARABOLA),
]

FALSE_STEPS: list[Step] = [
    (ALONE, SQUARE.replace("<=", "<"), "ex y. 4*y - a^2 <= 0 and y > b", {"variable": "x"}, "true"),
    (ALONE, SQUARE.replace("<=", ">="), "ex y. 4*y - a^2 <= 0 and y > b", {"variable": "x"}, "true"),
    (ALONE, SQUARE, "ex y. 4*y + a^2 <= 0 and y > b", {"variable": "x"}, "true"),
    (ALONE, SQUARE.replace("> b", "> x"), "ex y. 4*y - a^2 <= 0 and y > b", {"variable": "x"}, "true"),
    (WITNESS, "ex x. x > a and x < b", "true", by(MIDDLE), "true"),
    (WITNESS, "ex x. x > a and x < b", "true", by(MIDDLE), "a <= b"),
    (WITNESS, "ex x. x > a and x < b", "true", by(("x", "a - x")), "a < b"),
    (WITNESS, "ex x. x > a and x < b", "true", by(), "a < b"),
    (WITNESS, "ex x. x > a", "true", by(("x", "a*x - 1")), "true"),
    (WITNESS, "ex x. x^2 > a", "true", by(("x", "x - 1")), "x > a"),  # of another x
    (APART, BLOCK, "(ex x. x > c and (x < 1 or x > 2) and x = a)", {}, "true"),
    (APART, BLOCK, "(ex x. (x < 1 or x > 2) and x = a) or (ex x. (x < 1 or x > 2) and x = b)", {}, "true"),
    (APART, "all x. x = a or x = b", "(all x. x = a) or (all x. x = b)", {}, "true"),
    (APART, "ex x. x > a and x < b", "(ex x. x > a) and (ex x. x < b)", {}, "true"),
    (POSITION, "ex x. 2*x > a and 2*x < b", "ex x. x > a and x < b", values(("x", {"x": "1"})), "true"),
    (POSITION, "ex x. x^2 = 2", "ex x. x^2 = 1", values(("x", {"x": "2"})), "true"),
    (POSITION, "ex x. x > a and x < 0", "ex x. 0 > a and x < 0", values(("x", {"1": "0"})), "true"),
    (POSITION, "ex x, y. x > y and y > a", "ex x, y. x > 0 and y > b", values(("x", {"x": "1", "y": "1"})), "true"),
    *((TAKEN, before, after, FREE, given) for before, after, given in VALUE_NOT_TAKEN),
    *((ALONE, before, after, {"variable": "x"}, "true") for before, after in NO_PARABOLA),
]


@each(*TRUE_STEPS)
def test_a_true_step_is_one_of_the_kernel(rule: str, before: str, after: str, evidence: Any, given: str) -> None:
    assert refused(rule, before, after, evidence, given) == ""


@each(*FALSE_STEPS)
def test_a_false_step_is_none(rule: str, before: str, after: str, evidence: Any, given: str) -> None:
    assert refused(rule, before, after, evidence, given)


def test_a_case_that_settles_a_scaling_ends_it() -> None:
    """The cases after one that is true were looked for in "true": AttributeError."""
    evidence = {"variable": "x", "weights": [["x", "1"], ["y", "1"]], "values": [1, 0], "theory": NO_LEMMAS}
    assert qe.eliminate("ex y, x. y^3 + 2*x^3 > 0 and y^2*x = 0", check=True).guarantee is qe.Guarantee.CHECKED
    assert refused("homogeneous scaling", "ex x, y. x >= 0 and x + y > 0", "false", evidence)
