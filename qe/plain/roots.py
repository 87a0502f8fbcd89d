"""Enclosures of all complex roots of a polynomial under the names of python-flint."""

from __future__ import annotations

import cmath
from collections.abc import Sequence
from math import isqrt

from qe.plain.balls import arb, arb_poly, ctx
from qe.plain.univariate import fmpz_poly

ROUNDS = 200
FIRST_BITS = 64


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
        self.c = [c if isinstance(c, arb) else arb(c) for c in p.c]

    def degree(self) -> int:
        """The degree, -1 for zero."""
        return len(self.c) - 1

    def roots(self, maxprec: int) -> list[acb]:
        """Disjoint boxes, each with exactly one root; ``ValueError`` where so many bits do not suffice to find any.

        THEOREM (Smith, J. ACM 17, 1970). Let z_1, ..., z_n be different numbers and p of degree n with the leading
        coefficient c. All roots of p are in the discs around z_i with the radius n*|p(z_i)/(c*prod(z_i - z_j))|, and
        where a disc meets no other, exactly one is in it.
        """
        n = self.degree()
        if n < 1:
            return []
        scale, places = _first(self.c)
        bits = FIRST_BITS
        while bits <= max(maxprec, FIRST_BITS):
            places, moved = _improved(self.c, scale, places, bits)
            boxes = _enclosed(self.c, places, scale - bits, 2 * bits) if moved else None
            if boxes is not None:
                return boxes
            bits *= 2
        raise ValueError("roots() failed to converge")


Gauss = tuple[int, int]


def _first(c: Sequence[arb]) -> tuple[int, list[Gauss]]:
    """(k, approximations z*2^(k - FIRST_BITS)) by floating point numbers (Aberth, Math. Comp. 27, 1973)."""
    n = len(c) - 1
    sizes = [(x.m.bit_length() + x.e) if x.m else None for x in c]
    lead = sizes[-1]
    if lead is None:
        raise ValueError("the leading coefficient may be 0")
    scale = 1 + max((-((lead - 1 - s) // (n - i)) for i, s in enumerate(sizes[:-1]) if s is not None), default=0)  # Fujiwara
    p = [_float(x, i * scale - n * scale - lead) for i, x in enumerate(c)]
    slope = [i * x for i, x in enumerate(p)][1:]
    z = [cmath.rect(0.6 + 0.1 * (i % 3), 2.4 * i + 0.4) for i in range(n)]
    for _ in range(ROUNDS):
        largest = 0.0
        for i in range(n):
            value, rise = _value(p, z[i]), _value(slope, z[i])
            if value == 0:
                continue
            pull = sum(1 / (z[i] - w) for j, w in enumerate(z) if j != i and w != z[i])
            under = rise - value * pull
            step = value / under if under else 1e-3
            z[i] -= step
            largest = max(largest, abs(step) / (abs(z[i]) + 1e-300))
        if largest < 1e-15:
            break
    return scale, [(int(w.real * 2**FIRST_BITS), int(w.imag * 2**FIRST_BITS)) for w in z]


def _float(x: arb, shift: int) -> float:
    cut = max(x.m.bit_length() - 60, 0)
    e = x.e + shift + cut
    return float(x.m >> cut) * 2.0**e if e > -1000 else 0.0


def _value(p: Sequence[float], z: complex) -> complex:
    total = 0j
    for c in reversed(p):
        total = total * z + c
    return total


def _improved(c: Sequence[arb], scale: int, places: Sequence[Gauss], bits: int) -> tuple[list[Gauss], bool]:
    """The approximations with ``bits`` bits behind the point, one step of Newton's method better."""
    n, lead = len(c) - 1, c[-1].m.bit_length() + c[-1].e
    work = 2 * bits
    p = [_fixed(x, i * scale - n * scale - lead + work) for i, x in enumerate(c)]
    found = []
    for x, y in places:
        if bits > FIRST_BITS:
            x, y = x << bits // 2, y << bits // 2
        a = b = u = v = 0  # value and derivative
        for k in reversed(p):
            u, v = (u * x - v * y >> bits) + a, (u * y + v * x >> bits) + b
            a, b = (a * x - b * y >> bits) + k, a * y + b * x >> bits
        size = u * u + v * v
        if size:
            x, y = x - ((a * u + b * v) << bits) // size, y - ((b * u - a * v) << bits) // size
        found.append((x, y))
    return found, len(set(found)) == n


def _fixed(x: arb, shift: int) -> int:
    e = x.e + shift
    return x.m << e if e >= 0 else x.m >> -e


def _enclosed(c: Sequence[arb], places: Sequence[Gauss], exponent: int, bits: int) -> list[acb] | None:
    """Boxes around the discs of the theorem, for approximations times 2^exponent, or None where two of them meet."""
    n, unit = len(c) - 1, arb(2) ** abs(exponent)
    with ctx.workprec(bits):
        unit = 1 / unit if exponent < 0 else unit
        boxes = []
        if c[-1].contains(0):
            return None
        for i, (x, y) in enumerate(places):
            re, im = unit * x, unit * y
            a = b = arb(0)
            for k in reversed(c):
                a, b = a * re - b * im + k, a * im + b * re
            under = c[-1] * c[-1]
            for j, (z, w) in enumerate(places):
                if j != i:
                    under = under * (unit * unit * ((x - z) ** 2 + (y - w) ** 2))
            radius = _root_above((a * a + b * b) * (n * n) / under)
            around = arb(0).union(radius).union(-radius)
            boxes.append(acb(re + around, im + around))
    if any(boxes[i].overlaps(boxes[j]) for i in range(n) for j in range(i)):
        return None
    return boxes


def _root_above(x: arb) -> arb:
    """An exact number at least as large as the square root of any in the ball."""
    top, e = x.m + x.r, x.e
    top, e = (top << 1, e - 1) if e % 2 else (top, e)
    half = arb(2) ** abs(e // 2)
    root = arb(isqrt(top) + 1)
    return root * half if e >= 0 else root / half
