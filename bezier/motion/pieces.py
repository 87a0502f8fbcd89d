"""A path in time as one chain of Bézier curves: the form in which other programs take it.

Without a motion the time is that of ``path.csv``: each curve takes its duration. With one it is in seconds, and the
curves composed with the time law are polynomials again, between the breaks of the law and the passages from curve to
curve. Coordinates and passages that are irrational are replaced by rational numbers next to them (``BITS``).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any

from bezier.curves import bernstein as bs
from bezier.curves.curve import Bezier
from bezier.curves.enclosure import bounds
from bezier.motion.motion import Motion
from bezier.motion.timelaw import TimeLaw, composed, stretches
from bezier.paths.path import Path

BITS = 96


@dataclass(frozen=True, slots=True)
class Piece:
    """The part of a motion from ``low`` to ``high``: ``curve``, its parameter proportional to time, on ``name``."""

    name: str
    low: Fraction
    high: Fraction
    curve: Bezier


def pieces(path: Path, motion: Motion | None) -> tuple[Piece, ...]:
    """The motion as pieces of one degree, in order, each beginning where and when the one before ends."""
    curves = {name: Bezier(tuple(tuple(map(near, p)) for p in curve.points)) for name, curve in path.curves.items()}
    found = tuple(_plain(path, curves) if motion is None else _timed(path, curves, motion))
    degree = max(piece.curve.degree for piece in found)
    return tuple(Piece(p.name, p.low, p.high, p.curve.elevate(degree)) for p in found)


def near(value: Any) -> Fraction:
    """The number if it is rational, else a rational one next to it."""
    low, high = bounds(value, BITS)
    return (low + high) / 2


def _plain(path: Path, curves: dict[str, Bezier]) -> Iterator[Piece]:
    begin = Fraction(0)
    for name, curve in curves.items():
        end = begin + path.duration(name)
        yield Piece(name, begin, end, curve)
        begin = end


def _timed(path: Path, curves: dict[str, Bezier], motion: Motion) -> Iterator[Piece]:
    law = TimeLaw.of(motion.timing.law, motion.timing.ramp)
    certain = [stretch for stretch in stretches(path, law) if stretch.certain]
    middles = [(a.high + b.low) / 2 for a, b in pairwise(certain)]
    ends = [Fraction(0), *middles, Fraction(1)]
    for stretch, (low, high) in zip(certain, pairwise(ends), strict=True):
        curve, inside = curves[stretch.curve], (low, high - low)
        rows = [bs.to_power(curve.coordinate(i)) for i in range(curve.dimension)]
        forms = [bs.from_power(composed(composed(row, stretch.parameter), inside)) for row in rows]
        yield Piece(stretch.curve, low * motion.duration, high * motion.duration, _curve(forms))


def _curve(forms: list[bs.Coefficients]) -> Bezier:
    """The curve with these coordinates, whose degrees may differ."""
    degree = max(len(form) for form in forms) - 1
    return Bezier(tuple(zip(*(bs.elevate(form, degree) for form in forms), strict=True)))
