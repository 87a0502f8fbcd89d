"""A change of variables: its image says what the formula says at the values, and the way back gives these."""

from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from qe.formula.evaluate import holds_at
from qe.formula.syntax import Exists
from qe.io.text import read
from qe.rules.change import Change

FORMULA = read("x^2*y - z > 1 and (x < y or x*z = 2) and not z^2 - x*y <= 0")
small = st.integers(-3, 3)


@given(small, small, st.integers(-2, 2), st.booleans())
def test_the_image_says_what_the_formula_says_at_the_values(y: int, z: int, number: int, mirrored: bool) -> None:
    ring = FORMULA.ring
    assert ring is not None
    change = Change({"x": ring.var("y") * number}) if mirrored else Change.to_number("x", number, ring)
    image, at = change.image(FORMULA), {"y": Fraction(y), "z": Fraction(z)}
    (lift,) = change.lifts
    x = lift.value(at)
    assert isinstance(x, Fraction) and x == (y * number if mirrored else number)
    assert "x" not in image.free
    assert holds_at(image, at) is holds_at(FORMULA, {**at, "x": x})


def test_the_node_is_the_block_at_the_values() -> None:
    ring = FORMULA.ring
    assert ring is not None
    node = Change.to_number("x", 2, ring).node(("x", "z"), FORMULA)
    assert isinstance(node.formula, Exists) and node.formula.variables == ("z",)
    assert node.formula.body == Change.to_number("x", 2, ring).image(FORMULA)
    assert node.lift({"z": Fraction(1), "y": Fraction(1)})["x"] == 2


def test_inner_blocks_are_changed_too() -> None:
    formula = read("(ex u. u^2 < x) and x > y")
    assert formula.ring is not None
    assert str(Change.to_number("x", 4, formula.ring).image(formula)) == "(ex u. u^2 < 4) and y < 4"
