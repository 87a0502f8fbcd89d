"""Numbers of Q(theta) for the checker: polynomials modulo p with integer coefficients over one denominator.

Nothing is assumed about p beyond one simple root theta in the stated interval: a residue that reduces to the zero
polynomial is zero at theta, and every strict sign is proved by an interval, so p need not be irreducible.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm

from qe.errors import CertificateRejected
from qe.options import Budget

MAX_BITS = 60_000


@dataclass(frozen=True, slots=True)
class Residue:
    """(c_0 + c_1 theta + …)/denominator; lowest terms, no trailing zeros, so zero is ((), 1)."""

    coefficients: tuple[int, ...]
    denominator: int

    @property
    def is_zero(self) -> bool:
        """Whether it is the zero polynomial (then its value is 0; the converse is not claimed)."""
        return not self.coefficients


ZERO = Residue((), 1)


def _reduced(coefficients: list[int], denominator: int) -> Residue:
    while coefficients and not coefficients[-1]:
        coefficients.pop()
    common = gcd(denominator, *coefficients)
    if common != 1:
        coefficients, denominator = [c // common for c in coefficients], denominator // common
    return Residue(tuple(coefficients), denominator)


def of_rationals(values: Sequence[Fraction]) -> Residue:
    """The residue with these coefficients."""
    denominator = lcm(*(v.denominator for v in values))
    return _reduced([v.numerator * (denominator // v.denominator) for v in values], denominator)


def add(a: Residue, b: Residue) -> Residue:
    """a + b."""
    common = lcm(a.denominator, b.denominator)
    u, v = common // a.denominator, common // b.denominator
    size = max(len(a.coefficients), len(b.coefficients))
    out = [0] * size
    for i, c in enumerate(a.coefficients):
        out[i] = c * u
    for i, c in enumerate(b.coefficients):
        out[i] += c * v
    return _reduced(out, common)


def scale(a: Residue, factor: Fraction) -> Residue:
    """factor * a."""
    return _reduced([c * factor.numerator for c in a.coefficients], a.denominator * factor.denominator)


class RootField:
    """Arithmetic modulo p, and signs at its root theta between ``lo`` and ``hi``.

    The constructor proves that p has exactly one root there, a simple one (p changes sign and p' does not vanish), or
    that lo = hi is a root; otherwise it raises ``CertificateRejected`` at ``path``.
    """

    def __init__(self, p: Sequence[int], lo: Fraction, hi: Fraction, path: str, budget: Budget | None = None) -> None:
        if len(p) < 2 or p[-1] == 0:
            raise CertificateRejected(f"{path}.minimal_polynomial", "expected positive degree")
        self.p, self.degree, self.path, self.budget = tuple(p), len(p) - 1, path, budget or Budget()
        self.unit = lcm(lo.denominator, hi.denominator)
        self.a, self.b = int(lo * self.unit), int(hi * self.unit)
        if self.a > self.b:
            raise CertificateRejected(f"{path}.interval", "the lower end is above the upper end")
        self.reach = max(abs(self.a), abs(self.b)) // self.unit + 1
        self._table = self._powers()
        left, right = self._sign_of_p(self.a), self._sign_of_p(self.b)
        self.left = left
        if self.a == self.b:
            if left:
                raise CertificateRejected(f"{path}.interval", "the point is not a root of the polynomial")
            return
        if left * right >= 0:
            raise CertificateRejected(f"{path}.interval", "the polynomial does not change sign on the interval")
        slope = tuple(i * c for i, c in enumerate(self.p))[1:]
        if self._interval_sign(slope) is None:
            raise CertificateRejected(f"{path}.interval", "the interval does not isolate one simple root")

    def _sign_of_p(self, numerator: int) -> int:
        value, power = 0, 1
        for c in reversed(self.p):
            value = value * numerator + c * power
            power *= self.unit
        return (value > 0) - (value < 0)

    def _powers(self) -> list[list[int]]:
        """lead^(d-1) * x^k modulo p for k = d, …, 2d-2, as integer rows."""
        d, lead = self.degree, self.p[-1]
        rows: list[list[int]] = []
        row = [-c for c in self.p[:-1]]  # lead * x^d
        for k in range(d - 1):
            # here row = lead^(k+1) * x^(d+k)
            rows.append([c * lead ** (d - 2 - k) for c in row])
            top = row[-1]
            shifted = [0, *row[:-1]]
            row = [lead * s - top * c for s, c in zip(shifted, self.p[:-1], strict=True)]
        return rows

    def multiply(self, a: Residue, b: Residue) -> Residue:
        """a * b modulo p."""
        self.budget.check("verify")
        u, v, d = a.coefficients, b.coefficients, self.degree
        if not u or not v:
            return ZERO
        product = [0] * (len(u) + len(v) - 1)
        for i, x in enumerate(u):
            if x:
                for j, y in enumerate(v):
                    product[i + j] += x * y
        denominator = a.denominator * b.denominator
        if len(product) > d:
            factor = self.p[-1] ** (d - 1)
            low = [c * factor for c in product[:d]]
            for c, row in zip(product[d:], self._table, strict=False):
                if c:
                    for i, t in enumerate(row):
                        low[i] += c * t
            product, denominator = low, denominator * factor
        if denominator < 0:
            product, denominator = [-c for c in product], -denominator
        return _reduced(product, denominator)

    def _interval_sign(self, c: Sequence[int]) -> int | None:
        """The sign of sum c_i x^i on the whole interval, if the mean value theorem shows it is constant."""
        total, unit = self.a + self.b, 2 * self.unit
        value, power = 0, 1
        for coefficient in reversed(c):
            value = value * total + coefficient * power
            power *= unit
        # |c(x) - c(middle)| <= bound * (b - a)/unit with bound = sum i |c_i| reach^(i-1)
        bound = sum(i * abs(k) * self.reach ** (i - 1) for i, k in enumerate(c) if i)
        if abs(value) * unit > bound * (self.b - self.a) * (power // unit) and value:
            return 1 if value > 0 else -1
        return None

    def sign(self, a: Residue) -> int:
        """The sign of the value at theta; 0 only for the zero polynomial.

        Raises ``CertificateRejected`` when a nonzero polynomial looks like zero (p is then reducible).
        """
        if a.is_zero:
            return 0
        if len(a.coefficients) == 1:
            return 1 if a.coefficients[0] > 0 else -1
        while True:
            self.budget.check("verify")
            found = self._interval_sign(a.coefficients)
            if found is not None:
                return found
            if self.unit.bit_length() > MAX_BITS or self.a == self.b:
                raise CertificateRejected(self.path, "a sign could not be decided by intervals")
            self._refine(48)

    def _refine(self, steps: int) -> None:
        for _ in range(steps):
            middle = self.a + self.b
            self.a, self.b, self.unit = 2 * self.a, 2 * self.b, 2 * self.unit
            at = self._sign_of_p(middle)
            if at == 0:
                self.a = self.b = middle
                return
            if at == self.left:
                self.a = middle
            else:
                self.b = middle
