"""The zeros of an ideal from its multiplication matrices: all of them, with their coordinates and multiplicities."""

from __future__ import annotations

from fractions import Fraction

from flint import fmpq, fmpq_mat

from qe.exact.zeros import Zero, zeros_of
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
