"""Time laws: how a path of several curves is run through in a given time, with rigorous bounds of its speed.

The path parameter is sigma in [0, D], D the sum of the durations d_k of the curves; curve k is at
u = (sigma - sigma_k) / d_k. A law s maps tau = time / T in [0, 1] onto [0, 1] without turning back, and
sigma = D s(tau). With X(tau) the position, velocity and acceleration are X'(tau) / T and X''(tau) / T^2, so their
largest norms for T = 1 say everything.

Between the breaks of the law and the passages from one curve to the next, |X'|^2 and |X''|^2 are polynomials in tau,
whose maxima are enclosed (``curves.enclosure.maximum``). A passage at an irrational tau is enclosed too; what both
curves reach inside that interval counts for the upper bounds only.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from math import ceil
from typing import Any

from bezier.curves import bernstein as bs
from bezier.curves.enclosure import Enclosure, bounds, maximum, root_above, root_enclosure
from bezier.paths.path import Path
from qe.errors import InputError

REL = Fraction(1, 10**6)
PASSAGE_WIDTH = Fraction(1, 2**60)
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

    def derivatives(self, tau: Fraction) -> tuple[Fraction, Fraction, Fraction]:
        """s, s' and s'' at tau, those of the earlier polynomial at a break."""
        pieces = zip(self.breaks[1:], self.polynomials, strict=True)
        polynomial = next(p for high, p in pieces if tau <= high)
        slope = bs.power_derivative(polynomial)
        value, first, second = (bs.power_value(p, tau) for p in (polynomial, slope, bs.power_derivative(slope)))
        return value, first, second

    def passage(self, share: Fraction, width: Fraction = PASSAGE_WIDTH) -> tuple[Fraction, Fraction]:
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


@dataclass(frozen=True, slots=True)
class TimeStretch:
    """A time interval in which a curve is run through by one polynomial: ``parameter`` is u as a power form of tau."""

    curve: str
    low: Fraction
    high: Fraction
    parameter: Power
    certain: bool
    """Whether the curve is on its way in all of it; otherwise the passage to its neighbour lies in it."""


def stretches(path: Path, law: TimeLaw) -> Iterator[TimeStretch]:
    """The stretches of a motion in order; neighbours overlap by at most ``PASSAGE_WIDTH``."""
    total = sum((path.duration(name) for name in path.curves), ZERO)
    begin, start = ZERO, (ZERO, ZERO)
    for name in path.curves:
        length = path.duration(name)
        end = law.passage((begin + length) / total) if begin + length < total else (ONE, ONE)
        for low, high, certain in ((*start, False), (start[1], end[0], True), (*end, False)):
            for first, last, polynomial in zip(law.breaks, law.breaks[1:], law.polynomials, strict=False):
                if max(low, first) < min(high, last):
                    shifted = (polynomial[0] - begin / total, *polynomial[1:])
                    scaled = tuple(c * total / length for c in shifted)
                    yield TimeStretch(name, max(low, first), min(high, last), scaled, certain)
        begin, start = begin + length, end


@dataclass(frozen=True, slots=True)
class Extremes:
    """The largest speed and acceleration of a motion that takes one unit of time."""

    speed: Enclosure
    acceleration: Enclosure

    def lasting(self, duration: Fraction) -> Extremes:
        """The same for a motion that takes this time."""
        return Extremes(self.speed.scaled(1 / duration), self.acceleration.scaled(1 / duration**2))


def extremes(path: Path, law: TimeLaw, rel: Fraction = REL) -> Extremes:
    """Enclosures of max |X'| and max |X''| over the whole motion, for T = 1."""
    speed = acceleration = Enclosure(ZERO, ZERO)
    for stretch in stretches(path, law):
        rows = zip(*path.curves[stretch.curve].points, strict=True)
        position = [composed(bs.to_power(row), stretch.parameter) for row in rows]
        velocity = [bs.power_derivative(p) for p in position]
        speed = _larger(speed, _largest_norm(velocity, stretch, rel))
        acceleration = _larger(acceleration, _largest_norm([bs.power_derivative(v) for v in velocity], stretch, rel))
    return Extremes(speed, acceleration)


def composed(outer: Power, inner: Power) -> Power:
    """outer(inner(tau)) by Horner's rule."""
    total: Power = ()
    for c in reversed(outer):
        product = bs.power_multiply(total, inner) or (ZERO,)
        total = (product[0] + c, *product[1:])
    return total


def _largest_norm(vector: list[Power], stretch: TimeStretch, rel: Fraction) -> Enclosure:
    """The largest norm of a vector of polynomials on the stretch."""
    square: bs.Coefficients = (ZERO,)
    for p in vector:
        moved = bs.from_power(composed(p, (stretch.low, stretch.high - stretch.low)))
        square = bs.add(square, bs.multiply(moved, moved))
    if not stretch.certain:
        return root_enclosure(ZERO, max(bounds(c)[1] for c in square))
    return root_enclosure(*maximum(square, (ONE,), rel).finite)


def _larger(a: Enclosure, b: Enclosure) -> Enclosure:
    return Enclosure(*map(max, a.finite, b.finite))


def least_duration(unit: Extremes, limits: Mapping[str, Fraction]) -> Fraction:
    """The least time in which ``max_speed`` and ``max_acceleration`` are kept, rounded up to a multiple of ``TICK``.

    Speed scales with 1/T and acceleration with 1/T^2. ``unit``: the extremes for T = 1.
    """
    times = [ZERO]
    if "max_speed" in limits:
        times.append(unit.speed.finite[1] / limits["max_speed"])
    if "max_acceleration" in limits:
        times.append(root_above(unit.acceleration.finite[1] / limits["max_acceleration"], bits=64))
    return ceil(max(times) / TICK) * TICK
