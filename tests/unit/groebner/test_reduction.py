"""Division by elements whose leading coefficients are parameters: the identity that it promises, term by term."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from qe.exact.block_order import BlockOrder
from qe.exact.groebner import MonomialOrder, groebner_basis
from qe.exact.ring import Poly, Ring
from qe.groebner.reduction import Divisor, cleared, divides, joined, monomial, reduced_basis, remainder
from tests.strategies import polynomials
from tests.tables import each
from tests.unit.exact.ideal_membership import in_ideal

RING = Ring.of(("a", "b", "x", "y"))
A, B, X, Y = (RING.var(name) for name in RING.names)
BLOCK = BlockOrder((2, 3), (0, 1))


@given(polynomials(RING, max_degree=3))
def test_a_polynomial_is_its_terms(poly: Poly) -> None:
    terms = BLOCK.terms(poly)
    assert joined(terms, BLOCK, RING) == poly
    assert [BLOCK.order.key(e) for e in terms] == sorted(map(BLOCK.order.key, terms), reverse=True)
    if poly:
        divisor = Divisor(poly, BLOCK)
        assert divisor.lead == BLOCK.lead(poly)
        assert joined(dict([divisor.lead, *divisor.tail]), BLOCK, RING) == poly


def test_monomials() -> None:
    assert monomial(BLOCK, (2, 1), A + 1) == (A + 1) * X**2 * Y
    assert divides((1, 0), (1, 3)) and divides((0, 0), (0, 0)) and not divides((1, 1), (2, 0))


@given(polynomials(RING, max_degree=3), polynomials(RING, max_degree=2), polynomials(RING, max_degree=2))
def test_the_remainder_differs_by_a_combination(poly: Poly, one: Poly, other: Poly) -> None:
    divisors = [Divisor(p, BLOCK) for p in (one, other) if p and not BLOCK.is_free(p)]
    scale, rest = remainder(poly, divisors, BLOCK, None)
    assert BLOCK.is_free(scale) and scale
    assert not divisors or in_ideal(scale * poly - rest, [d.poly for d in divisors])
    assert divisors or (scale, rest) == (RING.constant(1), poly)
    for exponents in BLOCK.terms(rest):
        assert not any(divides(d.lead[0], exponents) for d in divisors)


def test_scales_are_as_small_as_the_coefficients_allow() -> None:
    assert remainder(A * X, [Divisor(A * X - B, BLOCK)], BLOCK, None) == (RING.constant(1), B)
    assert remainder(X, [Divisor(A * X - B, BLOCK)], BLOCK, None) == (A, B)
    assert remainder(A * X, [Divisor(A**2 * X - B, BLOCK)], BLOCK, None) == (A, B)
    assert remainder(X**2, [Divisor(A * X - B, BLOCK)], BLOCK, None) == (A**2, B**2)
    assert remainder(X - Y, [Divisor(X - Y, BLOCK)], BLOCK, None) == (RING.constant(1), RING.constant(0))


def test_coefficients_are_reduced_where_the_segment_has_equations() -> None:
    base = groebner_basis([A**2 - B], variables=(2, 3, 0, 1))
    assert base is not None
    scale, rest = remainder(A**2 * Y, [Divisor(X - A, BLOCK)], BLOCK, base)
    assert (scale, rest) == (RING.constant(1), B * Y)
    assert remainder(A**2 * X - A * B, [Divisor(X - A, BLOCK)], BLOCK, base)[1] == RING.constant(0)


@each(
    (A * X + A * B, X + B),
    (-2 * A * X - 2 * A, X + 1),
    (A * X + B, A * X + B),
    ((A + B) * X**2 + (A**2 - B**2) * Y, X**2 + (A - B) * Y),
    (6 * X, X),
)
def test_content_is_divided_out(poly: Poly, expected: Poly) -> None:
    assert cleared(poly, BLOCK) == expected.normal()[1]


def test_a_reduced_basis() -> None:
    found = reduced_basis([X * Y + A * X + X, Y - B, X**2 - Y], BLOCK, None)
    assert found[0] == Y - B or found[0] == (Y - B).normal()[1]
    leads = [BLOCK.lead(p)[0] for p in found]
    assert leads == sorted(leads, key=BLOCK.order.key)
    for k, p in enumerate(found):
        others = [Divisor(q, BLOCK) for i, q in enumerate(found) if i < k]
        assert not any(divides(d.lead[0], e) for d in others for e in list(BLOCK.terms(p))[1:])


@given(st.sampled_from(tuple(MonomialOrder)))
def test_the_lead_follows_the_order(order: MonomialOrder) -> None:
    block = BlockOrder((2, 3), (0, 1), order)
    expected = (1, 0) if order is MonomialOrder.LEX else (0, 2)
    assert Divisor(A * X + B * Y**2, block).lead[0] == expected
