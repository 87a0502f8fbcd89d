"""A rational point next to an algebraic one, in the same piece of space between the zeros of given polynomials."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import lcm
from typing import Any

from flint import arb, fmpq

from qe.errors import InternalError, Unable
from qe.exact.algebraic import RealAlgebraic
from qe.exact.balls import ends, hull, lower_end, precision, upper_end
from qe.exact.isolate import simplest_between
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point

_FIRST_BITS = 64
_MOST_BITS = 8192
_SHORT = 10**6
Balls = list[arb]


def rational_values(point: Point) -> tuple[Fraction, ...]:
    """The coordinates of a point all of whose coordinates are rational."""
    values = (point.number(i) for i in range(point.depth))
    return tuple(value for value in values if isinstance(value, Fraction))


def multiples_around(value: Any, unit: Fraction) -> tuple[Fraction, Fraction]:
    """The neighbouring multiples of ``unit``, a power of 1/2, around a number, which is told exactly (both are equal
    then) where it is rational and known as such, one of them, or a fraction with a short denominator."""
    if isinstance(value, Fraction | fmpq):
        return Fraction(str(value)), Fraction(str(value))
    low, high = ends(value.ball(unit.denominator.bit_length() + 4))
    middle = Fraction((low + high) / 2)
    for guess in (middle.limit_denominator(_SHORT), round(middle / unit) * unit):
        side = value.compare_rational(fmpq(guess.numerator, guess.denominator))
        if side == 0:
            return guess, guess
    return (guess, guess + unit) if side > 0 else (guess - unit, guess)


def rational_between(lower: Fraction | RealAlgebraic | None, upper: Fraction | RealAlgebraic | None) -> Fraction:
    """A simple rational number between two numbers, the first of which is smaller; None stands for infinity.

    Raises ``InternalError`` unless it is.
    """
    if lower is not None and upper is not None and not lower < upper:
        raise InternalError(f"no rational number lies between {lower} and {upper}")
    bits = _FIRST_BITS
    while True:
        low, high = _end(lower, bits, 1), _end(upper, bits, 0)
        if low is None:
            low = fmpq(-1) if high is None or high > 0 else fmpq(high.floor() - 2)
        if high is None:
            high = fmpq(1) if low < 0 else fmpq(low.ceil() + 2)
        if low < high:
            simplest = simplest_between(low, high)
            return Fraction(int(simplest.p), int(simplest.q))
        bits *= 2


def _end(value: Fraction | RealAlgebraic | None, bits: int, side: int) -> fmpq | None:
    """A rational bound of a number, from below (0) or above (1)."""
    if value is None:
        return None
    bound = value if isinstance(value, Fraction) else value.interval(bits)[side]
    return fmpq(bound.numerator, bound.denominator)


def nearby(
    point: Point, polys: Sequence[Poly], vanishing: frozenset[Poly], centre: Sequence[Fraction] | None
) -> tuple[Fraction, ...]:
    """A rational point r such that no polynomial vanishes on a connected set that joins r with the start of a segment.

    The segment is (point, point + t (centre - point)] for all small t > 0; ``vanishing`` are the polynomials known to
    vanish at the point. Without such polynomials the point itself is joined with r, and no centre is needed. Raises
    ``Unable`` if a polynomial vanishes on the whole segment.
    """
    bits = _FIRST_BITS
    segment = None
    if vanishing:
        assert centre is not None
        segment = _Segment(point, polys, vanishing, centre)
    while bits <= _MOST_BITS:
        with precision(bits + 16):
            start: Balls | None = _coordinates(point, bits)
            if segment is not None and start is not None:
                start = segment.entered(start)
            found = None if start is None else _inside_box(polys, start, bits)
        if found is not None:
            return found
        bits *= 2
    raise Unable("no rational point next to an algebraic one was found")


def _coordinates(point: Point, bits: int) -> Balls:
    balls = []
    for i in range(point.depth):
        value = point.coordinate(i)
        balls.append(arb(value) if isinstance(value, fmpq) else point.ball(i, bits))
    return balls


def enclosure(point: Point, i: int, bits: int) -> tuple[Fraction, Fraction]:
    """Rational numbers around a coordinate; both are the coordinate if it is rational."""
    value = point.coordinate(i)
    if isinstance(value, fmpq):
        exact = Fraction(int(value.p), int(value.q))
        return exact, exact
    with precision(bits):
        ball = point.ball(i, bits)
    return ends(ball)


def without_zeros(polys: Sequence[Poly], sides: Sequence[tuple[Fraction, Fraction]], bits: int) -> bool:
    """Whether it is seen that no polynomial vanishes in a box."""
    with precision(bits):
        box = [hull(fmpq(a.numerator, a.denominator), fmpq(b.numerator, b.denominator)) for a, b in sides]
        return not any(enclosed(f, box).contains(0) for f in polys)


def enclosed(f: Poly, at: Sequence[arb]) -> arb:
    """A ball around f at a box (all variables of f are given), by nested Horner evaluation."""
    if not f.variables:
        return arb(f.constant_value())
    i = f.variables[-1]
    total = arb(0)
    for c in reversed(f.coefficients(i)):
        total = total * at[i] + enclosed(c, at)
    return total


def _inside_box(polys: Sequence[Poly], at: Balls, bits: int) -> tuple[Fraction, ...] | None:
    """A simple rational point of the largest box around the balls that is seen to hold no zero."""
    for size in range(2, bits // 2, 3):
        half = arb(2) ** -size
        box = [x + arb(0, half) for x in at]
        if not any(enclosed(f, box).contains(0) for f in polys):
            return tuple(_simplest(x) for x in box)
    return None


def _simplest(x: arb) -> Fraction:
    q = simplest_between(lower_end(x), upper_end(x))
    return Fraction(int(q.p), int(q.q))


class _Segment:
    """The polynomials along x + t (centre - x), as coefficients of powers of t over the point.

    t is counted in units of one over the common denominator of the centre.
    """

    def __init__(
        self, point: Point, polys: Sequence[Poly], vanishing: frozenset[Poly], centre: Sequence[Fraction]
    ) -> None:
        self.unit = lcm(*(c.denominator for c in centre))
        self.goal = [int(c * self.unit) for c in centre]
        ring = point.ring
        longer = Ring.of((*ring.names, "along segment"))
        t = longer.gen(ring.size)
        moved = {i: longer.gen(i) + t * (g - self.unit * longer.gen(i)) for i, g in enumerate(self.goal)}
        self.rows: list[list[Poly]] = []
        for f in polys:
            row = [c.convert(ring) for c in f.convert(longer).compose(moved).coefficients(ring.size)]
            first = 1 if f in vanishing else 0
            while first < len(row) and point.vanishes(point.reduce(row[first])):
                first += 1
            if first == len(row):
                raise Unable("a boundary polynomial vanishes on a whole segment")
            self.rows.append(row[first:])

    def entered(self, at: Balls) -> Balls | None:
        """The point at a t > 0 up to which (0 excluded) no polynomial vanishes; None if the balls are too wide."""
        values = [[enclosed(c, at) for c in row] for row in self.rows]
        if any(row[0].contains(0) for row in values):
            return None
        step = Fraction(1, 4 * self.unit)
        while any(_on(row, step).contains(0) for row in values):
            step /= 4
        return [x + arb(fmpq(step.numerator, step.denominator)) * (g - self.unit * x) for x, g in zip(at, self.goal)]


def _on(row: Sequence[arb], step: Fraction) -> arb:
    """The values of a polynomial in t on [0, step]."""
    half = fmpq(step.numerator, 2 * step.denominator)
    interval = arb(half, half)
    total = arb(0)
    for c in reversed(row):
        total = total * interval + c
    return total
