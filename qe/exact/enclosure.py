"""Rigorous enclosures of root functions over boxes, with first derivatives (ball arithmetic, forward mode).

All functions compute at FLINT's working precision, which the caller sets (``qe.exact.balls.precision``).

With f(centre) and a gradient that varies by at most r_i (in radius) over a box of half-widths h_i, the mean
of f over the box differs from f(centre) by at most Σ r_i h_i / 2: second order in the size of the box.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction

from flint import arb, arb_poly, ctx, fmpq

from qe.exact.algebraic import RealAlgebraic
from qe.exact.ball_roots import certified_roots
from qe.exact.balls import hull
from qe.exact.ring import Poly

Sides = tuple[arb, ...]


class Jet:
    """A ball ``value`` around all values on the box, the balls of the partial derivatives there (None: not known to be
    bounded), and a ball around the value at the box's centre. ``sides``: the box as [-h_i, h_i] around its centre.
    """

    __slots__ = ("centre", "sides", "slope", "value")

    def __init__(self, value: arb, slope: tuple[arb, ...] | None, centre: arb, sides: tuple[arb, ...]) -> None:
        if slope is not None and sides:
            tight = centre  # the mean value form is second order where the plain evaluation is first order
            for d, side in zip(slope, sides, strict=True):
                tight = tight + d * side
            if tight.rad() < value.rad():
                value = tight
        self.value, self.slope, self.centre, self.sides = value, slope, centre, sides

    def __add__(self, other: Jet) -> Jet:
        slope = _both(self.slope, other.slope, lambda a, b: a + b)
        return Jet(self.value + other.value, slope, self.centre + other.centre, self.sides)

    def __sub__(self, other: Jet) -> Jet:
        slope = _both(self.slope, other.slope, lambda a, b: a - b)
        return Jet(self.value - other.value, slope, self.centre - other.centre, self.sides)

    def __neg__(self) -> Jet:
        return self.scaled(-1)

    def __mul__(self, other: Jet) -> Jet:
        slope = _both(self.slope, other.slope, lambda a, b: a * other.value + b * self.value)
        return Jet(self.value * other.value, slope, self.centre * other.centre, self.sides)

    def scaled(self, factor: arb | int) -> Jet:
        """A constant multiple."""
        return Jet(self.value * factor, self._steeper(factor), self.centre * factor, self.sides)

    def _steeper(self, factor: arb | int) -> tuple[arb, ...] | None:
        """The partial derivatives times a factor."""
        return None if self.slope is None else tuple(d * factor for d in self.slope)

    def inverse(self) -> Jet | None:
        """1/self, or None when zero is not excluded."""
        if self.value.contains(0):
            return None
        slope = self._steeper(-1 / (self.value * self.value))
        return Jet(1 / self.value, slope, 1 / self.centre, self.sides)

    def root(self) -> Jet:
        """The square root of a function known to be nonnegative."""
        centre = _root(self.centre)
        if self.value > 0:
            value = self.value.sqrt()
            return Jet(value, self._steeper(1 / (2 * value)), centre, self.sides)
        return Jet(_root(self.value), None, centre, self.sides)

    def over(self, divisor: int) -> Jet:
        """Divided by a nonzero integer."""
        return self.scaled(1 / arb(divisor))

    def arcsine(self) -> Jet:
        """asin of a function known to lie in [-1, 1]."""
        value, centre = _arcsine(self.value), _arcsine(self.centre)
        inside = 1 - self.value * self.value
        return Jet(value, self._steeper(inside.rsqrt()) if inside > 0 else None, centre, self.sides)

    def mean(self) -> arb:
        """A ball around the mean value on the box."""
        if self.slope is None or not all(d.is_finite() for d in self.slope):
            return self.value
        spread = arb(0)
        for d, side in zip(self.slope, self.sides, strict=True):
            spread += arb(d.rad()) * side.abs_upper()
        refined = self.centre + arb(0, 1) * spread / 2
        return refined if refined.rad() < self.value.rad() else self.value


def _arcsine(x: arb) -> arb:
    quarter = arb.pi() / 2
    low, high = x.lower(), x.upper()
    return (low.asin() if low > -1 and low < 1 else -quarter if low <= -1 else quarter).union(
        high.asin() if high < 1 and high > -1 else quarter if high >= 1 else -quarter
    )


def _root(x: arb) -> arb:
    if x > 0:
        return x.sqrt()
    top = x.upper()
    return arb(0).union(top.sqrt()) if top > 0 else arb(0)


def _both(
    a: tuple[arb, ...] | None, b: tuple[arb, ...] | None, join: Callable[[arb, arb], arb]
) -> tuple[arb, ...] | None:
    if a is None or b is None:
        return None
    return tuple(join(x, y) for x, y in zip(a, b, strict=True))


def box_sides(box: Sequence[tuple[Fraction, Fraction]]) -> tuple[arb, ...]:
    """The sides of a box as balls around zero."""
    halves = [(b - a) / 2 for a, b in box]
    return tuple(arb(0, 1) * arb(fmpq(h.numerator, h.denominator)) for h in halves)


def constant(value: Fraction | int | RealAlgebraic, sides: tuple[arb, ...]) -> Jet:
    """A number as a jet."""
    ball = value.ball(ctx.prec) if isinstance(value, RealAlgebraic) else arb(fmpq(value.numerator, value.denominator))
    return Jet(ball, (arb(0),) * len(sides), ball, sides)


def smooth_side(lo: Fraction, hi: Fraction, side: int, sides: tuple[arb, ...]) -> tuple[Jet, Jet]:
    """w(v) = 3v^2 - 2v^3 on [lo, hi] within [0, 1], and w'(v): the substitution that removes square-root ends."""
    v = hull(fmpq(lo.numerator, lo.denominator), fmpq(hi.numerator, hi.denominator))
    middle = (lo + hi) / 2
    c = arb(fmpq(middle.numerator, middle.denominator))
    first, second = [arb(0)] * len(sides), [arb(0)] * len(sides)
    first[side], second[side] = 6 * v * (1 - v), 6 - 12 * v
    place = Jet(v * v * (3 - 2 * v), tuple(first), c * c * (3 - 2 * c), sides)
    return place, Jet(6 * v * (1 - v), tuple(second), 6 * c * (1 - c), sides)


def evaluate(p: Poly, at: Mapping[int, Jet], sides: tuple[arb, ...]) -> Jet:
    """The polynomial at jets for its variables."""
    if p.is_constant:
        return constant(p.constant_value(), sides)
    i = p.level
    total: Jet | None = None
    for c in reversed(p.coefficients(i)):
        own = evaluate(c, at, sides)
        total = own if total is None else total * at[i] + own
    assert total is not None
    return total


def root_jet(p: Poly, k: int, at: Mapping[int, Jet], sides: tuple[arb, ...]) -> Jet | None:
    """The k-th root (from 1, with multiplicity) of p in its main variable; None if not enclosed."""
    c = [evaluate(a, at, sides) for a in p.coefficients(p.level)]
    if len(c) == 2:
        scale = c[1].inverse()
        return None if scale is None else -c[0] * scale
    if len(c) != 3:
        return _isolated_root(c, k, sides)
    scale = c[2].scaled(2).inverse()
    if scale is None:
        return None
    root = (c[1] * c[1] - (c[2] * c[0]).scaled(4)).root()
    lower = (k == 1) == bool(c[2].value > 0)
    return ((-c[1]) - root if lower else root - c[1]) * scale


def _isolated_root(c: list[Jet], k: int, sides: tuple[arb, ...]) -> Jet | None:
    """A simple root of higher degree: Krawczyk's test around the root at the centre.

    If N(Y) = y0 - f(box, y0)/f'(box, Y) lies inside Y, every f(x, .) with x in the box has exactly one root in Y; being
    the k-th at the centre it is the k-th throughout, because roots do not cross inside a cell.
    """
    at_centre = certified_roots([a.centre for a in c], ctx.prec // 2)
    if at_centre is None or len(at_centre) < k:
        return None
    y0 = at_centre[k - 1].mid()
    f = arb_poly([a.value for a in c])
    slope = f.derivative()
    residual = f(y0)
    guess = at_centre[k - 1]
    for _ in range(8):
        wide = guess + arb(0, 1) * (guess.rad() + arb(2) ** (20 - ctx.prec))
        steepness = slope(wide)
        if steepness.contains(0):
            return None
        guess = y0 - residual / steepness
        if wide.contains_interior(guess):
            slopes: list[arb] = []
            for i in range(len(sides)):
                if any(a.slope is None for a in c):
                    return Jet(guess, None, at_centre[k - 1], sides)
                slopes.append(-arb_poly([a.slope[i] for a in c if a.slope is not None])(guess) / steepness)
            return Jet(guess, tuple(slopes), at_centre[k - 1], sides)
    return None
