"""Numbers modulo a polynomial with a root in an interval: against exact algebraic numbers of the engine."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.errors import CertificateRejected
from qe.exact.field import NumberField
from qe.exact.ring import Ring
from qe.expert.arithmetic.field import ONE, RootField, constant
from qe.proof.entry import Entry
from tests.tables import each

COEFFICIENTS = st.lists(st.fractions(-3, 3, max_denominator=4), min_size=1, max_size=3)


def field(polynomial: list[str], low: str, high: str) -> RootField:
    return RootField(Entry({"minimal_polynomial": polynomial, "interval": [low, high]}, "field"))  # type: ignore[dict-item]


def number(of: RootField, *coefficients: Fraction | int) -> Any:
    """The sum of the coefficients times powers of theta."""
    total = constant(Fraction(0))
    for c in reversed(coefficients):
        total = of.reduced(total * of.theta + constant(Fraction(c)))
    return total


@given(COEFFICIENTS, COEFFICIENTS)
def test_arithmetic_and_signs(a: list[Fraction], b: list[Fraction]) -> None:
    """2*x^3 - 2*x - 3 between 1 and 2: the leading coefficient is not 1."""
    here, other = field(["-3", "-2", "0", "2"], "5/4", "3/2"), NumberField.from_root([-3, -2, 0, 2], 1, 2)
    theta = other.generator()

    def value(coefficients: list[Fraction]) -> Any:
        return sum((theta**k * v for k, v in enumerate(coefficients)), theta * 0)

    def agrees(found: Any, expected: Any) -> None:
        assert value([Fraction(int(c.p), int(c.q)) for c in found.coeffs()]) == expected
        assert here.sign(found) == (expected > 0) - (expected < 0)

    u, v, x, y = number(here, *a), number(here, *b), value(a), value(b)
    agrees(u, x)
    agrees(here.reduced(u + v), x + y)
    agrees(here.reduced(u * v), x * y)
    assert not here.reduced(u - u)


@each(
    (["-2", "0", "1"], "2", "1", "isolate one root"),
    (["-2", "0", "1"], "2", "3", "isolate one root"),
    (["-2", "0", "1"], "-2", "2", "isolate one root"),
    (["-4", "0", "1"], "2", "3", "isolate one root"),  # the root is an end
    (["-4", "0", "1"], "1", "2", "isolate one root"),
    (["0", "-1", "0", "1"], "-2", "2", "isolate one root"),  # three roots
    (["-2", "0", "1"], "1", "1", "not a root"),
    (["1"], "0", "1", "positive degree"),
    ([], "1", "2", "positive degree"),
    (["1", "0"], "0", "1", "positive leading"),
    (["-2", "0", "2"], "1", "2", "primitive"),
    (["2", "0", "-1"], "1", "2", "positive leading"),
    (["-1/2", "0", "1"], "0", "1", "integers"),
)
def test_the_interval_has_to_isolate_a_root(polynomial: list[str], low: str, high: str, reason: str) -> None:
    with pytest.raises(CertificateRejected, match=reason):
        field(polynomial, low, high)


@each(["1"], ["1", "2", "3"])
def test_an_interval_has_two_ends(interval: list[str]) -> None:
    with pytest.raises(CertificateRejected):
        RootField(Entry({"minimal_polynomial": ["-2", "0", "1"], "interval": interval}, "field"))  # type: ignore[dict-item]


@each(
    (["-4", "0", "1"], "2", "2", [-1, 1], 1),
    (["10", "-2", "-5", "1"], "1", "3/2", [-1, 1], 1),  # (x^2 - 2)(x - 5) at sqrt 2
    (["-2", "0", "1"], "-2", "-1", [0, 1], -1),
    (["-2", "0", "1"], "1", "2", [-2, 0, 1], 0),  # the zero polynomial
)
def test_signs(polynomial: list[str], low: str, high: str, coefficients: list[int], sign: int) -> None:
    here = field(polynomial, low, high)
    assert here.sign(number(here, *coefficients)) == sign


@each(
    (["-4", "0", "1"], "2", "2", [-2, 1]),
    (["10", "-2", "-5", "1"], "1", "3/2", [-2, 0, 1]),
    (["-1", "3", "-3", "1"], "0", "2", [-1, 1]),  # a triple root
)
def test_a_number_that_is_zero_but_not_the_zero_polynomial_has_no_sign(
    polynomial: list[str], low: str, high: str, coefficients: list[int]
) -> None:
    """Else a weight that is not the zero polynomial would count as positive."""
    here = field(polynomial, low, high)
    with pytest.raises(CertificateRejected, match="reducible"):
        here.sign(number(here, *coefficients))


def test_close_numbers_are_told_apart() -> None:
    here = field(["-2", "0", "1"], "1", "2")
    near = Fraction(14142135623730950488016887242096980785696718753769, 10**49)
    assert here.sign(number(here, -near, 1)) == 1
    assert here.sign(number(here, -near - Fraction(1, 10**49), 1)) == -1


def test_numbers_are_read_strictly() -> None:
    here = field(["-2", "0", "1"], "1", "2")
    assert here.number(Entry(["1", "1/2"], "number")) == number(here, 1, Fraction(1, 2))
    assert not here.number(Entry(["0"], "number")) and here.number(Entry(["1"], "number")) == ONE
    for wrong in ([], ["1", "0"], ["1", "1", "1"], ["2/4"], [1]):
        with pytest.raises(CertificateRejected):
            here.number(Entry(wrong, "number"))  # type: ignore[arg-type]


def test_values_at_a_point() -> None:
    here, ring = field(["-2", "0", "1"], "1", "2"), Ring.of(("x", "y"))
    at = [here.theta, here.reduced(here.theta + 1)]
    assert not here.value(ring.var("x") ** 2 * 3 - 6, at)
    assert here.value(ring.var("x") * ring.var("y") - 1, at) == number(here, 1, 1)
