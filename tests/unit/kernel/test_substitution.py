"""Numbers and quotients in place of a variable."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from qe.errors import CertificateRejected
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom
from qe.formula.evaluate import holds_at
from qe.formula.syntax import TRUE, Formula, Relation
from qe.kernel.step import Claim
from qe.kernel.substitution import at_number, mapped, quotient
from qe.proof.entry import Entry
from tests.strategies import formulas, polynomials
from tests.unit.certify.claims import RING, formula

CLAIM = Claim("rule", TRUE, TRUE, RING, Entry({}, "evidence"), "step")
X = RING.index["x"]
PLANE = Ring.of(("x", "a"))


LINE = polynomials(Ring.of(("a",))).map(lambda p: p.convert(PLANE))


@given(polynomials(PLANE, max_degree=4), LINE, LINE, st.integers(-3, 3))
def test_a_quotient_times_a_power_of_its_bottom(poly: Poly, top: Poly, bottom: Poly, a: int) -> None:
    """bottom^d * poly(top/bottom), where the bottom is not zero."""
    below = bottom.evaluate((5, a))
    assume(below)
    degree = poly.degree(0)
    found = quotient(poly, 0, top, bottom)
    value = poly.evaluate((top.evaluate((5, a)) / below, a))
    assert found.degree(0) <= 0 and found.evaluate((5, a)) == value * below ** max(degree, 0)


@given(formulas(names=("x", "y"), max_depth=3), st.fractions(-3, 3, max_denominator=5), st.integers(-3, 3))
def test_a_number(given_: Formula, value: Fraction, y: int) -> None:
    over = formula(given_)
    found = at_number(over, X, value, CLAIM)
    everywhere = dict.fromkeys(RING.names, Fraction(0))
    assert "x" not in found.free
    assert holds_at(found, {**everywhere, "y": y}) == holds_at(over, {**everywhere, "x": value, "y": y})


def test_quantifiers_and_negations_are_gone_through() -> None:
    given_ = formula("not (ex y. x + y > 0 and (all z. z*x < 1)) or y = x")
    assert at_number(given_, X, Fraction(2), CLAIM) == formula("not (ex y. 2 + y > 0 and (all z. z*2 < 1)) or y = 2")
    bound = formula("ex x. x > a")
    with pytest.raises(CertificateRejected, match="a quantifier inside binds x"):
        at_number(bound, X, Fraction(2), CLAIM)
    with pytest.raises(CertificateRejected, match="root atoms"):
        at_number(formula("a > root(1, a^2 - b, a)"), X, Fraction(2), CLAIM)


def test_every_atom_is_changed() -> None:
    flipped = mapped(formula("x > 0 and (y > 0 or x < 1)"), lambda a: atom(-a.poly, a.relation), (), CLAIM)
    assert flipped == formula("x < 0 and (y < 0 or x > 1)")
    with pytest.raises(CertificateRejected):
        mapped(formula("all y. y > x"), lambda a: a, (RING.var("y"),), CLAIM)


def test_what_a_change_brings_in_is_not_captured() -> None:
    y = RING.var("y")
    with pytest.raises(CertificateRejected, match="brings in"):  # even where the caller has not said that it uses y
        mapped(formula("all y. y > x and x > 0"), lambda a: atom(a.poly + y, a.relation), (), CLAIM)
    beside = mapped(formula("(all y. y > z) and x > 0"), lambda a: atom(a.poly.compose({X: y}), a.relation), (), CLAIM)
    assert beside == formula("(all y. y > z) and y > 0")


def test_relations_stay() -> None:
    for relation in Relation:
        assert at_number(atom(RING.gen(X) - RING.var("a"), relation), X, Fraction(1, 2), CLAIM) == atom(
            1 - 2 * RING.var("a"), relation
        )
