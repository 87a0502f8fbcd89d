"""Polynomials that tell true open cells from false ones where the boundary polynomials alone do not."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from qe.decomposition.projection import Levels
from qe.elimination.critical.open_cells import OpenCell
from qe.errors import InternalError
from qe.exact.ring import Poly

Clash = tuple[OpenCell, OpenCell]

MOST_PLANES = 6
"""Planes in later variables that are tried before derivatives, which bring many more cells (measured: ten times)."""


def separated(
    polys: frozenset[Poly], cells: Callable[[frozenset[Poly]], tuple[Levels, list[OpenCell]]]
) -> tuple[Levels, list[OpenCell]]:
    """Factor lists with those of ``polys``, by whose signs no true open cell looks like a false one, and the cells.

    ``cells(polys)`` gives the factor lists closed under projection and all their open cells. Two cells that look alike
    part at some level over a common sample, with sectors between them, since neighbouring ones differ in the sign of a
    factor. A rational value of such a sector tells them apart, for good at the first level; at later levels that is
    only so over the sample, so after ``MOST_PLANES`` of them derivatives are taken: by Thom's lemma one of a factor of
    that level has different signs (Basu, Pollack, Roy 2006, Proposition 2.27). There are finitely many, so this ends.
    """
    planes = 0
    while True:
        levels, listing = cells(polys)
        new = set()
        for clash in _clashes(listing):
            level = next(k for k, (a, b) in enumerate(zip(clash[0].path, clash[1].path, strict=True)) if a != b)
            if level == 0 or planes < MOST_PLANES:
                new.add(_plane(clash, level, levels, listing))
                planes += level > 0
            else:
                new.add(_derivative(clash, level, levels))
        if not new:
            return levels, listing
        polys |= new


def _clashes(listing: list[OpenCell]) -> list[Clash]:
    """One pair of a true and a false cell for each sign vector that both have."""
    seen: dict[tuple[str, ...], OpenCell] = {}
    found: dict[tuple[str, ...], Clash] = {}
    for cell in listing:
        other = seen.setdefault(cell.signs, cell)
        if other.truth is not cell.truth:
            found.setdefault(cell.signs, (other, cell))
    return list(found.values())


def _plane(clash: Clash, level: int, levels: Levels, listing: list[OpenCell]) -> Poly:
    """x_level = the sample of the middle sector between two cells."""
    left, right = clash
    middle = (*left.path[:level], (left.path[level] + right.path[level]) // 2)
    value = next(c.values[level] for c in listing if c.path[: level + 1] == middle)
    ring = next(f.ring for factors in levels for f in factors)
    return value.denominator * ring.gen(level) - value.numerator


def _derivative(clash: Clash, level: int, levels: Levels) -> Poly:
    for f in _derivatives(levels[level], level):
        if _sign(f, clash[0]) * _sign(f, clash[1]) < 0:
            return f
    raise InternalError("derivatives do not separate the cells, against Thom's lemma")


def _derivatives(factors: tuple[Poly, ...], level: int) -> Iterator[Poly]:
    """All derivatives of the factors, those of low degree first."""
    found = []
    for f in factors:
        while f.degree(level) > 1:
            f = f.derivative(level)
            found.append(f.normal()[1])
    yield from sorted(found, key=lambda f: (f.total_degree, f.term_count()))


def _sign(f: Poly, cell: OpenCell) -> int:
    return f.sign_at((*cell.values, *(0 for _ in range(f.ring.size - len(cell.values)))))
