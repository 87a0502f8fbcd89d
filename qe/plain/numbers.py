"""Integers and fractions under the names of python-flint, and determinants."""

from __future__ import annotations

from collections.abc import Sequence
from functools import total_ordering
from math import gcd

fmpz = int


class DomainError(ArithmeticError):
    """A division that is not exact."""


@total_ordering
class fmpq:
    """A fraction in lowest terms: numerator ``p``, denominator ``q`` > 0."""

    __slots__ = ("p", "q")
    p: int
    q: int

    def __new__(cls, p: int | fmpq = 0, q: int = 1) -> fmpq:
        if isinstance(p, fmpq):
            return p if q == 1 else p / q
        if not q:
            raise ZeroDivisionError("cannot create rational number with zero denominator")
        self, common = super().__new__(cls), gcd(p, q) if q > 0 else -gcd(p, q)
        self.p, self.q = p // common, q // common
        return self

    def __eq__(self, other: object) -> bool:
        if isinstance(other, int):
            return self.q == 1 and self.p == other
        return isinstance(other, fmpq) and self.p == other.p and self.q == other.q

    def __lt__(self, other: fmpq | int) -> bool:
        p, q = _parts(other)
        return self.p * q < p * self.q

    def __hash__(self) -> int:
        return hash((self.p, self.q)) if self.q != 1 else hash(self.p)

    def __bool__(self) -> bool:
        return self.p != 0

    def __repr__(self) -> str:
        return f"{self.p}/{self.q}" if self.q != 1 else str(self.p)

    def __neg__(self) -> fmpq:
        return fmpq(-self.p, self.q)

    def __abs__(self) -> fmpq:
        return fmpq(abs(self.p), self.q)

    def __add__(self, other: fmpq | int) -> fmpq:
        p, q = _parts(other)
        return fmpq(self.p * q + p * self.q, self.q * q)

    __radd__ = __add__

    def __sub__(self, other: fmpq | int) -> fmpq:
        p, q = _parts(other)
        return fmpq(self.p * q - p * self.q, self.q * q)

    def __rsub__(self, other: int) -> fmpq:
        return -self + other

    def __mul__(self, other: fmpq | int) -> fmpq:
        p, q = _parts(other)
        return fmpq(self.p * p, self.q * q)

    __rmul__ = __mul__

    def __truediv__(self, other: fmpq | int) -> fmpq:
        p, q = _parts(other)
        return fmpq(self.p * q, self.q * p)

    def __rtruediv__(self, other: int) -> fmpq:
        return fmpq(other * self.q, self.p)

    def __pow__(self, exponent: int) -> fmpq:
        if exponent < 0:
            return fmpq(self.q, self.p) ** -exponent
        return fmpq(self.p**exponent, self.q**exponent)


def _parts(value: fmpq | int) -> tuple[int, int]:
    return (value, 1) if isinstance(value, int) else (value.p, value.q)


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
