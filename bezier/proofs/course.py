"""An arm with three joints along a curve, in ball arithmetic, and Krawczyk's test.

The first joint moves everything rigidly. So f is the end point less the curve's point at middle + σ, both seen from
what the first joint carries while it goes along its line: it has the same zeros, and is as tame near the axis of that
joint as elsewhere. THEOREM (Krawczyk 1969; Neumaier, Interval Methods for Systems of Equations, section 5.1, with a
parameter): for any matrix C, if -C f(σ, 0) + (I - C ∂f/∂r(σ, R)) R lies in the interior of the box R for all σ, there
is exactly one r in R with f = 0, for every σ; it lies in that image, and depends continuously on σ.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import comb
from typing import Any

from flint import arb, arb_mat, arb_poly, arb_series

from bezier.proofs.arm_rows import ArmChain
from bezier.proofs.square_roots import (
    Polynomial,
    Surd,
    back,
    carried_with_rates,
    combined,
    image,
    moved,
    rational_ball,
)
from qe.exact.balls import precision

BITS = 96
ball = rational_ball
ORIGIN = (0, 0, 0)

Jet = list[Sequence[arb]]
"""A point, and derivatives of it."""


@dataclass(frozen=True, slots=True)
class Lines:
    """The joints at centre + slope σ where the curve is at middle + σ."""

    middle: arb
    centre: Sequence[arb]
    slope: Sequence[arb]

    @staticmethod
    def of(middle: Fraction, centre: Sequence[Fraction], slope: Sequence[Fraction]) -> Lines:
        """In balls."""
        return Lines(ball(middle), [*map(ball, centre)], [*map(ball, slope)])

    def at(self, step: arb) -> tuple[arb, list[arb]]:
        """The parameter and the joints."""
        return self.middle + step, [c + v * step for c, v in zip(self.centre, self.slope, strict=True)]

    def seen(self, step: arb) -> list[arb]:
        """The joints seen from what the first one carries."""
        return [arb(0), *self.at(step)[1][1:]]


def coefficients(points: Sequence[Sequence[Any]]) -> list[list[Fraction]]:
    """Of the coordinates of a curve as polynomials in its parameter: c_k = C(n,k) Σ_j (-1)^(k-j) C(k,j) b_j for control
    points b."""
    n = len(points) - 1
    signed = [[(-1) ** (k - j) * comb(k, j) * comb(n, k) for j in range(k + 1)] for k in range(n + 1)]
    return [[sum((w * Fraction(p[i]) for w, p in zip(row, points)), Fraction(0)) for row in signed] for i in range(3)]


def seen_from_base(chain: ArmChain, curve: Sequence[Sequence[Fraction]]) -> list[Polynomial]:
    """A curve, by the coefficients of its coordinates, in the frame of the first joint."""
    rows, shift = back(chain.constants[0])
    listed = [Polynomial.of(map(Surd.rational, row)) for row in curve]
    return [combined(row, listed) + Polynomial.of([o]) for row, o in zip(rows, shift, strict=True)]


class Course:
    """One arm along one curve."""

    def __init__(self, chain: ArmChain, curve: Sequence[Sequence[Fraction]]) -> None:
        self.turns = chain.turns
        with precision(BITS):
            self._links = chain.in_numbers(Surd.ball)[1:]
            self._curve = [[arb_poly([c.ball() for c in p]) for p in seen_from_base(chain, curve)]]
            for _ in range(2):
                self._curve.append([p.derivative() for p in self._curve[-1]])

    def tip(self, q: Sequence[arb]) -> tuple[list[arb], arb_mat]:
        """The end point seen from the base, and its derivatives by the joints as columns."""
        values = [self._value(k, v) for k, v in enumerate(q)]
        point, rates = carried_with_rates(self._links, values, ORIGIN)
        return list(point), arb_mat([[rate[i] for rate in rates] for i in range(3)])

    def tip_along(self, q: Sequence[arb], rates: Sequence[arb], order: int) -> Jet:
        """The end point seen from the base with the joints at q + rates t, and its derivatives by t at 0."""
        jet: Jet = [ORIGIN] * (order + 1)
        for k, link in reversed([*enumerate(self._links)]):
            jet = self._moved(k, q[k], rates[k], [image(link, v, is_point=not i) for i, v in enumerate(jet)])
        return jet

    def target(self, lines: Lines, step: arb, order: int) -> Jet:
        """The same of the curve's point at middle + step + t, seen from what the first joint carries."""
        s, q = lines.at(step)
        return self._moved(0, -q[0], -lines.slope[0], [[row(s) for row in rows] for rows in self._curve[: order + 1]])

    def _moved(self, joint: int, value: arb, rate: arb, jet: Jet) -> Jet:
        """By a joint: what a turn makes of a point that moves while it turns, it makes of what is seen to move."""
        (x, y, _), *rates = jet
        if not self.turns[joint]:
            jet = [jet[0], *((u, v, w + rate) for u, v, w in rates[:1]), *rates[1:]]
        elif rates:
            (u, v, w), *bends = rates
            bent = ((a - rate * (2 * v + rate * x), b + rate * (2 * u - rate * y), c) for a, b, c in bends)
            jet = [jet[0], (u - rate * y, v + rate * x, w), *bent]
        pair = self._value(joint, value)
        return [moved(pair, v, is_point=not k) for k, v in enumerate(jet)]

    def error(self, lines: Lines, step: arb, half: arb) -> list[arb]:
        """f(σ, 0) for all σ in step + half, by the mean value theorem."""
        tip, (goal,) = self.tip(lines.seen(step))[0], self.target(lines, step, 0)
        _, ahead = self.tip_along(lines.seen(step + half), [arb(0), *lines.slope[1:]], 1)
        _, wanted = self.target(lines, step + half, 1)
        return [a - b + half * (c - d) for a, b, c, d in zip(tip, goal, ahead, wanted, strict=True)]

    def image(self, lines: Lines, sigma: Fraction, half: Fraction, radii: Sequence[Fraction]) -> list[arb] | None:
        """Of a box under the test for all σ within ``half`` of ``sigma``; None where C is not found."""
        step, wide, box = ball(sigma), around(half), [around(r) for r in radii]
        inverse = inverse_of(self.tip(lines.seen(step))[1])
        if inverse is None:
            return None
        whole = [a + b for a, b in zip(lines.seen(step + wide), box, strict=True)]
        return test_image(inverse, self.error(lines, step, wide), self.tip(whole)[1], box)

    def _value(self, joint: int, value: Any) -> tuple[Any, ...]:
        return (value.cos(), value.sin()) if self.turns[joint] else (value,)


def inverse_of(m: arb_mat) -> arb_mat | None:
    """The middle of an inverse: any matrix will do for the test."""
    try:
        result = m.inv()
    except ZeroDivisionError:
        return None
    return arb_mat([[result[i, j].mid() for j in range(3)] for i in range(3)])


def times(m: arb_mat, v: Sequence[arb]) -> list[arb]:
    """A matrix times a vector."""
    return list((m * arb_mat([[x] for x in v])).entries())


def test_image(inverse: arb_mat, start: Sequence[arb], jacobian: arb_mat, box: Sequence[arb]) -> list[arb]:
    """-C f + (I - C J) R."""
    newton, rest = times(inverse, start), times(arb_mat(3, 3, 1) - inverse * jacobian, box)
    return [b - a for a, b in zip(newton, rest, strict=True)]


def dual(value: arb, rate: int = 0) -> arb_series:
    """A number with its derivative in one direction."""
    return arb_series([value, rate], prec=2)


def around(radius: Fraction) -> arb:
    """The ball of this radius around 0."""
    return arb(0, 1) * ball(radius)


def strictly_within(values: Sequence[arb], radii: Sequence[Fraction]) -> bool:
    """Whether every ball lies in the open ball of its radius around 0."""
    return all(v.abs_upper() < ball(r) for v, r in zip(values, radii, strict=True))


def radius_above(value: arb) -> Fraction:
    """A number at least as large as all absolute values in the ball."""
    top = value.abs_upper().fmpq()
    return Fraction(int(top.p), int(top.q))
