"""Notes on what may have been meant otherwise: which there are, and that they never change with the rest."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from qe.formula.doubts import doubts, numbers_as_names
from qe.formula.syntax import Exists, ForAll
from qe.formula.traverse import subformulas
from qe.io import formats
from qe.spelling import glued, joined_names
from tests.strategies import formulas


def noted(text: str, format: str = "text") -> tuple[str, ...]:
    return doubts(formats.read(text, format), text, format)


def test_each_name_is_noted_once() -> None:
    text = "(ex x. ax^2 > 0) and (all y. bcy > c and cy < y) and (ex x. 2*ax**3 < c)"
    assert noted(text) == (
        "x does not occur; did you mean a*x^2?",
        "bcy is one name; a product is written b*c*y",
        "cy is one name; a product is written c*y",
    )
    assert doubts(formats.read(text)) == ("x does not occur",)  # no text: nobody has typed it


def test_a_variable_to_solve_for_is_to_occur() -> None:
    """ ``solve("ax^2 + bx + c = 0", "x")`` was c = -ax^2 - bx, without a word."""
    text = "ax^2 + bx + c = 0"
    assert doubts(formats.read(text), text, "text", ("x",)) == ("x does not occur; did you mean a*x^2?",)
    assert doubts(formats.read(text), "", "", ("x", "c")) == ("x does not occur",)
    assert doubts(formats.read("x*0 = y"), "x*0 = y", "text", ("x", "y")) == ()  # typed, and simplified away


def test_products_are_letters_side_by_side() -> None:
    assert joined_names(("ax", "xa", "abx", "aax", "x1", "x_a", "tax", "xx"), ("x",)) == {
        "ax": "a*x",
        "xa": "x*a",
        "xx": "x*x",
    }
    assert joined_names(("a", "abx", "tax"), ("x",)) == {"abx": "a*b*x", "tax": "t*a*x"}
    assert joined_names(("ax",), ("x", "ax")) == {} and glued(("ax",), "y") == ""


def test_letters_beside_their_neighbours_are_no_numbers() -> None:
    assert numbers_as_names(("e", "i"), "e*x = i") == ("e and i are variables here, no numbers",)
    assert numbers_as_names(("d", "e"), "d*x = e") == numbers_as_names(("e",), "`e` = 1") == ()
    assert numbers_as_names(("e",), r"\frac{1}{e} = 1") == numbers_as_names(("e",), "") == ()


@given(formulas())
def test_exactly_the_idle_variables_are_noted(formula) -> None:
    """The class of ``ex x. ax^2 + bx + c = 0``: what is noted of a formula without a text is what its blocks say."""
    blocks = [f for f in subformulas(formula) if isinstance(f, Exists | ForAll)]
    idle = {name for block in blocks for name in block.variables if name not in block.body.free}
    assert {*doubts(formula)} == {f"{name} does not occur" for name in idle}


@given(st.sampled_from("abcd"), st.sampled_from("xyz"), st.integers(2, 9))
def test_the_product_that_may_be_meant(letter: str, variable: str, power: int) -> None:
    note = f"{variable} does not occur; did you mean {letter}*{variable}^{power}?"
    assert noted(f"ex {variable}. {letter}{variable}^{power} + 1 = 0") == (note,)
    assert noted(f"ex {variable}. {letter}*{variable}^{power} + 1 = 0") == ()
