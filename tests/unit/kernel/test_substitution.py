"""Numbers and quotients in place of a variable."""

from __future__ import annotations

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from qe.errors import CertificateRejected
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom
from qe.formula.syntax import TRUE, Formula
from qe.kernel.step import Claim
from qe.kernel.substitution import mapped, quotient
from qe.proof.entry import Entry
from tests.strategies import polynomials
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


def test_quantifiers_and_negations_are_gone_through() -> None:
    def turned(text: str) -> Formula:
        by = {X: -RING.gen(X)}
        return mapped(formula(text), lambda a: atom(a.poly.compose(by), a.relation), (RING.gen(X),), CLAIM)

    given_ = "not (ex y. x + y > 0 and (all z. z*x < 1)) or y = x"
    assert turned(given_) == formula("not (ex y. -x + y > 0 and (all z. -z*x < 1)) or y = -x")
    with pytest.raises(CertificateRejected, match="a quantifier inside binds x"):
        turned("ex x. x > a")
    with pytest.raises(CertificateRejected, match="root atoms"):
        turned("a > root(1, a^2 - b, a)")


def test_every_atom_is_changed() -> None:
    flipped = mapped(formula("x > 0 and (y > 0 or x < 1)"), lambda a: atom(-a.poly, a.relation), (), CLAIM)
    assert flipped == formula("x < 0 and (y < 0 or x > 1)")
    with pytest.raises(CertificateRejected):
        mapped(formula("all y. y > x"), lambda a: a, (RING.var("y"),), CLAIM)


def test_what_a_change_brings_in_is_not_captured() -> None:
    y = RING.var("y")
    with pytest.raises(CertificateRejected, match="brings in"):  # even where the caller has not said that it uses y
        mapped(formula("all y. y > x and x > 0"), lambda a: atom(a.poly + y, a.relation), (), CLAIM)
