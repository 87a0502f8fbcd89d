"""Polynomials that tell true open cells from false ones where the boundary polynomials alone do not."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction

from qe.eliminate.critical.helpers import Levels
from qe.eliminate.critical.open_cells import OpenCell
from qe.errors import InternalError
from qe.exact.ring import Poly, Ring

Clash = tuple[OpenCell, OpenCell]


def separated(
    polys: frozenset[Poly], cells: Callable[[frozenset[Poly]], tuple[Levels, list[OpenCell]]]
) -> tuple[Levels, list[OpenCell]]:
    """Factor lists with those of ``polys``, by whose signs no true open cell looks like a false one, and the cells.

    ``cells(polys)`` gives the factor lists closed under projection and all their open cells. Cells over different
    sectors of the first variable are told apart by a rational value between; a sector lies between, since neighbouring
    ones differ in the sign of a factor. Others part over a common sample at some level, where by Thom's lemma a
    derivative of a factor of that level has different signs (Basu, Pollack, Roy 2006, Proposition 2.27). There are
    finitely many of both kinds, so this ends.
    """
    while True:
        levels, listing = cells(polys)
        clash = _clash(listing)
        if clash is None:
            return levels, listing
        polys |= {_separator(clash, levels, listing)}


def _clash(listing: list[OpenCell]) -> Clash | None:
    seen: dict[tuple[str, ...], OpenCell] = {}
    for cell in listing:
        other = seen.setdefault(cell.signs, cell)
        if other.truth is not cell.truth:
            return other, cell
    return None


def _separator(clash: Clash, levels: Levels, listing: list[OpenCell]) -> Poly:
    left, right = clash
    level = next(k for k, (a, b) in enumerate(zip(left.path, right.path, strict=True)) if a != b)
    ring = next(f.ring for factors in levels for f in factors)
    if level == 0:
        low, high = sorted((left.path[0], right.path[0]))
        middle = (low + high) // 2
        return _plane(ring, next(c.values[0] for c in listing if c.path[0] == middle))
    for f in _derivatives(levels[level], level):
        if _sign(f, left) * _sign(f, right) < 0:
            return f
    raise InternalError("derivatives do not separate the cells, against Thom's lemma")


def _plane(ring: Ring, value: Fraction) -> Poly:
    return value.denominator * ring.gen(0) - value.numerator


def _derivatives(factors: tuple[Poly, ...], level: int) -> Iterator[Poly]:
    """All derivatives of the factors, those of low degree first."""
    found = []
    for f in factors:
        while f.degree(level) > 1:
            f = f.derivative(level)
            found.append(f.normal()[1])
    yield from sorted(found, key=lambda f: (f.total_degree, f.term_count()))


def _sign(f: Poly, cell: OpenCell) -> int:
    value = f.evaluate((*cell.values, *(0 for _ in range(f.ring.size - len(cell.values)))))
    return (value > 0) - (value < 0)
