"""Cofactors: combinations multiply out, and none is found where there is none."""

from hypothesis import given
from hypothesis import strategies as st

from qe.exact.ring import Poly, Ring
from qe.options import Budget
from qe.proving.cofactors import cofactors

R = Ring.of(("x", "y"))
X, Y = R.gen(0), R.gen(1)


@given(st.lists(st.integers(-3, 3), min_size=6, max_size=6))
def test_combinations_are_found_and_multiply_out(numbers: list[int]) -> None:
    a, b, c, d, e, f = numbers
    generators = [X * X + Y * a + b, X * Y - 1]
    targets = [generators[0] * (X * c + d) + generators[1] * (Y * e + f), generators[1] * X * c, generators[0]]
    check([target for target in targets if target], generators)


def check(targets: list[Poly], generators: list[Poly]) -> None:
    for target, solved in zip(targets, cofactors(targets, generators, Budget(20)), strict=True):
        assert solved is not None
        number, factors = solved
        assert number > 0
        assert target * number == sum((c * g for c, g in zip(factors, generators, strict=True)), R.constant(0))


def test_no_common_zero() -> None:
    check([R.constant(1)], [X * Y - 1, X])


def test_outside_the_ideal() -> None:
    assert cofactors([X + 1], [X * X, Y], Budget(20)) == [None]
    inside, outside, unit = X * Y, X + 1, R.constant(1)
    found = cofactors([outside, inside, unit, X * X * Y + X], [X, Y * Y], Budget(20))
    assert [solved is None for solved in found] == [True, False, True, False]
