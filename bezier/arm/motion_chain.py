"""Chains of rigid motions in ball arithmetic: their end point with first and second derivatives, and proofs that a
joint position
exists, is unique in a box and depends smoothly on a parameter (Krawczyk's test; Neumaier, Interval Methods for Systems
of Equations, 1990, sections 5.1 and 5.2).

For s = m + σ in an interval of half width h a joint position is sought as q = c + vσ + r with r in a box R. With f(r,
s) the end point at q minus p(s), C an approximate inverse of its Jacobian and Q a box around all these q,

    K = -C f(0, s) + (I - C J(Q)) R,    f(0, s) in f(0, m) + [-h, h] (J(c + v[-h, h]) v - p'(s)).

K inside the interior of R proves for every such s exactly one solution with r in R; r lies in K. J(Q) is regular then.

The first joint moves all that follows rigidly. So its line c + vσ is taken back from p(s), seen from the base, and the
other joints are to reach what remains: f is the same up to a motion that depends on σ alone, with the same zeros, and J
does not turn with that joint. Else pieces near its axis, where it turns fast, could only be as long as the square of
the distance allows.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import inf, nextafter
from typing import Any

from flint import arb, arb_mat

from bezier.obstacles.polyhedron import cross
from bezier.proofs.square_roots import rational_ball
from qe.exact.balls import precision
from qe.exact.field import FieldElement

BITS = 80
NEWTON_STEPS, CLOSE = 30, 1e-13  # at most, and the last one that floats can tell from none
BOXES = 2  # that are tried: where joints differ in scale, the image of one is a better guess
SPARE = 1.5
"""How much smaller than the box its image has to be: more than the rounding of ``radius`` and ``inner`` to floats."""

Range = tuple[float, float]


@dataclass(frozen=True, slots=True)
class ProvedPiece:
    """For every s in [low, high] there is exactly one joint position within ``radius`` of centre + slope (s - middle).

    It lies within ``inner`` of it. ``velocity`` and ``acceleration``: bounds of its first and second derivative by s.
    Joint values in rad or mm, one entry for each joint; the numbers are meant exactly.
    """

    low: Fraction
    high: Fraction
    centre: tuple[float, ...]
    slope: tuple[float, ...]
    radius: tuple[float, ...]
    inner: tuple[float, ...]
    velocity: tuple[Range, ...]
    acceleration: tuple[Range, ...]

    def at(self, s: Fraction) -> tuple[Fraction, ...]:
        """The middle of the boxes at s."""
        step = s - (self.low + self.high) / 2
        return tuple(Fraction(c) + Fraction(v) * step for c, v in zip(self.centre, self.slope, strict=True))

    def near(self, s: Fraction) -> tuple[float, ...]:
        """The same in floating point."""
        step = float(s - (self.low + self.high) / 2)
        return tuple(c + v * step for c, v in zip(self.centre, self.slope, strict=True))


Coefficients = Sequence[Sequence[arb]]
"""Of 1, s, s², …, for each coordinate."""


@dataclass(frozen=True, slots=True)
class Track:
    """A curve p(s) seen from the base of an arm, with its first and second derivatives."""

    derivatives: tuple[Coefficients, Coefficients, Coefficients]

    def at(self, s: arb, order: int = 0) -> list[arb]:
        """A derivative at a ball, by Horner's rule."""
        values = []
        for coefficients in self.derivatives[order]:
            total = arb(0)
            for c in reversed(coefficients):
                total = total * s + c
            values.append(total)
        return values

    def behind(self, turns: bool, value: arb, rate: arb, s: arb) -> list[list[arb]]:
        """p(s), p'(s), p''(s) seen from what the first joint moves, which is at ``value`` and goes on at ``rate``."""
        p, first, second = (self.at(s, order) for order in range(3))
        if not turns:
            return [[*p[:2], p[2] - value], [*first[:2], first[2] - rate], second]
        (x, y, _), (u, v, _) = p, first
        first = [u + rate * y, v - rate * x, first[2]]
        second = [second[0] + rate * (2 * v - rate * x), second[1] - rate * (2 * u + rate * y), second[2]]
        sine, cosine = value.sin_cos()
        return [[cosine * a + sine * b, cosine * b - sine * a, c] for a, b, c in (p, first, second)]


class MotionChain:
    """constants[0] M(q_1) constants[1] … M(q_n) constants[n] applied to the origin, n = 3 for ``piece``.

    ``constants``: rigid motions as three rows of four rational numbers or field elements; ``turning``: whether a joint
    turns about (else slides along) its z axis.
    """

    __slots__ = ("_base", "_constants", "_turning")

    def __init__(self, constants: Sequence[Sequence[Sequence[object]]], turning: Sequence[bool]) -> None:
        with precision(BITS + 16):
            self._base, *self._constants = (
                arb_mat([*([ball_of(v) for v in row] for row in m), [arb(0), arb(0), arb(0), arb(1)]])
                for m in constants
            )
        self._turning = tuple(turning)

    def track(self, curve: Sequence[Sequence[Fraction]]) -> Track:
        """A curve, given by the coefficients of 1, s, s², … of each coordinate (mm), seen from the base."""
        with precision(BITS + 16):
            turn = [[self._base[k, i] for k in range(3)] for i in range(3)]  # the inverse: a rotation is orthogonal
            width = max(map(len, curve))
            vectors = [[ball_of(c[k]) if k < len(c) else arb(0) for c in curve] for k in range(width)]
            vectors[0] = [c - self._base[i, 3] for i, c in enumerate(vectors[0])]
            seen = [[sum((a * b for a, b in zip(row, v, strict=True)), arb(0)) for v in vectors] for row in turn]
            first = [_derived(c) for c in seen]
            return Track((seen, first, [_derived(c) for c in first]))

    def _frames(self, q: Sequence[arb]) -> tuple[list[tuple[list[arb], list[arb]]], list[arb]]:
        """Axis and origin of every joint, and the end point."""
        whole, axes = arb_mat(4, 4, 1), []
        for value, turns, constant in zip(q, self._turning, self._constants, strict=True):
            axes.append(([whole[i, 2] for i in range(3)], [whole[i, 3] for i in range(3)]))
            whole = whole * _motion(value, turns) * constant
        return axes, [whole[i, 3] for i in range(3)]

    def _jacobian(self, q: Sequence[arb]) -> tuple[arb_mat, list[arb], list[list[arb]], list[list[arb]]]:
        """(J, end point, axes, columns of J)."""
        axes, tip = self._frames(q)
        columns = [
            list(cross(z, [a - b for a, b in zip(tip, o, strict=True)])) if turns else z
            for (z, o), turns in zip(axes, self._turning, strict=True)
        ]
        rows = [[column[i] for column in columns] for i in range(3)]
        return arb_mat(rows), tip, [z for z, _ in axes], columns

    def _bend(self, axes: list[list[arb]], columns: list[list[arb]], rate: Sequence[arb]) -> list[arb]:
        """Σ_ij ∂²(end point)/∂q_i∂q_j rate_i rate_j: the second derivative is z_i x column_j for i <= j, i turning."""
        total = [arb(0)] * 3
        for j, column in enumerate(columns):
            for i in range(j + 1):
                if self._turning[i]:
                    weight = rate[i] * rate[j] * (1 if i == j else 2)
                    total = [t + weight * c for t, c in zip(total, cross(axes[i], column), strict=True)]
        return total

    def solve(self, track: Track, s: Fraction, start: Sequence[float]) -> list[float] | None:
        """Newton's method from ``start``: joint values near a solution, in floating point, or None."""
        with precision(BITS):
            target = track.at(ball_of(s))
            q = [arb(v) for v in start]
            for _ in range(NEWTON_STEPS):
                matrix, tip, _, _ = self._jacobian([v.mid() for v in q])
                step = _solved(matrix, [a - b for a, b in zip(tip, target, strict=True)])
                if step is None:
                    return None
                q = [(a.mid() - b.mid()) for a, b in zip(q, step, strict=True)]
                if all(abs(b.mid()) < CLOSE for b in step):
                    return [float(v.mid()) for v in q]
            return None

    def piece(self, track: Track, low: Fraction, high: Fraction, start: Sequence[float]) -> ProvedPiece | None:
        """A proved piece over [low, high] near ``start``, a solution about the middle; None where the test fails."""
        centre = self.solve(track, (low + high) / 2, start)
        if centre is None:
            return None
        with precision(BITS):
            return self._tested(track, low, high, centre)

    def _tested(self, track: Track, low: Fraction, high: Fraction, centre: list[float]) -> ProvedPiece | None:
        middle, sigma = ball_of((low + high) / 2), arb(0, 1) * ball_of((high - low) / 2)
        q, first, turns = [arb(0), *map(arb, centre[1:])], arb(centre[0]), self._turning[0]
        matrix, tip, _, _ = self._jacobian(q)
        inverse = _inverse(matrix)
        if inverse is None:
            return None
        target, forwards, _ = track.behind(turns, first, arb(0), middle)
        slope = [float(x.mid()) for x in _times(inverse, forwards)]
        rate, v = arb(slope[0]), [arb(0), *map(arb, slope[1:])]
        error = [a - b for a, b in zip(tip, target, strict=True)]
        along = [a + b * sigma for a, b in zip(q, v, strict=True)]
        _, forwards, bend = track.behind(turns, first + rate * sigma, rate, middle + sigma)
        drift = [a - b for a, b in zip(_times(self._jacobian(along)[0], v), forwards, strict=True)]
        newton = _times(inverse, [a + sigma * b for a, b in zip(error, drift, strict=True)])
        image = newton
        for _ in range(BOXES):
            size = [2 * x.abs_upper() + arb(2) ** -36 for x in image]
            box = [arb(0, 1) * x for x in size]
            jacobian, _, axes, columns = self._jacobian([a + b for a, b in zip(along, box, strict=True)])
            near = inverse * jacobian
            rest = [sum((((1 if i == j else 0) - near[i, j]) * box[j] for j in range(3)), arb(0)) for i in range(3)]
            image = [b - a for a, b in zip(newton, rest, strict=True)]
            if all(SPARE * x.abs_upper() < r for x, r in zip(image, size, strict=True)):
                break
        else:
            return None
        velocity = _solved(near, _times(inverse, forwards))
        if velocity is None:
            return None
        push = [a - b for a, b in zip(bend, self._bend(axes, columns, velocity), strict=True)]
        acceleration = _solved(near, _times(inverse, push))
        if acceleration is None:
            return None
        return ProvedPiece(
            low,
            high,
            tuple(centre),
            tuple(slope),
            tuple(-_above(-r) for r in size),
            tuple(_above(x.abs_upper()) for x in image),
            (_range(velocity[0] + rate), *map(_range, velocity[1:])),
            tuple(map(_range, acceleration)),
        )


def _motion(value: arb, turns: bool) -> arb_mat:
    if not turns:
        return arb_mat([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, value], [0, 0, 0, 1]])
    s, c = value.sin(), value.cos()
    return arb_mat([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])


def _times(m: arb_mat, v: Sequence[arb]) -> list[arb]:
    return [sum((m[i, j] * v[j] for j in range(3)), arb(0)) for i in range(3)]


def _inverse(m: arb_mat) -> arb_mat | None:
    """The middle of an inverse: any matrix will do for the test."""
    try:
        result = m.inv()
    except ZeroDivisionError:
        return None
    return arb_mat([[result[i, j].mid() for j in range(3)] for i in range(3)])


def _solved(m: arb_mat, v: Sequence[arb]) -> list[arb] | None:
    try:
        result = m.solve(arb_mat([[x] for x in v]))
    except ZeroDivisionError:
        return None
    return [result[i, 0] for i in range(3)]


def _derived(coefficients: Sequence[arb]) -> list[arb]:
    return [k * c for k, c in enumerate(coefficients)][1:]


def ball_of(value: Any) -> arb:
    """A rational number or an element of a field as a ball."""
    if isinstance(value, FieldElement):
        return value.ball(BITS)
    return rational_ball(Fraction(value))


def _range(x: arb) -> Range:
    return -_above(-x), _above(x)


def _above(x: arb) -> float:
    return nextafter(float(x.upper()), inf)
