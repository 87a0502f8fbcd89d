"""Joints that can be chosen: exactly which values of such a joint the other ones can follow, and which of these lie
between its limits.

Where the others can follow is the set of angles (or lengths) at which a polynomial in t is not negative, with θ = φ +
2 arctan t: between its real roots its sign is constant, so one rational t each decides.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, floor, pi
from typing import Any

from bezier.arm.model import Joint, JointKind
from bezier.proofs.families import arcs_of
from bezier.proofs.nested_roots import JointValue
from bezier.proofs.square_roots import Surd
from qe.errors import InternalError, Unable
from qe.exact.point_values import Ball, Evaluation, angle, pi_ends, roots_above, signs_around
from qe.exact.ring import Poly

Ends = tuple[Fraction, Fraction]
BITS = 64


@dataclass(frozen=True, slots=True, eq=False)
class Value:
    """One joint of one solution: its angle in (-pi, pi] (rad) or its length (mm), in a ball at most 2^-60 wide, and
    cosine and sine of an angle."""

    ball: Ball
    pair: tuple[Ball, Ball] | None = None

    def __float__(self) -> float:
        return float(self.ball)

    @property
    def ends(self) -> Ends:
        """An interval around the angle or the length."""
        return self.ball.ends

    def fixed(self, places: int) -> str:
        """The angle or the length with so many decimal places."""
        digits = round(sum(self.ends) / 2 * 10**places)
        whole, part = divmod(abs(digits), 10**places)
        return f"{'-' if digits < 0 else ''}{whole}.{part:0{places}d}"

    def meets(self, other: Value) -> bool:
        """Whether the balls leave it open that both are the same: those of cosine and sine, or of the length."""
        pairs = zip(self.pair or (self.ball,), other.pair or (other.ball,), strict=True)
        return all(a.ends[0] <= b.ends[1] and b.ends[0] <= a.ends[1] for a, b in pairs)

    @property
    def cosine(self) -> Ends | None:
        """An interval around the cosine; None for a length."""
        return None if self.pair is None else self.pair[0].ends

    @property
    def sine(self) -> Ends | None:
        """An interval around the sine; None for a length."""
        return None if self.pair is None else self.pair[1].ends


@dataclass(frozen=True, eq=False)
class Exact(ABC):
    """The exact value of a joint."""

    joint: JointValue

    @abstractmethod
    def value(self, bits: int = BITS) -> Value:
        """The angle or the length, with intervals at most about 2^-bits wide."""

    @abstractmethod
    def sign(self, number: Any) -> int:
        """Of one of the numbers that the joint is made of."""

    def length_side(self, limit: Fraction) -> int:
        """The sign of a length minus a limit."""
        return self.sign(self.joint.c - self.joint.w.by(Surd.rational(limit)))


@dataclass(frozen=True, eq=False)
class AtPlace(Exact):
    """At a point, in polynomials (``Ratio``)."""

    place: Evaluation

    def value(self, bits: int = BITS) -> Value:
        below, parts = self.joint.w, [v for v in (self.joint.c, self.joint.s) if v is not None]
        balls = [self.place.quotient(v.top, below.top, Fraction(below.bottom, v.bottom), bits) for v in parts]
        return Value(balls[0]) if len(balls) == 1 else Value(angle(balls[0], balls[1], bits), (balls[0], balls[1]))

    def sign(self, number: Any) -> int:
        return self.place.point.sign(number.top)


MOST_BITS = 4096
MOST_RADIANS = 25
"""Limits of joints that turn: four full turns. Larger ones may be degrees."""


def allowed(joint: Joint, exact: Exact) -> bool:
    """Whether the angle, or one that differs from it by full turns, lies in the closed interval of the limits.

    The limits are rational numbers of radians. cos and sin of a rational number other than 0 are transcendental
    (Lindemann), those of the angle algebraic: so more digits always tell the two apart, but for the limit 0. The length
    of a joint that slides may be a limit: it is compared exactly.
    """
    if joint.limits is None:
        return True
    least, most = joint.limits
    if joint.motion is JointKind.PRISMATIC:
        return exact.length_side(least) >= 0 >= exact.length_side(most)
    if most - least >= 7:  # more than a full turn
        return True
    return any(side(exact, k, least) >= 0 and side(exact, k, most) <= 0 for k in full_turns(joint.limits))


def full_turns(limits: tuple[Fraction, Fraction]) -> range:
    """How many full turns an angle in (-pi, pi] may be away from one between the limits, and some more."""
    least, most = limits
    turn = 2 * pi_ends(64 + max(abs(least), abs(most)).numerator.bit_length())[0]
    return range(floor(least / turn) - 2, ceil(most / turn) + 2)


def side(exact: Exact, turns: int, limit: Fraction) -> int:
    """The sign of an angle, full turns added, minus a limit (rad). Raises ``Unable`` if they agree to 4096 places."""
    bits = 64
    while bits <= MOST_BITS:
        low, high = exact.value(bits).ends
        pi_low, pi_high = pi_ends(bits + 16)
        low += 2 * turns * (pi_low if turns > 0 else pi_high)
        high += 2 * turns * (pi_high if turns > 0 else pi_low)
        if low > limit or high < limit:
            return 1 if low > limit else -1
        # the sine vanishes, and the interval around 0 tells that the cosine is 1
        if limit == 0 and turns == 0 and exact.joint.s is not None and not exact.sign(exact.joint.s):
            return 0
        bits *= 2
    raise Unable(f"an angle agrees with a limit of its joint to {MOST_BITS} binary places")


Arc = tuple[Exact | None, Exact | None]
"""All angles from one on the way round to the other, or all lengths between two; both ends belong to it, and may be
one. None: there is no end on this side."""


@dataclass(frozen=True, eq=False)
class Choice:
    """A joint that can be chosen, by its place in the arm; ``arcs``: which values are possible, None for all."""

    joint: int
    arcs: tuple[Arc, ...] | None = None


@dataclass(frozen=True)
class Edge:
    """Where a range of values between the limits of a joint ends: at ``end``, full turns added, or at a ``limit``;
    nowhere where both are None."""

    end: Exact | None = None
    turns: int = 0
    limit: Fraction | None = None

    @property
    def value(self) -> float | None:
        """The number, where there is one."""
        if self.end is not None:
            return float(self.end.value()) + self.turns * 2 * pi
        return None if self.limit is None else float(self.limit)

    def side(self, limit: Fraction, motion: JointKind, infinite: int) -> int:
        """The sign of the number minus a limit; ``infinite`` where there is none."""
        if self.end is None:
            return infinite
        return self.end.length_side(limit) if motion is JointKind.PRISMATIC else side(self.end, self.turns, limit)


Span = tuple[Edge, Edge]


def not_negative(here: Evaluation, p: Poly, var: int, joint: JointValue, motion: JointKind) -> tuple[Arc, ...] | None:
    """The values of a joint, in the variable ``var`` next after the place, at which p is not negative. The
    angle that t misses must be no zero of p, unless it vanishes everywhere."""
    roots = roots_above(here.point, var, p)
    if roots is None:
        return None
    signs = [s > 0 for s in signs_around(here.point, var, p, roots)]
    ends = [AtPlace(joint, here.extend(root)) for root in roots]
    if motion is JointKind.PRISMATIC:
        if not roots:
            return None if signs[0] else ()
        return arcs_of([None, *ends, None], [signs[0], *[True] * len(ends), signs[-1]], [*signs, False])
    if signs[0] != signs[-1]:
        raise InternalError("a range of angles has a zero where t is infinite")
    if not roots:
        return None if signs[0] else ()
    return arcs_of(ends, [True] * len(ends), signs[1:])


def spans(joint: Joint, choice: Choice) -> tuple[Span, ...]:
    """The values of the joint between its limits, ascending and disjoint."""
    if joint.motion is JointKind.REVOLUTE:
        return tuple(_angles(joint, choice))
    listed = ((None, None),) if choice.arcs is None else choice.arcs
    return tuple(span for low, high in listed for span in _clipped(joint, Edge(low), Edge(high)))


def _clipped(joint: Joint, low: Edge, high: Edge) -> Iterator[Span]:
    """What the limits of the joint leave of a range."""
    if joint.limits is None:
        yield low, high
        return
    least, most = joint.limits
    if high.side(least, joint.motion, 1) >= 0 >= low.side(most, joint.motion, -1):
        yield (
            low if low.side(least, joint.motion, -1) >= 0 else Edge(limit=least),
            high if high.side(most, joint.motion, 1) <= 0 else Edge(limit=most),
        )


def _angles(joint: Joint, choice: Choice) -> Iterator[Span]:
    if choice.arcs is None:
        least, most = joint.limits or (None, None)
        yield Edge(limit=least), Edge(limit=most)
        return
    arcs = sorted(((a, b) for a, b in choice.arcs if a and b), key=lambda arc: float(arc[0].value()))
    wraps = [int(_is_before(high, low)) for low, high in arcs]
    for turns in (0,) if joint.limits is None else full_turns(joint.limits):
        for (low, high), wrap in zip(arcs, wraps, strict=True):
            yield from _clipped(joint, Edge(low, turns), Edge(high, turns + wrap))


def _is_before(one: Exact, other: Exact) -> bool:
    """Whether the first of two different angles in (-pi, pi] is the smaller one; they are the same only as objects."""
    bits = BITS
    while one is not other:
        (a, b), (c, d) = one.value(bits).ends, other.value(bits).ends
        if b < c or d < a:
            return b < c
        bits *= 2
    return False
