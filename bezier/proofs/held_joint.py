"""Where an arm with three joints can be while one of them is held: relations that its end point p then satisfies.

What is left is B M(q_a) C M(q_b) e. Of p' = B^-1 p the joint a leaves (z, |p'|²) as they are if it turns, (x, y) if it
slides. In C M(q_b) e these two are k + a·u with u = (cos q_b, sin q_b), or k + a q_b (and q_b² more in |p'|²). With D =
the two of p' - k, and a, b the factors of u in the first and the second: D1 b2 - D2 a2 = det cos q_b and D2 a1 - D1 b1
= det sin q_b, det = a1 b2 - a2 b1, so that the sum of the squares of these two is det². Numbers of any kind that can be
added, subtracted and multiplied: polynomials along a curve, balls with derivatives.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from bezier.proofs.arm_rows import ArmChain
from bezier.proofs.square_roots import ONE, ZERO, Surd, dot, image, together

Vector = Sequence[Any]
Rigid = Any
"""Rows of the rotation, and the shift."""

Relation = tuple[Any, Vector]
"""What vanishes at the end point, provided that the numbers in the second place do."""


@dataclass(frozen=True, slots=True)
class Held:
    """``turns``: whether the joints a and b turn; ``rows``: k and its factors, for each of the two equations."""

    base: Rigid
    turns: tuple[bool, bool]
    rows: tuple[Vector, Vector]

    @staticmethod
    def of(chain: ArmChain, joint: int, value: Sequence[Any], lift: Callable[[Surd], Any]) -> Held:
        """The arm with one joint (0, 1, 2) at a cosine and a sine, or at a length; ``lift`` makes numbers of this kind
        of its constants."""
        turns, zero, one = chain.turns, lift(ZERO), lift(ONE)
        motion = turned(value[0], value[1], zero, one) if turns[joint] else slid(value[0], zero, one)
        parts: list[Rigid] = [([[*map(lift, row)] for row in rows], [*map(lift, o)]) for rows, o in chain.constants]
        _, end = parts.pop()
        if joint == 2:
            end = image(parts.pop(), image(motion, end))
        else:
            parts[joint : joint + 2] = [together(together(parts[joint], motion), parts[joint + 1])]
        first, second = (turn for k, turn in enumerate(turns) if k != joint)
        base, (rows, shift) = parts
        return Held(base, (first, second), _factors(spread((rows, shift), end, second), first, second))

    def relations(self, point: Vector) -> list[Relation]:
        """The relations for this end point; those that tell most where their conditions hold come first."""
        rows, shift = self.base
        away = [c - o for c, o in zip(point, shift, strict=True)]
        x, y, z = (dot(column, away) for column in zip(*rows, strict=True))
        (k1, *a), (k2, *b) = self.rows
        d1, d2 = (z - k1, x * x + y * y + z * z - k2) if self.turns[0] else (x - k1, y - k2)
        still = (d1 * d1 + d2 * d2, (*a, *b))
        if self.turns[1]:
            det, cosine, sine = a[0] * b[1] - a[1] * b[0], d1 * b[1] - d2 * a[1], d2 * a[0] - d1 * b[0]
            return [still, (cosine, (det,)), (sine, (det,)), (cosine * cosine + sine * sine - det * det, ())]
        if self.turns[0]:
            return [(d1, (a[0],)), (d2 * a[0] * a[0] - b[0] * a[0] * d1 - d1 * d1, ())]
        return [still, (d1 * b[0] - d2 * a[0], ())]


def turned(cosine: Any, sine: Any, zero: Any, one: Any) -> Rigid:
    """The motion of a joint that turns."""
    return ((cosine, zero - sine, zero), (sine, cosine, zero), (zero, zero, one)), (zero, zero, zero)


def slid(length: Any, zero: Any, one: Any) -> Rigid:
    """The motion of a joint that slides."""
    return ((one, zero, zero), (zero, one, zero), (zero, zero, one)), (zero, zero, length)


def spread(constant: Rigid, end: Vector, turns: bool) -> list[Vector]:
    """f0, f1, f2 with C M(q_b) e = f0 + cos q_b f1 + sin q_b f2, or f0, f1 with f0 + q_b f1."""
    (x, y, z), (rows, shift) = end, constant
    if not turns:
        return [image(constant, end), [row[2] for row in rows]]
    return [
        [row[2] * z + o for row, o in zip(rows, shift, strict=True)],
        [row[0] * x + row[1] * y for row in rows],
        [row[1] * x - row[0] * y for row in rows],
    ]


def _factors(f: list[Vector], first_turns: bool, second_turns: bool) -> tuple[Vector, Vector]:
    if not first_turns:
        return [v[0] for v in f], [v[1] for v in f]
    square, *mixed = (dot(f[0], v) for v in f)
    # f1 and f2 are orthogonal and equally long: |f1|² is constant
    return [v[2] for v in f], [square + dot(f[1], f[1]) if second_turns else square, *(m + m for m in mixed)]
