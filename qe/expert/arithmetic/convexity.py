"""Quadratic polynomials for the checker: their matrices, values, gradients, convexity by LDL^T, rank; exact numbers."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from flint import fmpq

from qe.exact.ring import Poly

Row = Sequence[Any]
"""Numbers of one kind, or of kinds that may be multiplied with each other."""


@dataclass(frozen=True, slots=True)
class Quadratic:
    """A polynomial p of degree at most 2 over a number: v^T M v for v, its variables and 1."""

    poly: Poly
    matrix: tuple[tuple[Any, ...], ...]

    @staticmethod
    def of(poly: Poly, scale: int = 1, number: Callable[[int, int], Any] = fmpq) -> Quadratic:
        """poly/scale, which is of degree at most 2."""
        size = poly.ring.size + 1
        matrix = [[number(0, 1)] * size for _ in range(size)]
        for exponents, coefficient in poly.terms():
            i, j = (i for i, e in enumerate((*exponents, 2 - sum(exponents))) for _ in range(e))
            matrix[i][j] += number(coefficient, 2 * scale)
            matrix[j][i] += number(coefficient, 2 * scale)
        return Quadratic(poly, tuple(map(tuple, matrix)))

    @property
    def is_convex(self) -> bool:
        """Whether it is convex in its variables."""
        return is_convex([row[:-1] for row in self.matrix[:-1]])

    @property
    def hessian(self) -> list[Row]:
        """The matrix of second derivatives."""
        return [[2 * c for c in row[:-1]] for row in self.matrix[:-1]]

    def value(self, v: Row) -> Any:
        """The value at a point, which ends with 1."""
        return inner(v, (inner(row, v) for row in self.matrix))

    def gradient(self, v: Row) -> Row:
        """The derivatives at a point, which ends with 1."""
        return [2 * inner(row, v) for row in self.matrix[:-1]]


def inner(a: Iterable[Any], b: Iterable[Any]) -> Any:
    """The sum of the products of entries; 0 where all of these are."""
    return sum(x * y for x, y in zip(a, b, strict=True) if x and y)


def is_convex(matrix: Sequence[Row]) -> bool:
    """Whether a symmetric matrix is positive semidefinite: symmetric elimination, one diagonal entry at a time.

    A zero diagonal entry of a positive semidefinite matrix forces a zero row; a positive one is eliminated, and the
    Schur complement is positive semidefinite iff the matrix is.
    """
    m = [list(row) for row in matrix]
    for k in range(len(m)):
        pivot = m[k][k]
        if pivot < 0 or (pivot == 0 and any(m[k][j] for j in range(k, len(m)))):
            return False
        if pivot == 0:
            continue
        for i in range(k + 1, len(m)):
            factor = m[i][k] / pivot
            if factor:
                for j in range(k, len(m)):
                    m[i][j] -= factor * m[k][j]
    return True


def rank(rows: Iterable[Row]) -> int:
    """The rank of a rational matrix."""
    work, found = [list(row) for row in rows if any(row)], 0
    while work:
        row = work.pop()
        lead = next((i for i, v in enumerate(row) if v), None)
        if lead is None:
            continue
        found += 1
        for other in work:
            if other[lead]:
                factor = other[lead] / row[lead]
                for j, v in enumerate(row):
                    other[j] -= factor * v
    return found
