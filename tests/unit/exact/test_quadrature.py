"""Rigorous integrals of |f| sqrt(q): closed forms, enclosures of coefficients, and the width asked for."""

from fractions import Fraction
from math import asinh, pi, sqrt

import pytest

from qe.errors import Unable
from qe.exact import quadrature
from qe.exact.quadrature import root_integral
from tests.tables import each

ZERO, ONE = Fraction(0), Fraction(1)


def exactly(*coefficients: int) -> list[tuple[Fraction, Fraction]]:
    return [(Fraction(c), Fraction(c)) for c in coefficients]


@each(3, 9, 20)
@each(
    ((1,), (4,), ZERO, ONE, 2.0),
    ((0, 1), (1,), ZERO, ONE, 0.5),
    ((1, -2), (9,), Fraction(1, 2), ONE, 0.75),  # the factor is negative: its size counts
    ((1,), (1, 0, 4), ZERO, ONE, (2 * sqrt(5) + asinh(2)) / 4),
    ((2,), (1, 0, -1), ZERO, Fraction(1, 2), pi / 6 + sqrt(3) / 4),
)
def test_closed_forms(
    factor: tuple[int, ...], radicand: tuple[int, ...], low: Fraction, high: Fraction, value: float, digits: int
) -> None:
    rel = Fraction(1, 10**digits)
    below, above = root_integral(exactly(*factor), exactly(*radicand), low, high, rel)
    assert above - below <= rel * above
    assert float(below) <= value * (1 + 1e-14) and value * (1 - 1e-14) <= float(above)


def test_wide_coefficients_give_both_ends() -> None:
    wide = [(Fraction(1), Fraction(4))]
    with pytest.raises(Unable, match="not enclosed"):
        root_integral(exactly(1), wide, ZERO, ONE, Fraction(1, 10))
    below, above = root_integral(exactly(1), wide, ZERO, ONE, ONE)
    assert below <= 1 and above >= 2


def test_it_gives_up_at_the_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(quadrature, "MAX_BITS", quadrature.FIRST_BITS)
    with pytest.raises(Unable):
        root_integral(exactly(1), exactly(1, 1), ZERO, ONE, Fraction(1, 10**60))
