"""Vectors over variables along which the polynomials of a formula are constant, or by which they are homogeneous."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction

from qe.exact.quadratic_form import solve_linear
from qe.exact.ring import Poly
from qe.formula.syntax import Formula
from qe.formula.traverse import polynomials

Weights = dict[str, Fraction]
"""A vector over variables, by those where it is not 0."""

Row = tuple[Fraction, ...]


def constant_direction(body: Formula, names: frozenset[str]) -> Weights:
    """A vector w over the named variables with sum of w_i * dp/dv_i = 0 for every polynomial p; empty if there is none.

    Then p(v + t*w) = p(v) for all real t.
    """
    return _annihilator(body, names, _derivatives)


def homogeneous_weights(body: Formula, names: frozenset[str]) -> Weights:
    """Weights w of the named variables with p(t^w * v) = t^d * p(v) for every polynomial p, some d and all t > 0; empty
    if there are none: they annihilate the differences of exponents."""
    return _annihilator(body, names, _differences)


def _annihilator(body: Formula, names: frozenset[str], rows: Callable[[Poly, Sequence[int]], Iterator[Row]]) -> Weights:
    """The sum of a basis of the vectors whose product with every row is 0, each with one free coordinate 1 and the
    others 0."""
    polys, ring = polynomials(body), body.ring
    if ring is None:
        return {}
    columns = [i for i in range(ring.size) if ring.names[i] in names and any(p.degree(i) for p in polys)]
    listing = list(dict.fromkeys(row for poly in polys for row in rows(poly, columns)))
    solved = solve_linear(listing, [Fraction(0)] * len(listing), len(columns))
    if solved is None or not solved.kernel:
        return {}
    total = (sum(entries, Fraction(0)) for entries in zip(*solved.kernel, strict=True))
    return {ring.names[i]: w for i, w in zip(columns, total, strict=True) if w}


def _derivatives(poly: Poly, columns: Sequence[int]) -> Iterator[Row]:
    """One row per monomial: its coefficient in each partial derivative."""
    rows: dict[tuple[int, ...], list[Fraction]] = {}
    for k, i in enumerate(columns):
        for exponents, coefficient in poly.derivative(i).terms():
            rows.setdefault(exponents, [Fraction(0)] * len(columns))[k] = Fraction(coefficient)
    yield from map(tuple, rows.values())


def _differences(poly: Poly, columns: Sequence[int]) -> Iterator[Row]:
    """The exponents of every other term less those of the first."""
    first, *others = (exponents for exponents, _ in poly.terms())
    for other in others:
        yield tuple(Fraction(other[i] - first[i]) for i in columns)
