"""Common zeros by least squares: isolated ones, one of many, none."""

from collections.abc import Sequence

from qe.exact.near_zeros import NearZeros
from qe.exact.ring import Ring
from tests.tables import each

RING = Ring.of(("x", "y"))
X, Y = RING.var("x"), RING.var("y")


@each(
    ((X * X + Y * Y - 1, X - Y), (1, 1), ("sqrt(2)/2", "sqrt(2)/2")),
    ((X**3 - 2, Y + 3), (-4, 7), ("root(1, x^3 - 2)", "-3")),
    ((X * X - 2 * Y, Y - 8), (-1, 0), ("-4", "8")),
)
def test_isolated_zeros_are_recognised(polys: tuple, start: Sequence[float], numbers: tuple[str, str]) -> None:
    spent: list[int] = []
    zeros = NearZeros.of(polys, spent.append)
    point, is_zero = zeros.near(start, 64)
    assert is_zero and sum(spent) > 0
    assert tuple(str(zeros.coordinate(i, point, 3)) for i in range(2)) == numbers


def test_zeros_that_are_not_isolated_are_reached() -> None:
    point, is_zero = NearZeros.of([(X * Y - 1) ** 2 * X + X * Y - 1], lambda units: None).near((3, 2), 200)
    assert is_zero and abs(float(point[0] * point[1]) - 1) < 1e-12


def test_where_there_is_none() -> None:
    zeros = NearZeros.of([X * X + Y * Y + 1], lambda units: None)
    point, is_zero = zeros.near((1, 2), 64)
    assert not is_zero and zeros.coordinate(0, point, 1) is None


def test_unknowns_that_are_fixed() -> None:
    point, _ = NearZeros.of([X * Y - 6], lambda units: None).near((2, 1), 64, {0})
    assert (float(point[0]), float(point[1])) == (2, 3)
