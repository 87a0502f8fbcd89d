"""The sealed list of factors: whatever comes in is factored, constants stay out, nothing is there twice."""

from hypothesis import given
from hypothesis import strategies as st

from qe.decomposition.operators.lazard import LAZARD
from qe.decomposition.projection import FactorSet, factor_lists
from qe.exact.ring import Poly, Ring
from qe.options import Budget
from tests.strategies import polynomials

RING = Ring.of(("x", "y"))


@given(st.lists(polynomials(RING, max_degree=3), max_size=4))
def test_only_irreducible_factors_and_each_once(polys: list[Poly]) -> None:
    found = FactorSet(polys)
    listing = list(found)
    assert len(set(listing)) == len(listing)
    for f in listing:
        assert not f.is_constant and f.factors() == (1, ((f, 1),))
    for p in polys:
        left = p
        for f in listing:
            while left and not left.is_constant and left.gcd(f) == f:
                left = left.exact_divide(f)
        assert left.is_constant
    assert sorted(map(str, found.at(0) + found.at(1))) == sorted(map(str, listing))
    assert all(f.level == 1 for f in found.at(1))


def test_projection_stops_at_the_lowest_level_wanted() -> None:
    x, y = RING.gen(0), RING.gen(1)
    circle = x**2 + y**2 - 1
    below, above = factor_lists([circle], 2, LAZARD, Budget(), lowest=1)
    assert (below, above) == ((), (circle,))
    below, _ = factor_lists([circle], 2, LAZARD, Budget())
    assert set(below) == {x - 1, x + 1}
