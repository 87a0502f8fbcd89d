"""Members of a sum of two ideals taken apart."""

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from qe.errors import InternalError
from qe.exact.ideal_sum import graded_basis, taken_apart
from qe.exact.ring import Poly, Ring
from tests.strategies import polynomials
from tests.unit.exact.ideal_membership import in_ideal

RING = Ring.of(("a", "x", "y"))
A, X, Y = (RING.gen(i) for i in range(3))
PLACES = (2, 1, 0)


def tick() -> None:
    """No limit."""


def parts(member: Poly, first: list[Poly], second: list[Poly]) -> tuple[int, Poly]:
    (found,) = taken_apart([member], graded_basis(first, PLACES), graded_basis(second, PLACES), PLACES, tick)
    return found


@settings(max_examples=15)
@given(
    *[polynomials(RING, max_degree=2).filter(bool)] * 2,
    st.lists(polynomials(RING, max_degree=1), min_size=2, max_size=2),
)
def test_one_part_is_in_either_ideal(f: Poly, e: Poly, factors: list[Poly]) -> None:
    member = factors[0] * f + factors[1] * e
    assume(bool(member))
    scale, part = parts(member, [f], [e])
    assert scale > 0
    for own, ideal in ((part, f), (scale * member - part, e)):
        assert not own or in_ideal(own, [ideal])


def test_no_member() -> None:
    with pytest.raises(InternalError, match="no member"):
        parts(X + 1, [X * Y], [A])
