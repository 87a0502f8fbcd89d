"""Bisection of polynomials in Bernstein form where only signs and quotients matter: integers stay integers.

Halving multiplies all coefficients by 2^degree, so that no division is needed; polynomials of one degree keep their
quotients.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from typing import Any

from bezier.curves import bernstein as bs

Numbers = tuple[Any, ...]


def halves(b: Numbers) -> tuple[Numbers, Numbers]:
    """Positive multiples of the Bernstein coefficients on [0, 1/2] and [1/2, 1].

    The factor is 2^degree for integers and 1 for other numbers.
    """
    if not all(isinstance(c, int) for c in b):
        return bs.split(b)
    n = len(b) - 1
    row, left, right = list(b), [b[0] << n], [b[-1] << n]
    for k in range(1, n + 1):
        row = [x + y for x, y in pairwise(row)]
        left.append(row[0] << (n - k))
        right.append(row[-1] << (n - k))
    return tuple(left), tuple(reversed(right))


def exact(b: Numbers) -> Numbers:
    """The same numbers ready for division: integers as fractions."""
    return tuple(Fraction(c) if isinstance(c, int) else c for c in b)
