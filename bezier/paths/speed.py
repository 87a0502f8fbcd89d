"""How slow a curve gets: a proved positive least speed, or the parameters at which it stops."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from bezier.curves.curve import Bezier
from bezier.curves.enclosure import Enclosure, maximum, root_above, root_below
from bezier.curves.nonnegative import UNIT, Interval, isolate, located
from bezier.curves.scalar import is_zero
from bezier.paths.path import Path

REL = Fraction(1, 10**6)
"""Relative width of the enclosure of the squared speed."""


@dataclass(frozen=True, slots=True)
class Slowest:
    """The least speed of a curve in mm per unit of time.

    ``least``: it lies in this enclosure, which is 0 when the curve stops. ``stops``: where, as intervals of the
    parameter with one zero of the speed each (equal ends: exactly there).
    """

    least: Enclosure
    stops: tuple[Interval, ...]


def slowest(curve: Bezier, duration: Fraction = Fraction(1)) -> Slowest:
    """The least of |P'(t)| / duration over [0, 1]."""
    squared = curve.hodograph().norm_squared()
    zero = Enclosure(Fraction(0), Fraction(0))
    if all(map(is_zero, squared)):
        return Slowest(zero, (UNIT,))
    ends = [(t, t) for t, value in zip(UNIT, (squared[0], squared[-1]), strict=True) if is_zero(value)]
    stops = sorted([*ends, *(located(squared, interval) for interval in isolate(squared))])
    if stops:
        return Slowest(zero, tuple(stops))
    # the least of p > 0 is one over the largest of 1/p
    top = maximum((Fraction(1),), squared, REL)
    assert top.high is not None
    return Slowest(Enclosure(root_below(1 / top.high) / duration, root_above(1 / top.low) / duration), ())


def slowest_of(path: Path) -> Mapping[str, Slowest]:
    """``slowest`` for each curve of a path, with respect to time."""
    return {name: slowest(curve, path.duration(name)) for name, curve in path.curves.items()}
