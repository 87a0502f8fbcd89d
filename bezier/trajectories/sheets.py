"""Where the segment between two moving points is clear of sets that are given by polynomial conditions.

Its points P(t, s) = (1 - s) a(t) + s b(t) are a surface. A condition f >= 0 is along it a polynomial in t and s; in
powers of the distances from both ends of an interval of s it has coefficients c_k(t) (Bernstein's, up to factors).

THEOREM. Where all c_k are negative for the t of an interval, f is negative on the rectangle: an identity, and signs of
polynomials in t, which those between their roots tell. The kernel proves both.

Points are known up to ``near`` only, so f is made larger by what that changes: at most ``near`` times the sum of the
largest absolute values of the derivatives of f in a box around the points and those that are so near (the mean value
theorem).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise, product
from math import lcm

from bezier.curves import bernstein as bs
from bezier.curves.curve import Bezier
from bezier.curves.nonnegative import Nonnegative, decide
from bezier.curves.scalar import Vector, terms_between, terms_sum
from bezier.curves.sentences import InBernstein, by_signs, dyadic_above, in_bernstein
from bezier.obstacles.bodies import around
from bezier.obstacles.obstacle import Constraint
from bezier.obstacles.survey import MAX_DEGREE
from qe.errors import Unable
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists
from qe.formula.syntax import Formula, Relation
from qe.options import Budget
from qe.proof.certificate import Certificate
from qe.proving.lemma_list import Lemmas

RING = Ring.of(("t", "s"))
T, S = RING.var("t"), RING.var("s")
MOST, SHORTEST, LONGER = 4000, Fraction(1, 1 << 40), 1 << 12
"""Rectangles for one segment and set; intervals of t, and by what factor shares may be longer: short ones change less
nearby."""
ZERO, ONE = Fraction(0), Fraction(1)
Conditions = tuple[tuple[Constraint, ...], ...]
"""A union of intersections."""
Touched = Callable[[Fraction, Sequence[Fraction]], Fraction | None]


@dataclass(frozen=True, slots=True, order=True)
class Rectangle:
    """Where no point of a segment is in a set: in this ``piece``, for these t, between these shares. ``normal``: of a
    half-space that holds the set."""

    piece: int
    low: Fraction
    high: Fraction
    first: Fraction = ZERO
    last: Fraction = ONE
    normal: Vector = ()


@dataclass(frozen=True, eq=False)
class Sheet:
    """The points of a segment with moving ends, known up to ``near``."""

    ends: tuple[Bezier, Bezier]
    near: Fraction

    def through(self, share: Fraction) -> Bezier:
        """The curve of a point that divides the segment."""
        pairs = zip(*(end.points for end in self._alike), strict=True)
        return Bezier(tuple(tuple(x + share * (y - x) for x, y in zip(a, b, strict=True)) for a, b in pairs))

    def widened(self, conditions: Conditions, part: Rectangle) -> Conditions:
        """The set made wider: for the points of a rectangle."""
        return self.around(conditions, self.corners(part))

    def around(self, conditions: Conditions, points: Sequence[Vector], times: int = 1) -> Conditions:
        """The set made wider: for points in the box around these, so many ``times`` what ``near`` changes."""
        return tuple(tuple(self._wider(c, points, times) for c in piece) for piece in conditions)

    def _wider(self, c: Constraint, points: Sequence[Vector], times: int) -> Constraint:
        corners, change = list(product(*zip(*around(points, self.near), strict=True))), ZERO
        for axis in range(3):
            lowered = {(*e[:axis], e[axis] - 1, *e[axis + 1 :]): e[axis] * x for e, x in c.terms if e[axis]}
            change += max(map(abs, terms_between(lowered, corners)), default=ZERO)
        return Constraint.of(terms_sum(dict(c.terms), {(0, 0, 0): times * dyadic_above(self.near * change)}))

    # --- search -----------------------------------------------------------------------------------------------
    def followed(
        self, piece: int, judge: Callable[[Rectangle], Rectangle | bool], touched: Touched
    ) -> Iterator[Rectangle | tuple[Fraction, Fraction]]:
        """Rectangles that cover [0, 1] x [0, 1], or that up to a t, and this with a share where the set is touched.
        ``judge``: the rectangle with what shows that it is clear; or else whether its shares are to be halved, not the
        interval of t. ``touched``: at a t, one of some shares, if it is. Raises ``Unable``."""
        todo, count = [(ZERO, ONE, [(ZERO, ONE)])], 0
        while todo:
            low, high, waiting = todo.pop()
            still = list[tuple[Fraction, Fraction]]()
            while waiting:
                (first, last), count = waiting.pop(), count + 1
                found = judge(Rectangle(piece, low, high, first, last))
                if isinstance(found, Rectangle):
                    yield found
                elif found:
                    waiting += [((first + last) / 2, last), (first, (first + last) / 2)]
                else:
                    still.append((first, last))
            if still and (share := touched(low, sorted({share for ends in still for share in ends}))) is not None:
                yield low, share
                return
            if still and (count > MOST or high - low < SHORTEST):
                raise Unable("undecided: a link comes so close to an obstacle that small parts do not tell")
            middle = (low + high) / 2
            todo += [(middle, high, still[:]), (low, middle, still)] if still else []

    def judged(self, conditions: Conditions, part: Rectangle) -> Rectangle | bool:
        """By the signs of coefficients; shares are halved where both ends are clear, or the rest is short."""
        seen = self._seen(self.widened(conditions, part), part)
        if all(any(everywhere for _, _, everywhere in piece) for piece in seen):
            return part
        is_short = part.last - part.first > LONGER * (part.high - part.low)
        return is_short or all(any(row[end] for row in piece) for piece in seen for end in (0, 1))

    def touched(self, conditions: Conditions, t: Fraction, shares: Iterable[Fraction]) -> Fraction | None:
        """The first of the shares at which a point is in the set, up to twice what ``near`` changes."""
        for share in shares:
            at = self.through(share).point(t)
            if any(all(c.value(at) >= 0 for c in piece) for piece in self.around(conditions, (at,), 2)):
                return share
        return None

    def _seen(self, conditions: Conditions, part: Rectangle) -> list[list[tuple[bool, bool, bool]]]:
        """Whether a condition fails at the first share, at the last, and everywhere on a rectangle."""
        return [[self._fails(c, part) for c in piece] for piece in conditions]

    def _fails(self, condition: Constraint, part: Rectangle) -> tuple[bool, bool, bool]:
        def is_negative(c: Poly) -> bool:
            power = [Fraction(x.constant_value()) for x in c.coefficients(0)]
            found = decide(bs.negate(bs.restrict(bs.from_power(power), part.low, part.high)))
            return isinstance(found, Nonnegative) and not found.touches

        first, *others = self._coefficients(self._along(condition), part).coefficients
        ends = is_negative(first), is_negative((first, *others)[-1])
        return *ends, all(ends) and all(map(is_negative, others[:-1]))

    def corners(self, part: Rectangle) -> list[Vector]:
        """Points with the rectangle in their hull."""
        curves = (self.through(share).segment(part.low, part.high) for share in (part.first, part.last))
        return [p for curve in curves for p in curve.points]

    @cached_property
    def _alike(self) -> list[Bezier]:
        return [end.elevate(max(e.degree for e in self.ends)) for end in self.ends]

    # --- proof ------------------------------------------------------------------------------------------------
    def sentence(self, conditions: Conditions, part: Rectangle) -> Formula:
        """That a point of the rectangle is in the set."""
        within = [(T, part.low, part.high), (S, part.first, part.last)]
        ends = [atom(x * low.denominator - low.numerator, Relation.GE) for x, low, _ in within]
        ends += [atom(x * high.denominator - high.numerator, Relation.LE) for x, _, high in within]
        held = disj(conj(atom(self._along(c), Relation.GE) for c in piece) for piece in conditions)
        return exists(RING.names, conj((*ends, held)))

    def refuted(self, conditions: Conditions, part: Rectangle) -> Certificate:
        """That no point is. Raises ``Unable``."""
        lemmas = Lemmas(RING)
        signs = dict.fromkeys(T * end.denominator - end.numerator for end in (part.low, part.high))
        for piece, seen in zip(conditions, self._seen(conditions, part), strict=True):
            whole = self._along(next(c for c, (_, _, everywhere) in zip(piece, seen, strict=True) if everywhere))
            if not whole.is_constant:
                listed = self._coefficients(whole, part)
                signs |= listed.say(lemmas, [(-listed.power, ((whole, 1),))])
        lemmas.line(list(signs), 0)
        proof = by_signs(self.sentence(conditions, part), lemmas, Budget())
        if proof is None:
            raise Unable("a rectangle has no certificate")
        return proof

    @cached_property
    def _at(self) -> tuple[list[Poly], int]:
        """The coordinates of P(t, s) over a number."""
        scale = lcm(*(c.denominator for end in self.ends for p in end.points for c in p))
        rows = [[bs.to_power(end.coordinate(i)) for end in self.ends] for i in range(3)]
        polys = ([RING.from_terms({(k, 0): int(c * scale) for k, c in enumerate(p)}) for p in row] for row in rows)
        return [p + S * (q - p) for p, q in polys], scale

    def _along(self, condition: Constraint) -> Poly:
        """A positive multiple of a condition at P(t, s). Raises ``Unable``."""
        if condition.degree * self._alike[0].degree > MAX_DEGREE:
            raise Unable(f"undecided: a formula has along a link a degree above {MAX_DEGREE}")
        return condition.poly(*self._at)

    def _coefficients(self, whole: Poly, part: Rectangle) -> InBernstein:
        return in_bernstein(whole, 1, whole.degree(1), (part.first, part.last))


def cover(parts: Iterable[Rectangle], end: Fraction) -> bool:
    """Whether rectangles of one piece cover [0, end] x [0, 1]."""
    known = sorted(parts, key=lambda part: part.first)
    times = sorted({ZERO, end, *(t for part in known for t in (part.low, part.high) if t < end)})
    for low, high in pairwise(times):
        reached = ZERO
        for part in known:
            if part.low <= low and high <= part.high and part.first <= reached:
                reached = max(reached, part.last)
        if reached < 1:
            return False
    return True
