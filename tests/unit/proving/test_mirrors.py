"""Rule "mirror images of a convex set": which bodies are convex by their form, written by hand."""

from tests.tables import each
from tests.unit.proving.elaborated import refused

RULE = "mirror images of a convex set"

NEGATED = {"mirror": [["x", "x", -1]]}
SPAN = "x < b and -x < b"


def said(before: str, after: str) -> str:
    return refused(RULE, before, after, NEGATED)


@each(
    (f"ex x. {SPAN}", "0 < b"),
    (f"ex x. {SPAN} and (a > 0 or c^2 = 2)", "0 < b and (a > 0 or c^2 = 2)"),
    (f"ex x. {SPAN} and (ex y. y^2 = a)", "0 < b and (ex y. y^2 = a)"),
    (f"ex x. {SPAN} and (ex y. x + y < 1 and -x + y < 1)", "0 < b and (ex y. y < 1)"),
    ("ex x. a > 0 or x < b and -x < b", "a > 0 or 0 < b"),
    (f"ex x. all y. y*x < b and -y*x < b or y^2 > {1}", "all y. 0 < b or y^2 > 1"),
)
def test_convex_bodies(before: str, after: str) -> None:
    assert not said(before, after)


@each(
    ("ex x. x /= 0", "0 /= 0"),
    ("ex x. x > 1 or x < -1", "0 > 1 or 0 < -1"),
    ("ex x. x^2 > b", "0 > b"),
    ("ex x. (ex y. x*y > 1 and y > 0 or x*y < -1 and y > 0)", "false"),
    ("ex x. (ex y. x*y > 1 and x + y > 1) or (ex z. -x*z > 1 and -x + z > 1)", "false"),
    ("ex x. not (x < 1 and -x < 1)", "not (0 < 1 and 0 < 1)"),
    ("ex x. a > 1 or not (x < 1 and -x < 1)", "a > 1 or not (0 < 1 and 0 < 1)"),
    ("ex x. a > 1 or x > root(1, x^3 - b) or x < root(1, x^3 + b)", "a > 1"),  # its variables are not looked for
)
def test_bodies_that_are_not_seen_to_be_convex(before: str, after: str) -> None:
    assert said(before, after)


def test_nothing_but_the_block_at_the_fixed_points() -> None:
    for after in ("0 <= b", "0 < b and a > 0", "ex x. x < b", "true"):
        assert said(f"ex x. {SPAN}", after)
