"""Whether the exact angle of a joint lies between its limits."""

from __future__ import annotations

from fractions import Fraction
from math import ceil, floor

from bezier.arm.elimination import Quotient
from bezier.arm.model import Joint, Motion
from bezier.arm.value import Known, value_of
from qe.errors import Unable
from qe.exact.point_values import Evaluation, pi_ends

MOST_BITS = 4096
MOST_RADIANS = 25
"""Limits of joints that turn: four full turns. Larger ones may be degrees."""


def allowed(joint: Joint, here: Evaluation, known: Known) -> bool:
    """Whether the angle, or one that differs from it by full turns, lies in the closed interval of the limits.

    The limits are rational numbers of radians. cos and sin of a rational number other than 0 are transcendental
    (Lindemann), those of the angle algebraic: so more digits always tell the two apart, but for the limit 0. The length
    of a joint that slides may be a limit: it is compared exactly.
    """
    if joint.limits is None:
        return True
    least, most = joint.limits
    if joint.motion is Motion.PRISMATIC:
        return length_side(here, known[0], least) >= 0 >= length_side(here, known[0], most)
    if most - least >= 7:  # more than a full turn
        return True
    return any(side(here, known, k, least) >= 0 and side(here, known, k, most) <= 0 for k in full_turns(joint.limits))


def full_turns(limits: tuple[Fraction, Fraction]) -> range:
    """How many full turns an angle in (-pi, pi] may be away from one between the limits, and some more."""
    least, most = limits
    turn = 2 * pi_ends(64 + max(abs(least), abs(most)).numerator.bit_length())[0]
    return range(floor(least / turn) - 2, ceil(most / turn) + 2)


def side(here: Evaluation, known: Known, turns: int, limit: Fraction) -> int:
    """The sign of an angle, full turns added, minus a limit (rad). Raises ``Unable`` if they agree to 4096 places."""
    bits = 64
    while bits <= MOST_BITS:
        low, high = value_of(here, known, bits).ends
        pi_low, pi_high = pi_ends(bits + 16)
        low += 2 * turns * (pi_low if turns > 0 else pi_high)
        high += 2 * turns * (pi_high if turns > 0 else pi_low)
        if low > limit or high < limit:
            return 1 if low > limit else -1
        # the sine vanishes, and the interval around 0 tells that the cosine is 1
        if limit == 0 and turns == 0 and here.point.sign(known[1].top) == 0:
            return 0
        bits *= 2
    raise Unable(f"an angle agrees with a limit of its joint to {MOST_BITS} binary places")


def length_side(here: Evaluation, length: Quotient, limit: Fraction) -> int:
    """The sign of a length minus a limit."""
    scale, below = length.scale, here.point.sign(length.bottom)
    top = length.top * (scale.numerator * limit.denominator)
    return below * here.point.sign(top - length.bottom * (limit.numerator * scale.denominator))
