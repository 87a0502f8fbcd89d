"""Formulas as text: how they are printed, what may have been meant otherwise, what they are made of."""

from dataclasses import replace

from hypothesis import given
from hypothesis import strategies as st

from qe.exact.ring import Poly, Ring
from qe.formula.doubts import doubts, numbers_as_names
from qe.formula.notation import Level, bracketed, chain, monomials, oriented, polynomial, positive
from qe.formula.relation import Relation
from qe.formula.syntax import Exists, ForAll
from qe.formula.text import TEXT, text_notation
from qe.formula.traverse import subformulas
from qe.io import formats
from qe.io.text import read, understood
from tests.strategies import formulas, polynomials
from tests.tables import each

RING = Ring.of(("x", "y"))
X, Y = RING.var("x"), RING.var("y")


@each(
    (X * Y - X**2 + 1, "-x^2 + x*y + 1"),
    (3 * Y - 2, "3*y - 2"),
    (RING.constant(0), "0"),
    (RING.constant(-1), "-1"),
    (-X, "-x"),
    (Y**3 + X**2 * Y, "x^2*y + y^3"),
    (10**30 * X - 1, f"{10**30}*x - 1"),
)
def test_polynomials(poly: Poly, text: str) -> None:
    assert polynomial(monomials(poly), TEXT) == text


@given(polynomials(RING))
def test_the_first_coefficient_becomes_positive(poly: Poly) -> None:
    if not poly:
        return
    assert {powers: c for c, powers in monomials(poly)} == {
        tuple((RING.names[i], k) for i, k in enumerate(e) if k): c for e, c in poly.terms()
    }
    for relation in Relation:
        parts, found = oriented(poly, relation)
        assert parts[0][0] > 0 and parts == positive(poly)
        assert found is (relation if monomials(poly)[0][0] > 0 else relation.flipped)
    degrees = [sum(k for _, k in powers) for _, powers in monomials(poly)]
    assert degrees == sorted(degrees, reverse=True)


PARTS = (read("x > 0"), read("y > 0 or x = 1"), read("ex z. z > x"))


def test_chains_are_bracketed_where_they_must_be() -> None:
    strict = replace(TEXT, strict=True)
    both = "x > 0 and (y > 0 or x = 1) and ex z. x < z"
    assert chain(PARTS, Level.AND, Level.OPEN, True, TEXT) == both
    assert chain(PARTS, Level.AND, Level.OR, True, TEXT) == both
    assert chain(PARTS, Level.AND, Level.OR, True, strict) == f"({both})"
    assert chain(PARTS, Level.AND, Level.AND, True, TEXT) == f"({both})"
    closed = "x > 0 and (y > 0 or x = 1) and (ex z. x < z)"
    assert chain(PARTS, Level.AND, Level.OPEN, False, TEXT) == closed
    assert chain(PARTS[:2], Level.OR, Level.OPEN, True, TEXT) == "x > 0 or (y > 0 or x = 1)"
    assert chain(PARTS, Level.OR, Level.AND, False, TEXT).endswith("or ex z. x < z)")
    assert bracketed(PARTS[1], ("[", "]"), TEXT) == "[y > 0 or x = 1]"


def test_names_like_constants_are_quoted_where_they_are_free() -> None:
    assert text_notation(["x"]) is TEXT
    assert text_notation(["pi", "x"]).name("pi") == "`pi`" and text_notation(["pi"]).name("x") == "x"
    assert TEXT.quantifier(True, ("x", "two words")) == "all x, `two words`. "
    assert TEXT.quantifier(False, ("x",)) == "ex x. "
    assert TEXT.root("x", Relation.LE, Y - X**2, -1) == "x <= root(-1, x^2 - y)"


def noted(text: str, format: str = "text") -> tuple[str, ...]:
    return doubts(formats.read(text, format), text, format)


def test_each_name_is_noted_once() -> None:
    text = "(ex x. ax^2 > 0) and (all y. bcy > c and cy < y) and (ex x. 2*ax**3 < c)"
    assert noted(text) == (
        "x does not occur; did you mean a*x?",
        "bcy is one name; a product is written b*c*y",
        "cy is one name; a product is written c*y",
    )
    assert doubts(formats.read(text)) == ("x does not occur",)  # no text: nobody has typed it


def test_a_variable_to_solve_for_is_to_occur() -> None:
    """``solve("ax^2 + bx + c = 0", "x")`` was c = -ax^2 - bx, without a word."""
    text = "ax^2 + bx + c = 0"
    assert doubts(formats.read(text), text, "text", ("x",)) == ("x does not occur; did you mean a*x?",)
    assert doubts(formats.read(text), "", "", ("x", "c")) == ("x does not occur",)
    assert doubts(formats.read("x*0 = y"), "x*0 = y", "text", ("x", "y")) == ()  # typed, and simplified away


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
    note = f"{letter}{variable} is read as the product {letter}*{variable}"
    assert understood(typed := f"ex {variable}. {letter}{variable}^{power} + 1 = 0") == (typed, (note,))
    assert noted(typed) == ()
    assert noted(f"ex {variable}. {letter}*{variable}^{power} + 1 = 0") == ()
