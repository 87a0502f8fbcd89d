"""What a picture of a region shows, as numbers: found once, under the limits of the question, painted anywhere.

A sketch is data for looking only; it can be sent between processes and painted on axes of the caller's.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from qe.decomposition.pieces import Piece, Range
from qe.errors import InputError, Unable
from qe.regions.described import Described as Region
from qe.regions.ends import Span, ends
from qe.regions.solid import Solid, spread
from qe.regions.space import Frame, shape_of

SAMPLES = 400
"""Samples along the first variable of one piece in the plane."""
MARGIN = 0.06
"""Free space around the region, as a share of its size."""
UNBOUNDED = 4.0
"""How far a picture follows a direction in which the region goes on for ever."""


Border = tuple[float, bool]


@dataclass(frozen=True, slots=True)
class Band:
    """A piece in the plane: values of the first variable, both ends above them, and what is known of the ends.

    ``lower``, ``upper``: whether the end belongs to the piece, None where the piece goes on for ever. ``start``,
    ``stop``: the first and the last value, and whether they belong to it, alike.
    """

    xs: Sequence[float]
    low: Sequence[float]
    high: Sequence[float]
    lower: bool | None
    upper: bool | None
    start: Border | None
    stop: Border | None

    @property
    def borders(self) -> list[Border]:
        """Both ends, where it has any."""
        return [end for end in (self.start, self.stop) if end is not None]


@dataclass(frozen=True, slots=True)
class Segment:
    """A piece of a line: its ends and whether they belong to it, None where it goes on for ever."""

    low: float
    high: float
    lower: bool | None
    upper: bool | None


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
    """The sketch of a region; ``InputError`` above three variables, ``Unable`` where its numbers are no floats."""
    order = tuple(region.order)
    if len(order) > 3:
        raise InputError(f"a picture needs 1 to 3 variables, the region has {len(order)}")
    try:
        return _sketched(region, order)
    except OverflowError:
        raise Unable("no picture: it would have numbers beyond floating point (about 10^308)") from None


def _sketched(region: Region, order: tuple[str, ...]) -> Sketch:
    if len(order) == 3:
        shape, frame = shape_of(region)
        return Sketch(order, region.is_empty, solid=shape, frame=frame)
    spans = tuple(_span(region, name) for name in order)
    if len(order) == 1:
        segments = [Segment(*ends(p, 0, {}, spans[0]), *_closed(p.ranges[0])) for p in region.cells]
        return Sketch(order, region.is_empty, spans, segments=tuple(segments))
    return Sketch(order, region.is_empty, spans, bands=tuple(_band(p, spans) for p in region.cells))


def _span(region: Region, variable: str) -> Span:
    """Drawing limits of a variable; unbounded directions are cut off."""
    if region.is_empty:
        return -1.0, 1.0
    lower, upper = region.bounds(variable)
    lo = float(lower) if lower is not None else (float(upper) if upper is not None else 0.0) - UNBOUNDED
    hi = float(upper) if upper is not None else (float(lower) if lower is not None else 0.0) + UNBOUNDED
    pad = MARGIN * (hi - lo) or max(1.0, MARGIN * abs(lo))  # more than the spacing of floats
    return lo - pad, hi + pad


def _closed(own: Range) -> tuple[bool | None, bool | None]:
    """Whether the ends of a range belong to it, None for those it does not have."""
    return None if own.lower is None else own.lower_closed, None if own.upper is None else own.upper_closed


def _band(piece: Piece, spans: Sequence[Span]) -> Band:
    first, up = piece.ranges
    lo, hi = ends(piece, 0, {}, spans[0])
    xs = [lo] if first.is_point else list(spread(lo, hi, SAMPLES))
    pairs = [ends(piece, 1, {0: x}, spans[1]) for x in xs]
    start, stop = (None if has is None else (x, has) for x, has in zip((lo, hi), _closed(first), strict=True))
    return Band(xs, [low for low, _ in pairs], [high for _, high in pairs], *_closed(up), start, stop)


def bands(region: Region) -> list[tuple[Sequence[float], Sequence[float], Sequence[float]]]:
    """A bounded region in two variables as areas between curves: values of the first variable, both ends over them."""
    nowhere = ((0.0, 0.0), (0.0, 0.0))  # every piece has ends of its own
    listed = [_band(piece, nowhere) for piece in region.cells if not piece.ranges[0].is_point]
    return [(band.xs, band.low, band.high) for band in listed]
