"""Packed monomials: products, order, divisibility, least common multiples."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.errors import Unable
from qe.exact.groebner import MonomialOrder
from qe.exact.packed import PackedMonomials

MONOMIALS = PackedMonomials(4, 12)
EXPONENTS = st.tuples(*(st.integers(0, 9),) * 4)
packed = MONOMIALS.packed


@given(EXPONENTS, EXPONENTS)
def test_integers_behave_as_the_monomials_do(a: tuple[int, ...], b: tuple[int, ...]) -> None:
    key = MonomialOrder.DEGREVLEX.key
    assert MONOMIALS.exponents(packed(a)) == a and MONOMIALS.degree(packed(a)) == sum(a)
    assert packed(a) + packed(b) == packed([i + j for i, j in zip(a, b, strict=True)])
    assert (packed(a) < packed(b)) == (key(a) < key(b))
    assert MONOMIALS.exponents(MONOMIALS.lcm(packed(a), packed(b))) == tuple(map(max, a, b))
    divides = all(i <= j for i, j in zip(a, b, strict=True))
    assert MONOMIALS.divides(MONOMIALS.fields(packed(a)), MONOMIALS.fields(packed(b))) == divides
    assert MONOMIALS.are_coprime(packed(a), packed(b)) == (not any(i and j for i, j in zip(a, b, strict=True)))


def test_a_degree_that_does_not_fit() -> None:
    assert packed((1023, 0, 0, 0))
    with pytest.raises(Unable):
        packed((1000, 0, 0, 24))
