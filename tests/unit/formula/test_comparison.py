"""Comparisons as people write them."""

from hypothesis import given
from hypothesis import strategies as st

import qe
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, convert
from qe.formula.relation import Relation
from qe.formula.syntax import Atom
from qe.io.text import read
from tests.strategies import RELATIONS, polynomials
from tests.tables import each

RING = Ring.of(("x", "y"))
X, Y = RING.var("x"), RING.var("y")


@each(
    ("a*(a - b) > 0", "a*(a - b) > 0"),
    ("x^2*y - x*y >= 0", "x*y*(x - 1) >= 0"),
    ("(1 - x)*(x - 2)*(y - 3) < 0", "(x - 1)*(x - 2)*(y - 3) > 0"),
    ("(1 - x)*(x - 2)*(3 - y) < 0", "(x - 1)*(x - 2)*(y - 3) < 0"),
    ("(x + y)*(y - x) > 0", "x^2 < y^2"),
    ("x^2*y > 0 and y*(x - 1)^2*(y + x^2)^3 > 0", "x^2*y > 0 and y*(x - 1)^2*(x^2 + y)^3 > 0"),
    ("x^2 - x < 0", "x^2 - x < 0"),  # the product is longer
    ("x^41 - x^40 < 0", "x^41 - x^40 < 0"),
)
def test_products_that_are_no_longer(given_text: str, printed: str) -> None:
    assert str(read(given_text)) == printed


def test_a_product_with_a_negative_leading_coefficient_turns_the_relation() -> None:
    assert str(Atom(-(X - 1) * (Y - 1), Relation.GT)) == "(x - 1)*(y - 1) < 0"


@given(polynomials(RING), polynomials(RING), RELATIONS)
def test_products_are_read_back_as_they_were(f: Poly, g: Poly, relation: Relation) -> None:
    formula = atom(f * g, relation)
    assert convert(read(str(formula)), RING) == formula


@each(
    ("x - 2 >= 0", "x >= 2"),
    ("5*x + 4 = 0", "x = -4/5"),
    ("0 < -x - 3", "x < -3"),
    ("a + c - 1 <= 0", "a + c <= 1"),
    ("a - c - 1 <= 0", "a <= c + 1"),
    ("x - y /= 0", "x /= y"),
    ("r + s + 1 = 0", "r + s + 1 = 0"),
    ("x^2 + y^2 - 1 <= 0", "x^2 + y^2 <= 1"),
    ("4*x^2 - 27 <= 0", "4*x^2 <= 27"),
    ("x^2 + 2*x - 1 <= 0", "x^2 + 2*x - 1 <= 0"),
    ("x^2 - y >= 0", "y <= x^2"),
    ("x*y - z < 0", "z > x*y"),
    ("x^2 - 4*a*c >= 0", "x^2 - 4*a*c >= 0"),
    ("x*y - z*a > 0", "x*y - z*a > 0"),
    ("`pi` - 3 > 0 and x - 1/10^30 = 0", f"`pi` > 3 and x = 1/{10**30}"),
)
def test_the_sides_of_comparisons(given_text: str, printed: str) -> None:
    assert str(read(given_text)) == printed and qe.equivalent(given_text, printed)


@given(polynomials(RING), st.sampled_from(Relation))
def test_both_sides_mean_the_same(poly: Poly, relation: Relation) -> None:
    if poly.is_constant:
        return
    stated = convert(read(str(Atom(poly, relation))), RING)
    assert isinstance(stated, Atom)
    (unit, primitive), (other, same) = poly.normal(), stated.poly.normal()
    assert same == primitive and stated.relation is (relation if (unit > 0) == (other > 0) else relation.flipped)
