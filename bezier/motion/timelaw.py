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

from qe.errors import InputError
from qe.exact.rational_poly import RationalPoly

TICK = Fraction(1, 10**6)
ZERO, ONE = Fraction(0), Fraction(1)


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
    """A law on [0, 1]: polynomials of tau, each between two breaks. Invariant: increasing."""

    breaks: tuple[Fraction, ...]
    polynomials: tuple[RationalPoly, ...]

    @staticmethod
    def of(law: Law, ramp: Fraction = Fraction(1, 4)) -> TimeLaw:
        """``ramp``: the share of the time in which the trapezoid speeds up, and of that in which it slows down. Raises
        ``InputError`` for the least time, which depends on the path."""
        if law is Law.LEAST:
            raise InputError("law: expected cubic, quintic or trapezoid, which have a formula, found least")
        if law is not Law.TRAPEZOID:
            powers = [0, 0, 3, -2] if law is Law.CUBIC else [0, 0, 0, 10, -15, 6]
            return TimeLaw((ZERO, ONE), (RationalPoly.of(list(map(Fraction, powers))),))
        if not 0 < ramp <= Fraction(1, 2):
            raise InputError("the ramp of a trapezoid takes more than 0 and at most 1/2 of the time")
        top = 1 / (1 - ramp)
        bend = top / (2 * ramp)
        level = [[-top * ramp / 2, top]] if ramp < Fraction(1, 2) else []
        rows = [[ZERO, ZERO, bend], *level, [1 - bend, 2 * bend, -bend]]  # 1 - bend (1 - tau)^2
        return TimeLaw((ZERO, ramp, *([1 - ramp] if level else []), ONE), tuple(map(RationalPoly.of, rows)))

    @property
    def shares(self) -> list[RationalPoly]:
        """The polynomials, each by what is since its own break."""
        return [p.compose(RationalPoly.of([low, 1])) for low, p in zip(self.breaks, self.polynomials, strict=False)]

    def derivatives(self, tau: Fraction) -> tuple[Fraction, Fraction, Fraction]:
        """s, s' and s'' at tau, those of the earlier polynomial at a break."""
        p = next(p for high, p in zip(self.breaks[1:], self.polynomials, strict=True) if tau <= high)
        return p(tau), p.derivative()(tau), p.derivative().derivative()(tau)

    def passage(self, share: Fraction, width: Fraction) -> tuple[Fraction, Fraction]:
        """Rational numbers around the tau with s(tau) = share, equal where that is found exactly, as at breaks."""
        for low, high, p in zip(self.breaks, self.breaks[1:], self.polynomials, strict=False):
            if share == p(low):
                return low, low
            if share < p(high):
                break
        else:
            return self.breaks[-1], self.breaks[-1]
        while high - low > width:
            middle = (low + high) / 2
            value = p(middle)
            if value == share:
                return middle, middle
            low, high = (middle, high) if value < share else (low, middle)
        return low, high
