"""A segment: its leading monomials, dimension and reduction."""

from __future__ import annotations

import pickle

from qe.exact.block_order import BlockOrder
from qe.exact.ring import Poly, Ring
from qe.groebner.segment import Segment, monomial_names
from tests.tables import each

RING = Ring.of(("a", "b", "x", "y"))
A, B, X, Y = (RING.var(name) for name in RING.names)
BLOCK = BlockOrder((2, 3), (0, 1))


def segment(
    *basis: Poly, equal: tuple[Poly, ...] = (), nonzero: tuple[Poly, ...] = (), some: tuple[Poly, ...] = ()
) -> Segment:
    return Segment(BLOCK, equal, nonzero, some, basis)


@each(
    ((), (), 2, False),
    ((RING.constant(1),), ((0, 0),), -1, True),
    ((A * X - B,), ((1, 0),), 1, False),
    ((A * X - B, Y**2 - X), ((1, 0), (0, 2)), 0, False),
    ((X * Y - 1,), ((1, 1),), 1, False),
)
def test_leading_monomials_and_dimension(basis: tuple[Poly, ...], leads: object, dimension: int, unit: bool) -> None:
    found = segment(*basis)
    assert (found.leads, found.dimension, found.is_unit) == (leads, dimension, unit)


def test_where_not_all_vanish() -> None:
    assert segment().unequal == ()
    assert segment(some=(A, B)).unequal == (A, B)
    assert segment(nonzero=(A, B)).unequal == (A * B,)
    assert segment(nonzero=(A, B), some=(A - 1, B - 1)).unequal == (A * B * (A - 1), A * B * (B - 1))


def test_reduction_modulo_basis_and_equations() -> None:
    plain = segment(A * X - B, nonzero=(A,))
    assert plain.base is None and plain.reduce(X * Y) == (A, B * Y)
    bound = segment(X - A, equal=(A**2 - B,))
    assert bound.base is not None and bound.reduce(X**2) == (RING.constant(1), B)
    assert bound.reduce(X**2 - B)[1] == RING.constant(0)


def test_what_is_remembered_is_not_pickled() -> None:
    one = segment(X - A, equal=(A**2 - B,), some=(B,))
    assert one.base is not None and one.leads
    again = pickle.loads(pickle.dumps(one))
    assert again == one and set(vars(again)) == {
        "block",
        "equal",
        "nonzero",
        "some",
        "basis",
        "elements",
        "faithful",
    }


def test_names_of_monomials() -> None:
    assert [monomial_names(e, ("x", "y")) for e in ((0, 0), (1, 0), (2, 1), (0, 3))] == ["1", "x", "x^2*y", "y^3"]
