"""Infix printing: the order of terms, signs, and brackets."""

from __future__ import annotations

from dataclasses import replace

from hypothesis import given

from qe.exact.ring import Poly, Ring
from qe.formula.notation import Level, bracketed, chain, monomials, oriented, polynomial, positive
from qe.formula.relation import Relation
from qe.formula.text import TEXT, text_notation
from qe.io.text import read
from tests.strategies import polynomials
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
    both = "x > 0 and (y > 0 or x - 1 = 0) and ex z. x - z < 0"
    assert chain(PARTS, Level.AND, Level.OPEN, True, TEXT) == both
    assert chain(PARTS, Level.AND, Level.OR, True, TEXT) == both
    assert chain(PARTS, Level.AND, Level.OR, True, strict) == f"({both})"
    assert chain(PARTS, Level.AND, Level.AND, True, TEXT) == f"({both})"
    closed = "x > 0 and (y > 0 or x - 1 = 0) and (ex z. x - z < 0)"
    assert chain(PARTS, Level.AND, Level.OPEN, False, TEXT) == closed
    assert chain(PARTS[:2], Level.OR, Level.OPEN, True, TEXT) == "x > 0 or (y > 0 or x - 1 = 0)"
    assert chain(PARTS, Level.OR, Level.AND, False, TEXT).endswith("or ex z. x - z < 0)")
    assert bracketed(PARTS[1], ("[", "]"), TEXT) == "[y > 0 or x - 1 = 0]"


def test_names_like_constants_are_quoted_where_they_are_free() -> None:
    assert text_notation(["x"]) is TEXT
    assert text_notation(["pi", "x"]).name("pi") == "`pi`" and text_notation(["pi"]).name("x") == "x"
    assert TEXT.quantifier(True, ("x", "two words")) == "all x, `two words`. "
    assert TEXT.quantifier(False, ("x",)) == "ex x. "
    assert TEXT.root("x", Relation.LE, Y - X**2, -1) == "x <= root(-1, x^2 - y)"
