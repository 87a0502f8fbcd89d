"""What a picture of a region shows, as numbers: found once, under the limits of the question, painted anywhere.

A sketch is data for looking only; it can be sent between processes and painted on axes of the caller's.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from qe.cells.pieces import Piece
from qe.errors import InputError
from qe.regions.described import Described as Region
from qe.regions.ends import Span, ends
from qe.regions.solid import Solid
from qe.regions.space import Frame, shape_of

SAMPLES = 400
"""Samples along the first variable of one piece in the plane."""
MARGIN = 0.06
"""Free space around the region, as a share of its size."""
UNBOUNDED = 4.0
"""How far a picture follows a direction in which the region goes on for ever."""
INSIDE = 1e-7
"""The share of a range left out at its ends, where the roots above may coincide or vanish."""


@dataclass(frozen=True, slots=True)
class Band:
    """A piece in the plane: values of the first variable, both ends above them, and what is known of the ends.

    ``lower``, ``upper``: whether the end belongs to the piece, None where the piece goes on for ever.
    ``seam``: the piece lies over one value of the first variable, between two other pieces.
    """

    xs: Sequence[float]
    low: Sequence[float]
    high: Sequence[float]
    lower: bool | None
    upper: bool | None
    seam: bool


@dataclass(frozen=True, slots=True)
class Segment:
    """A piece of a line: its ends and whether they belong to it."""

    low: float
    high: float
    lower: bool
    upper: bool


@dataclass(frozen=True, slots=True)
class Sketch:
    """A region in one to three variables; of ``segments``, ``bands`` and ``solid`` only one is filled.

    ``spans``: the drawn range of each variable on a line or in the plane; ``frame``: where space is cut.
    """

    order: tuple[str, ...]
    is_empty: bool
    spans: tuple[Span, ...] = ()
    segments: tuple[Segment, ...] = ()
    bands: tuple[Band, ...] = ()
    solid: Solid = field(default_factory=lambda: Solid((), ()))
    frame: Frame | None = None


def sketch(region: Region) -> Sketch:
    """The sketch of a region; ``InputError`` above three variables."""
    order = tuple(region.order)
    if len(order) > 3:
        raise InputError(f"a picture needs 1 to 3 variables, the region has {len(order)}")
    if len(order) == 3:
        shape, frame = shape_of(region)
        return Sketch(order, region.is_empty, solid=shape, frame=frame)
    spans = tuple(_span(region, name) for name in order)
    if len(order) == 1:
        segments = [_segment(piece, spans[0]) for piece in region.cells]
        return Sketch(order, region.is_empty, spans, segments=tuple(segments))
    seams = _seams(region.cells)
    return Sketch(order, region.is_empty, spans, bands=tuple(_band(p, spans, seams) for p in region.cells))


def _span(region: Region, variable: str) -> Span:
    """Drawing limits of a variable; unbounded directions are cut off."""
    if region.is_empty:
        return -1.0, 1.0
    lower, upper = region.bounds(variable)
    lo = float(lower) if lower is not None else (float(upper) if upper is not None else 0.0) - UNBOUNDED
    hi = float(upper) if upper is not None else (float(lower) if lower is not None else 0.0) + UNBOUNDED
    pad = MARGIN * (hi - lo) or 1.0
    return lo - pad, hi + pad


def _segment(piece: Piece, span: Span) -> Segment:
    return Segment(*ends(piece, 0, {}, span), piece.ranges[0].lower_closed, piece.ranges[0].upper_closed)


def _seams(pieces: Sequence[Piece]) -> frozenset[Any]:
    """The values of the first variable where several pieces meet: inner lines, not the region's outline."""
    met: Counter[Any] = Counter()
    for piece in pieces:
        met.update({end.value for end in (piece.ranges[0].lower, piece.ranges[0].upper) if end is not None})
    return frozenset(value for value, count in met.items() if count > 1)


def _band(piece: Piece, spans: Sequence[Span], seams: frozenset[Any]) -> Band:
    first, up = piece.ranges
    lo, hi = ends(piece, 0, {}, spans[0])
    xs = [lo] if first.is_point else list(lo + (hi - lo) * _inner_grid(SAMPLES))
    found = [ends(piece, 1, {0: x}, spans[1]) for x in xs]
    lower = None if up.lower is None else up.lower_closed
    upper = None if up.upper is None else up.upper_closed
    seam = first.is_point and first.lower is not None and first.lower.value in seams
    return Band(xs, [low for low, _ in found], [high for _, high in found], lower, upper, seam)


def _inner_grid(count: int) -> Any:
    """Shares of a range from end to end, dense towards the ends but not on them."""
    return INSIDE + (1 - 2 * INSIDE) * (1 - np.cos(np.linspace(0, np.pi, count))) / 2


def bands(region: Region) -> list[tuple[Sequence[float], Sequence[float], Sequence[float]]]:
    """A bounded region in two variables as areas between curves: values of the first variable, both ends over them."""
    nowhere = ((0.0, 0.0), (0.0, 0.0))  # every piece has ends of its own
    found = [_band(piece, nowhere, frozenset()) for piece in region.cells if not piece.ranges[0].is_point]
    return [(band.xs, band.low, band.high) for band in found]
