"""Quadratic polynomials over Q and exact linear algebra over any ordered field with an exact sign.

Everything here is generic in the number type: ``Fraction`` and ``qe.exact.field.FieldElement`` both work.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from math import gcd
from typing import Any

from flint import fmpq, fmpq_mat, fmpz_mat

from qe.exact.ring import Poly

# A number with + - * / and comparison with 0: Fraction or FieldElement.
Number = Any
Vector = Sequence[Number]
Matrix = Sequence[Sequence[Number]]


class Definiteness(Enum):
    """What LDL^T proves about a symmetric matrix."""

    POSITIVE_DEFINITE = "positive definite"
    POSITIVE_SEMIDEFINITE = "positive semidefinite"
    NOT_SEMIDEFINITE = "not positive semidefinite"


@dataclass(frozen=True, slots=True)
class Quadratic:
    """q(x) = x^T H x / 2 + b.x + c over Q. Invariant: ``hessian`` is symmetric, of the size of ``gradient``."""

    hessian: tuple[tuple[Fraction, ...], ...]
    gradient: tuple[Fraction, ...]
    constant: Fraction

    @staticmethod
    def linear(gradient: Sequence[Fraction], constant: Fraction | int = 0) -> Quadratic:
        """b.x + c."""
        return Quadratic(((Fraction(0),) * len(gradient),) * len(gradient), tuple(gradient), Fraction(constant))

    @property
    def size(self) -> int:
        """The number of variables."""
        return len(self.gradient)

    @property
    def is_linear(self) -> bool:
        """Whether nothing is quadratic."""
        return not any(any(row) for row in self.hessian)

    def value(self, x: Vector) -> Number:
        """q(x), exactly."""
        total: Number = self.constant
        for i, row in enumerate(self.hessian):
            inner: Number = self.gradient[i]
            if row[i]:
                inner = inner + x[i] * (row[i] / 2)
            for j in range(i + 1, len(row)):
                if row[j]:
                    inner = inner + x[j] * row[j]
            if not isinstance(inner, Fraction) or inner:
                total = total + x[i] * inner
        return total

    def slope(self, x: Vector) -> list[Number]:
        """The gradient H x + b at x."""
        return [dot(row, x, start) for row, start in zip(self.hessian, self.gradient, strict=True)]

    def stationary(self) -> Solution | None:
        """Where the gradient is zero; None where it is nowhere."""
        return solve_linear(self.hessian, [-b for b in self.gradient], self.size)

    def restrict(self, origin: Sequence[Fraction], basis: Sequence[Sequence[Fraction]]) -> Quadratic:
        """z -> q(origin + sum z_k basis_k): again a quadratic polynomial."""
        images = [[dot(row, v) for row in self.hessian] for v in basis]
        slope = self.slope(origin)
        hessian = tuple(tuple(dot(u, image) for u in basis) for image in images)
        gradient = tuple(dot(slope, v) for v in basis)
        return Quadratic(hessian, gradient, Fraction(self.value(origin)))


def combine(weights: Sequence[Fraction], parts: Sequence[Quadratic]) -> Quadratic:
    """The linear combination of quadratic polynomials of one size (at least one part)."""
    n = parts[0].size
    pairs = [(w, q) for w, q in zip(weights, parts, strict=True) if w]
    zero = Fraction(0)
    hessian = tuple(tuple(sum((w * q.hessian[i][j] for w, q in pairs), zero) for j in range(n)) for i in range(n))
    gradient = tuple(sum((w * q.gradient[i] for w, q in pairs), zero) for i in range(n))
    return Quadratic(hessian, gradient, sum((w * q.constant for w, q in pairs), zero))


def quadratic(poly: Poly, variables: Sequence[int]) -> Quadratic | None:
    """The polynomial as a quadratic one in these ring variables (which must be all that occur); None above degree 2."""
    if poly.total_degree > 2:
        return None
    place = {v: k for k, v in enumerate(variables)}
    n = len(variables)
    hessian = [[Fraction(0)] * n for _ in range(n)]
    gradient, constant = [Fraction(0)] * n, Fraction(0)
    for exponents, coefficient in poly.terms():
        occurring = [place[v] for v, e in enumerate(exponents) for _ in range(e)]
        if not occurring:
            constant += coefficient
        elif len(occurring) == 1:
            gradient[occurring[0]] += coefficient
        else:
            i, j = occurring
            hessian[i][j] += coefficient
            hessian[j][i] += coefficient
    return Quadratic(tuple(map(tuple, hessian)), tuple(gradient), constant)


def dot(u: Vector, v: Vector, start: Number = Fraction(0)) -> Number:
    """The scalar product, and ``start``."""
    total = start
    for a, b in zip(u, v, strict=True):
        if a and b:
            total = total + a * b
    return total


def _exact(entry: Number) -> Number:
    return Fraction(entry) if isinstance(entry, int) else entry


def definiteness(matrix: Matrix) -> Definiteness:
    """Decide semidefiniteness by LDL^T with symmetric pivoting.

    A symmetric matrix is positive semidefinite iff elimination with pivots from the diagonal meets no negative
    pivot and, once all remaining diagonal entries are zero, the remaining block is zero (Golub–Van Loan, 4.2.8).
    """
    m = [[_exact(entry) for entry in row] for row in matrix]
    left = list(range(len(m)))
    while left:
        if any(m[i][i] < 0 for i in left):
            return Definiteness.NOT_SEMIDEFINITE
        pivot = next((i for i in left if m[i][i] > 0), None)
        if pivot is None:
            if any(m[i][j] != 0 for i in left for j in left):
                return Definiteness.NOT_SEMIDEFINITE
            return Definiteness.POSITIVE_SEMIDEFINITE
        left.remove(pivot)
        for i in left:
            if m[i][pivot]:
                factor = m[i][pivot] / m[pivot][pivot]
                for j in left:
                    m[i][j] = m[i][j] - factor * m[pivot][j]
    return Definiteness.POSITIVE_DEFINITE


@dataclass(frozen=True, slots=True)
class Solution:
    """All solutions of a linear system: ``particular`` + span(``kernel``); ``free`` are the non-pivot columns."""

    particular: tuple[Number, ...]
    kernel: tuple[tuple[Number, ...], ...]
    free: tuple[int, ...]


def echelon(rows: Matrix) -> tuple[list[list[Number]], list[int]]:
    """The nonzero rows of the reduced row echelon form, which is unique, and their pivot columns, ascending.

    Over Q by FLINT; over a field of algebraic numbers by Gauss and Jordan.
    """
    work = [[_exact(entry) for entry in row] for row in rows]
    if not work or not work[0]:
        return [], []
    if all(isinstance(entry, Fraction) for row in work for entry in row):
        none, zero = fmpq(0), Fraction(0)  # most entries
        flat = [fmpq(entry.numerator, entry.denominator) if entry else none for row in work for entry in row]
        reduced, rank = fmpq_mat(len(work), len(work[0]), flat).rref()
        work = [[Fraction(int(e.p), int(e.q)) if e else zero for e in row] for row in reduced.tolist()[:rank]]
        return work, [next(c for c, entry in enumerate(row) if entry) for row in work]
    pivots: list[int] = []
    for column in range(len(work[0])):
        top = len(pivots)
        pivot = next((r for r in range(top, len(work)) if work[r][column]), None)
        if pivot is None:
            continue
        work[top], work[pivot] = work[pivot], work[top]
        scale = 1 / work[top][column]
        work[top] = [entry * scale if entry else entry for entry in work[top]]
        for r, row in enumerate(work):
            if r != top and row[column]:
                factor = row[column]
                work[r] = [a - factor * b if b else a for a, b in zip(row, work[top], strict=True)]
        pivots.append(column)
    return work[: len(pivots)], pivots


def solve_linear(rows: Matrix, rhs: Vector, width: int) -> Solution | None:
    """All x with rows.x = rhs (``width`` unknowns); None when there is none.

    Free unknowns are zero in ``particular``. Pivots are taken from the leftmost columns.
    """
    work, pivots = echelon([[*row, b] for row, b in zip(rows, rhs, strict=True)])
    if width in pivots:
        return None
    zero, one = Fraction(0), Fraction(1)
    particular: list[Number] = [zero] * width
    for r, column in enumerate(pivots):
        particular[column] = work[r][width]
    free = tuple(c for c in range(width) if c not in pivots)
    kernel = []
    for c in free:
        vector: list[Number] = [zero] * width
        vector[c] = one
        for r, column in enumerate(pivots):
            vector[column] = -work[r][c]
        kernel.append(tuple(vector))
    return Solution(tuple(particular), tuple(kernel), free)


def integer_combinations(
    columns: Sequence[Mapping[Any, int]], targets: Sequence[Mapping[Any, int]]
) -> list[tuple[int, list[int]] | None]:
    """For each target (n, c) with n > 0 and n times it the sum of the c times the columns, or None where it is none.

    Columns and targets give the entries that are not 0, by row.
    """
    rows = {row: k for k, row in enumerate(dict.fromkeys(row for column in columns for row in column))}
    inside = [target for target in targets if rows.keys() >= target.keys()]
    width = len(columns)
    matrix = fmpz_mat(len(rows), width + len(inside))
    for c, column in enumerate((*columns, *inside)):
        for row, value in column.items():
            matrix[rows[row], c] = value
    reduced, scale, rank = matrix.rref() if rows else (matrix, 1, 0)
    pivots, column_of = list[int](), 0
    for r in range(rank):
        column_of = next(c for c in range(column_of, width + len(inside)) if reduced[r, c])
        pivots.append(column_of)
    sign = 1 if scale > 0 else -1
    solved = list[tuple[int, list[int]] | None]()
    for target in targets:
        solution: tuple[int, list[int]] | None = None
        if rows.keys() >= target.keys():
            c = width + inside.index(target)
            entries = {pivot: int(reduced[r, c]) for r, pivot in enumerate(pivots) if reduced[r, c]}
            if all(pivot < width for pivot in entries):
                common = gcd(int(scale), *entries.values())
                solution = sign * int(scale) // common, [sign * entries.get(k, 0) // common for k in range(width)]
        solved.append(solution)
    return solved


def independent_rows(rows: Matrix) -> tuple[int, ...]:
    """Indices of a maximal linearly independent subset of the rows, the earliest ones."""
    return tuple(echelon(list(zip(*rows, strict=True)))[1])
