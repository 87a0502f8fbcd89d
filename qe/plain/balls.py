"""Balls around real numbers under the names of python-flint, and polynomials over them.

A ball is all numbers whose distance from m*2^e is at most r*2^e. Every operation gives a ball that contains all results
for numbers of the given ones; midpoints are rounded to the working precision ``ctx.prec``, radii to few bits.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from qe.plain.numbers import fmpq

RADIUS_BITS = 30
EXACT = (1 << 63) - 1
"""How many bits of an exact ball are right."""


class _Context:
    """The working precision."""

    prec = 53
    threads = 1

    @contextmanager
    def workprec(self, bits: int) -> Iterator[None]:
        """The body at this precision."""
        saved, self.prec = self.prec, bits
        try:
            yield
        finally:
            self.prec = saved


ctx = _Context()


class arb:
    """A ball; immutable."""

    __slots__ = ("e", "m", "r")

    def __init__(self, value: int | fmpq | arb = 0) -> None:
        if isinstance(value, int):
            self.m, self.r, self.e = value, 0, 0
        elif isinstance(value, arb):
            self.m, self.r, self.e = value.m, value.r, value.e
        else:
            near = _rounded(value.p, 0, 0) if value.q == 1 else _quotient(value.p, value.q, 0)
            self.m, self.r, self.e = near.m, near.r, near.e

    def __repr__(self) -> str:
        return f"arb({self.m} +/- {self.r}, * 2^{self.e})"

    # --- arithmetic ------------------------------------------------------------------------
    def __neg__(self) -> arb:
        return ball(-self.m, self.r, self.e)

    def __add__(self, other: arb | int) -> arb:
        (m, r), (n, s), e = _common(self, _arb(other))
        return _rounded(m + n, r + s, e)

    __radd__ = __add__

    def __sub__(self, other: arb | int) -> arb:
        (m, r), (n, s), e = _common(self, _arb(other))
        return _rounded(m - n, r + s, e)

    def __rsub__(self, other: int) -> arb:
        return -self + other

    def __mul__(self, other: arb | int) -> arb:
        b = _arb(other)
        r, s = self.r, b.r
        radius = abs(self.m) * s + abs(b.m) * r + r * s if r or s else 0
        return _rounded(self.m * b.m, radius, self.e + b.e)

    __rmul__ = __mul__

    def __truediv__(self, other: arb | int) -> arb:
        b = _arb(other)
        least = abs(b.m) - b.r
        if least <= 0:
            raise ZeroDivisionError("division by a ball that contains 0")
        middle = _quotient(self.m, b.m, self.e - b.e)
        if not self.r and not b.r:
            return middle
        # |x/y - m/n| <= (|m|*s + |n|*r)/(|n|*(|n| - s))
        error = _quotient(abs(self.m) * b.r + abs(b.m) * self.r, abs(b.m) * least, self.e - b.e)
        return middle + ball(0, abs(error.m) + error.r, error.e)

    def __rtruediv__(self, other: int) -> arb:
        return arb(other) / self

    def __pow__(self, exponent: int) -> arb:
        if exponent < 0:
            return 1 / self**-exponent
        result = arb(1)
        for bit in bin(exponent)[2:]:
            result = result * result * self if bit == "1" else result * result
        return result

    # --- order -----------------------------------------------------------------------------
    def __lt__(self, other: arb | int) -> bool:
        (m, r), (n, s), _ = _common(self, _arb(other))
        return m + r < n - s

    def __gt__(self, other: arb | int) -> bool:
        (m, r), (n, s), _ = _common(self, _arb(other))
        return m - r > n + s

    def overlaps(self, other: arb) -> bool:
        """Whether they have a number in common."""
        return not self < other and not self > other

    def contains(self, other: arb | int) -> bool:
        """Whether all of the other one lies in it."""
        (m, r), (n, s), _ = _common(self, _arb(other))
        return m - r <= n - s and n + s <= m + r

    def is_zero(self) -> bool:
        """Whether it is exactly 0."""
        return not self.m and not self.r

    # --- ends ------------------------------------------------------------------------------
    def mid(self) -> arb:
        """The midpoint."""
        return ball(self.m, 0, self.e)

    def rad(self) -> arb:
        """The radius."""
        return ball(self.r, 0, self.e)

    def fmpq(self) -> fmpq:
        """The value of an exact ball."""
        return fmpq(self.m << self.e) if self.e >= 0 else fmpq(self.m, 1 << -self.e)

    def union(self, other: arb) -> arb:
        """A ball that contains both."""
        (m, r), (n, s), e = _common(self, other)
        return _between(min(m - r, n - s), max(m + r, n + s), e)

    def intersection(self, other: arb) -> arb:
        """A ball that contains all that is in both."""
        (m, r), (n, s), e = _common(self, other)
        low, high = max(m - r, n - s), min(m + r, n + s)
        if low > high:
            raise ValueError("empty intersection")
        return _between(low, high, e)

    def rel_accuracy_bits(self) -> int:
        """About how many bits of the midpoint are right."""
        if not self.r:
            return EXACT
        return self.m.bit_length() - self.r.bit_length() - 1 if self.m else -EXACT


def _arb(value: arb | int) -> arb:
    return value if isinstance(value, arb) else arb(value)


def ball(m: int, r: int, e: int) -> arb:
    """All numbers between (m - r)*2^e and (m + r)*2^e."""
    made = object.__new__(arb)
    made.m, made.r, made.e = m, r, e
    return made


def _rounded(m: int, r: int, e: int) -> arb:
    """A ball that contains this one, within the working precision."""
    cut = max(m.bit_length() - ctx.prec, r.bit_length() - RADIUS_BITS)
    if cut > 0:
        exact = not m & ((1 << cut) - 1)
        m, e = m >> cut, e + cut
        r = (r >> cut) + (1 if r else 0) + (not exact) if r or not exact else 0
    return ball(m, r, e)


def _quotient(p: int, q: int, e: int) -> arb:
    """A ball around p/q*2^e."""
    shift = max(ctx.prec + 1 + q.bit_length() - p.bit_length(), 0)
    m, rest = divmod(p << shift, q)
    return _rounded(m, 1 if rest else 0, e - shift)


def _between(low: int, high: int, e: int) -> arb:
    return _rounded(low + high, high - low, e - 1)


def _common(a: arb, b: arb) -> tuple[tuple[int, int], tuple[int, int], int]:
    """Midpoints and radii at one exponent."""
    if a.e == b.e:
        return (a.m, a.r), (b.m, b.r), a.e
    if a.e > b.e:
        shift = a.e - b.e
        return (a.m << shift, a.r << shift), (b.m, b.r), b.e
    shift = b.e - a.e
    return (a.m, a.r), (b.m << shift, b.r << shift), a.e


class arb_poly:
    """A polynomial by its coefficients from degree 0 up."""

    __slots__ = ("c",)

    def __init__(self, coefficients: Sequence[arb | int] = ()) -> None:
        self.c = [_arb(c) for c in coefficients]
        while self.c and self.c[-1].is_zero():
            self.c.pop()

    def __getitem__(self, k: int) -> arb:
        return self.c[k] if 0 <= k < len(self.c) else arb(0)

    def coeffs(self) -> list[arb]:
        """The coefficients from degree 0 up."""
        return self.c

    def __call__(self, x: arb) -> arb:
        value = arb(0)
        for c in reversed(self.c):
            value = value * x + c
        return value

    def derivative(self) -> arb_poly:
        """The derivative."""
        return arb_poly([c * k for k, c in enumerate(self.c)][1:])

    def __floordiv__(self, other: arb_poly) -> arb_poly:
        """The quotient without remainder; the leading coefficient of the divisor is not 0."""
        rest, n, lead = list(self.c), len(other.c) - 1, other.c[-1]
        quotient: list[Any] = [arb(0)] * max(len(rest) - n, 0)
        for k in reversed(range(len(quotient))):
            quotient[k] = rest[k + n] / lead
            for j, b in enumerate(other.c[:-1], k):
                rest[j] = rest[j] - quotient[k] * b
        return arb_poly(quotient)
