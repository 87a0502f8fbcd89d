"""Numbers as sums of square roots: what certificates about arms, and poses, are in."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from bezier.curves.scalar import rational
from qe.errors import Unable
from qe.exact.algebraic import RealAlgebraic, irreducible_roots
from qe.exact.algebraic_text import square_part

Terms = dict[int, Fraction]


def square_roots(value: Any) -> Terms:
    """The number as a sum of factors times square roots of squarefree numbers, from a field of at most two square
    roots. Raises ``Unable`` where it is none.

    With c the mean of a number and its conjugates, it is c plus what it differs from c by (degree 2), or plus its half
    sums with each conjugate, less c (degree 4): in such a field their squares are rational.
    """
    number = rational(value)
    if number is not None:
        return {1: number} if number else {}
    a: RealAlgebraic = value if isinstance(value, RealAlgebraic) else value.to_algebraic()
    conjugates = irreducible_roots(a.poly)
    refused = Unable("certificates of joint positions are for coordinates that are sums of square roots")
    if a.degree not in (2, 4) or len(conjugates) != a.degree:
        raise refused
    mean = Fraction(-a.minimal_polynomial[-2], a.degree * a.minimal_polynomial[-1])
    parts = [a - mean] if a.degree == 2 else [(a + b) * Fraction(1, 2) - mean for b in conjugates if b != a]
    result = {1: mean}
    for x in parts:
        square = rational(x * x)
        if square is None:
            raise refused
        if square:
            d, q = _root(square)
            result[d] = result.get(d, Fraction(0)) + (q if x > 0 else -q)
    return {d: q for d, q in result.items() if q}


def _root(square: Fraction) -> tuple[int, Fraction]:
    whole = square.numerator * square.denominator
    outside = square_part(whole)
    return whole // outside**2, Fraction(outside, square.denominator)
