"""Polynomials in one variable with integer coefficients under the name of python-flint."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from qe.plain.numbers import fmpq
from qe.plain.polynomial import Polynomial


class fmpz_poly(Polynomial):
    """A polynomial by its coefficients from degree 0 up."""

    __slots__ = ()

    def __init__(self, coefficients: Iterable[int] = ()) -> None:
        self.places, self.t = (0,), {k: c for k, c in enumerate(coefficients) if c}

    def degree(self) -> int:
        """The degree, -1 for zero."""
        return max(self.t, default=-1)

    def coeffs(self) -> list[int]:
        """The coefficients from degree 0 up; the last one is not 0."""
        return [self.t.get(k, 0) for k in range(self.degree() + 1)]

    def __getitem__(self, k: int) -> int:
        return self.t.get(k, 0)

    def height_bits(self) -> int:
        """The bit length of the largest coefficient."""
        return max((c.bit_length() for c in self.t.values()), default=0)

    def __divmod__(self, other: fmpz_poly) -> tuple[fmpz_poly, fmpz_poly]:
        """(q, r) with self = q*other + r; coefficients of r from the degree of ``other`` on are smaller than its
        leading one."""
        if not other:
            raise ZeroDivisionError("fmpz_poly division by 0")
        rest, divisor = self.coeffs(), other.coeffs()
        n, lead = len(divisor) - 1, divisor[-1]
        quotient = [0] * max(len(rest) - n, 0)
        for k in reversed(range(len(quotient))):
            if abs(rest[k + n]) >= abs(lead):
                factor = quotient[k] = rest[k + n] // lead
                for j, b in enumerate(divisor, k):
                    rest[j] -= factor * b
        return fmpz_poly(quotient), fmpz_poly(rest)

    def __floordiv__(self, other: fmpz_poly) -> fmpz_poly:
        return divmod(self, other)[0]

    def __mod__(self, other: fmpz_poly) -> fmpz_poly:
        return divmod(self, other)[1]

    def __call__(self, x: Any) -> Any:
        if isinstance(x, fmpq):  # homogeneous, in integers
            total, power = 0, 1
            for c in reversed(self.coeffs()):
                total, power = total * x.p + c * power, power * x.q
            return fmpq(total * x.q, power)
        value = x * 0
        for c in reversed(self.coeffs()):
            value = value * x + c
        return value
