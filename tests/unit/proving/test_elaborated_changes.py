"""Changes of variables in one block, by rules that are no primitives: those of the theorem are the kernel's, no others.

A row is a step, as in ``test_elaborated_blocks``.
"""

from typing import Any

from tests.tables import each
from tests.unit.certify.claims import NO_LEMMAS
from tests.unit.proving.elaborated import Row, is_a_step_and_no_other_is, refused, rows

SHIFT, EXCHANGE, MIRROR = "degree shift", "two variables exchanged", "mirror images of a convex set"
TRANSLATION, SCALING, FORM = "translation of the origin", "homogeneous scaling", "sphere seen along a form"


def exponent(by: Any, variable: Any = "x") -> dict[str, Any]:
    return {"variable": variable, "exponent": by, "theory": NO_LEMMAS}


def exchanged(before: str, after: str) -> Row:
    """There are numbers with the sum x and the product y iff x^2 - 4*y >= 0."""
    return f"ex x, y. {before}", f"ex x, y. x^2 - 4*y >= 0 and {after}", {"variables": ["x", "y"]}


SUMS = [
    ("x > 1 and y > 1", "x > 2 and y - x + 1 > 0"),
    ("x >= 1 and y >= 1", "x >= 2 and y - x + 1 >= 0"),
    ("x < 1 and y < 1", "x < 2 and y - x + 1 > 0"),
    ("x <= 1 and y <= 1", "x <= 2 and y - x + 1 >= 0"),
    ("x = 1 and y = 1", "x = 2 and y - x + 1 = 0"),
    ("x /= 1 and y /= 1", "y - x + 1 /= 0"),
]
NO_SUMS = [
    *((pair, both.replace(part, "true")) for pair, both in SUMS for part in both.split(" and ")),
    ("x /= 1 and y /= 1", "x /= 2 and y - x + 1 /= 0"),
    ("x > 1 and y > 1", "x > 2 and y - x + 1 >= 0"),
    ("x >= 1 and y >= 1", "x >= 2 and y - x + 1 > 0"),
    ("x < 1 and y < 1", "x < 2 and y - x + 1 < 0"),
]
# Bodies that are convex by their form.
NEGATED = {"mirror": [["x", "x", -1]]}
SPAN = "x < b and -x < b"


def along(variable: str, *weights: tuple[str, str]) -> dict[str, Any]:
    return {"variable": variable, "weights": [list(w) for w in weights]}


def scaled(values: list[int], variable: str, *weights: tuple[str, str]) -> dict[str, Any]:
    return {**along(variable, *weights), "values": values, "theory": NO_LEMMAS}


XY = ("x", "1"), ("y", "1")
DIAGONAL = along("x", *XY)
DIFFERENCE = "ex x, y. (x - y)^2 < a and x - y > b"
MOVED = "ex y. y^2 < a and -y > b"
CUBES, CUBES_AT_1 = "ex x, y. x^3 + y^3 > 0 and x^2*y > 0", "ex y. 1 + y^3 > 0 and y > 0"
PARABOLA = "ex x, y. x^2 = y and x > 0 and y < a - a + 3*x^2"


def sphere(of: str) -> dict[str, Any]:
    return {"sphere": ["atom", f"{of} - 1", "<"], "variables": ["x", "y"], "form": "a*x + b*y"}


TRUE_STEPS: dict[str, list[Row]] = {
    SHIFT: [
        ("ex x. x^4 + a < 0 and x^2 > b", "ex x. x >= 0 and x^2 + a < 0 and x > b", exponent(2)),
        ("ex x. x^6 + a*x^3 + b = 0", "ex x. x^2 + a*x + b = 0", exponent(3)),
        ("ex x. x^3 < a and x < 0", "ex x. x < a and x < 0", exponent(3)),  # the sign of x is that of x^3
        ("ex x. x^2 = a and x > 0 and b < 1", "ex x. x >= 0 and x = a and x > 0 and b < 1", exponent(2)),
        ("ex x, y. x^2*y = a and y^3 < b", "ex x, y. x >= 0 and x*y = a and y^3 < b", exponent(2)),
        ("ex x. ex y. y > 0 and x^2 = y", "ex x, y. x >= 0 and y > 0 and x = y", exponent(2)),
        ("ex x. not (x^4 < a or x^2 = b)", "ex x. x >= 0 and not (x^2 < a or x = b)", exponent(2)),
    ],
    EXCHANGE: [
        *(exchanged(f"x*y = a and {pair}", f"y = a and {both}") for pair, both in SUMS),
        *(exchanged(f"x*y = a and x - y {sign} 0", f"y = a and x^2 - 4*y {sign} 0") for sign in ("=", "/=")),
    ],
    MIRROR: [
        (f"ex x. {SPAN}", "0 < b", NEGATED),
        (f"ex x. {SPAN} and (a > 0 or c^2 = 2)", "0 < b and (a > 0 or c^2 = 2)", NEGATED),
        (f"ex x. {SPAN} and (ex y. y^2 = a)", "0 < b and (ex y. y^2 = a)", NEGATED),
        (f"ex x. {SPAN} and (ex y. x + y < 1 and -x + y < 1)", "0 < b and (ex y. y < 1)", NEGATED),
        ("ex x. a > 0 or x < b and -x < b", "a > 0 or 0 < b", NEGATED),
        ("ex x. all y. y*x < b and -y*x < b or y^2 > 1", "all y. 0 < b or y^2 > 1", NEGATED),
        ("ex x. not (x > a or -x > a)", "a >= 0", NEGATED),
    ],
    TRANSLATION: [
        (DIFFERENCE, MOVED, DIAGONAL),
        (
            "ex x. all y. x - y > a or (ex z. z^2 - 2*z*x + x^2 = b)",
            "all y. -y > a or (ex z. z^2 = b)",
            along("x", ("x", "2"), ("y", "2"), ("z", "2")),
        ),
    ],
    SCALING: [
        (
            CUBES,
            f"({CUBES_AT_1}) or (ex y. y^3 > 0 and 0 > 0) or (ex y. -1 + y^3 > 0 and y > 0)",
            scaled([1, 0, -1], "x", *XY),
        ),
        (PARABOLA, "ex y. 1 = y and y < 3", scaled([1], "x", ("x", "1"), ("y", "2"))),
        (PARABOLA, "ex y. 1 = y and y < 3", scaled([1], "x", ("x", "1/2"), ("y", "1"))),
        ("ex x, y. not (x <= 0 or x^2 > y)", "ex y. not (1 > y)", scaled([1], "x", ("x", "1"), ("y", "2"))),
    ],
}

FALSE_STEPS: dict[str, list[Row]] = {
    SHIFT: [
        ("ex x. x^4 + a < 0", "ex x. x^2 + a < 0", exponent(2)),  # without x >= 0
        ("ex x. x^4 + a < 0", "ex x. x > 0 and x^2 + a < 0", exponent(2)),
        ("ex x. x^6 = a", "ex x. x >= 0 and x^2 = a", exponent(3)),  # for odd exponents it is wrong
        ("ex x. x^3 = a", "ex x. x = a", exponent(2)),
        ("ex x. x^4 + x^2 = a", "ex x. x >= 0 and x + x^2 = a", exponent(4)),
        ("ex x. x^2 = a and x < 0", "ex x. x >= 0 and x = a and x < 0", exponent(2)),
        ("ex x. x^2 = a", "ex x. x >= 0 and x = a", exponent(1)),
        ("all x. x^2 = a", "all x. x >= 0 and x = a", exponent(2)),
        ("ex y. y^2 = x^2", "ex y. y^2 = x", exponent(2)),  # x is not bound here
        ("ex x. x^2 = a and (all x. x^2 > b)", "ex x. x >= 0 and x = a and (all x. x > b)", exponent(2)),
        ("ex x. x^2 = a and x > root(1, x^2 - b)", "ex x. x >= 0 and x = a and x > root(1, x - b)", exponent(2)),
        ("ex x. x^2 = a and x > b", "ex x. x >= 0 and x = a and x > b", exponent(2)),
        *(
            ("ex x. x^2 = a", "ex x. x >= 0 and x = a", malformed)
            for malformed in (exponent("2"), exponent(2, "y"), exponent(2, 7), exponent(2, "q"))
        ),
    ],
    EXCHANGE: [
        *(exchanged(f"x*y = a and {pair}", f"y = a and {both}") for pair, both in NO_SUMS),
        # x > y and y^3 > x^3 have no solution, but both squares are positive wherever x and y differ.
        *(
            exchanged(
                f"x*y = a and x - y {sign} 0 and y^3 - x^3 {sign} 0",
                f"y = a and x^2 - 4*y {sign} 0 and (x^2 - 4*y)*(x^2 - y)^2 {sign} 0",
            )
            for sign in (">", ">=")
        ),
        # A condition on one of the two.
        *(exchanged(f"x*y = a and {at}", "y = a and x > 2") for at in ("x > 1", "x > 1 and y > 2", "(x > 1 or y > 2)")),
    ],
    MIRROR: [
        ("ex x. x /= 0", "0 /= 0", NEGATED),
        ("ex x. x > 1 or x < -1", "0 > 1 or 0 < -1", NEGATED),
        ("ex x. x^2 > b", "0 > b", NEGATED),
        ("ex x. (ex y. x*y > 1 and y > 0 or x*y < -1 and y > 0)", "false", NEGATED),
        ("ex x. (ex y. x*y > 1 and x + y > 1) or (ex z. -x*z > 1 and -x + z > 1)", "false", NEGATED),
        ("ex x. not (x < 1 and -x < 1)", "not (0 < 1 and 0 < 1)", NEGATED),
        ("ex x. a > 1 or not (x < 1 and -x < 1)", "a > 1 or not (0 < 1 and 0 < 1)", NEGATED),
        # Its variables are not looked for.
        ("ex x. a > 1 or x > root(1, x^3 - b) or x < root(1, x^3 + b)", "a > 1", NEGATED),
        # Nothing but the block at the fixed points.
        *((f"ex x. {SPAN}", after, NEGATED) for after in ("0 <= b", "0 < b and a > 0", "ex x. x < b", "true")),
    ],
    TRANSLATION: [
        (DIFFERENCE, MOVED, along("x", ("x", "1"), ("y", "-1"))),  # not constant along it
        (DIFFERENCE, MOVED, along("x", ("x", "1"))),
        (DIFFERENCE, MOVED, along("x", ("x", "0"), ("y", "1"))),  # x does not move
        (DIFFERENCE, MOVED, along("x", ("y", "1"))),
        (DIFFERENCE, "ex y. y^2 < a and y > b", DIAGONAL),
        (DIFFERENCE, "y^2 < a and -y > b", DIAGONAL),
        (DIFFERENCE, MOVED, along("a", ("a", "1"))),
        (DIFFERENCE, MOVED, along("x", ("x", "1"), ("x", "1"))),
        ("ex x. x - y > b", "-y > b", DIAGONAL),  # y is given
        ("all x. x - y > b", "-y > b", along("x", ("x", "1"))),
        ("ex x, y. x - y > b and (all y. y^2 > x - x)", "ex y. -y > b", DIAGONAL),
        ("ex x, y. x > root(1, (x - y)^2 - a, x)", "true", DIAGONAL),
        # A name bound twice, or free and bound.
        ("ex x. (ex y. x - y > a) and (ex x. x > b)", "true", DIAGONAL),
        ("ex x. (ex y. x - y > a) and y > b and x > x - y", "true", DIAGONAL),
    ],
    SCALING: [
        (CUBES, CUBES_AT_1, scaled([1], "x", *XY)),  # other signs of x are not excluded
        (CUBES, CUBES_AT_1, scaled([1], "x", ("x", "1"), ("y", "2"))),  # not homogeneous
        ("ex x. x^2 > a", "1 > a or 0 > a or 1 > a", scaled([1, 0, -1], "x", ("x", "1"))),
        ("ex x, y. x > 0 and y = x", "ex y. y = 2", scaled([1], "x", *XY)),
        ("ex x, y. x > 0 and y = x", "ex y. y = 1", scaled([1], "x", ("x", "0"), ("y", "1"))),
        ("ex x, y. x >= 0 and y = x", "ex y. y = 1", scaled([1], "x", *XY)),
    ],
    FORM: [
        # At a = b = 0 the block says c <= 0, and x^2 < a^2 + b^2 nothing.
        (
            "ex x, y. x^2 + y^2 < 1 and a*x + b*y >= c",
            "ex x. x^2 - a^2 - b^2 < 0 and x >= c",
            sphere("x^2 + y^2"),
        ),
        # a*x^2 + a*y^2 < 1 is no ball where a <= 0.
        (
            "ex x, y. a*x^2 + a*y^2 < 1 and a*x + b*y >= c",
            "ex x. a*x^2 - a^2 - b^2 < 0 and x >= c",
            sphere("a*x^2 + a*y^2"),
        ),
        ("ex x, y. x^2 + x*y + y^2 < 1 and a*x + b*y >= c", "ex x. x >= c", sphere("x^2 + x*y + y^2")),
    ],
}


@each(*rows(TRUE_STEPS))
def test_a_true_step_is_one_of_the_kernel_and_no_other(rule: str, before: Any, after: Any, evidence: Any) -> None:
    assert is_a_step_and_no_other_is(rule, before, after, evidence)


@each(*rows(FALSE_STEPS))
def test_a_false_step_is_none(rule: str, before: Any, after: Any, evidence: Any) -> None:
    assert refused(rule, before, after, evidence)


@each(
    (SHIFT, "ex x. x^2 = a and x < 0", "ex x. x >= 0 and x = a and x < 0", exponent(2)),
    (SCALING, "ex x, y. x*y > 0 and x^2 > y^2", "ex y. y > 0 and 1 > y^2", scaled([1], "x", *XY)),
)
def test_a_sign_that_is_known_outside_is_one_of_another_variable(rule: str, before: str, after: str, by: Any) -> None:
    assert refused(rule, before, after, by, given="x > 0")
