"""Zeros of polynomials: at algebraic points, at angles, near others, known beforehand."""

from fractions import Fraction
from fractions import Fraction as F
from math import cos, sin, sqrt

import pytest
from flint import fmpq, fmpq_mat

from qe.errors import Unable
from qe.exact.algebraic import RealAlgebraic
from qe.exact.fibre_stack import isolate_over
from qe.exact.field import NumberField
from qe.exact.nearby import nearby, rational_between
from qe.exact.remainder import divides
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.exact.tower import Tower
from qe.exact.zeros import Zero, zeros_of
from qe.exact.zeros_at_angle import zeros_at_angle
from tests.tables import each


def over_basis(points: list[tuple[int, int]], exponents: list[tuple[int, int]]) -> list[fmpq_mat]:
    """Multiplication matrices of the ideal of rational points, in these monomials."""
    size = len(points)
    values = fmpq_mat(size, size, [fmpq(x**i * y**j) for x, y in points for i, j in exponents])
    matrices = []
    for axis in (0, 1):
        times = fmpq_mat(size, size)
        for k, point in enumerate(points):
            times[k, k] = fmpq(point[axis])
        matrices.append(values.inv() * times * values)
    return matrices


def traces(matrices: list[fmpq_mat], exponents: list[tuple[int, int]]) -> fmpq_mat:
    """The traces of the multiplications by the basis, as a row."""
    size = len(exponents)
    found = []
    for i, j in exponents:
        product = fmpq_mat(size, size, [fmpq(int(r == c)) for r in range(size) for c in range(size)])
        for m, power in zip(matrices, (i, j), strict=True):
            for _ in range(power):
                product = product * m
        found.append(sum((product[k, k] for k in range(size)), fmpq(0)))
    return fmpq_mat(1, size, found)


def coordinates(zero: Zero) -> tuple[Fraction, ...]:
    return tuple(value.to_algebraic().as_fraction() for value in zero.values.values())


@each(
    ([(0, 0), (1, 2), (3, -1)], [(0, 0), (1, 0), (0, 1)]),
    ([(1, 1), (1, -1), (-1, 1), (-1, -1)], [(0, 0), (1, 0), (0, 1), (1, 1)]),  # no variable separates them
)
def test_rational_points_are_found_again(points: list[tuple[int, int]], exponents: list[tuple[int, int]]) -> None:
    matrices = over_basis(points, exponents)
    found = zeros_of(matrices, traces(matrices, exponents), len(points), ("x", "y"))
    assert sorted(map(coordinates, found)) == sorted(points)
    assert {zero.multiplicity for zero in found} == {1}


def test_a_double_zero_and_zeros_that_are_not_real() -> None:
    """(x - 1)^2 * (x^2 + 1) * (x^2 - 2): the companion matrix."""
    coefficients = [-2, 4, -3, 2, 0, -2]  # of the monic polynomial, from degree 0 up
    size = len(coefficients)
    companion = fmpq_mat(size, size)
    for i in range(1, size):
        companion[i, i - 1] = fmpq(1)
    for i, c in enumerate(coefficients):
        companion[i, size - 1] = fmpq(-c)
    powers = [(k, 0) for k in range(size)]
    row = traces([companion, fmpq_mat(size, size)], powers)
    found = zeros_of([companion], row, 5, ("x",))
    told = [(zero.values["x"].to_algebraic(), zero.multiplicity) for zero in found]
    assert [m for _, m in told] == [1, 2, 1]
    assert [value.minimal_polynomial for value, _ in told] == [(-2, 0, 1), (-1, 1), (-2, 0, 1)]
    low, high = found[2].box(40)["x"]
    assert low * low < 2 < high * high  # type: ignore[operator]


RING = Ring.of(("w", "s", "c", "z"))
W, S, C, Z = (RING.gen(k) for k in range(4))
ROOT = NumberField.from_root([-2, 0, 1], 1, 2).theta


@each(Fraction(3), Fraction(-1, 2), Fraction(22, 7))
@each(
    (S * C - Z, lambda w, c, z: [z / c]),
    (S**2 - W * C * S + 10 * Z**2, lambda w, c, z: []),
    ((S - W) * (S * C - W * Z), lambda w, c, z: sorted((w, w * z / c))),
    (C * W + Z, lambda w, c, z: []),
    (S**2 + C, lambda w, c, z: [-sqrt(-c), sqrt(-c)] if c < 0 else []),
)
def test_zeros_are_told_apart(p: Poly, expected, angle: Fraction) -> None:
    w, c, z = sqrt(2), cos(angle), sin(angle)
    if 2 * c * c > 40 * z * z:
        return  # the second one has zeros then
    found = zeros_at_angle(p, 1, ROOT, angle, 100)
    assert found is not None
    assert [float(low) for low, _ in found] == pytest.approx(expected(w, c, z))
    assert all(low <= high < low + Fraction(1, 1 << 40) for low, high in found)


def test_double_zeros_are_not() -> None:
    assert zeros_at_angle((S - C) ** 2, 1, ROOT, Fraction(1), 64) is None


PLANE = Ring.of(("x", "y"))
X, Y = PLANE.gen(0), PLANE.gen(1)
SQRT2 = RealAlgebraic.from_root((-2, 0, 1), 1, 2)


def signs(polys: list[Poly], values: tuple[F, ...]) -> list[int]:
    return [(v > 0) - (v < 0) for v in (p.evaluate(values) for p in polys)]


def test_off_the_zeros_signs_stay() -> None:
    point = Point.of(PLANE, [SQRT2, F(1, 3)])
    polys = [10**12 * (X * X - 2) + Y, X - Y, 7 * X - 10 + Y * Y]
    found = nearby(point, polys, frozenset(), None)
    assert signs(polys, found) == [point.sign(p) for p in polys]


def test_from_a_zero_into_the_direction_of_the_centre() -> None:
    point = Point.of(PLANE, [SQRT2, SQRT2])
    circle, line = X * X + Y * Y - 4, X - Y
    inwards = nearby(point, [circle, line + 1], frozenset((circle,)), (F(0), F(0)))
    assert signs([circle, line + 1], inwards) == [-1, 1]
    outwards = nearby(point, [circle], frozenset((circle,)), (F(3), F(3)))
    assert signs([circle], outwards) == [1]


def test_tangential_and_singular_beginnings() -> None:
    cusp = Y * Y - X * X * X
    point = Point.of(PLANE, [0, 0])
    assert signs([cusp], nearby(point, [cusp], frozenset((cusp,)), (F(1), F(0)))) == [-1]
    assert signs([cusp], nearby(point, [cusp], frozenset((cusp,)), (F(0), F(1)))) == [1]
    with pytest.raises(Unable):
        nearby(point, [X - Y], frozenset((X - Y,)), (F(1), F(1)))


@each((SQRT2, F(3, 2)), (F(7, 5), SQRT2), (None, SQRT2), (SQRT2, None), (-SQRT2, SQRT2), (None, None))
def test_rational_between(low: object, high: object) -> None:
    found = rational_between(low, high)  # type: ignore[arg-type]
    assert isinstance(found, F)
    assert low is None or low < found
    assert high is None or found < high


def test_rational_between_is_simple() -> None:
    assert rational_between(RealAlgebraic.from_root((11, -8, 1), 1, 2), RealAlgebraic.from_root((-5, 0, 1), 2, 3)) == 2
    assert rational_between(F(5), None) > 5 and rational_between(None, F(-5)) < -5


SPACE = Ring.of(("x", "y", "z"))
x, y, z = (SPACE.gen(i) for i in range(3))


def over(point: Point, f: Poly) -> Point:
    """The highest root of f over the point."""
    isolation = isolate_over(point, (f,))
    return isolation.sample(2 * len(isolation.sections) - 1)


@pytest.fixture
def point() -> Point:
    return over(over(Point(SPACE), x**3 - 2 * x - 1 - x**2), y**3 - x * y + 1 - 3 * x)


def test_multiples_of_a_section_vanish_without_the_tower(point: Point, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*given: object) -> object:
        raise AssertionError("the tower was asked")

    monkeypatch.setattr(Tower, "is_zero", refuse)
    monkeypatch.setattr(Point, "tower", property(refuse))
    assert point.is_zero((y**3 - x * y + 1 - 3 * x) * (y**5 + x**7 * y + 1))
    assert point.is_zero((x**3 - 2 * x - 1 - x**2) ** 2 * (y - 1))


def test_other_polynomials_are_still_decided(point: Point) -> None:
    f = y**3 - x * y + 1 - 3 * x
    assert not point.is_zero(f + 1)
    assert not point.is_zero(y**3 - x * y + 2)
    assert point.is_zero(f * f + (x**3 - 2 * x - 1 - x**2) * y)  # in the ideal, divided by neither


def test_sectors_know_nothing() -> None:
    isolation = isolate_over(Point(SPACE), (x**2 - 2,))
    assert isolation.sample(0).vanishing == ()
    assert isolation.sample(1).vanishing == (x**2 - 2,)


def test_divides() -> None:
    assert divides(x - y, 3 * (x**2 - y**2)) and divides(2 * x - 2 * y, x**2 - y**2)
    assert not divides(x - y, x**2 + y**2) and not divides(x * y, x)
