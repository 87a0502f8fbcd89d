"""Enclosures of all complex roots of a polynomial under the names of python-flint."""

from __future__ import annotations

from cmath import rect
from math import isqrt

from qe.plain.balls import arb, arb_poly, ball
from qe.plain.univariate import fmpz_poly

FIRST_BITS, FIRST_ROUNDS, MORE_ROUNDS = 64, 100, 3
Gauss = tuple[int, int]


class acb:
    """A box of complex numbers."""

    __slots__ = ("imag", "real")

    def __init__(self, real: arb, imag: arb) -> None:
        self.real, self.imag = real, imag

    def conjugate(self) -> acb:
        """The mirror image."""
        return acb(self.real, -self.imag)

    def overlaps(self, other: acb) -> bool:
        """Whether they have a number in common."""
        return self.real.overlaps(other.real) and self.imag.overlaps(other.imag)


class acb_poly:
    """A polynomial with real coefficients whose complex roots are looked for."""

    def __init__(self, p: arb_poly | fmpz_poly) -> None:
        self.c = [arb(c) for c in p.coeffs()]

    def degree(self) -> int:
        """The degree, -1 for zero."""
        return len(self.c) - 1

    def roots(self, maxprec: int) -> list[acb]:
        """Disjoint boxes, each with exactly one root; ``ValueError`` where so many bits do not suffice to find any.

        THEOREM (Smith, J. ACM 17, 1970). Let z_1, ..., z_n be different numbers and p of degree n with the leading
        coefficient c. All roots of p are in the discs around z_i with the radius n*|w_i|, w_i = p(z_i)/(c*prod(z_i -
        z_j)), and where a disc meets no other, exactly one is in it. With z_i - w_i for z_i, again and again, the radii
        become small where all roots are simple (Weierstrass).
        """
        n = self.degree()
        if n < 1:
            return []
        if self.c[-1].contains(0):
            raise ValueError("the leading coefficient may be 0")
        unit = min(c.e for c in self.c)
        sizes = [c.m.bit_length() + c.e if c.m else None for c in self.c]
        top = (sizes[-1] or 0) - 1
        bounds = (-((top - size) // (n - k)) for k, size in enumerate(sizes[:-1]) if size is not None)
        scale = 1 + max(bounds, default=0)  # Fujiwara
        start = (rect(2.0**FIRST_BITS * (0.5 + 0.3 * k / n), 2.4 * k + 0.4) for k in range(n))
        z, bits, rounds = [(int(w.real), int(w.imag)) for w in start], FIRST_BITS, FIRST_ROUNDS
        while bits <= max(maxprec, FIRST_BITS):  # z stands for z*2^(scale - bits)
            s = scale - bits
            shifts = [c.e - unit + s * k - min(s * n, 0) for k, c in enumerate(self.c)]
            middles = [c.m << shift for c, shift in zip(self.c, shifts, strict=True)]
            errors = [c.r << shift for c, shift in zip(self.c, shifts, strict=True)]
            for _ in range(rounds):
                largest = 0
                for i, (x, y) in enumerate(z):
                    dx, dy, _ = _correction(middles, errors, z, i)
                    z[i], largest = (x - dx, y - dy), max(largest, abs(dx), abs(dy))
                if largest <= 2:
                    break
            radii = [_correction(middles, errors, z, i)[2] for i in range(n)]
            boxes = [acb(ball(x, r, s), ball(y, r, s)) for (x, y), r in zip(z, radii, strict=True)]
            if not any(boxes[i].overlaps(boxes[j]) for i in range(n) for j in range(i)):
                return boxes
            if bits > FIRST_BITS and largest.bit_length() > bits // 2:
                break  # roots that are multiple, or too close to each other
            z, bits, rounds = [(x << bits, y << bits) for x, y in z], 2 * bits, MORE_ROUNDS
        raise ValueError("roots() failed to converge")


def _correction(middles: list[int], errors: list[int], z: list[Gauss], i: int) -> tuple[int, int, int]:
    """The nearest w_i, and the radius of a disc around z_i that has all of n*w_i."""
    (x, y), n = z[i], len(z)
    size = isqrt(x * x + y * y) + 1
    a = b = error = 0
    for m, r in zip(reversed(middles), reversed(errors), strict=True):
        a, b, error = a * x - b * y + m, a * y + b * x, error * size + r
    u, v = middles[-1], 0
    for j, (p, q) in enumerate(z):
        if j != i:
            p, q = (x - p, y - q) if (x, y) != (p, q) else (1, 1)  # equal ones have boxes that overlap
            u, v = u * p - v * q, u * q + v * p
    square = u * u + v * v
    dx, dy = (a * u + b * v) // square, (b * u - a * v) // square
    least = isqrt(square) * (abs(middles[-1]) - errors[-1]) // abs(middles[-1])
    return dx, dy, n * (isqrt(a * a + b * b) + 1 + error) // least + 1
