"""Integers and fractions under the names of python-flint, and determinants."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

fmpz = int


class DomainError(ArithmeticError):
    """A division that is not exact."""


def _closed(operation: Callable[..., Fraction]) -> Any:
    """The operation of fractions with values here."""

    def applied(self: fmpq, *others: fmpq | int) -> fmpq:
        value = operation(self, *others)
        return value if value is NotImplemented else fmpq(value)

    return applied


class fmpq(Fraction):
    """A fraction in lowest terms: numerator ``p``, denominator ``q`` > 0."""

    __slots__ = ()
    p, q = Fraction.numerator, Fraction.denominator
    __neg__, __abs__ = _closed(Fraction.__neg__), _closed(Fraction.__abs__)
    __add__, __radd__ = _closed(Fraction.__add__), _closed(Fraction.__radd__)
    __sub__, __rsub__ = _closed(Fraction.__sub__), _closed(Fraction.__rsub__)
    __mul__, __rmul__ = _closed(Fraction.__mul__), _closed(Fraction.__rmul__)
    __truediv__, __rtruediv__ = _closed(Fraction.__truediv__), _closed(Fraction.__rtruediv__)
    __pow__ = _closed(Fraction.__pow__)


class fmpz_mat:
    """A matrix of integers."""

    def __init__(self, rows: Sequence[Sequence[int]]) -> None:
        self.rows = [list(row) for row in rows]

    def det(self) -> int:
        """The determinant, by elimination without fractions (Bareiss, Math. Comp. 22, 1968)."""
        rows, sign, last = [row[:] for row in self.rows], 1, 1
        while len(rows) > 1:
            pivot = next((k for k, row in enumerate(rows) if row[0]), None)
            if pivot is None:
                return 0
            if pivot:
                rows[0], rows[pivot], sign = rows[pivot], rows[0], -sign
            first, *top = rows[0]
            rows = [
                [(first * a - row[0] * b) // last for a, b in zip(row[1:], top, strict=True)]
                if row[0]
                else [first * a // last for a in row[1:]]
                for row in rows[1:]
            ]
            last = first
        return sign * rows[0][0] if rows else 1
