"""Joint positions along a curve in boxes, and proofs that one exists, is unique in its box and depends smoothly on a
parameter: pieces by Krawczyk's test (``bezier.proofs.course``).

J(Q) is regular for the box Q around all joint positions of a piece: their first and second derivatives follow from
J q' = p' and J q'' = p'' - Σ_ij ∂²(end point)/∂q_i∂q_j q_i' q_j', the curve p seen from what the first joint carries.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import inf, nextafter

from flint import arb, arb_mat

from bezier.proofs.course import Course, Lines, around, inverse_of, test_image, times
from qe.exact.balls import precision

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


def solved(course: Course, s: Fraction, start: Sequence[float]) -> list[float] | None:
    """Newton's method from ``start``: joint values near a solution, in floating point, or None."""
    with precision(BITS):
        (target,) = course.target(Lines.of(s, [ZERO] * 3, [ZERO] * 3), arb(0), 0)
        q = [arb(v) for v in start]
        for _ in range(NEWTON_STEPS):
            tip, matrix = course.tip(q)
            step = _solution(matrix, [a - b for a, b in zip(tip, target, strict=True)])
            if step is None:
                return None
            q = [(a - b).mid() for a, b in zip(q, step, strict=True)]
            if all(abs(b.mid()) < CLOSE for b in step):
                return [float(v) for v in q]
        return None


def piece(course: Course, low: Fraction, high: Fraction, start: Sequence[float]) -> ProvedPiece | None:
    """A proved piece over [low, high] near ``start``, a solution about the middle; None where the test fails."""
    centre = solved(course, (low + high) / 2, start)
    if centre is None:
        return None
    with precision(BITS):
        return _tested(course, low, high, centre)


def _tested(course: Course, low: Fraction, high: Fraction, centre: list[float]) -> ProvedPiece | None:
    sigma, still = around((high - low) / 2), Lines.of((low + high) / 2, list(map(Fraction, centre)), [ZERO] * 3)
    inverse = inverse_of(course.tip(still.seen(arb(0)))[1])
    if inverse is None:
        return None
    slope = [float(x.mid()) for x in times(inverse, course.target(still, arb(0), 1)[1])]
    lines = Lines(still.middle, still.centre, list(map(arb, slope)))
    error = course.error(lines, arb(0), sigma)
    result = times(inverse, error)
    for _ in range(BOXES):
        size = [2 * x.abs_upper() + arb(2) ** -36 for x in result]
        box = [arb(0, 1) * x for x in size]
        whole = [a + b for a, b in zip(lines.seen(sigma), box, strict=True)]
        jacobian = course.tip(whole)[1]
        result = test_image(inverse, error, jacobian, box)
        if all(SPARE * x.abs_upper() < r for x, r in zip(result, size, strict=True)):
            break
    else:
        return None
    near, (_, forwards, bend) = inverse * jacobian, course.target(lines, sigma, 2)
    velocity = _solution(near, times(inverse, forwards))
    if velocity is None:
        return None
    push = [a - b for a, b in zip(bend, course.tip_along(whole, velocity, 2)[2], strict=True)]
    acceleration = _solution(near, times(inverse, push))
    if acceleration is None:
        return None
    return ProvedPiece(
        low,
        high,
        tuple(centre),
        tuple(slope),
        tuple(-_above(-r) for r in size),
        tuple(_above(x.abs_upper()) for x in result),
        (_range(velocity[0] + lines.slope[0]), *map(_range, velocity[1:])),
        tuple(map(_range, acceleration)),
    )


ZERO = Fraction(0)


def _solution(m: arb_mat, v: Sequence[arb]) -> list[arb] | None:
    try:
        return list(m.solve(arb_mat([[x] for x in v])).entries())
    except ZeroDivisionError:
        return None


def _range(x: arb) -> Range:
    return -_above(-x), _above(x)


def _above(x: arb) -> float:
    return nextafter(float(x.upper()), inf)
