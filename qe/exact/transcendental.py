"""Real numbers that are not algebraic, by the names of the variables that stand for them."""

from __future__ import annotations

from flint import arb

from qe.exact.balls import precision
from qe.spelling import NUMBERS

_BALLS = dict(zip(NUMBERS, (arb.pi, arb.const_e, arb.const_euler, arb.const_catalan)))


def floor_of(name: str, bits: int) -> int:
    """The greatest integer up to 2^bits times the number."""
    with precision(2 * bits + 64):
        return int((_BALLS[name]() * arb(2) ** bits).floor().unique_fmpz())
