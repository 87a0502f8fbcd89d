"""Numbers modulo a polynomial with a root in an interval: against exact algebraic numbers of the engine."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.errors import CertificateRejected
from qe.exact.field import NumberField
from qe.expert.arithmetic import residue
from qe.expert.arithmetic.numbers import read_field, read_number
from qe.expert.arithmetic.residue import ZERO, Residue, RootField, add, of_rationals, scale
from qe.proof.entry import Entry
from tests.tables import each

COEFFICIENTS = st.lists(st.fractions(-3, 3, max_denominator=4), min_size=1, max_size=3)


def cubic() -> tuple[RootField, NumberField]:
    """2*x^3 - 2*x - 3 between 1 and 2: the leading coefficient is not 1."""
    return RootField((-3, -2, 0, 2), Fraction(5, 4), Fraction(3, 2), "field"), NumberField.from_root(
        [-3, -2, 0, 2], 1, 2
    )


@given(COEFFICIENTS, COEFFICIENTS, st.fractions(-3, 3, max_denominator=4))
def test_arithmetic_and_signs(a: list[Fraction], b: list[Fraction], c: Fraction) -> None:
    field, other = cubic()
    theta = other.generator()

    def value(coefficients: list[Fraction]) -> object:
        return sum((theta**k * v for k, v in enumerate(coefficients)), theta * 0)

    def agrees(found: Residue, expected: object) -> None:
        told = [Fraction(n, found.denominator) for n in found.coefficients]
        assert value(told) == expected
        assert field.sign(found) == (expected > 0) - (expected < 0)  # type: ignore[operator]

    u, v, x, y = of_rationals(a), of_rationals(b), value(a), value(b)
    agrees(u, x)
    agrees(add(u, v), x + y)  # type: ignore[operator]
    agrees(field.multiply(u, v), x * y)  # type: ignore[operator]
    agrees(scale(u, c), x * c)  # type: ignore[operator]
    assert add(u, scale(u, Fraction(-1))) == ZERO


def test_residues_are_in_lowest_terms() -> None:
    assert of_rationals([Fraction(1, 2), Fraction(1, 3), Fraction(0)]) == Residue((3, 2), 6)
    assert scale(Residue((3, 2), 6), Fraction(6)) == Residue((3, 2), 1)
    assert of_rationals([Fraction(0)]) == ZERO and ZERO.is_zero


@each(
    ((-2, 0, 1), 2, 1, "above the upper"),
    ((-2, 0, 1), 2, 3, "does not change sign"),
    ((-2, 0, 1), -2, 2, "does not change sign"),
    ((-4, 0, 1), 2, 3, "does not change sign"),  # the root is an end
    ((-4, 0, 1), 1, 2, "does not change sign"),
    ((0, -1, 0, 1), -2, 2, "one simple root"),  # three roots
    ((-1, 3, -3, 1), 0, 2, "one simple root"),  # a triple root
    ((-2, 0, 1), 1, 1, "not a root"),
    ((1,), 0, 1, "positive degree"),
    ((1, 0), 0, 1, "positive degree"),
)
def test_the_interval_has_to_isolate_a_simple_root(p: tuple[int, ...], low: int, high: int, reason: str) -> None:
    with pytest.raises(CertificateRejected, match=reason):
        RootField(p, Fraction(low), Fraction(high), "field")


def test_a_root_at_the_ends_of_a_point_interval() -> None:
    field = RootField((-4, 0, 1), Fraction(2), Fraction(2), "field")
    assert field.sign(of_rationals([Fraction(-1), Fraction(1)])) == 1
    with pytest.raises(CertificateRejected, match="could not be decided"):
        field.sign(of_rationals([Fraction(-2), Fraction(1)]))  # theta - 2 is 0, but not the zero polynomial


def test_a_reducible_polynomial_is_found_out_and_never_wrong(monkeypatch: pytest.MonkeyPatch) -> None:
    """(x^2 - 2)(x - 5) at sqrt 2: x^2 - 2 is 0 there without being the zero polynomial."""
    monkeypatch.setattr(residue, "MAX_BITS", 500)
    field = RootField((10, -2, -5, 1), Fraction(1), Fraction(3, 2), "field")
    assert field.sign(of_rationals([Fraction(-1), Fraction(1)])) == 1
    with pytest.raises(CertificateRejected, match="could not be decided"):
        field.sign(of_rationals([Fraction(-2), Fraction(0), Fraction(1)]))


def test_close_numbers_are_told_apart() -> None:
    field = RootField((-2, 0, 1), Fraction(1), Fraction(2), "field")
    near = Fraction(14142135623730950488016887242096980785696718753769, 10**49)
    assert field.sign(of_rationals([-near, Fraction(1)])) == 1
    assert field.sign(of_rationals([-near - Fraction(1, 10**49), Fraction(1)])) == -1


def test_the_sign_at_the_other_root_is_the_other_one() -> None:
    negative = RootField((-2, 0, 1), Fraction(-2), Fraction(-1), "field")
    assert negative.sign(of_rationals([Fraction(0), Fraction(1)])) == -1
    assert negative.sign(negative.multiply(of_rationals([Fraction(0), Fraction(1)]), Residue((0, 1), 1))) == 1


@each(
    (["-2", "0", "2"], ["1", "2"]),  # not primitive
    (["2", "0", "-1"], ["1", "2"]),
    (["-1/2", "0", "1"], ["0", "1"]),
    ([], ["1", "2"]),
    (["-2", "0", "1"], ["1"]),
    (["-2", "0", "1"], ["1", "2", "3"]),
)
def test_fields_are_read_strictly(polynomial: list[str], interval: list[str]) -> None:
    entry = {"minimal_polynomial": polynomial, "interval": interval}
    with pytest.raises(CertificateRejected):
        read_field(Entry(entry, "field"))  # type: ignore[arg-type]


def test_numbers_are_read_strictly() -> None:
    field = read_field(Entry({"minimal_polynomial": ["-2", "0", "1"], "interval": ["1", "2"]}, "field"))
    assert read_number(Entry(["1", "1/2"], "number"), field) == Residue((2, 1), 2)
    assert read_number(Entry(["0"], "number"), field) == ZERO
    for wrong in ([], ["1", "0"], ["1", "1", "1"], ["2/4"], [1]):
        with pytest.raises(CertificateRejected):
            read_number(Entry(wrong, "number"), field)  # type: ignore[arg-type]
