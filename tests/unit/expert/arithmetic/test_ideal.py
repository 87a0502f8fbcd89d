"""The checker's Gröbner bases and signatures, against those of the producers."""

from __future__ import annotations

import pytest
from flint import fmpq, fmpq_mat
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.errors import Unable
from qe.exact import quotient
from qe.exact.groebner import Limits, groebner_basis
from qe.exact.ring import Poly, Ring
from qe.expert.arithmetic.ideal import Ideal, TraceForms, product, signature, terms_of
from tests.unit.exact.famous_systems import katsura

RING = Ring.of(("y", "x"))
y, x = RING.gen(0), RING.gen(1)


def nothing() -> None:
    """No limit."""


def ideal(*polys: Poly, weights: tuple[int, int] = (1, 1)) -> Ideal:
    return Ideal([terms_of(p) for p in polys], weights, nothing)


@given(st.integers(1, 5), st.data())
def test_signatures_of_symmetric_matrices(size: int, data: st.DataObject) -> None:
    numbers = data.draw(st.lists(st.integers(-2, 2), min_size=size * size, max_size=size * size))
    rows = [[fmpq(numbers[min(i, j) * size + max(i, j)]) for j in range(size)] for i in range(size)]
    expected = quotient.signature(fmpq_mat(size, size, [c for row in rows for c in row]))
    assert signature(rows, nothing) == expected


POLYS = st.dictionaries(st.tuples(*(st.integers(0, 3),) * 2), st.integers(-3, 3).filter(bool), min_size=1, max_size=4)


@settings(max_examples=50)
@given(st.lists(POLYS, min_size=1, max_size=3), st.tuples(st.integers(1, 4), st.integers(1, 4)), POLYS)
def test_the_same_ideals(polys: list[dict[tuple[int, int], int]], weights: tuple[int, int], other: dict) -> None:  # type: ignore[type-arg]
    given_ = [RING.from_terms(p) for p in polys]
    theirs = groebner_basis(given_, variables=(0, 1), weights=weights, limits=Limits(600, 4000, 40_000))
    assert theirs is not None
    ours = ideal(*given_, weights=weights)
    found = theirs.polys
    assert all(not ours.remainder(terms_of(p)) for p in found)
    third = RING.from_terms(other)
    assert (not ours.remainder(terms_of(third))) == theirs.contains(third)
    assert ours.is_finite == (quotient.dimension(theirs) <= 0)
    if ours.is_finite:
        size = quotient.Quotient(theirs).size
        assert len(ours.monomials()) == size
        if 0 < size < 10:
            exact = quotient.Quotient(theirs)
            assert TraceForms(ours).signature(terms_of(third)) == exact.signature(third)


def test_the_empty_set_and_the_whole_space() -> None:
    assert ideal(x - 1, x - 2).monomials() == [] and ideal(x - 1, x - 2).is_finite
    assert not ideal().is_finite and not ideal(x * y).is_finite
    assert TraceForms(ideal(x, x - 1)).signature(terms_of(x)) == 0


def test_products() -> None:
    assert product(terms_of(x + y), terms_of(x - y)) == terms_of(x**2 - y**2)


def test_a_long_basis_ends_at_the_limits(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("qe.expert.arithmetic.ideal.MOST_ELEMENTS", 5)
    ring = Ring.of(tuple(f"u{k}" for k in range(4)))
    with pytest.raises(Unable, match="limits of the checker"):
        Ideal([terms_of(ring.from_terms(p)) for p in katsura(3)], (1,) * 4, nothing)
