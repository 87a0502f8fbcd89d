"""Does the path go through the origin O? The paper leaves O out of the reachable set, so it is worth a note.

A curve goes through O where its three coordinates vanish together: at events at which all three signs are zero.
"""

from __future__ import annotations

from fractions import Fraction

from bezier.curves.curve import Bezier
from bezier.curves.events import events_of
from bezier.curves.nonnegative import Interval
from bezier.curves.scalar import sign
from bezier.paths.path import Path

START, END = (Fraction(0), Fraction(0)), (Fraction(1), Fraction(1))


def through_origin(curve: Bezier) -> tuple[Interval, ...]:
    """The parameters with P(t) = O, ascending, each isolated (equal ends: exactly)."""
    rows = [curve.coordinate(i) for i in range(curve.dimension)]
    if any({sign(c) for c in row} in ({1}, {-1}) for row in rows):
        return ()
    return tuple(event.t for event in events_of(rows) if not any(event.signs))


def remarks(path: Path) -> tuple[str, ...]:
    """A note for each place inside a curve where the path goes through O; given points in O have notes of their own."""
    found = []
    for name, curve in path.curves.items():
        for low, high in through_origin(curve):
            if (low, high) not in (START, END):
                t = str(low) if low == high else f"about {float((low + high) / 2):.8g}"
                found.append(f"the path goes through the origin O ({name} at t = {t}), which the paper excludes")
    return tuple(found)
