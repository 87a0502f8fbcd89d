"""Whether the exact angle of a joint lies between its limits."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import ceil, floor
from typing import Any

from bezier.arm.elimination import Quotient
from bezier.arm.model import Joint, Motion
from qe.errors import Unable
from qe.exact.point_values import Evaluation, pi_ends

MOST_BITS = 4096
Known = tuple[Quotient, ...]


def allowed(joint: Joint, here: Evaluation, quotients: Known, value: Callable[[Evaluation, Known, int], Any]) -> bool:
    """Whether the angle, or one that differs from it by full turns, lies in the closed interval of the limits.

    The limits are rational numbers of radians. cos and sin of a rational number other than 0 are transcendental
    (Lindemann), those of the angle algebraic: so more digits always tell the two apart, but for the limit 0. The length
    of a joint that slides may be a limit: it is compared exactly.
    """
    if joint.limits is None:
        return True
    if joint.motion is Motion.PRISMATIC:
        low, high = (_side(here, quotients[0], limit) for limit in joint.limits)
        return low >= 0 >= high
    least, most = joint.limits
    if most - least >= 7:  # more than a full turn
        return True
    turn = 2 * pi_ends(64 + max(abs(least), abs(most)).numerator.bit_length())[0]
    turns = range(floor(least / turn) - 1, ceil(most / turn) + 2)
    return any(_between(joint.limits, k, here, quotients, value) for k in turns)


def _between(
    limits: tuple[Fraction, Fraction],
    turns: int,
    here: Evaluation,
    quotients: Known,
    value: Callable[[Evaluation, Known, int], Any],
) -> bool:
    bits = 64
    while bits <= MOST_BITS:
        low, high = value(here, quotients, bits).ends
        pi_low, pi_high = pi_ends(bits + 16)
        low, high = (
            low + 2 * turns * (pi_low if turns > 0 else pi_high),
            high + 2 * turns * (pi_high if turns > 0 else pi_low),
        )
        above, below = _compare(low, high, limits[0]), _compare(low, high, limits[1])
        if above is None and limits[0] == 0 and turns == 0 and _is_zero(here, quotients):
            above = 0
        if below is None and limits[1] == 0 and turns == 0 and _is_zero(here, quotients):
            below = 0
        if above is not None and below is not None:
            return above >= 0 >= below
        if above == -1 or below == 1:
            return False
        bits *= 2
    raise Unable(f"an angle agrees with a limit of its joint to {MOST_BITS} binary places")


def _side(here: Evaluation, length: Quotient, limit: Fraction) -> int:
    """The sign of a length minus a limit."""
    scale, below = length.scale, here.point.sign(length.bottom)
    top = length.top * (scale.numerator * limit.denominator)
    return below * here.point.sign(top - length.bottom * (limit.numerator * scale.denominator))


def _compare(low: Fraction, high: Fraction, limit: Fraction) -> int | None:
    return 1 if low > limit else -1 if high < limit else None


def _is_zero(here: Evaluation, quotients: Known) -> bool:
    """Whether the angle is 0: the sine vanishes, and the cosine is then 1 or -1, which the interval around 0 tells."""
    return here.point.sign(quotients[1].top) == 0
