"""Ideals from a Gröbner basis: in another order, quotients and radicals."""

import pytest
from flint import fmpq, fmpq_mat
from hypothesis import given
from hypothesis import strategies as st

from qe.exact.fglm import changed_order
from qe.exact.groebner import Basis, MonomialOrder, groebner_basis
from qe.exact.ideals import has_zeros
from qe.exact.quotient import PositiveDimensional, Quotient, dimension, independent_sets, signature
from qe.exact.ring import Poly, Ring
from tests.unit.exact.ideal_membership import in_ideal, in_radical

# Change of order.

RING = Ring.of(("z", "y", "x"))
z, y, x = (RING.gen(i) for i in range(3))
SYSTEM = (x**2 + y * z - 2, y**2 - x * z + 1, z**2 - x - y)


@pytest.mark.parametrize("order", list(MonomialOrder))
def test_another_order_as_if_computed_there(order: MonomialOrder) -> None:
    basis = groebner_basis(SYSTEM, variables=(2, 1, 0))
    direct = groebner_basis(SYSTEM, variables=(2, 1, 0), order=order)
    assert basis is not None and direct is not None
    moved = changed_order(basis, order)
    assert set(moved.polys) == set(direct.polys) and set(moved.leads) == set(direct.leads)
    back = changed_order(moved, MonomialOrder.DEGREVLEX)
    assert set(back.polys) == set(basis.polys)
    assert moved.contains(x * SYSTEM[0]) and not moved.contains(x)


def test_other_variables_first() -> None:
    basis = groebner_basis(SYSTEM, variables=(2, 1, 0))
    assert basis is not None
    moved = changed_order(basis, MonomialOrder.LEX, (0, 1, 2))
    (last,) = moved.free_of((0, 1))
    assert last.degree(2) == 8 and moved.contains(last)


def test_the_unit_ideal_and_infinitely_many_zeros() -> None:
    unit = groebner_basis([x, x - 1], variables=(2, 1))
    assert unit is not None and changed_order(unit, MonomialOrder.LEX).is_unit
    curve = groebner_basis([x * y], variables=(2, 1))
    assert curve is not None
    with pytest.raises(PositiveDimensional):
        changed_order(curve, MonomialOrder.LEX)


def test_membership_in_radicals() -> None:
    assert in_radical(x, [x**3]) and not in_ideal(x, [x**3])
    assert in_ideal(x**2 - y**2, [x - y]) and not in_radical(x, [x * y])
    assert has_zeros([x**2 + 1]) and not has_zeros([x**2 + 1, x]) and not has_zeros([x * y], [x, y])
    assert has_zeros([], [x]) and not has_zeros([], [x, x - x])
    assert in_radical(RING.constant(0), []) and not in_radical(x, [])


# Quotients by zero-dimensional ideals: monomials, matrices, traces, signatures; dimensions.


def basis_of(*polys: Poly, order: MonomialOrder = MonomialOrder.DEGREVLEX) -> Basis:
    found = groebner_basis(polys, variables=(2, 1, 0), order=order)
    assert found is not None
    return found


@pytest.mark.parametrize("order", list(MonomialOrder))
def test_matrices_commute_and_satisfy_the_equations(order: MonomialOrder) -> None:
    equations = (x**2 + y * z - 2, y**2 - x * z + 1, z**2 - x - y)
    quotient = Quotient(basis_of(*equations, order=order))
    assert quotient.size == 8
    a, b, c = quotient.matrices
    assert a * b == b * a and a * c == c * a and b * c == c * b
    for p in equations:
        assert quotient.matrix(p) == fmpq_mat(8, 8)
    assert quotient.matrix(x * y + 3 * z) == a * b + c * fmpq(3)


def test_signatures_count_signs_at_real_zeros() -> None:
    quotient = Quotient(basis_of((x - 1) * (x - 2) * (x + 3) * (x**2 + 1), y - x**2, z))
    assert quotient.distinct == 5 and quotient.signature() == 3
    assert quotient.signature(x) == 1
    assert quotient.signature(y - 4) == 0 - 1 + 1  # -3 at 1, 0 at 2, 5 at -3
    assert quotient.signature(x - 1) == 0


def test_multiplicities_do_not_count_twice() -> None:
    quotient = Quotient(basis_of((x - 1) ** 3, y**2, z - x))
    assert quotient.size == 6 and quotient.distinct == 1 and quotient.signature() == 1
    assert quotient.signature(-x) == -1


def test_everything_is_in_the_unit_ideal() -> None:
    unit = basis_of(x, x - 1)
    assert unit.is_unit and unit.contains(y + 3) and unit.contains(RING.constant(1))


def test_dimensions() -> None:
    assert dimension(basis_of(x * y, x * z)) == 2
    assert dimension(basis_of(x * y - 1, z)) == 1
    assert dimension(basis_of(x - 1, y, z)) == 0
    assert dimension(basis_of(x, x - 1)) == -1
    assert set(independent_sets(basis_of(x * y, x * z).leads, 3)) == {(1, 2)}


@given(st.lists(st.integers(-3, 3), min_size=6, max_size=6))
def test_the_signature_of_a_congruent_diagonal(entries: list[int]) -> None:
    a, b, c, d, e, f = entries
    lower = fmpq_mat(3, 3, [1, 0, 0, d, 1, 0, e, f, 1])
    diagonal = fmpq_mat(3, 3, [a, 0, 0, 0, b, 0, 0, 0, c])
    expected = sum((v > 0) - (v < 0) for v in (a, b, c))
    assert signature(lower * diagonal * lower.transpose()) == expected
