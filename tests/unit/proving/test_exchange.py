"""Rule "two variables exchanged": what stands for conditions that change with the variables, by their relation."""

from tests.tables import each
from tests.unit.proving.elaborated import refused

REAL = "x^2 - 4*y >= 0"
"""There are numbers with the sum x and the product y."""


def said(before: str, after: str) -> str:
    sides = f"ex x, y. {before}", f"ex x, y. {REAL} and {after}"
    return refused("two variables exchanged", *sides, {"variables": ["x", "y"]})


@each(
    ("x > 1 and y > 1", "x > 2 and y - x + 1 > 0"),
    ("x >= 1 and y >= 1", "x >= 2 and y - x + 1 >= 0"),
    ("x < 1 and y < 1", "x < 2 and y - x + 1 > 0"),
    ("x <= 1 and y <= 1", "x <= 2 and y - x + 1 >= 0"),
    ("x = 1 and y = 1", "x = 2 and y - x + 1 = 0"),
    ("x /= 1 and y /= 1", "y - x + 1 /= 0"),
)
def test_two_conditions_by_their_sum_and_product(pair: str, together: str) -> None:
    assert not said(f"x*y = a and {pair}", f"y = a and {together}")
    for part in together.split(" and "):
        assert said(f"x*y = a and {pair}", f"y = a and {together.replace(part, 'true')}")


@each(
    ("x /= 1 and y /= 1", "x /= 2 and y - x + 1 /= 0"),
    ("x > 1 and y > 1", "x > 2 and y - x + 1 >= 0"),
    ("x >= 1 and y >= 1", "x >= 2 and y - x + 1 > 0"),
    ("x < 1 and y < 1", "x < 2 and y - x + 1 < 0"),
)
def test_with_another_relation_they_are_refused(pair: str, together: str) -> None:
    assert said(f"x*y = a and {pair}", f"y = a and {together}")


@each("=", "/=")
def test_a_difference_is_zero_iff_its_square_is(relation: str) -> None:
    assert not said(f"x*y = a and x - y {relation} 0", f"y = a and x^2 - 4*y {relation} 0")


@each(">", ">=")
def test_the_square_of_a_difference_does_not_tell_its_sign(relation: str) -> None:
    """x > y and y^3 > x^3 have no solution, but both squares are positive wherever x and y differ."""
    before = f"x*y = a and x - y {relation} 0 and y^3 - x^3 {relation} 0"
    after = f"y = a and x^2 - 4*y {relation} 0 and (x^2 - 4*y)*(x^2 - y)^2 {relation} 0"
    assert said(before, after)


@each("x*y = a and x > 1", "x*y = a and x > 1 and y > 2", "x*y = a and (x > 1 or y > 2)")
def test_a_condition_on_one_of_them_is_refused(before: str) -> None:
    assert said(before, "y = a and x > 2")
