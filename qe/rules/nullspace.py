"""Vectors that annihilate a stream of rows of rational numbers, for the symmetry rules."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction

from qe.exact.quadratic_form import solve_linear
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

    The sum of a basis of them, each with one free coordinate 1 and the others 0.
    """
    listing = list(dict.fromkeys(map(tuple, rows)))
    solved = solve_linear(listing, [Fraction(0)] * len(listing), len(columns))
    if solved is None or not solved.kernel:
        return None
    return {c: sum(entries, Fraction(0)) for c, *entries in zip(columns, *solved.kernel, strict=True)}


def derivative_rows(poly: Poly, columns: Sequence[int]) -> Iterator[list[Fraction]]:
    """One row per monomial: its coefficient in each partial derivative."""
    rows: dict[tuple[int, ...], list[Fraction]] = {}
    for k, i in enumerate(columns):
        for exponents, coefficient in poly.derivative(i).terms():
            rows.setdefault(exponents, [Fraction(0)] * len(columns))[k] = Fraction(coefficient)
    yield from rows.values()
