"""Isolation of the real roots of squarefree polynomials with several factors."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

from flint import fmpq, fmpz_poly
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.exact.isolate import isolate, sign_at, simplest_between
from tests.strategies import HUGE
from tests.tables import each

X = fmpz_poly([0, 1])


def product(roots: list[Fraction]) -> fmpz_poly:
    """A polynomial with these real roots, and two that are not real."""
    p = X**2 + 2
    for root in roots:
        p *= root.denominator * X - root.numerator
    return p


def check(roots: list[Fraction]) -> None:
    """Disjoint intervals in order, one for each root; the ends of an open one are no roots."""
    p, found = product(roots), isolate(product(roots))
    assert len(found) == len(roots)
    for (low, high), root in zip(found, sorted(roots), strict=True):
        value = fmpq(root.numerator, root.denominator)
        if low == high:
            assert low == value
        else:
            assert low < value < high and sign_at(p, low) * sign_at(p, high) < 0
    assert all(left[1] <= right[0] for left, right in pairwise(found))


@each(
    "1 13/10 2",  # between two dyadic roots, in the half that the middle of the interval does not show
    "2 8/3 4 5",  # this one did not end
    "-3 0 11/3",  # zero as an end of two intervals
    "0",
    "-2 0 2",
)
def test_roots_beside_roots_that_are_ends(roots: str) -> None:
    check([Fraction(root) for root in roots.split()])


dyadic = st.builds(Fraction, st.integers(-16, 16), st.sampled_from((1, 2, 4)))
other = st.builds(Fraction, st.integers(-60, 60), st.sampled_from((3, 5, 7, 11)))
far_or_close = st.builds(lambda near, by: near + by, dyadic, st.sampled_from([Fraction(h) for h in HUGE])) | st.builds(
    lambda near, by: near + 1 / by, dyadic, st.sampled_from([Fraction(h) for h in HUGE])
)


@settings(max_examples=60, deadline=None)
@given(st.sets(dyadic, max_size=4), st.sets(other | far_or_close, max_size=4))
def test_every_root_has_its_interval(dyadic_roots: set[Fraction], others: set[Fraction]) -> None:
    check(sorted(dyadic_roots | others))


@settings(max_examples=60, deadline=None)
@given(st.lists(st.integers(-9, 9), min_size=17, max_size=24), other | far_or_close)
def test_the_sign_of_a_long_polynomial_is_the_exact_one(coefficients: list[int], value: Fraction) -> None:
    """Long polynomials are tried by balls first; at a root, and just beside it, no ball decides."""
    at = fmpq(value.numerator, value.denominator)
    beside = at + fmpq(1, 2**2000)
    long = fmpz_poly([*coefficients, 1])
    with_root = long * (value.denominator * X - value.numerator)
    for p, point in ((long, at), (with_root, at), (with_root, beside)):
        exact = p(point)
        assert sign_at(p, point) == (exact > 0) - (exact < 0)


@each(
    ("0", "1", "1/2"),
    ("1/2", "1", "2/3"),
    ("0", "1/3", "1/4"),
    ("-1", "1", "0"),
    ("-1", "0", "-1/2"),
    ("2", "4", "3"),
)
def test_the_simplest_number_is_neither_end(low: str, high: str, between: str) -> None:
    found = simplest_between(*(fmpq(f.numerator, f.denominator) for f in map(Fraction, (low, high))))
    assert str(found) == between
