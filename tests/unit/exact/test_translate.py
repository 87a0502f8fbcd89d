"""Polynomials in coordinates counted from another point, and with numbers put in."""

from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from qe.exact.ring import Poly, Ring
from qe.exact.translate import put_in, translated
from tests.strategies import polynomials, rationals

RING = Ring.of(("x", "y", "z"))
POINT = st.tuples(rationals(), rationals(), rationals())


@given(polynomials(RING, max_degree=3).filter(bool), POINT, POINT)
def test_the_sign_is_that_at_the_moved_point(p: Poly, origin: tuple[Fraction, ...], at: tuple[Fraction, ...]) -> None:
    moved = translated(p, origin)
    there = p.evaluate([a + b for a, b in zip(at, origin, strict=True)])
    here = moved.evaluate(list(at))
    assert (here > 0) - (here < 0) == (there > 0) - (there < 0)
    assert translated(moved, [-v for v in origin]).normal()[1] == p.normal()[1]
    assert abs(moved.normal()[0]) == 1  # it is primitive


def test_a_sign_is_kept() -> None:
    x, y, _ = (RING.gen(i) for i in range(3))
    assert translated(-x * y, [Fraction(1), Fraction(0), Fraction(0)]) == -(x + 1) * y
    assert translated(2 * x - 1, [Fraction(1, 2)] * 3) == x
    assert translated(x, [Fraction(1, 3)] * 3) == 3 * x + 1


@given(polynomials(RING, max_degree=3), st.dictionaries(st.integers(0, 2), rationals()), POINT)
def test_numbers_put_in_at_once(p: Poly, values: dict[int, Fraction], at: tuple[Fraction, ...]) -> None:
    found = put_in(p, values)
    there = p.evaluate([values.get(i, v) for i, v in enumerate(at)])
    here = found.evaluate(list(at))
    assert (here > 0) - (here < 0) == (there > 0) - (there < 0)
    assert not {*values} & {*found.variables}
