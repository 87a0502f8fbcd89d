"""What a covering says of the space of the free variables: its cells, with their truth and the signs known there."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from qe.decomposition.line import Cover, CoverInterval
from qe.exact.ring import Poly
from qe.proof.cells import CHARACTER_OF, FreeCell

Levels = tuple[tuple[Poly, ...], ...]


def parameter_cells(cover: Cover, free: int) -> tuple[Levels, list[FreeCell]]:
    """The polynomials of the first ``free`` levels, and cells that cover the space of these variables.

    A cell is an interval over an interval and so on; what is known there are the signs of their own polynomials. Its
    path are the numbers of the intervals.
    """
    levels: list[dict[Poly, int]] = [{} for _ in range(free)]
    cells = list(_cells(cover, (), (), levels))
    widths = [len(level) for level in levels]
    listed = [
        FreeCell(path, tuple(_text(own, width) for own, width in zip(signs, widths, strict=False)), truth)
        for path, signs, truth in cells
    ]
    return tuple(tuple(level) for level in levels), listed


Signs = tuple[Mapping[int, int], ...]


def _cells(
    cover: Cover, path: tuple[int, ...], signs: Signs, levels: list[dict[Poly, int]]
) -> Iterator[tuple[tuple[int, ...], Signs, bool]]:
    places = levels[cover.point.depth]
    for k, interval in enumerate(cover.intervals):
        known = {places.setdefault(f, len(places)): s for f, s in _signs(interval).items()}
        here, reason = ((*path, k), (*signs, known)), interval.known.reason
        if isinstance(reason, Cover) and reason.point.depth < len(levels):
            yield from _cells(reason, *here, levels)
        else:
            assert interval.known.truth is not None
            yield *here, interval.known.truth


def _signs(interval: CoverInterval) -> dict[Poly, int]:
    """The signs of its own polynomials at its sample."""
    at, sample = interval.known.at, interval.known.sample
    return {f: 0 if at is not None and at.poly == f else sample.sign(f) for f in interval.own}


def _text(signs: Mapping[int, int], width: int) -> str:
    return "".join([CHARACTER_OF[signs.get(j)] for j in range(width)]).rstrip("?")
