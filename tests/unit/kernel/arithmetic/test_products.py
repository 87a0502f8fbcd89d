"""Products of listed factors: trial division, signs with unknown factors, and which lists are refused."""

from __future__ import annotations

from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.errors import CertificateRejected
from qe.exact.ring import Poly, Ring
from qe.kernel.arithmetic.products import FactorLists, Product, check_lists, possible_signs, sign

RING = Ring.of(("x", "y"))
X, Y = RING.gen(0), RING.gen(1)
LISTS = ((X, X**2 - 2, X + 7), (Y - X, Y**2 + X, X * Y + 1))


@given(
    st.lists(st.tuples(st.integers(0, 1), st.integers(0, 2), st.integers(1, 3)), max_size=4),
    st.integers(-6, 6).filter(bool),
)
def test_products_are_taken_apart(powers, constant):
    poly, wanted = RING.constant(constant), {}
    for level, index, exponent in powers:
        poly = poly * LISTS[level][index] ** exponent
        wanted[level, index] = wanted.get((level, index), 0) + exponent
    found = FactorLists(RING, LISTS).decompose(poly)
    assert found is not None and found.unit == (1 if constant > 0 else -1)
    assert {(i, j): e for i, j, e in found.powers} == wanted


@pytest.mark.parametrize("poly", [Y, X + 1, X**2 - 3, (Y - X) * (Y + X), X**2 + 2])
def test_what_is_left_over_is_seen(poly: Poly) -> None:
    lists = FactorLists(RING, LISTS)
    assert lists.decompose(poly) is None and lists.decompose(poly) is None
    assert lists.decompose(RING.constant(0)) == Product(0, ())


SIGNS = st.sampled_from((-1, 0, 1, None))


@given(
    st.sampled_from((-1, 1)),
    st.lists(st.tuples(st.integers(0, 1), st.integers(0, 2), st.integers(1, 3)), max_size=4, unique_by=lambda p: p[:2]),
    st.lists(SIGNS, min_size=6, max_size=6),
    st.integers(0, 2),
)
def test_signs_by_definition(unit, powers, values, depth):
    """All values of the unknown signs are tried."""
    table = [values[:3], values[3:]][:depth]
    known = {(k, j): s for k, row in enumerate(table) for j, s in enumerate(row)}
    unknown = [p[:2] for p in powers if known.get(p[:2]) is None]
    possible = set()
    for chosen in product((-1, 0, 1), repeat=len(unknown)):
        all_signs = {**known, **dict(zip(unknown, chosen, strict=True))}
        result = unit
        for level, index, exponent in powers:
            result *= all_signs[level, index] ** exponent
        possible.add(result)
    found = Product(unit, tuple(powers))
    assert possible_signs(found, table) == possible
    assert sign(found, table) == (next(iter(possible)) if not unknown or possible == {0} else None)


def test_lists_are_checked() -> None:
    check_lists(RING, LISTS)
    other = Ring.of(("x", "y", "z"))
    for wrong, reason in (
        (LISTS[:1], "expected 2 lists"),
        (((X, X), LISTS[1]), "listed twice"),
        (((X, Y), LISTS[1]), "main variable is not x"),
        (((2 * X,), LISTS[1]), "not primitive"),
        (((-X,), LISTS[1]), "not primitive"),
        (((other.gen(0),), LISTS[1]), "another ring"),
    ):
        with pytest.raises(CertificateRejected, match=reason):
            check_lists(RING, wrong)


@pytest.mark.parametrize("unit", [-1, 1])
@pytest.mark.parametrize("exponents", [(1, 1), (1, 2), (2, 1), (3, 2), (2, 2)])
def test_signs_of_two_known_factors(unit: int, exponents: tuple[int, int]) -> None:
    found = Product(unit, ((0, 0, exponents[0]), (1, 0, exponents[1])))
    for s, t in product((-1, 0, 1), repeat=2):
        wanted = unit * s ** exponents[0] * t ** exponents[1]
        assert sign(found, [[s], [t]]) == wanted and possible_signs(found, [[s], [t]]) == {wanted}


def test_signs_of_powers_of_an_unknown_factor() -> None:
    for exponent, known in ((2, {0, 1}), (1, {-1, 0, 1}), (3, {-1, 0, 1})):
        found = Product(1, ((0, 0, exponent), (1, 0, 1)))
        assert possible_signs(found, [[None], [1]]) == known
        assert possible_signs(found, [[None], [-1]]) == {-s for s in known}
        assert sign(found, [[None], [1]]) is None and sign(found, [[None], [0]]) == 0
