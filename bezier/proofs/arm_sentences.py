"""What certificates about arms say, as sentences: cosines and sines of joints that turn, lengths of those that slide.

The joints are the variables c1, s1, c2, s2, ... (cosine and sine) and d1, d2, ... (length in mm); root2, root3, ... are
the square roots in the rows. Equations of the arm: c^2 + s^2 = 1 for each joint that turns, and that the end point is
where it should be; for a pose that the first half of the arm, from the base, and the other half, read back from the
pose, bring the origin and two axes to the same place (the third axis follows, as both halves are motions).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from math import lcm, prod

from bezier.proofs.arm_rows import ArmChain, Box
from bezier.proofs.square_roots import ONE, STILL, ZERO, Motion, Surd, Triple, carried, image, primes
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists, forall, iff, implies, neg
from qe.formula.syntax import Formula, Relation


@dataclass(frozen=True)
class Expression:
    """A polynomial: coefficients by products of variables."""

    terms: dict[tuple[str, ...], Surd]

    def __add__(self, other: Expression) -> Expression:
        total = dict(self.terms)
        for product, c in other.terms.items():
            total[product] = total.get(product, ZERO) + c
        return Expression({product: c for product, c in total.items() if c})

    def __neg__(self) -> Expression:
        return Expression({product: -c for product, c in self.terms.items()})

    def __sub__(self, other: Expression) -> Expression:
        return self + -other

    def __mul__(self, other: Expression) -> Expression:
        pairs = ((a, b, c * d) for a, c in self.terms.items() for b, d in other.terms.items())
        return sum((Expression({tuple(sorted((*a, *b))): c}) for a, b, c in pairs), Expression({}))


ALONG = "s"
"""The parameter of a curve."""
ROOT = "root"
ORIGIN: Triple = (ZERO, ZERO, ZERO)
Boxes = Sequence[Box | None]
"""Of each joint."""
Chosen = Mapping[int, Sequence[tuple[Box, Box]] | None]
"""By joints that can be chosen: the ends of arcs; None: all angles."""


def constant(value: Surd) -> Expression:
    """A number as a polynomial."""
    return Expression({(): value} if value else {})


def variable(name: str) -> Expression:
    """A variable as a polynomial."""
    return Expression({(name,): ONE})


@dataclass(frozen=True)
class ArmEquations:
    """Polynomials that vanish where the joints bring an arm to its place. ``names``: the variables of each joint."""

    names: tuple[tuple[str, ...], ...]
    expressions: tuple[Expression, ...]

    @staticmethod
    def at_point(chain: ArmChain, point: Sequence[Expression]) -> ArmEquations:
        """The end point is there."""
        names, (base, *links) = _names(chain), chain.in_numbers(constant)
        values = [list(map(variable, joint)) for joint in names]
        end = image(base, carried(links, values, _constants(ORIGIN)))
        return ArmEquations(names, tuple(a - b for a, b in zip(end, point, strict=True)))

    @staticmethod
    def on_curve(chain: ArmChain, coefficients: Sequence[Sequence[Fraction]]) -> ArmEquations:
        """The same for a point of a curve, whose coordinates are polynomials in ``ALONG``."""
        point = [Expression({(ALONG,) * k: Surd.rational(c) for k, c in enumerate(row) if c}) for row in coefficients]
        return ArmEquations.at_point(chain, point)

    @staticmethod
    def at_pose(chain: ArmChain, pose: Motion) -> ArmEquations:
        """The end point and the axes of the end effector are there."""
        names, half = _names(chain), (len(chain.turns) + 1) // 2
        values = [list(map(variable, joint)) for joint in names]
        base, *links = chain.in_numbers(constant)
        last = ArmChain((STILL, *chain.constants[half + 1 :]), chain.turns[half:]).reversed.in_numbers(constant)
        # a joint that goes the other way has the opposite sine, or length
        behind = [[*value[:-1], -value[-1]] for value in values[half:][::-1]]
        ((rows, shift),) = ArmChain((pose,), ()).in_numbers(constant)
        expressions = list[Expression]()
        for start, is_point in ((ORIGIN, True), (STILL[0][0], False), (STILL[0][1], False)):
            ahead = image(base, carried(links[:half], values[:half], _constants(start), is_point), is_point)
            end = image(last[0], carried(last[1:], behind, _constants(start), is_point), is_point)
            expressions += [a - b for a, b in zip(ahead, image((rows, shift), end, is_point), strict=True)]
        return ArmEquations(names, tuple(expressions))

    @property
    def primes(self) -> tuple[int, ...]:
        """Whose square roots occur."""
        radicands = {d for e in self.expressions for c in e.terms.values() for d, _ in c.terms}
        return tuple(sorted({p for d in radicands for p in primes(d)}))

    def variables(self, number: int | None = None) -> tuple[str, ...]:
        """The joints; with a number: those of the position with that number."""
        return tuple(name if number is None else f"{name}_{number}" for names in self.names for name in names)

    def hold(self, ring: Ring) -> Formula:
        """That all equations hold."""
        circles = (_on_circle(ring, names) for names in self.names if len(names) == 2)
        return conj((*circles, *(atom(_poly(e, ring), Relation.EQ) for e in self.expressions)))

    def exactly(self, ring: Ring, count: int, boxes: Sequence[Boxes] = ()) -> Formula:
        """That there are so many positions, different ones; with boxes, which are disjoint: one in each."""
        points, joints = [self.variables(k) for k in range(1, count + 1)], self.variables()
        parts = [self.within(ring, box, k) for k, box in enumerate(boxes, 1)]
        if not boxes:
            parts = [neg(_same(ring, *pair)) for pair in combinations(points, 2)]
        listed = disj(_same(ring, joints, point) for point in points)
        parts.append(forall(joints, iff(self.hold(ring), listed)))
        return exists([v for point in points for v in point], conj(parts))

    def within(self, ring: Ring, boxes: Boxes, number: int | None = None) -> Formula:
        """That cosines and sines, or lengths, are in the boxes; a joint without one may be anything."""
        sizes = [len(names) for names in self.names]
        ends = [end for box, size in zip(boxes, sizes, strict=True) for end in box or (None,) * size]
        named = zip(self.variables(number), ends, strict=True)
        return conj(between(ring.var(name), *end) for name, end in named if end is not None)

    def only(self, ring: Ring, boxes: Boxes) -> Formula:
        """That there is exactly one position in the boxes."""
        joints, point = self.variables(), self.variables(1)
        inside = conj((self.hold(ring), self.within(ring, boxes)))
        return exists(point, forall(joints, iff(inside, _same(ring, joints, point))))

    def family(self, ring: Ring, boxes: Boxes, chosen: Chosen) -> Formula:
        """That some angles of the joints that are chosen, and the others can follow them to a position in the boxes,
        iff each is in one of its arcs; these have ends in boxes, where they have no ends all angles are."""
        names, ends, arcs = [self.names[k] for k in chosen], list[str](), list[Formula]()
        parts = list[Formula]()
        for angle, listed in zip(names, chosen.values(), strict=True):
            inside = list[Formula]()
            for i, pair in enumerate(listed or ()):
                low, high = ([f"{name}_{2 * i + j}" for name in angle] for j in (1, 2))
                for end, box in ((low, pair[0]), (high, pair[1])):
                    parts += (_on_circle(ring, end), *(between(ring.var(v), *b) for v, b in zip(end, box, strict=True)))
                parts += [_same(ring, low, high)] if pair[0] == pair[1] else []
                ends += (*low, *high)
                inside.append(_same(ring, angle, low) if pair[0] == pair[1] else _in_arc(ring, angle, low, high))
            arcs += [disj(inside)] if listed is not None else []
        angles = [v for name in names for v in name]
        others = [v for v in self.variables() if v not in angles]
        follows = exists(others, conj((self.hold(ring), self.within(ring, boxes))))
        circles = conj(_on_circle(ring, angle) for angle in names if len(angle) == 2)
        return exists(ends, conj((*parts, forall(angles, implies(circles, iff(follows, conj(arcs)))))))


def ring_of(listed: Sequence[ArmEquations], count: int = 0) -> Ring:
    """Of the square roots, the parameter, the joints, and so many positions."""
    numbers = (None, *range(1, count + 1))
    joints = [name for number in numbers for name in listed[0].variables(number)]
    return Ring.of((*_roots(listed), ALONG, *joints))


def with_roots(ring: Ring, listed: Sequence[ArmEquations], formula: Formula) -> Formula:
    """A formula in which the names of square roots stand for these."""
    known = [
        atom(p, relation)
        for name in _roots(listed)
        for p, relation in (
            (ring.var(name) ** 2 - int(name.removeprefix(ROOT)), Relation.EQ),
            (ring.var(name), Relation.GT),
        )
    ]
    return exists(_roots(listed), conj((*known, formula)))


def between(x: Poly, low: Fraction, high: Fraction) -> Formula:
    """low <= x <= high."""
    least = atom(x * low.denominator - low.numerator, Relation.GE)
    return conj((least, atom(x * high.denominator - high.numerator, Relation.LE)))


def _roots(listed: Sequence[ArmEquations]) -> tuple[str, ...]:
    return tuple(f"{ROOT}{p}" for p in sorted({p for equations in listed for p in equations.primes}))


def _names(chain: ArmChain) -> tuple[tuple[str, ...], ...]:
    return tuple((f"c{k}", f"s{k}") if turning else (f"d{k}",) for k, turning in enumerate(chain.turns, 1))


def _same(ring: Ring, one: Sequence[str], other: Sequence[str]) -> Formula:
    return conj(atom(ring.var(a) - ring.var(b), Relation.EQ) for a, b in zip(one, other, strict=True))


def _on_circle(ring: Ring, angle: Sequence[str]) -> Formula:
    return atom(ring.var(angle[0]) ** 2 + ring.var(angle[1]) ** 2 - 1, Relation.EQ)


def _in_arc(ring: Ring, angle: Sequence[str], low: Sequence[str], high: Sequence[str]) -> Formula:
    """That an angle is on the way round from one to another, both included, by the sines of differences."""

    def sine(a: Sequence[str], b: Sequence[str], relation: Relation) -> Formula:
        """How that of the angle from a to b compares with 0."""
        return atom(ring.var(a[0]) * ring.var(b[1]) - ring.var(a[1]) * ring.var(b[0]), relation)

    small = conj(sine(*pair, Relation.GE) for pair in ((low, high), (low, angle), (angle, high)))
    outside = disj(sine(*pair, Relation.LE) for pair in ((high, angle), (angle, low)))
    return disj((small, conj((sine(low, high, Relation.LT), outside))))


def _constants(point: Triple) -> list[Expression]:
    return list(map(constant, point))


def _poly(expression: Expression, ring: Ring) -> Poly:
    """A positive multiple with integer coefficients."""
    below = lcm(*(q.denominator for c in expression.terms.values() for _, q in c.terms))
    total = ring.constant(0)
    for product, c in expression.terms.items():
        variables = prod(map(ring.var, product), start=ring.constant(1))
        for d, q in c.terms:
            roots = (ring.var(f"{ROOT}{p}") for p in primes(d))
            total = total + variables * prod(roots, start=ring.constant(int(q * below)))
    return total
