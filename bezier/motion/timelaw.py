"""Time laws: how a path of several curves is run through in a given time.

The path parameter is sigma in [0, D], D the sum of the durations d_k of the curves; curve k is at
u = (sigma - sigma_k) / d_k. A law s maps tau = time / T in [0, 1] onto [0, 1] without turning back, and
sigma = D s(tau). With X(tau) the position, velocity and acceleration are X'(tau) / T and X''(tau) / T^2, so their
largest norms for T = 1 say everything.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from typing import Any

from bezier.curves import bernstein as bs
from qe.errors import InputError
from qe.exact.rational_poly import RationalPoly

TICK = Fraction(1, 10**6)
ZERO, ONE = Fraction(0), Fraction(1)
Power = tuple[Any, ...]


class Law(Enum):
    """How the path is run through.

    CUBIC: 3 tau^2 - 2 tau^3, at rest at both ends. QUINTIC: 6 tau^5 - 15 tau^4 + 10 tau^3, without acceleration there
    either. TRAPEZOID: the speed rises linearly, stays, and falls linearly. LEAST: as fast as the limits allow.
    """

    CUBIC = "cubic"
    QUINTIC = "quintic"
    TRAPEZOID = "trapezoid"
    LEAST = "least"


@dataclass(frozen=True, slots=True)
class TimeLaw:
    """A law on [0, 1]: polynomials of tau by ascending powers, each between two breaks. Invariant: increasing."""

    breaks: tuple[Fraction, ...]
    polynomials: tuple[Power, ...]

    @staticmethod
    def of(law: Law, ramp: Fraction = Fraction(1, 4)) -> TimeLaw:
        """``ramp``: the share of the time in which the trapezoid speeds up, and of that in which it slows down. Raises
        ``InputError`` for the least time, which depends on the path."""
        if law is Law.CUBIC:
            return TimeLaw((ZERO, ONE), ((ZERO, ZERO, Fraction(3), Fraction(-2)),))
        if law is Law.QUINTIC:
            return TimeLaw((ZERO, ONE), ((ZERO, ZERO, ZERO, Fraction(10), Fraction(-15), Fraction(6)),))
        if law is Law.LEAST:
            raise InputError("law: expected cubic, quintic or trapezoid, which have a formula, found least")
        if not 0 < ramp <= Fraction(1, 2):
            raise InputError("the ramp of a trapezoid takes more than 0 and at most 1/2 of the time")
        top = 1 / (1 - ramp)
        bend = top / (2 * ramp)
        rise, fall = (ZERO, ZERO, bend), (1 - bend, 2 * bend, -bend)  # 1 - bend (1 - tau)^2
        if ramp == Fraction(1, 2):
            return TimeLaw((ZERO, ramp, ONE), (rise, fall))
        return TimeLaw((ZERO, ramp, 1 - ramp, ONE), (rise, (-top * ramp / 2, top), fall))

    @property
    def shares(self) -> list[RationalPoly]:
        """The polynomials, each by what is since its own break."""
        moved = zip(self.breaks, self.polynomials, strict=False)
        return [RationalPoly.of(p).compose(RationalPoly.of([low, 1])) for low, p in moved]

    def derivatives(self, tau: Fraction) -> tuple[Fraction, Fraction, Fraction]:
        """s, s' and s'' at tau, those of the earlier polynomial at a break."""
        pieces = zip(self.breaks[1:], self.polynomials, strict=True)
        polynomial = next(p for high, p in pieces if tau <= high)
        slope = bs.power_derivative(polynomial)
        value, first, second = (bs.power_value(p, tau) for p in (polynomial, slope, bs.power_derivative(slope)))
        return value, first, second

    def passage(self, share: Fraction, width: Fraction) -> tuple[Fraction, Fraction]:
        """Rational numbers around the tau with s(tau) = share, equal where that is found exactly, as at breaks."""
        for low, high, polynomial in zip(self.breaks, self.breaks[1:], self.polynomials, strict=False):
            if share == bs.power_value(polynomial, low):
                return low, low
            if share < bs.power_value(polynomial, high):
                break
        else:
            return self.breaks[-1], self.breaks[-1]
        while high - low > width:
            middle = (low + high) / 2
            value = bs.power_value(polynomial, middle)
            if value == share:
                return middle, middle
            low, high = (middle, high) if value < share else (low, middle)
        return low, high
