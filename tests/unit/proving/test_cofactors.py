"""Cofactors: combinations multiply out, and none is found where there is none."""

from __future__ import annotations

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
    target = generators[0] * (X * c + d) + generators[1] * (Y * e + f)
    if target:
        check([target], generators)


def check(targets: list[Poly], generators: list[Poly]) -> None:
    found = cofactors(targets, generators, Budget(20))
    assert found is not None
    numbers, factors = found
    assert numbers[0] > 0
    left = sum((t * n for t, n in zip(targets, numbers, strict=True)), R.constant(0))
    assert left == sum((c * g for c, g in zip(factors, generators, strict=True)), R.constant(0))


def test_up_to_a_multiple_of_another_polynomial() -> None:
    check([X**3 + Y - 2, X * 2 + Y - 2], [X * X - 2])


def test_no_common_zero() -> None:
    check([R.constant(1)], [X * Y - 1, X])


def test_outside_the_ideal() -> None:
    assert cofactors([X + 1], [X * X, Y], Budget(20)) is None
    assert cofactors([R.constant(1)], [X, Y], Budget(20)) is None
