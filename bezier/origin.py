"""Does the path go through the origin O? The paper leaves O out of the reachable set, so it is worth a note.

A curve goes through O where its three coordinates vanish together: at the roots of their greatest common divisor.
"""

from __future__ import annotations

from fractions import Fraction
from functools import reduce

from bezier.curves import bernstein as bs
from bezier.curves.curve import Bezier
from bezier.curves.nonnegative import Interval, isolate, located
from bezier.curves.scalar import is_zero, sign
from bezier.path import Path

START, END = (Fraction(0), Fraction(0)), (Fraction(1), Fraction(1))


def through_origin(curve: Bezier) -> tuple[Interval, ...]:
    """The parameters with P(t) = O, ascending, each isolated (equal ends: exactly)."""
    rows = [curve.coordinate(i) for i in range(curve.dimension)]
    if any({sign(c) for c in row} in ({1}, {-1}) for row in rows):
        return ()
    powers = [bs.to_power(row) for row in rows]
    common = bs.trim(reduce(lambda a, b: bs.gcd(a, b) if a and b else a or b, map(bs.trim, powers)))
    found = [at for at in (START, END) if all(is_zero(c) for c in curve.point(at[0]))]
    if len(common) > 1:
        form = bs.from_power(common)
        found += [located(form, interval) for interval in isolate(form)]
    return tuple(sorted(found))


def remarks(path: Path) -> tuple[str, ...]:
    """A note for each place inside a curve where the path goes through O; given points in O have notes of their own."""
    found = []
    for name, curve in path.curves.items():
        for low, high in through_origin(curve):
            if (low, high) not in (START, END):
                t = str(low) if low == high else f"about {float((low + high) / 2):.8g}"
                found.append(f"the path goes through the origin O ({name} at t = {t}), which the paper excludes")
    return tuple(found)
