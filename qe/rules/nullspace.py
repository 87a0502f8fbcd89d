"""Vectors that annihilate a stream of rows of rational numbers, for the symmetry rules."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction

from qe.exact.ring import Poly
from qe.formula.syntax import Formula
from qe.formula.traverse import polynomials


def occurring(body: Formula, names: frozenset[str]) -> tuple[list[Poly], list[int]]:
    """The polynomials of a formula, and the indices of the named variables that occur in them."""
    polys = polynomials(body)
    if not polys:
        return [], []
    ring = polys[0].ring
    return polys, [i for i in range(ring.size) if ring.names[i] in names and any(p.degree(i) for p in polys)]


def kernel_vector(columns: Sequence[int], rows: Iterable[list[Fraction]]) -> dict[int, Fraction] | None:
    """A nonzero vector, by column name, whose product with every row is 0; None if there is none.

    Gaussian elimination that stops as soon as the rows have full rank.
    """
    reduced: dict[int, list[Fraction]] = {}
    for given in rows:
        row = given
        for k in sorted(reduced):
            if row[k]:
                ratio = row[k] / reduced[k][k]
                row = [a - ratio * b for a, b in zip(row, reduced[k], strict=True)]
        if any(row):
            reduced[next(k for k, v in enumerate(row) if v)] = row
            if len(reduced) == len(columns):
                return None
    free = [k for k in range(len(columns)) if k not in reduced]
    if not free:
        return None
    solution = [Fraction(0)] * len(columns)
    for k in free:
        solution[k] = Fraction(1)
    for k in sorted(reduced, reverse=True):
        tail = sum((reduced[k][j] * solution[j] for j in range(k + 1, len(columns))), Fraction(0))
        solution[k] = -tail / reduced[k][k]
    return {columns[k]: value for k, value in enumerate(solution)}
