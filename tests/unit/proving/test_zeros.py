"""Rule "conditions on zeros that follow": what the others imply may go, and nothing that they only seem to imply."""

from tests.tables import each
from tests.unit.proving.elaborated import refused

RULE = "conditions on zeros that follow"

NOT_BOTH = "(x /= 0 or y /= 0)"


@each(
    "x*y + 2 < 0",
    "x*y - 2 > 0",
    "x^2 + y^2 /= 0",
    "(x*y - 2 > 0 or x /= 0)",
    "(x*y - 2 > 0 and z > 0)",
)
def test_what_the_others_imply_may_go(kept: str) -> None:
    assert not refused(RULE, f"ex x, y. {NOT_BOTH} and {kept}", f"ex x, y. {kept}")


@each(
    "x*y + 2 > 0",
    "x*y - 2 < 0",
    "x*y + 2 >= 0",
    "x^2 + y^2 = 0",
    "x*y + z < 0",
    "x*y + z /= 0",
    "x + z^2 > 0",
    "(x*y - 2 > 0 or z /= 0)",
)
def test_conditions_that_hold_or_may_hold_where_both_are_zero_imply_nothing(kept: str) -> None:
    assert refused(RULE, f"ex x, y. {NOT_BOTH} and {kept}", f"ex x, y. {kept}")


@each(
    ("(x = 0 or y = 0)", "x^2*y^2 <= 0", ""),
    ("(x = 0 or y = 0)", "x^2*y^2 >= 0", "x /= 0, y /= 0"),
    ("(x = 0 or y = 0)", "x^2*y^2 > 0", "x /= 0, y /= 0"),
    ("(x = 0 or y = 0)", "-x^2*y^2 >= 0", ""),
    ("(x = 0 or y = 0)", "x*y^2 <= 0", "x /= 0, y /= 0"),
    ("(x = 0 or y = 0)", "x^2*z^2 <= 0", "x /= 0, y /= 0"),
)
def test_a_power_is_positive_only_where_it_is_even_and_its_variable_is_not_zero(
    gone: str, kept: str, zeros: str
) -> None:
    said = refused(RULE, f"ex x, y. {gone} and {kept}", f"ex x, y. {kept}")
    assert bool(said) is bool(zeros)


def test_dually_what_implies_the_others_may_go() -> None:
    before = "all x, y. x = 0 and y = 0 or x*y + 2 >= 0"
    assert not refused(RULE, before, "all x, y. x*y + 2 >= 0")
    before = "all x, y. x = 0 and y = 0 or x*y + 2 < 0"
    assert refused(RULE, before, "all x, y. x*y + 2 < 0")


@each(
    (f"ex x, y. {NOT_BOTH} and x*y > 2", f"all x, y. {NOT_BOTH} and x*y > 2"),
    (f"ex x, y. {NOT_BOTH} and x*y > 2", "ex x. x*y > 2"),
    (f"ex x, y. {NOT_BOTH} and x*y > 2", "ex x, y. x*y > 2 and x > 0"),
    ("ex x, y. (ex z. x*z /= 0) and x*y > 2", "ex x, y. x*y > 2"),
)
def test_other_steps_are_refused(before: str, after: str) -> None:
    assert refused(RULE, before, after)
