"""Polynomials in Bernstein form over a number field, for the checkers of certificates about curves.

A polynomial of degree n on [0, 1] is the list b_0, ..., b_n with p(t) = sum_k C(n,k) t^k (1-t)^(n-k) b_k. On [a, b] it
lies between its smallest and its largest Bernstein coefficient for [a, b] (Farouki, "The Bernstein polynomial basis: a
centennial retrospective", CAGD 2012, section 3).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from math import comb

from qe.expert.arithmetic.numbers import read_number
from qe.expert.arithmetic.residue import ZERO, Residue, RootField, add, of_rationals, scale
from qe.proof.entry import Entry

Vector = list[Residue]
MAX_DEGREE = 64


def read_points(entry: Entry, field: RootField) -> list[Vector]:
    """Control points of one dimension, at most ``MAX_DEGREE`` + 1 of them."""
    points = [[read_number(c, field) for c in p.items()] for p in entry.items()]
    if not 1 <= len(points) <= MAX_DEGREE + 1 or not points[0] or len({len(p) for p in points}) != 1:
        raise entry.fail(f"expected at most {MAX_DEGREE + 1} points of one dimension")
    return points


def total(values: Sequence[Residue]) -> Residue:
    """The sum."""
    result = ZERO
    for value in values:
        result = add(result, value)
    return result


def product(a: Sequence[Residue], b: Sequence[Residue], field: RootField) -> list[Residue]:
    """c_k = sum_{i+j=k} C(m,i) C(n,j) / C(m+n,k) a_i b_j (Farouki 2012, section 4)."""
    m, n = len(a) - 1, len(b) - 1
    out = [ZERO] * (m + n + 1)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            weight = Fraction(comb(m, i) * comb(n, j), comb(m + n, i + j))
            out[i + j] = add(out[i + j], scale(field.multiply(x, y), weight))
    return out


def constant(value: Fraction, degree: int) -> list[Residue]:
    """A constant polynomial written with this degree."""
    return [of_rationals([value])] * (degree + 1)


def restricted(b: Sequence[Residue], low: Fraction, high: Fraction) -> list[Residue]:
    """The coefficients on [low, high], 0 <= low < high <= 1, mapped to [0, 1]."""
    piece = list(b) if high == 1 else _left(b, high)
    return list(reversed(_left(list(reversed(piece)), 1 - low / high))) if low else piece


def _left(coefficients: Sequence[Residue], t: Fraction) -> list[Residue]:
    """De Casteljau: the coefficients on [0, t], mapped to [0, 1]."""
    row, out = list(coefficients), [coefficients[0]]
    while len(row) > 1:
        row = [add(scale(x, 1 - t), scale(y, t)) for x, y in pairwise(row)]
        out.append(row[0])
    return out
