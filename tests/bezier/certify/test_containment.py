"""Whole curves inside balls and half-spaces, by Bernstein coefficients on pieces."""

from __future__ import annotations

from fractions import Fraction
from math import comb
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bezier.certify.containment import check_containment, constant, product, read_points, restricted, total
from qe.errors import CertificateRejected
from qe.expert.arithmetic.residue import Residue, RootField, of_rationals
from qe.proof.entry import Entry
from tests.tables import each

RATIONAL = {"minimal_polynomial": ["0", "1"], "interval": ["0", "0"]}
ARCH = [["-1", "0"], ["0", "2"], ["1", "0"]]


def payload(condition: Any, *breaks: str, points: Any = ARCH) -> dict[str, Any]:
    given = [[[c] for c in p] for p in points]
    return {"field": RATIONAL, "points": given, "condition": condition, "breaks": list(breaks or ("0", "1"))}


def ball(square: str, *centre: str) -> dict[str, Any]:
    return {"centre": list(centre or ("0", "0")), "radius_squared": [square]}


def side(offset: str, *normal: str) -> dict[str, Any]:
    return {"normal": list(normal), "offset": offset}


@each(
    (side("2", "0", "1"), ()),  # y <= 2, of the control points
    (side("1", "0", "1"), ("0", "1/2", "1")),
    (side("0", "0", "-1"), ()),
    (side("1", "1", "0"), ()),
    (ball("1"), ("0", "1/2", "1")),
    (ball("2", "0", "1"), ()),
)
def test_inside(condition: Any, breaks: tuple[str, ...]) -> None:
    check_containment(payload(condition, *breaks))


@each(
    (side("1", "0", "1"), (), "Bernstein coefficient"),
    (side("99/100", "0", "1"), ("0", "1/2", "1"), "Bernstein coefficient"),
    (side("0", "0", "1"), (), "Bernstein coefficient"),
    (side("0", "1", "0"), (), "Bernstein coefficient"),
    (ball("1"), (), "Bernstein coefficient"),
    (ball("1", "0", "1"), (), "Bernstein coefficient"),
    (side("1", "0", "1", "0"), (), "expected 2 numbers"),
    (ball("4", "0", "0", "0"), (), "expected 2 numbers"),
    (side("2", "0", "1"), ("0",), "ascending numbers"),
    (side("2", "0", "1"), ("0", "1/2"), "ascending numbers"),
    (side("2", "0", "1"), ("1/2", "1"), "ascending numbers"),
    (side("2", "0", "1"), ("0", "1/2", "1/2", "1"), "ascending numbers"),
    (side("2", "0", "1"), ("0", "2/3", "1/3", "1"), "ascending numbers"),
    (None, (), "expected an object"),
)
def test_what_is_refused(condition: Any, breaks: tuple[str, ...], reason: str) -> None:
    with pytest.raises(CertificateRejected, match=reason):
        check_containment(payload(condition, *breaks))


def test_the_break_that_fails_is_named() -> None:
    with pytest.raises(CertificateRejected) as error:
        check_containment(payload(side("3/4", "0", "1"), "0", "1/4", "1"))
    assert error.value.step == "payload.breaks[2]"


FIELD = RootField((0, 1), Fraction(0), Fraction(0), "rationals")
VALUES = st.lists(st.fractions(-2, 2, max_denominator=3), min_size=1, max_size=4)
PLACES = [Fraction(k, 5) for k in range(6)]


def residues(values: list[Fraction]) -> list[Residue]:
    return [of_rationals([v]) for v in values]


def value(b: list[Residue], t: Fraction) -> Fraction:
    n = len(b) - 1
    numbers = [Fraction(*(x.coefficients or (0,)), x.denominator) for x in b]
    return sum((comb(n, k) * t**k * (1 - t) ** (n - k) * v for k, v in enumerate(numbers)), Fraction(0))


@given(VALUES, VALUES)
def test_a_product_has_the_product_of_the_values(a: list[Fraction], b: list[Fraction]) -> None:
    u, v = residues(a), residues(b)
    found = product(u, v, FIELD)
    assert len(found) == len(a) + len(b) - 1
    assert all(value(found, t) == value(u, t) * value(v, t) for t in PLACES)


@given(VALUES, st.integers(0, 5), st.integers(1, 6))
def test_a_restriction_has_the_values_on_its_interval(a: list[Fraction], low: int, size: int) -> None:
    start, end = Fraction(low, 6), min(Fraction(low + size, 6), Fraction(1))
    u = residues(a)
    found = restricted(u, start, end)
    assert all(value(found, t) == value(u, start + t * (end - start)) for t in PLACES)


def test_constants_and_sums() -> None:
    assert [value(constant(Fraction(3, 2), 4), t) for t in PLACES] == [Fraction(3, 2)] * 6
    assert total(residues([Fraction(1), Fraction(1, 2)])) == of_rationals([Fraction(3, 2)])
    assert total([]).is_zero


def test_points_have_one_dimension_and_are_not_too_many() -> None:
    def read(points: list[list[list[str]]]) -> int:
        return len(read_points(Entry(points, "points"), FIELD))  # type: ignore[arg-type]

    assert read([[["0"], ["1"]], [["2"], ["3"]]]) == 2
    assert read([[["0"]]] * 65) == 65
    for wrong in ([], [[]], [[["0"], ["1"]], [["2"]]], [[["0"]]] * 66):
        with pytest.raises(CertificateRejected):
            read(wrong)
