"""Triangular points and fibres over them, on cases with known answers."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import pytest

from qe.errors import InternalError
from qe.exact.ring import Poly, Ring
from qe.formula.build import convert
from qe.io.text import read
from qe.kernel.arithmetic.fibre import AlgebraicFibre, SimplePart, fibre, lazard_evaluation, values
from qe.kernel.arithmetic.triangular import ORIGIN, Coordinate, Point

RING = Ring.of(("x", "y", "z"))


def poly(text: str) -> Poly:
    found = convert(read(f"{text} = 0"), RING)
    return found.poly  # type: ignore[attr-defined,no-any-return]


def point(*systems: tuple[str, int, int]) -> Point:
    """Each coordinate: polynomial and the ends of its interval; the polynomial rises there."""
    built = ORIGIN
    for i, (text, low, high) in enumerate(systems):
        built = built.extended(Coordinate(i, poly(text), Fraction(low), Fraction(high), 1))
    return built


SQRT2 = point(("x^2 - 2", 1, 2))
FOURTH = point(("x^2 - 2", 1, 2), ("y^2 - x", 1, 2))  # y = 2^(1/4)
SPLIT = point(("x^2 - 2", 1, 2), ("y^2 - 2", 1, 2))  # the second polynomial is reducible over the first


@pytest.mark.parametrize(
    ("at", "text", "sign"),
    [
        (SQRT2, "x^2 - 2", 0),
        (SQRT2, "x^4 - 4", 0),
        (SQRT2, "1414213562373095048801688724209698078569*x - 2000000000000000000000000000000000000000", -1),
        (SQRT2, "x + 1", 1),
        (FOURTH, "y^4 - 2", 0),
        (FOURTH, "y^3 - x*y", 0),
        (FOURTH, "y - x", -1),
        (SPLIT, "x - y", 0),
        (SPLIT, "x + y", 1),
        (SPLIT, "x*y - 2", 0),
    ],
)
def test_signs(at: Point, text: str, sign: int) -> None:
    assert at.sign(poly(text)) == sign
    assert at.sign(poly(f"-({text})")) * -1 == sign or poly(f"-({text})") == poly(text)
    assert at.vanishes(poly(text)) is (sign == 0)


def test_a_variable_without_a_value_is_refused() -> None:
    with pytest.raises(InternalError):
        SQRT2.sign(poly("y - 1"))


@pytest.mark.parametrize(
    ("text", "degree", "count"),
    [
        ("z^2 - x", 2, 2),
        ("z^2 + y", 2, 0),
        ("(z - y)^2*(z^2 - x)*(z - 3)", 5, 3),  # z = y is a root of the second factor too
        ("(z - y)^2*(z - x)^2", 4, 2),
        ("(z - y)^2*(z^2 + x)", 4, 1),
        ("(z - y)^3*(z + 1)", 4, 2),
        ("(y^2 - x)*z^3 + z - y", 1, 1),
        ("z^4 - 3*x*z^2 + z", 4, 4),
    ],
)
def test_counts_over_a_tower(text: str, degree: int, count: int) -> None:
    f = fibre(FOURTH, poly(text), 2)
    assert isinstance(f, AlgebraicFibre)
    assert (f.degree, f.count(), f.count_by_remainders(), f.squarefree().count()) == (degree, count, count, count)


def test_double_roots_are_split_off_without_division() -> None:
    f = fibre(FOURTH, poly("(z - y)^2*(z^2 - 3)"), 2)
    assert isinstance(f, AlgebraicFibre)
    simple = f.squarefree()
    assert isinstance(simple, SimplePart)
    assert simple.degree == 3
    at = values(tuple(Fraction(v) for v in (-2, 0, Fraction(3, 2), 2)))
    assert f.signs(at) == [1, -1, -1, 1]
    changes = simple.signs(at)
    assert [a != b for a, b in pairwise(changes)] == [True, True, True]
    for low, high, value in [(0, Fraction(3, 2), "z - y"), (Fraction(3, 2), 2, "z^2 - 3"), (-2, 0, "z^2 - 3")]:
        number = simple.coordinate(Fraction(low), Fraction(high))
        assert isinstance(number, Coordinate)
        assert FOURTH.extended(number).sign(poly(value)) == 0


def test_common_roots_are_found_and_told_from_near_ones() -> None:
    f, g = (fibre(FOURTH, poly(t), 2) for t in ("z^3 - x*z + y - 1", "z^2 - x"))
    h = fibre(FOURTH, poly("z^4 - 2"), 2)
    assert isinstance(g, AlgebraicFibre)
    assert g.gcd(AlgebraicFibre(FOURTH, 2, poly("z^4 - x^2"))).degree == 2
    assert g.gcd(AlgebraicFibre(FOURTH, 2, poly("(z - y)*(z - 5)"))).degree == 1
    assert f.gcd(g).degree == 0
    assert h.count() == 2
    near = AlgebraicFibre(FOURTH, 2, poly("z^2 - x*z + y*z - x*y"))  # roots x and -y
    common = g.gcd(near)
    low, middle, high = common.signs(values((Fraction(-2), Fraction(0), Fraction(2))))
    assert common.degree == 1 and low == -middle and middle == high


def test_lazard_evaluation_keeps_the_hidden_root() -> None:
    """(x - a)*(z - 1) + (x - a)^2*z over x = a leaves z - 1."""
    f = poly("(x^2 - 2)*(z - 1) + (x^2 - 2)^2*z")
    evaluated = fibre(SQRT2, lazard_evaluation(f, SQRT2, {1: Fraction(0)}, 2), 2)
    assert evaluated.degree == 1
    assert evaluated.signs(values((Fraction(1, 2), Fraction(1), Fraction(3, 2)))) == [-1, 0, 1]
    rational = lazard_evaluation(poly("x^2*z - x*y^2*z - x^3"), ORIGIN, {0: Fraction(0), 1: Fraction(0)}, 2)
    assert rational.normal()[1] == poly("z")
