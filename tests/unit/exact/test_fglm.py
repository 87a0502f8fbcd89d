"""Change of order, and division with cofactors."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.exact.division import divided
from qe.exact.fglm import changed_order
from qe.exact.groebner import MonomialOrder, groebner_basis
from qe.exact.ideals import has_zeros
from qe.exact.quotient import PositiveDimensional
from qe.exact.ring import Poly, Ring
from tests.unit.exact.ideal_membership import in_ideal, in_radical

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


@st.composite
def polynomials(draw: st.DrawFn) -> Poly:
    terms = st.dictionaries(st.tuples(*[st.integers(0, 3)] * 3), st.integers(-9, 9).filter(bool), max_size=5)
    return RING.from_terms(draw(terms))


@settings(max_examples=40)
@given(polynomials(), st.sampled_from(list(MonomialOrder)))
def test_division_is_an_identity_and_reduces(poly: Poly, order: MonomialOrder) -> None:
    basis = groebner_basis(SYSTEM, variables=(2, 1, 0), order=order)
    assert basis is not None
    found = divided(poly, basis)
    total = found.remainder
    for quotient, divisor in zip(found.quotients, basis.polys, strict=True):
        total = total + quotient * divisor
    assert total == poly * found.scale and found.scale > 0
    scale, rest = basis.reduce(poly)
    assert found.remainder * scale == rest * found.scale


def test_membership_in_radicals() -> None:
    assert in_radical(x, [x**3]) and not in_ideal(x, [x**3])
    assert in_ideal(x**2 - y**2, [x - y]) and not in_radical(x, [x * y])
    assert has_zeros([x**2 + 1]) and not has_zeros([x**2 + 1, x]) and not has_zeros([x * y], [x, y])
    assert has_zeros([], [x]) and not has_zeros([], [x, x - x])
    assert in_radical(RING.constant(0), []) and not in_radical(x, [])
