"""Polynomials with square roots in their coefficients that have one sign on an interval, proved by subdivision.

On [a, b] a polynomial lies between its smallest and its largest Bernstein coefficient there (R. T. Farouki, CAGD 29,
2012, section 3). The coefficients are enclosed by integers, and halves follow by de Casteljau's algorithm.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from math import ceil, comb, floor

from bezier.certify import square_roots as sr
from bezier.certify.square_roots import Polynomial, Surd

BITS = (256, 1024)
MOST_SUMS = 20_000_000
"""Of the coefficients of all parts that are looked at."""

Ends = list[tuple[int, int]]


def constant_sign(p: Polynomial, low: Fraction, high: Fraction) -> int:
    """1 or -1 if p is proved to have this sign everywhere on [low, high], else 0."""
    ends = {sr.at(p, x).sign() for x in (low, high)}
    if len(ends) > 1 or ends == {0}:
        return 0
    bernstein = _bernstein(p, low, high)
    return ends.pop() if any(_is_nonzero(_enclosed(bernstein, bits)) for bits in BITS) else 0


def _bernstein(p: Polynomial, low: Fraction, high: Fraction) -> list[Surd]:
    """b_k = Σ_j C(k,j) / C(n,j) c_j, c the coefficients of p(low + (high - low) u)."""
    step, moved = [Surd.rational(low), Surd.rational(high - low)], Polynomial()
    for c in reversed(p):
        moved = sr.add(sr.times(moved, step), [c])
    n = len(p) - 1
    moved = moved + [sr.ZERO] * (n + 1 - len(moved))
    result = []
    for k in range(n + 1):
        pairs = [(d, q * Fraction(comb(k, j), comb(n, j))) for j in range(k + 1) for d, q in moved[j].terms]
        result.append(Surd.of(pairs))
    return result


def _enclosed(values: list[Surd], bits: int) -> Ends:
    ends = [v.interval(2 * bits) for v in values]
    unit = max(max(abs(a), abs(b)) for a, b in ends) / (1 << bits)
    return [(floor(a / unit), ceil(b / unit)) for a, b in ends]


def _is_nonzero(whole: Ends) -> bool:
    parts, count, most = [whole], 0, 200 + MOST_SUMS // len(whole) ** 2
    while parts:
        part, count = parts.pop(), count + 1
        if all(low > 0 for low, _ in part) or all(high < 0 for _, high in part):
            continue
        if any(low <= 0 <= high for low, high in (part[0], part[-1])) or count > most:
            return False
        parts += _halves(part)
    return True


def _halves(row: Ends) -> tuple[Ends, Ends]:
    """The coefficients on both halves: after k sums they are 2^k times as large."""
    left, right, k = [row[0]], [row[-1]], 0
    while len(row) > 1:
        row, k = [(a + c, b + d) for (a, b), (c, d) in pairwise(row)], k + 1
        left.append((row[0][0] >> k, -(-row[0][1] >> k)))
        right.append((row[-1][0] >> k, -(-row[-1][1] >> k)))
    return left, right[::-1]
