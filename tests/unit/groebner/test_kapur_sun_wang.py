"""Segments that partition the points of a set, with bases that specialise everywhere on them."""

from __future__ import annotations

from fractions import Fraction
from itertools import product
from random import Random

import pytest

from qe.exact.block_order import BlockOrder
from qe.exact.ring import Poly, Ring
from qe.groebner.kapur_sun_wang import segments
from qe.groebner.segment import Segment
from qe.options import Budget
from tests.unit.groebner.support import places

RING = Ring.of(("a", "b", "x", "y"))
A, B, X, Y = (RING.var(name) for name in RING.names)
BLOCK = BlockOrder((2, 3), (0, 1))
POINTS = [(Fraction(a), Fraction(b)) for a, b in product((-2, -1, 0, 1, 2), repeat=2)]


def at(poly: Poly, point: tuple[Fraction, Fraction]) -> Fraction:
    return poly.evaluate((*point, 0, 0))


def lies_in(point: tuple[Fraction, Fraction], segment: Segment) -> bool:
    zero = all(not at(p, point) for p in segment.equal) and all(at(p, point) for p in segment.nonzero)
    return zero and (not segment.some or any(at(p, point) for p in segment.some))


SYSTEMS = [
    [A * X - B, X**2 - Y],
    [A * X + Y - 1, X + A * Y - 1],
    [A * X**2 + B * X + 1],
    [A * X, B * Y, X * Y - 1],
    [A, B * X - 1],
    [A * B - 1, X - Y],
    [(A - B) * X * Y, Y**2 - A],
]


@pytest.mark.parametrize("polys", SYSTEMS, ids=str)
def test_every_point_lies_in_one_segment_and_the_basis_specialises(polys: list[Poly]) -> None:
    found = list(segments(polys, BLOCK, Budget(60)))
    for point in POINTS:
        assert sum(lies_in(point, s) for s in found) == 1
    chance = Random(1)
    for segment in found:
        for place in places(segment.equal, segment.nonzero, segment.some, (0, 1), chance)[:2]:
            assert place.leads(polys, BLOCK) == set(segment.leads)
            assert place.ideal(polys, BLOCK) == place.ideal(segment.basis, BLOCK) if segment.basis else True


def test_only_the_points_that_are_asked_about() -> None:
    whole = list(segments([A * X - B], BLOCK, Budget(60)))
    asked = list(segments([A * X - B], BLOCK, Budget(60), equal=[A * B], nonzero=[A - 1]))
    for point in POINTS:
        a, b = point
        expected = int(a * b == 0 and a != 1)
        assert sum(lies_in(point, s) for s in whole) == 1 and sum(lies_in(point, s) for s in asked) == expected
    assert len(list(segments([X], BLOCK, Budget(60), equal=[A], nonzero=[A**2]))) == 0
    assert next(segments([X], BLOCK, Budget(60), nonzero=[RING.constant(3)])).nonzero == ()


def test_the_quadratic_equation() -> None:
    """Where the leading coefficient does not vanish, where it does, and where nothing is left but a contradiction."""
    found = list(segments([A * X**2 + B * X + 1], BLOCK, Budget(60)))
    leads = {s.leads for s in found}
    assert leads == {((2, 0),), ((1, 0),), ((0, 0),)}
    (unit,) = [s for s in found if s.is_unit]
    assert lies_in((Fraction(0), Fraction(0)), unit) and not lies_in((Fraction(0), Fraction(1)), unit)


def test_the_zero_ideal() -> None:
    (found,) = segments([RING.constant(0)], BLOCK, Budget(60))
    assert found.basis == () and found.equal == () and found.dimension == 2
