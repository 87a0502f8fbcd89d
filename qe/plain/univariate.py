"""Polynomials in one variable with integer coefficients under the name of python-flint."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import zip_longest
from math import gcd
from typing import Any

from qe.plain import factors
from qe.plain.numbers import DomainError, fmpq
from qe.plain.terms import common_divisor


class fmpz_poly:
    """A polynomial by its coefficients from degree 0 up; immutable."""

    __slots__ = ("c",)

    def __init__(self, coefficients: Iterable[int] | fmpz_poly | int = ()) -> None:
        if isinstance(coefficients, int):
            coefficients = (coefficients,)
        c = list(coefficients.c if isinstance(coefficients, fmpz_poly) else coefficients)
        while c and not c[-1]:
            c.pop()
        self.c = c

    # --- structure -------------------------------------------------------------------------
    def degree(self) -> int:
        """The degree, -1 for zero."""
        return len(self.c) - 1

    def coeffs(self) -> list[int]:
        """The coefficients from degree 0 up; the last one is not 0."""
        return list(self.c)

    def __getitem__(self, k: int) -> int:
        return self.c[k] if 0 <= k < len(self.c) else 0

    def leading_coefficient(self) -> int:
        """The coefficient of the highest power, 0 for zero."""
        return self.c[-1] if self.c else 0

    def content(self) -> int:
        """The greatest common divisor of the coefficients."""
        return gcd(*self.c)

    def height_bits(self) -> int:
        """The bit length of the largest coefficient."""
        return max((c.bit_length() for c in self.c), default=0)

    def __bool__(self) -> bool:
        return bool(self.c)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, fmpz_poly | int) and self.c == fmpz_poly(other).c

    def __hash__(self) -> int:
        return hash(tuple(self.c))

    def __repr__(self) -> str:
        return f"fmpz_poly({self.c})"

    # --- arithmetic ------------------------------------------------------------------------
    def __neg__(self) -> fmpz_poly:
        return fmpz_poly([-c for c in self.c])

    def __add__(self, other: fmpz_poly | int) -> fmpz_poly:
        return fmpz_poly([a + b for a, b in zip_longest(self.c, fmpz_poly(other).c, fillvalue=0)])

    __radd__ = __add__

    def __sub__(self, other: fmpz_poly | int) -> fmpz_poly:
        return fmpz_poly([a - b for a, b in zip_longest(self.c, fmpz_poly(other).c, fillvalue=0)])

    def __mul__(self, other: fmpz_poly | int) -> fmpz_poly:
        if isinstance(other, int):
            return fmpz_poly([c * other for c in self.c])
        total = [0] * max(len(self.c) + len(other.c) - 1, 0)
        for i, a in enumerate(self.c):
            if a:
                for j, b in enumerate(other.c, i):
                    total[j] += a * b
        return fmpz_poly(total)

    __rmul__ = __mul__

    def __pow__(self, exponent: int) -> fmpz_poly:
        result = fmpz_poly(1)
        for _ in range(exponent):
            result = result * self
        return result

    def __divmod__(self, other: fmpz_poly | int) -> tuple[fmpz_poly, fmpz_poly]:
        """(q, r) with self = q*other + r; coefficients of r from the degree of ``other`` on are smaller than its
        leading one."""
        divisor = fmpz_poly(other).c
        if not divisor:
            raise ZeroDivisionError("fmpz_poly division by 0")
        rest, n, lead = list(self.c), len(divisor) - 1, divisor[-1]
        quotient = [0] * max(len(rest) - n, 0)
        for k in reversed(range(len(quotient))):
            if abs(rest[k + n]) >= abs(lead):
                factor = quotient[k] = rest[k + n] // lead
                for j, b in enumerate(divisor, k):
                    rest[j] -= factor * b
        return fmpz_poly(quotient), fmpz_poly(rest)

    def __floordiv__(self, other: fmpz_poly | int) -> fmpz_poly:
        return divmod(self, other)[0]

    def __mod__(self, other: fmpz_poly | int) -> fmpz_poly:
        return divmod(self, other)[1]

    def __truediv__(self, other: fmpz_poly | int) -> fmpz_poly:
        quotient, remainder = divmod(self, other)
        if remainder:
            raise DomainError("fmpz_poly division is not exact")
        return quotient

    def __call__(self, x: Any) -> Any:
        if isinstance(x, fmpq):  # homogeneous, in integers
            total, power = 0, 1
            for c in reversed(self.c):
                total, power = total * x.p + c * power, power * x.q
            return fmpq(total * x.q, power)
        if hasattr(x, "value_of"):
            return x.value_of(self.c)
        value = x * 0
        for c in reversed(self.c):
            value = value * x + c
        return value

    # --- algebra ---------------------------------------------------------------------------
    def derivative(self) -> fmpz_poly:
        """The derivative."""
        return fmpz_poly([k * c for k, c in enumerate(self.c)][1:])

    def gcd(self, other: fmpz_poly) -> fmpz_poly:
        """The greatest common divisor, with a positive leading coefficient."""
        return _from_terms(common_divisor(_terms(self), _terms(other), (0,)))

    def factor(self) -> tuple[int, list[tuple[fmpz_poly, int]]]:
        """The unit, and irreducible factors with their multiplicities."""
        unit, parts = factors.of_terms(_terms(self), (0,))
        return unit, [(_from_terms(f), e) for f, e in parts]


def _terms(p: fmpz_poly) -> dict[int, int]:
    return {k: c for k, c in enumerate(p.c) if c}


def _from_terms(terms: dict[int, int]) -> fmpz_poly:
    return fmpz_poly([terms.get(k, 0) for k in range(max(terms, default=-1) + 1)])
