"""The motion of the joints in time: bounds of their velocities and accelerations that hold at all times.

With q(s) the joint values along the path and σ = s(τ), τ = t/T: q' = q_s σ' / T and q'' = (q_ss σ'² + q_s σ'') / T².
The pieces of a branch come with bounds of q_s and q_ss; those of σ' and σ'' follow from their Bernstein coefficients
over the times in which the piece is run through.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import ceil, isqrt

from bezier.arm.joint_path import JointPath, Run
from bezier.arm.model import Joint
from bezier.arm.motion_chain import ProvedPiece
from bezier.curves import bernstein as bs
from bezier.curves.enclosure import Enclosure
from bezier.motion.timelaw import TICK, TimeLaw
from qe.errors import Unable
from qe.exact.rational_poly import RationalPoly

Range = tuple[Fraction, Fraction]
ZERO = Fraction(0)
SHORT = Fraction(1, 1 << 30)


@dataclass(frozen=True, slots=True)
class JointMotion:
    """One extreme of each joint (rad/s, rad/s²), for a motion that takes ``duration`` s."""

    joints: tuple[Joint, ...]
    duration: Fraction
    speeds: tuple[Enclosure, ...]
    accelerations: tuple[Enclosure, ...]

    @property
    def _limits(self) -> Iterator[tuple[str, Enclosure, Fraction]]:
        """Names, extremes and limits, velocities before accelerations for each joint."""
        for joint, v, a in zip(self.joints, self.speeds, self.accelerations, strict=True):
            if joint.max_velocity is not None:
                yield f"{joint.name} velocity", v, joint.max_velocity
            if joint.max_acceleration is not None:
                yield f"{joint.name} acceleration", a, joint.max_acceleration

    @property
    def kept(self) -> dict[str, bool | None]:
        """For each limit, by joint and kind, whether it is kept at all times."""
        return {name: extreme.keeps(limit) for name, extreme, limit in self._limits}

    @property
    def keeps_limits(self) -> bool:
        """Whether every limit is proved to be kept."""
        return all(kept is True for kept in self.kept.values())

    @property
    def enough(self) -> Fraction:
        """A duration (s) with which the same motion is proved to keep all limits, rounded up to ``TICK``."""
        factors = [Fraction(0)]
        for name, extreme, limit in self._limits:
            ratio = extreme.finite[1] / limit
            is_speed = name.endswith(" velocity")
            factors.append(ratio if is_speed else Fraction(isqrt(ceil(ratio * 10**12)) + 1, 10**6))
        return ceil(self.duration * max(factors) / TICK) * TICK


def joint_motion(path: JointPath, run: Run, law: TimeLaw, duration: Fraction, ends: Sequence[Fraction]) -> JointMotion:
    """The motion along a run from start to goal. Raises ``Unable`` for a run that ends before: its velocities may be
    unbounded."""
    if not run.covers(len(path.curves)):
        raise Unable(f"motion {run.number} does not go from start to goal; near its end the joints move ever faster")
    count = len(path.arm.joints)
    low, high = ([[ZERO, ZERO] for _ in range(count)] for _ in range(2))
    for piece, first, second in _timed(run, law, ends):
        squares = [x * x for x in first]
        square = (ZERO if first[0] <= 0 <= first[1] else min(squares)), max(squares)
        for j in range(count):
            v, a = ((Fraction(b[j][0]), Fraction(b[j][1])) for b in (piece.velocity, piece.acceleration))
            (low_push, high_push), (below, above) = _times(a, square), _times(v, second)
            speed, push = _times(v, first), (low_push + below, high_push + above)
            for k, value in enumerate((speed, push)):
                high[j][k] = max(high[j][k], *map(abs, value))
                low[j][k] = max(low[j][k], value[0], -value[1])
    speeds = tuple(Enclosure(low[j][0], high[j][0]).scaled(1 / duration) for j in range(count))
    pushes = tuple(Enclosure(low[j][1], high[j][1]).scaled(1 / duration**2) for j in range(count))
    return JointMotion(path.arm.joints, duration, speeds, pushes)


def _timed(run: Run, law: TimeLaw, ends: Sequence[Fraction]) -> Iterator[tuple[ProvedPiece, Range, Range]]:
    """Every piece with the ranges of ds/dτ and d²s/dτ² (s the parameter of its curve) while it is run through."""
    known = (ZERO, ZERO)
    for k, branch in run.parts:
        first = ends[k - 1] if k else ZERO
        length = ends[k] - first
        for piece in branch.pieces:  # each begins where the one before ends
            begin, known = known[0], law.passage(first + piece.high * length, SHORT)
            end = known[1]
            for (low, high), p in zip(pairwise(law.breaks), law.polynomials, strict=True):
                a, b = max(begin, low), min(end, high)
                if a < b or begin == end:
                    slope = p.derivative()
                    yield piece, _range(slope, a, b, 1 / length), _range(slope.derivative(), a, b, 1 / length)


def _range(p: RationalPoly, low: Fraction, high: Fraction, factor: Fraction) -> Range:
    """An interval around factor * p on [low, high]: its Bernstein coefficients there."""
    values = [factor * c for c in bs.restrict(bs.from_power(p.coefficients()), low, high)]
    return min(values), max(values)


def _times(a: Range, b: Range) -> Range:
    products = [x * y for x in a for y in b]
    return min(products), max(products)
