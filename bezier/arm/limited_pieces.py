"""The pieces of a motion, halved until the checker of certificates sees from them that it keeps all limits."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from math import tau

from bezier.arm.arm_json import arm_json
from bezier.arm.follow import SPARE, Branch, chain_of, curve_powers
from bezier.arm.model import Arm
from bezier.arm.motion_chain import Piece
from bezier.certify import branch as checked
from bezier.curves.curve import Bezier
from bezier.curves.scalar import exactly
from qe.errors import Unable
from qe.proof.entry import Entry

LEAST = Fraction(1, 1 << 40)
ROUNDING = 1e-14


def limited_pieces(
    arm: Arm, curves: Sequence[Bezier], parts: Sequence[tuple[int, Branch]], turns: Sequence[int]
) -> Iterator[tuple[int, Piece]]:
    """Pieces with the index of their curve, ``turns`` full turns added. Raises ``Unable`` where a joint comes closer to
    a limit than boxes can tell."""
    if not arm.has_limits:
        yield from ((k, piece) for k, branch in parts for piece in branch.pieces)
        return
    points = [[tuple(exactly(c) for c in p) for p in curve.points] for curve in curves]
    tubes = checked.Tubes(Entry(arm_json(arm), "arm"), points, [joint.limits for joint in arm.joints])
    tracks = [chain_of(arm).track(curve_powers(curve)) for curve in curves]
    for k, branch in parts:
        open_ones = [_turned(piece, turns) for piece in reversed(branch.pieces)]
        while open_ones:
            piece = open_ones.pop()
            if _keeps(tubes, k, piece):
                yield k, piece
                continue
            middle = (piece.low + piece.high) / 2
            halves = [
                chain_of(arm).piece(tracks[k], low, high, [float(v) for v in piece.at((low + high) / 2)])
                for low, high in ((middle, piece.high), (piece.low, middle))
            ]
            if piece.high - piece.low < LEAST or None in halves:
                raise Unable(f"near s = {float(middle):.9g} a joint is closer to a limit than boxes can tell")
            open_ones += [half for half in halves if half is not None]


def _turned(piece: Piece, turns: Sequence[int]) -> Piece:
    """Moved by full turns, rounded: the boxes have room for that."""
    centre = tuple(c + tau * k for c, k in zip(piece.centre, turns, strict=True))
    inner = tuple(r + ROUNDING * abs(k) for r, k in zip(piece.inner, turns, strict=True))
    return replace(piece, centre=centre, inner=inner)


def _keeps(tubes: checked.Tubes, curve: int, piece: Piece) -> bool:
    centre, slope, radius = (tuple(map(Fraction, values)) for values in (piece.centre, piece.slope, piece.radius))
    given = checked.Piece(curve, piece.low, piece.high, centre, slope, radius, Entry(None, "piece"))
    return tubes.unlimited(given, [SPARE * Fraction(r) for r in piece.inner]) is None
