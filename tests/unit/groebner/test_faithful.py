"""Elements of the given ideal with the values of a segment's basis on the segment."""

from dataclasses import replace

import pytest

from qe.exact.block_order import BlockOrder
from qe.exact.ring import Poly, Ring
from qe.groebner.faithful import with_faithful
from qe.groebner.kapur_sun_wang import segments
from qe.options import Budget
from tests.unit.exact.ideal_membership import in_ideal

RING = Ring.of(("a", "b", "x", "y"))
A, B, X, Y = (RING.var(name) for name in RING.names)
BLOCK = BlockOrder((2, 3), (0, 1))


@pytest.mark.parametrize(
    "polys",
    [(A * X - B, B * Y - A), (A * X**2 + B * X + 1,), (A * X + Y - 1, X + A * Y - 1), (A * X, B * Y, X * Y - 1)],
    ids=str,
)
def test_faithful_elements(polys: tuple[Poly, ...]) -> None:
    for segment in with_faithful(list(segments(polys, BLOCK, Budget(60))), polys, (), Budget(60)):
        found = segment.faithful
        assert found is not None and len(found) == len(segment.elements)
        for f, g in zip(found, segment.elements):
            assert in_ideal(f, polys)
            assert in_ideal(f, (*segment.equal, g)) if segment.equal else f == g


def test_they_differ_from_the_elements_where_the_equations_were_used() -> None:
    polys = (A * X - B, B * Y - A)
    found = with_faithful(list(segments(polys, BLOCK, Budget(60))), polys, (), Budget(60))
    assert any(s.faithful != s.elements for s in found)


def test_without_equations_or_polynomials_the_elements_are_faithful() -> None:
    (segment,) = segments([X - Y], BLOCK, Budget(60))
    bound = replace(segment, equal=(A,))
    for one, polys in ((segment, (X - Y,)), (bound, (RING.constant(0),))):
        assert with_faithful([one], polys, (), Budget(60))[0].faithful == one.elements


def test_minimal_polynomials_of_constants_belong_to_the_ideal() -> None:
    """b stands for the square root of 2: where nothing else vanishes, the elements themselves are faithful."""
    polys, modulus = (A * X - B, A * Y - 1), B**2 - 2
    generic, *_, special = with_faithful(
        list(segments(polys, BLOCK, Budget(60), equal=(modulus,))), polys, (modulus,), Budget(60)
    )
    assert generic.faithful == generic.elements
    assert special.faithful is not None and all(in_ideal(f, (*polys, modulus)) for f in special.faithful)
