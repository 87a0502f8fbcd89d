"""Common divisors and numbers of roots over algebraic points, by subresultants."""

from __future__ import annotations

import random
import time
from fractions import Fraction
from functools import reduce
from operator import mul

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.exact.isolate import isolate
from qe.exact.ring import Poly, Ring
from qe.kernel.arithmetic.fibre import AlgebraicFibre
from qe.kernel.arithmetic.triangular import Coordinate, Point, gcd, subresultants, trim

RING = Ring.of(("x", "y"))
X, Y = RING.gen(0), RING.gen(1)
ROOT = Point(Point(), Coordinate(0, X**2 - 2, Fraction(1), Fraction(2), 1))
PARTS = {
    Y - X: ("the root of 2",),
    Y + X: ("its negative",),
    Y**2 - 2: ("the root of 2", "its negative"),
    Y**2 - X: ("the fourth root", "its negative "),
    Y**2 + X: (),
    Y**3 - X: ("the sixth root",),
    X * Y - 2: ("the root of 2",),
    Y**4 + Y + 3 * X: (),
}
"""Polynomials with their real roots over x = sqrt(2), by name."""
products = st.lists(st.sampled_from(list(PARTS)), min_size=1, max_size=4)


def _product(parts: list[Poly]) -> Poly:
    return reduce(mul, parts)


@given(products)
def test_distinct_real_roots_are_counted(parts):
    fibre = AlgebraicFibre(ROOT, 1, _product(parts))
    assert fibre.count() == fibre.count_by_remainders() == len({name for part in parts for name in PARTS[part]})


@pytest.mark.parametrize(("constant", "count"), [(-X, 2), (X, 0)])
def test_subresultants_that_vanish_at_the_point_alone(constant, count):
    """Y^4 + constant there: between the degrees 3 and 0 all leading coefficients are zero."""
    zero = X**2 - 2
    assert AlgebraicFibre(ROOT, 1, Y**4 + zero * Y**2 + zero * Y + constant).count_by_remainders() == count


@given(products, products, products)
def test_a_common_divisor_divides_and_is_divided(common, one, other):
    f, g, d = _product(common + one), _product(common + other), _product(common)
    found = gcd(ROOT, f, g, 1)
    for divided in (f, g):
        assert gcd(ROOT, divided, found, 1).degree(1) == found.degree(1)
    assert gcd(ROOT, found, d, 1).degree(1) == d.degree(1)
    alone = set(one) & set(other)
    assert found.degree(1) > d.degree(1) if alone else True


@given(st.lists(st.integers(-3, 3), min_size=2, max_size=6), st.lists(st.integers(-3, 3), min_size=1, max_size=6))
def test_degrees_that_fall_at_the_point(ups, downs):
    """A leading coefficient that is not zero in general may be zero at the point: the divisor is not misled."""
    f = sum((c * X**k * Y**k for k, c in enumerate(ups)), (X**2 - 2) * Y**7)
    g = sum((c * X ** (k + 1) * Y**k for k, c in enumerate(downs)), (X**2 - 2) * Y**6 + Y ** len(downs))
    f, g = trim(ROOT, f, 1), trim(ROOT, g, 1)
    root = Y - X
    assert gcd(ROOT, f * root, g * root, 1).degree(1) == gcd(ROOT, f, g, 1).degree(1) + 1
    if f:
        assert subresultants(ROOT, f * root, f, 1)[-1].degree(1) == f.degree(1)


@pytest.mark.parametrize("zero", [0, 1])
def test_one_of_two_may_be_zero(zero):
    pair = [Y**2 - X, 0 * Y]
    assert gcd(ROOT, pair[zero], pair[1 - zero], 1) == Y**2 - X


def test_a_point_of_high_degree_takes_no_division_in_its_field():
    """A common divisor of two curves of degree 10 over a zero of their resultant took 33 s by remainders."""
    draw = random.Random(0)
    f, g = (sum(draw.randint(-9, 9) * X**i * Y**j for i in range(11) for j in range(11 - i)) for _ in "fg")
    resultant = max((part for part, _ in f.resultant(g, 1).factors()[1]), key=lambda part: part.degree(0))
    p = resultant.to_univariate(0)
    low, high = next((a, b) for a, b in isolate(p) if a < b)
    ends = [Fraction(int(end.p), int(end.q)) for end in (low, high)]
    point = Point(Point(), Coordinate(0, resultant, *ends, 1 if p(high) > 0 else -1))
    start = time.process_time()
    assert resultant.degree(0) == 100 and gcd(point, f, g, 1).degree(1) == 1
    assert time.process_time() - start < 3
