"""What is out of reach is refused, and called neither right nor wrong."""

from __future__ import annotations

from fractions import Fraction

import pytest

from qe.errors import Unable
from qe.kernel import limits
from tests.unit.certify.claims import RING, poly

A, X = RING.gen(0), RING.gen(3)


def test_the_last_that_is_in_reach_and_the_first_that_is_not(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(limits, "VARIABLES", 5)
    limits.check_variables(5)
    with pytest.raises(Unable, match="6 rows"):
        limits.check_variables(6)
    monkeypatch.setattr(limits, "DEGREES", 5)
    limits.check_resultant(poly("x^2 - a^9"), poly("x^3 - a"), 3)
    with pytest.raises(Unable, match="degrees 3 and 3"):
        limits.check_resultant(poly("x^3 - a^9"), poly("x^3 - a"), 3)
    monkeypatch.setattr(limits, "POWER_TERMS", 6)
    limits.check_power(A + X, 3)
    limits.check_power(A * X * 7, 10**9)  # one term: a power of it has one, too
    with pytest.raises(Unable, match="the power 4"):
        limits.check_power(A + X, 4)
    monkeypatch.setattr(limits, "POWER_BITS", 12)
    limits.check_value(poly("x^3 - a"), 3, Fraction(7, 1))
    limits.check_value(poly("x - a^40"), 3, Fraction(63, 32))
    with pytest.raises(Unable, match="of 5 bits"):
        limits.check_value(poly("x^3 - a"), 3, Fraction(7, 2))
    monkeypatch.setattr(limits, "FIELD_BITS", 16)
    limits.check_field([-3, 0, 1])
    with pytest.raises(Unable, match="degree 2 with coefficients of 3 bits"):
        limits.check_field([-4, 0, 1])


def test_huge_entries_are_refused_at_once() -> None:
    with pytest.raises(Unable):
        limits.check_power(A + X, 10**18)
    with pytest.raises(Unable):
        limits.check_value(X**9000, 3, Fraction(3**5000))
    with pytest.raises(Unable):
        limits.check_resultant(X**9000 - A, X**9000 + A, 3)
