"""Polynomials by blocks of variables, quotients put in, and stacks: the docstrings' identities, on random input."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.errors import BudgetExceeded
from qe.exact.factor import guarded_factor
from qe.exact.fibre_stack import isolate_over
from qe.exact.quadratic_form import echelon
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from tests.strategies import polynomials, rationals

RING = Ring.of(("a", "b", "x", "y"))
POLYS = polynomials(RING, max_degree=4, max_terms=6)


@given(POLYS, polynomials(RING, max_degree=1), polynomials(RING, max_degree=1), st.tuples(*[rationals()] * 4))
def test_a_quotient_put_in(p: Poly, top: Poly, bottom: Poly, point: tuple[Fraction, ...]) -> None:
    x = 2
    image = p.at_quotient(x, top, bottom)
    below = bottom.evaluate(point)
    if below:
        moved = (*point[:x], top.evaluate(point) / below, *point[x + 1 :])
        assert image.evaluate(point) == below ** p.degree(x) * p.evaluate(moved)


def test_a_quotient_that_grows_is_given_up() -> None:
    a, b, x, y = (RING.gen(i) for i in range(4))
    with pytest.raises(BudgetExceeded):
        (x**8 + y).at_quotient(2, a + b, b + y, most_terms=10)
    assert (x + y).at_quotient(2, a, b, most_terms=2) == a + b * y


def test_factors_are_the_factors_again() -> None:
    p = (RING.gen(0) - 1) ** 2 * (RING.gen(2) * 3 + RING.gen(1)) * -4
    unit, parts = guarded_factor(p.p)
    total = RING.constant(int(unit))
    for factor, exponent in parts:
        total = total * Poly(RING, factor) ** exponent
    assert total == p and sorted(e for _, e in parts) == [1, 2]


@given(st.lists(polynomials(Ring.of(("x",)), max_degree=3), min_size=1, max_size=3))
def test_the_cells_of_a_stack_are_told_by_their_samples(polys: list[Poly]) -> None:
    ring = Ring.of(("x",))
    stack = isolate_over(Point(ring), tuple(polys))
    maps = stack.sign_maps()
    assert len(maps) == 2 * len(stack.samples) - 1
    for position, signs in enumerate(maps):
        point = stack.sample(position)
        assert all(point.sign(p) == signs[p] for p in polys)
        if position % 2 == 0:
            assert point.number(0) == stack.samples[position // 2]
    numbers = [stack.sample(position).number(0) for position in range(len(maps))]
    assert numbers == sorted(numbers)


@given(st.lists(st.lists(rationals(), min_size=3, max_size=3), min_size=1, max_size=4))
def test_an_echelon_form_spans_the_rows(rows: list[list[Fraction]]) -> None:
    reduced, pivots = echelon(rows)
    assert pivots == sorted(set(pivots)) and len(reduced) == len(pivots)
    for k, (row, pivot) in enumerate(zip(reduced, pivots, strict=True)):
        assert not any(row[:pivot])
        assert [other[pivot] for other in reduced] == [Fraction(int(j == k)) for j in range(len(reduced))]
    for row in rows:  # the row is the combination of the reduced ones that its entries at the pivots say
        combined = [sum((row[p] * r[c] for p, r in zip(pivots, reduced)), Fraction(0)) for c in range(3)]
        assert combined == row


def test_coefficients_in_one_variable_highest_first_with_the_constant_one() -> None:
    a, b, x, _ = (RING.gen(i) for i in range(4))
    assert (a * x**2 + b).coefficients_in((2, 3)) == (a, b)
    assert (a * x**2 + a).coefficients_in((2,)) == (a,)
    assert (a + b).coefficients_in((2,)) == (a + b,)
    assert RING.constant(0).coefficients_in((2,)) == ()
