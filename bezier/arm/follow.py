"""Branches: joint positions followed along a curve, each step proved (``bezier.arm.motion_chain``).

Every piece proves exactly one solution in a tube of boxes over an interval of s. Two pieces belong to one branch when
at their common parameter the solution of the one, known to a smaller box, lies in the box of the other, which holds no
second one. So a branch is a proof that along the curve a solution exists for every s, and that it depends smoothly on
s.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import tau
from operator import attrgetter

from bezier.arm.inverse import Solution
from bezier.arm.model import Arm
from bezier.arm.motion_chain import ProvedPiece
from bezier.arm.motion_chain import piece as proved_piece
from bezier.curves.curve import Bezier
from bezier.proofs.course import Course, coefficients
from qe.exact.point_values import pi_ends

FIRST, LEAST = Fraction(1, 16), Fraction(1, 1 << 24)
NEAR = Fraction(1, 1 << 12)
"""How near to a place where solutions meet branches are followed."""

EASY = 0.58
"""Steps get longer where images are smaller than this against their boxes: it is 1/2 and grows with the length."""

ZERO, ONE = Fraction(0), Fraction(1)
SPARE = Fraction(5, 4)
"""What links leave to a checker that computes with other roundings."""

PI = pi_ends(96)
Box = tuple[tuple[Fraction, Fraction], ...]


@dataclass(frozen=True, slots=True)
class Branch:
    """Linked pieces over [low, high] within [0, 1], in ascending order."""

    pieces: tuple[ProvedPiece, ...]

    @property
    def low(self) -> Fraction:
        """The least parameter."""
        return self.pieces[0].low

    @property
    def high(self) -> Fraction:
        """The greatest parameter."""
        return self.pieces[-1].high

    def piece(self, s: Fraction) -> ProvedPiece:
        """A piece that contains s."""
        return self.pieces[bisect_left(self.pieces, s, key=attrgetter("high"))]

    def at(self, s: Fraction) -> tuple[float, ...]:
        """The joint values at s, to about the width of the boxes (rad or mm)."""
        return self.piece(s).near(s)

    def contains(self, s: Fraction, solution: Solution) -> bool:
        """Whether the branch takes this solution at s, exactly: its only solution in the box there is this one."""
        if not self.low <= s <= self.high or None in solution.values:
            return False
        piece = self.piece(s)
        sides = zip(_turned(solution, piece.near(s)), piece.at(s), map(Fraction, piece.radius), strict=True)
        return all(m - r <= low and high <= m + r for (low, high), m, r in sides)


def follow(
    arm: Arm,
    curve: Bezier,
    start: Sequence[float],
    at: Fraction,
    end: Fraction,
    before: tuple[ProvedPiece, Fraction] | None = None,
    stops: Sequence[Fraction] = (),
) -> tuple[ProvedPiece, ...]:
    """Pieces from ``at`` towards ``end`` as far as they can be proved, in ascending order of s.

    ``start``: joint values near the solution at ``at``. They end before ``end`` where the arm becomes singular.
    ``before``: a piece and a parameter at which its solution is that at ``at`` (of this curve, or of one that this one
    goes on from): the first piece is linked to it. ``stops``: about where solutions meet, where steps get small.
    """
    course = Course(arm.chain, coefficients(curve.points))
    forwards = end > at
    pieces: list[ProvedPiece] = []
    here, step = at, FIRST
    while here != end and step >= LEAST:
        far = min(here + step, end) if forwards else max(here - step, end)
        low, high = (here, far) if forwards else (far, here)
        if step < NEAR and any(abs(here - stop) < 2 * NEAR for stop in stops):
            break
        piece = proved_piece(course, low, high, pieces[-1].near((low + high) / 2) if pieces else start)
        last = (pieces[-1], here) if pieces else before
        if piece is None or (last is not None and not _same(*last, piece, here)):
            step /= 2
            continue
        pieces.append(piece)
        here = far
        if all(r < EASY * size for r, size in zip(piece.inner, piece.radius, strict=True)):
            step = min(2 * step, FIRST)
    return tuple(pieces if forwards else reversed(pieces))


def whole(
    arm: Arm,
    curve: Bezier,
    solution: Solution,
    at: Fraction,
    ends: tuple[Fraction, Fraction],
    stops: Sequence[Fraction] = (),
) -> Branch | None:
    """The branch through a solution at ``at``, followed both ways to ``ends``; None where no step is proved."""
    start = [angle for angle in solution.angles if angle is not None]
    if len(start) != len(arm.joints):
        return None
    before = follow(arm, curve, start, at, ends[0], stops=stops) if ends[0] < at else ()
    link = (before[-1], at) if before else None
    pieces = before + (follow(arm, curve, start, at, ends[1], before=link, stops=stops) if at < ends[1] else ())
    return Branch(pieces) if pieces and Branch(pieces).contains(at, solution) else None


def joined(one: ProvedPiece, other: ProvedPiece) -> bool:
    """Whether the solution at the end of one curve is the one where the next begins."""
    return _same(one, ONE, other, ZERO)


def _same(one: ProvedPiece, s: Fraction, other: ProvedPiece, t: Fraction) -> bool:
    """Whether the solutions at s and at t, over the same point, are one: the inner box of one lies in the other box."""
    gaps = [abs(a - b) for a, b in zip(one.at(s), other.at(t), strict=True)]
    return any(
        all(gap + SPARE * Fraction(r) <= Fraction(size) for gap, r, size in zip(gaps, a.inner, b.radius, strict=True))
        for a, b in ((one, other), (other, one))
    )


def _turned(solution: Solution, near: Sequence[float]) -> Box:
    """The box of the solution, by full turns next to these joint values."""
    result = []
    for value, other in zip(solution.values, near, strict=True):
        assert value is not None, "a branch is followed where no angle is free"
        turns = 0 if value.pair is None else round((other - float(value)) / tau)
        low, high = PI if turns >= 0 else PI[::-1]
        result.append((value.ends[0] + 2 * turns * low, value.ends[1] + 2 * turns * high))
    return tuple(result)
