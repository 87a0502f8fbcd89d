"""Whether a branch of an arm keeps the limits of its joints for every s, those that it touches included.

On a piece a joint lies within a radius of a straight line in s (``bezier.proofs.branch``). Where that does not tell
that it keeps a limit L, and L is a length or the angle 0, the arm with this joint held at L does: G(s) is a polynomial
that vanishes wherever it can be at the curve's point (``bezier.proofs.held_joint``). THEOREM. The joint is continuous,
and differs from L where G does not vanish. So if G has no zero within a piece, and the joint keeps L strictly at one
end, it does within; if one, and it does at both ends, it does up to that zero and behind it, and at the zero it keeps L
by continuity. If G is zero everywhere because of a relation F(s, q) that holds for all values q of this joint, F(s, L)
= 0, and if at one s the joint lies in an interval with L in which ∂F/∂q has no zero, it is L there and close by; it is
an analytic function of s, so it is L all along.

Zeros of G, whose coefficients are sums of square roots, are among those of the product of its conjugates, a rational
polynomial; Descartes' rule of signs, for it without multiple factors, bounds their number. An angle of a rational
number of radians other than 0 is transcendental in its sine and cosine: there a box has to tell.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache

from bezier.proofs.arm_rows import ArmChain
from bezier.proofs.course import BITS, around, ball, dual
from bezier.proofs.held_joint import Held
from bezier.proofs.square_roots import ONE, ZERO, Polynomial, Surd, primes
from qe.exact.balls import precision
from qe.exact.descartes import most_roots_between
from qe.proof.entry import Entry

PROBES = (-5, -2, -1, 1, 2, 3, 7)
"""Lengths, and tangents of half of angles. A condition of a relation is of degree at most 3 in a length, in cosine and
sine: where it vanishes for seven values it vanishes for all."""

Ends = tuple[Fraction, Fraction]
Range = tuple[Fraction, Fraction]


@dataclass(frozen=True, slots=True)
class JointStretch:
    """What is known of one joint between two parameters of a curve: it is within ``radius`` of the straight line with
    ``values`` at the ends. ``at_end(0)``, ``at_end(1)``: closer bounds of all joints at the ends."""

    curve: int
    ends: Range
    joint: int
    values: Range
    radius: Fraction
    at_end: Callable[[int], Sequence[Range]]


def read_limits(entry: Entry, joints: int) -> list[Ends | None]:
    """For each joint null, or its least and its greatest value."""
    result = list[Ends | None]()
    for item in entry.items():
        ends = None if item.value is None else tuple(v.rational() for v in item.items())
        if ends is not None and (len(ends) != 2 or ends[0] >= ends[1]):
            raise item.fail("expected null, or a least value below a greatest one")
        result.append(None if ends is None else (ends[0], ends[1]))
    if len(result) != joints:
        raise entry.fail(f"expected limits of {joints} joints")
    return result


class KeptLimits:
    """The limits of the joints of one arm along curves, given by the coefficients of 1, s, s², …"""

    def __init__(
        self, chain: ArmChain, curves: Sequence[Sequence[Sequence[Fraction]]], limits: Sequence[Ends | None]
    ) -> None:
        self._chain, self._curves, self.limits = chain, curves, limits
        self._zeros = cache(self._zeros_at)

    def keeps(self, part: JointStretch) -> bool:
        """Whether a joint is proved to keep its limits on a closed stretch."""
        for limit, side in zip(self.limits[part.joint] or (), (1, -1), strict=False):
            if min(side * (value - limit) for value in part.values) >= part.radius:
                continue
            if limit and self._chain.turns[part.joint]:
                return False
            zeros = self._zeros(part.curve, part.joint, limit)
            if not zeros:
                if not self._stands(part, limit):
                    return False
                continue
            inside = most_roots_between(zeros, *part.ends)
            if inside > 1:
                return False
            clear = [min(side * (value - limit) for value in part.at_end(k)[part.joint]) > 0 for k in range(2)]
            if not (all(clear) if inside else any(clear)):
                return False
        return True

    def _zeros_at(self, curve: int, joint: int, limit: Fraction) -> list[Fraction]:
        """The coefficients of a polynomial that vanishes where the joint can be at its limit; none if everywhere."""
        point = [Polynomial.of(map(Surd.rational, row)) for row in self._curves[curve]]
        value = (ONE, ZERO) if self._chain.turns[joint] else (Surd.rational(limit),)
        held = Held.of(self._chain, joint, [Polynomial.of([c]) for c in value], lambda c: Polynomial.of([c]))
        holding = (relation for relation, needs in held.relations(point) if not any(needs))
        return rational_product(next((p for p in holding if p), Polynomial()))

    def _stands(self, part: JointStretch, limit: Fraction) -> bool:
        """Whether the joint is at its limit all along: it is halfway, by a relation that holds for all its values."""
        joint, s, middle = part.joint, (part.ends[0] + part.ends[1]) / 2, (part.values[0] + part.values[1]) / 2
        if abs(middle - limit) > part.radius:
            return False
        turns, rows = self._chain.turns[joint], self._curves[part.curve]
        probes = [
            Held.of(self._chain, joint, _circle(k) if turns else (Surd.rational(k),), lambda c: c) for k in PROBES
        ]
        point = [sum((c * s**k for k, c in enumerate(row)), Fraction(0)) for row in rows]
        listed = [[not any(needs) for _, needs in held.relations(list(map(Surd.rational, point)))] for held in probes]
        with precision(BITS):
            value = dual(ball(middle) + around(part.radius), 1)
            parts = (value.cos(), value.sin()) if turns else (value,)
            held = Held.of(self._chain, joint, parts, lambda c: dual(c.ball()))
            relations = held.relations([dual(ball(c)) for c in point])
            return any(
                not relation[1].contains(0)
                for (relation, _), holds in zip(relations, zip(*listed, strict=True), strict=True)
                if all(holds)
            )


def rational_product(p: Polynomial) -> list[Fraction]:
    """The product of the conjugates over the rational numbers."""
    while roots := [d for c in p for d, _ in c.terms if d > 1]:
        prime = next(primes(roots[0]))
        p = p * Polynomial(tuple(c.conjugate(prime) for c in p))
    return [c.terms[0][1] if c else Fraction(0) for c in p]


def _circle(k: int) -> tuple[Surd, Surd]:
    return Surd.rational(Fraction(1 - k * k, 1 + k * k)), Surd.rational(Fraction(2 * k, 1 + k * k))
