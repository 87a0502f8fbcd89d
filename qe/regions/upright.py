"""The upright lines in a picture of a planar region: where its pieces end over one value of the first variable.

Over such a value the line is divided by the ends of the pieces beside it and on it. A part is a border if it belongs to
the region and not both sides do (drawn solid), or if it does not belong and a side does (dashed); a part with all three
is inside.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from qe.regions.sketch import Band

Part = tuple[float, float]

NEAR = 2e-3
"""The share of the height below which a part is not drawn: where pieces taper, their samples end a little before."""


@dataclass(frozen=True, slots=True)
class Upright:
    """A border over x; ``closed``: it belongs to the region; ``open_ends``: those of its ends that do not."""

    x: float
    low: float
    high: float
    closed: bool
    open_ends: tuple[float, ...] = ()


def uprights(bands: Sequence[Band], height: float) -> Iterator[Upright]:
    """The upright borders of pieces; ``height``: that of the picture."""
    least = NEAR * height
    for x in sorted({x for band in bands for x, _ in band.borders}):
        on = [b for b in bands if len(b.xs) == 1 and b.xs[0] == x]
        sides = [[part for part, _ in beside] for beside in _beside(bands, x)]
        own = [(b.low[0], b.high[0]) for b in on]
        own += [part for beside in _beside(bands, x) for part, closed in beside if closed]
        ends = sorted({end for part in (*sides[0], *sides[1], *own) for end in part})
        places = [end for k, end in enumerate(ends) if not k or end - ends[k - 1] > least] + ends[-1:]
        for low, high in pairwise(places):
            middle = (low + high) / 2
            beside = [_within(middle, parts) for parts in sides]
            member = _within(middle, own)
            if high - low > least and any((*beside, member)) and not (member and all(beside)):
                hollow = [end for b in on for end, has in ((b.low[0], b.lower), (b.high[0], b.upper)) if has is False]
                loose = tuple(end for end in hollow if end in (low, high)) if not any(beside) else ()
                yield Upright(x, low, high, member, loose)


def isolated(bands: Sequence[Band], height: float) -> list[tuple[float, float]]:
    """The pieces that are single points where no other piece ends."""
    least, points = NEAR * height, []
    for point in bands:
        if len(point.xs) == 1 and point.low == point.high:
            (x,), (y,) = point.xs, point.low
            beside = [part for side in _beside(bands, x) for part, _ in side]
            if not any(low - least <= y <= high + least for low, high in beside):
                points.append((x, y))
    return points


def _beside(bands: Sequence[Band], x: float) -> tuple[list[tuple[Part, bool]], list[tuple[Part, bool]]]:
    """What the pieces left and right of x are there, and whether it belongs to them."""
    wide = [b for b in bands if len(b.xs) > 1]
    left = [((b.low[-1], b.high[-1]), b.stop[1]) for b in wide if b.stop is not None and b.stop[0] == x]
    right = [((b.low[0], b.high[0]), b.start[1]) for b in wide if b.start is not None and b.start[0] == x]
    return left, right


def _within(y: float, parts: Sequence[Part]) -> bool:
    return any(low <= y <= high for low, high in parts)
