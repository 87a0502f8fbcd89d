"""All positions of three joints that bring a point to a place, each of which turns or slides: for certificates.

With frames A0 M1 A1 M2 A2 M3, e the point seen from there, p' = A0^-1 p, A1 = (R, o), v = A2 M3 e, and M2 v = (u, v_z)
or v + d e_z, the place is reached iff A1 M2 v has the same length and height as p' (a first joint that turns) or the
same x and y (one that slides) (D. L. Pieper 1968). These two are linear in u, or in d but for a square, and |u| =
|(v_x, v_y)|. With θ3 = φ + 2 arctan t, or t the length of the third joint, all over powers of 1 + t² or of 1 (where θ3
turns v runs on a circle, so that (1 + t²) |v|² is linear in v): either
they determine u or d, and the equation E in t is left; or a combination E of the two is free of u or d, and S = m² is
left for what it does not name. θ2 is the angle from (v_x, v_y) to u, unique where they are not 0, θ1 the one from
A1 M2 v to p', unique where p' is not on the first axis; where they are not unique every angle will do, as M1 and M2
move nothing then. So different (t, m) are different positions, or families. Where E is the zero polynomial there are
as many as roots of S, if S is negative everywhere else; if not, the third joint can be chosen, where S >= 0. A point on
the third axis stands still: nothing depends on that joint, and t = 0 stands for all of its angles.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from bezier.proofs import square_roots as sr
from bezier.proofs.families import Arcs, Position, not_negative
from bezier.proofs.held_joint import spread
from bezier.proofs.nested_roots import JointValue, Nested, Place, nested
from bezier.proofs.square_roots import ONE, ZERO, Interval, Motion, Polynomial, Surd, Triple, back, combined, dot, image
from qe.errors import Unable
from qe.options import Budget
from qe.proof.entry import Entry

HALF, TWO, UNIT = Surd.rational(Fraction(1, 2)), ONE + ONE, Polynomial((ONE,))
Linear = tuple[Polynomial, Surd]
"""A part without m, and the factor of m."""

FREE = "a joint can be chosen here"


@dataclass(frozen=True, slots=True)
class Positions:
    """``equation`` (E) and ``square`` (S, or None); ``full``: the degree of E where no angle is missed, 0 where t
    misses none; ``only_at_roots``: the equation is S, because E vanishes. ``parts``: M2 v over the norm; ``slide``:
    what tells the second joint, if it slides."""

    both: Equations
    equation: Polynomial
    full: int
    square: Polynomial | None
    parts: Sequence[Linear]
    slide: Linear | None
    only_at_roots: bool

    @staticmethod
    def of(
        constants: Sequence[Motion],
        turns: tuple[bool, ...],
        e: Triple,
        place: Triple,
        phi: tuple[Fraction, Fraction] | None,
        entry: Entry,
    ) -> Positions:
        """The equations of the derivation above; ``constants``: A0, A1, A2. ``phi`` is None where t is a length, or
        where the point stands still."""
        target = [Polynomial.of([c]) for c in image(back(constants[0]), place)]
        stands, t = is_still(turns, e), Polynomial((ZERO, ONE))
        factors = (UNIT,) if stands else (UNIT, t) if phi is None else circle(t, UNIT, phi)
        both = Equations.of(turns, constants[1], target, spread(constants[2], e, turns[2]), factors)
        equation, full, square, parts, slide = both.reduced()
        if stands and not equation:
            equation = t
        only_at_roots = not equation
        if only_at_roots:
            equation, full = square or Polynomial(), 4
        full = 0 if phi is None else full
        if equation and len(equation) <= full:
            raise entry.fail("the equation vanishes at the angle that t misses")
        return Positions(both, equation, full, square, parts, slide, only_at_roots)

    def family(self, marks: Entry, budget: Budget) -> Position:
        """The positions where E is the zero polynomial: the third joint can be chosen."""
        third, norm = self.both.third, self.both.norm
        if not self.only_at_roots or len(third) < 2:
            raise marks.fail("the equation of a third joint that turns does not hold everywhere")
        return self.third_chosen(not_negative(self.equation, third, norm, marks, budget) if self.equation else None)

    def third_chosen(self, arcs: Arcs) -> Position:
        """The positions in which the third joint has these angles."""
        (x, y, _), (u, v, _), turns = self.both.target, self.both.v, self.both.turns
        free = [turns[0] and not (x or y), turns[1] and not (u or v)]
        chosen: dict[int, Arcs] = {k: None for k in range(2) if free[k]}
        return Position([None, None, None], {**chosen, 2: arcs})

    def total(self, entry: Entry) -> int:
        """The number of positions (t, m) with t real."""
        if self.only_at_roots and (len(self.equation) % 2 == 0 or self.equation[-1].sign() > 0):
            raise entry.fail(FREE)
        if len(self.equation) == 1:
            return 0
        roots = sr.tarski(self.equation, UNIT)
        if not self.square or self.only_at_roots or not roots:
            return roots
        signs = sr.tarski(self.equation, self.square)
        nonzero = sr.tarski(self.equation, self.square * self.square)
        return (nonzero + signs) + (roots - nonzero)  # two for each positive one, one where it vanishes

    def at_root(self, between: Interval, entry: Entry) -> Iterator[Position]:
        """The positions over the one root in an interval."""
        ends = [self.equation.at(x) for x in between]
        if not all(ends):
            raise entry.fail("an end is a root")
        if self.only_at_roots and any(end.sign() > 0 for end in ends):
            raise entry.fail(FREE)
        if len(self.equation) == 1 or sr.tarski(self.equation, UNIT, between) != 1:
            raise entry.fail("expected exactly one root in the interval")
        yield from self.over(Place.of(self.equation, between))

    def over(self, place: Place) -> Iterator[Position]:
        """The positions over a root of the equation."""
        nothing = self.square is None or self.only_at_roots
        square = Nested({}) if nothing else nested(place.value(self.square or Polynomial()))
        for m in square.square_roots():
            yield self._position(place, m)

    def _position(self, place: Place, m: Nested) -> Position:
        def at(p: Polynomial) -> Nested:
            return nested(place.value(p))

        joints: list[JointValue | None] = list(self.both.joints(self.parts, self.slide, m, at))
        for k, vector in enumerate((self.both.target, self.both.v)):
            x, y = map(at, vector[:2])
            if self.both.turns[k] and not (x * x + y * y).sign():
                joints[k] = None
        joints += [None] * (3 - len(joints))
        return Position(joints, {k: None for k in range(3) if joints[k] is None})


def is_still(turns: tuple[bool, ...], e: Triple) -> bool:
    """Whether the point lies on the axis of the third joint, which turns."""
    return turns[2] and not (e[0] or e[1])


def circle(t: Any, one: Any, phi: tuple[Fraction, Fraction]) -> tuple[Any, Any, Any]:
    """1 + t², and cos θ and sin θ times it, for θ = φ + 2 arctan t."""
    c, s = map(Surd.rational, phi)
    minus, double = one - t * t, t + t
    return one + t * t, minus.by(c) - double.by(s), minus.by(s) + double.by(c)


def rows_of(second: Motion, first_turns: bool) -> tuple[Triple, Triple]:
    """What the two equations take of M2 v; ``second``: A1."""
    rows, shift = second
    return (tuple(dot(column, shift) for column in zip(*rows, strict=True)), rows[2]) if first_turns else rows[:2]


@dataclass(frozen=True, slots=True)
class Equations:
    """What is left of the two equations, in numbers of any kind that can be added, multiplied, and multiplied by a
    ``Surd``: polynomials in t, or in more variables. ``second``: A1; v, ``squared``, |v|², and ``third``, cosine and
    sine, or the length, of the third joint, times ``norm``.

    The results: E, its full degree in t where the third joint turns, S or None, M2 v times norm, and the length times
    norm of a second joint that slides."""

    turns: Sequence[bool]
    second: Motion
    target: Sequence[Any]
    norm: Any
    third: Sequence[Any]
    v: Sequence[Any]
    squared: Any

    @staticmethod
    def of(
        turns: Sequence[bool], second: Motion, target: Sequence[Any], f: Sequence[Any], factors: Sequence[Any]
    ) -> Equations:
        """v is the sum of f, times ``factors``, over the first of these, the norm; without the others the third joint
        moves nothing."""
        norm, v = factors[0], [combined(row, factors) for row in zip(*f[: len(factors)], strict=True)]
        if len(factors) < 3:
            squared = dot(v, v)
        else:  # |v|² = |f0|² + |f1|² + 2 cos θ f0·f1 + 2 sin θ f0·f2: f1 and f2 are orthogonal and equally long
            squared = combined(f[0], v).by(TWO) + norm.by(dot(f[1], f[1]) - dot(f[0], f[0]))
        return Equations(turns, second, target, norm, factors[1:], v, squared)

    def joints(self, parts: Sequence[Any], slide: Any, m: Any, at: Callable[[Any], Any]) -> list[JointValue]:
        """The joints, by M2 v and the length of a second joint that slides, in numbers that ``at`` makes of these:
        valid where no point is on the axis of a joint."""
        (rows, shift), norm, v, goal = self.second, at(self.norm), [*map(at, self.v)], [*map(at, self.target)]
        moved = [at(p) + m.by(c) for p, c in parts]
        q = [combined(row, moved) + norm.by(o) for row, o in zip(rows, shift, strict=True)]
        first = JointValue(norm * goal[2] - q[2], None, norm)
        if self.turns[0]:
            x, y = goal[:2]
            first = JointValue(x * q[0] + y * q[1], y * q[0] - x * q[1], (x * x + y * y) * norm)
        if slide is not None:
            second = JointValue(at(slide[0]) + m.by(slide[1]), None, norm)
        else:
            x, y = v[:2]
            second = JointValue(x * moved[0] + y * moved[1], x * moved[1] - y * moved[0], x * x + y * y)
        c, *sine = map(at, self.third) if self.third else (None,)
        return [first, second, *([JointValue(c, sine[0] if sine else None, norm)] if self.third else [])]

    def reduced(self) -> tuple[Any, int, Any, Sequence[tuple[Any, Surd]], tuple[Any, Surd] | None]:
        """What is left."""
        return self._second_turns() if self.turns[1] else self._second_slides()

    def _distance(self) -> Any:
        """(|p'|² - |o|² - |v|²) norm."""
        shift = self.second[1]
        return self.norm * dot(self.target, self.target) - self.norm.by(dot(shift, shift)) - self.squared

    def _shifted(self, i: int) -> Any:
        return self.norm * self.target[i] - self.norm.by(self.second[1][i])

    def _second_turns(self) -> tuple[Any, int, Any, Sequence[tuple[Any, Surd]], None]:
        """u from the two equations, and |u|² = |(v_x, v_y)|²."""
        (g, n), v = rows_of(self.second, self.turns[0]), self.v
        one, two = (self._distance().by(HALF), self._shifted(2)) if self.turns[0] else map(self._shifted, range(2))
        b1, b2 = one - v[2].by(g[2]), two - v[2].by(n[2])
        kappa, determinant = v[0] * v[0] + v[1] * v[1], g[0] * n[1] - g[1] * n[0]
        if determinant:
            over = determinant.inverse()
            x, y = b1.by(n[1] * over) - b2.by(g[1] * over), b2.by(g[0] * over) - b1.by(n[0] * over)
            return x * x + y * y - kappa, 4, None, ((x, ZERO), (y, ZERO), (v[2], ZERO)), None
        along, d, equation = (b1, g, b2) if g[0] or g[1] else (b2, n, b1)
        length = d[0] * d[0] + d[1] * d[1]
        if not length:
            raise Unable("the first two joints move alike")
        over = length.inverse()
        if g[0] or g[1]:
            equation = equation - b1.by(dot(n[:2], d[:2]) * over)
        u = (along.by(d[0] * over), -d[1] * over), (along.by(d[1] * over), d[0] * over)
        return equation, 2, kappa.by(length) - along * along, (*u, (v[2], ZERO)), None

    def _second_slides(self) -> tuple[Any, int, Any, Sequence[tuple[Any, Surd]], tuple[Any, Surd]]:
        """d from one of the two equations."""
        (g, n), v, square, full, factor = rows_of(self.second, self.turns[0]), self.v, None, 2, ZERO
        if not self.turns[0]:
            b1, b2 = (self._shifted(i) - combined(row, v) for i, row in enumerate((g, n)))
            length = g[2] * g[2] + n[2] * n[2]
            if not length:
                raise Unable("the first two joints move alike")
            d = (b1.by(g[2]) + b2.by(n[2])).by(length.inverse())
            equation = b1.by(n[2]) - b2.by(g[2])
        else:
            height, middle = self._shifted(2) - combined(n, v), v[2] + self.norm.by(g[2])
            # |A1 (v + d e_z)|² = |v|² + |o|² + 2 g·v + d² + 2 d (v_z + g_z)
            wanted = self.norm * (self._distance() - combined(g, v).by(TWO))
            if n[2]:
                d, full = height.by(n[2].inverse()), 4
                equation = d * d + (d * middle).by(TWO) - wanted
            else:
                square, factor = middle * middle + wanted, ONE
                d, equation = -middle, height
        return equation, full, square, ((v[0], ZERO), (v[1], ZERO), (v[2] + d, factor)), (d, factor)
