"""Ranges of variables that exclude a condition: x^2 + y^2 < 1 leaves no room for x*y > 1.

Theorem. Let p <= 0 hold, let c*x^k be a term of p, and let all other terms together be at least -m for all values in
the ranges known so far. Then c*x^k <= m, which bounds x. A conjunction is false if within the ranges that follow one of
its polynomials keeps the wrong sign. (Interval arithmetic, term by term; Davis 1987.)

The evidence is the list of bounds that were used and the condition that fails; the checker works out each again.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from math import inf, isfinite, isinf

from qe.exact.number import whole_root
from qe.exact.ring import Poly, SparseTerm
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.rules.block_context import BlockContext, Found
from qe.rules.step import StepKind
from qe.rules.tree import NEVER

ROUNDS, MOST_TERMS, BITS, SLACK = 3, 400, 16, 1e-6
"""How often all conditions are gone through; terms in all, at most; binary places of a root that is not rational; what
counts as near 0 in floating point, as a share of the greatest term."""

Number = Fraction | float
"""A rational number, or an infinity."""

Bound = tuple[int, str, int, int, Number]
"""Condition, variable, power of the term that gives it, side (1: from above), value."""

_UP = {Relation.LE, Relation.LT, Relation.EQ}
_DOWN = {Relation.GE, Relation.GT, Relation.EQ}


def excluded_by_ranges(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """The theorem on the comparisons of the conjunction."""
    parts = conjuncts(body)
    inequalities = [(k, a) for k, a in enumerate(parts) if isinstance(a, Atom) and a.relation is not Relation.NE]
    if len(inequalities) < 2 or sum(a.poly.term_count() for _, a in inequalities) > MOST_TERMS:
        return None
    if all(a.poly.total_degree < 2 for _, a in inequalities):
        return None  # linear conditions have methods of their own
    conditions = _conditions(inequalities)
    if not _may_fail(conditions):
        return None
    search = _Search(conditions)
    failing = search.failing()
    if failing is None:
        return None
    bounds = [[k, name, power, side, value] for k, name, power, side, value in search.bounds]
    return Found(StepKind.RANGES, str(parts[failing]), NEVER, {"bounds": bounds, "fails": failing})


def ranges_of(atoms: Sequence[Atom], *, rough: bool = False) -> dict[int, tuple[Number, Number]]:
    """The ranges of variables, by their places, that the theorem gives; in floating point, ``rough`` ones."""
    search = (_Rough if rough else _Search)(_conditions(enumerate(atoms)))
    search.failing()
    return {i: (search.low.get(i, -inf), search.high.get(i, inf)) for i in {*search.low, *search.high}}


def _conditions(inequalities: Iterable[tuple[int, Atom]]) -> list[_Condition]:
    return [
        _Condition(k, p, a.relation, p.sparse_terms(), frozenset(a.free))
        for k, a in inequalities
        for p in at_most_zero(a)
    ]


def at_most_zero(a: Atom) -> Iterator[Poly]:
    """The polynomials that the comparison says are at most 0."""
    if a.relation in _UP:
        yield a.poly
    if a.relation in _DOWN:
        yield -a.poly


@dataclass(frozen=True, slots=True)
class _Condition:
    """A polynomial that is at most 0 by the part at ``position``, whose relation is given."""

    position: int
    poly: Poly
    relation: Relation
    terms: list[SparseTerm]
    names: frozenset[str]


def _may_fail(conditions: Sequence[_Condition]) -> bool:
    """The same search in floating point, in a tenth of the time: whether it comes near to a condition that fails."""
    try:
        return _Rough(conditions).failing() is not None
    except OverflowError:  # numbers that floating point does not hold
        return True


@dataclass(slots=True)
class _Search:
    conditions: Sequence[_Condition]
    low: dict[int, Number] = field(default_factory=dict)
    high: dict[int, Number] = field(default_factory=dict)
    bounds: list[Bound] = field(default_factory=list)

    def failing(self) -> int | None:
        """The position of a condition that cannot hold, once some bounds are found."""
        looked: dict[int, int] = {}  # how many bounds were known when a condition was looked at
        for _ in range(ROUNDS):
            before = len(self.bounds)
            for number, condition in enumerate(self.conditions):
                since, looked[number] = looked.get(number), len(self.bounds)
                if since is not None and not any(bound[1] in condition.names for bound in self.bounds[since:]):
                    continue  # it says what it said
                least = [self.least(powers, c) for powers, c in condition.terms]
                if self.excludes(least, condition.relation):
                    return condition.position
                if least.count(-inf) < 2:  # else the rest of every term is unbounded
                    self._bound(condition, least)
            if len(self.bounds) == before:
                return None
        return None

    def excludes(self, least: Sequence[Number], relation: Relation) -> bool:
        """Whether a polynomial with these lower bounds of its terms cannot be at most 0, or less than 0."""
        total = _sum(least, self.number(0))
        return total > 0 or (total == 0 and relation in (Relation.LT, Relation.GT))

    def number(self, value: int) -> Number:
        return Fraction(value)

    def above(self, value: Number, power: int) -> Number:
        """A root, or a little more."""
        return _root_above(Fraction(value), power)

    def below(self, value: Number, power: int) -> Number:
        """A root, or a little less."""
        return _root_below(Fraction(value), power)

    def least(self, powers: tuple[tuple[int, int], ...], c: int) -> Number:
        """A lower bound of c * x^e over the ranges."""
        low: Number = self.number(c)
        high: Number = low
        for i, k in powers:
            ends = power_range(self.low.get(i, -inf), self.high.get(i, inf), k)
            products = [times(u, v) for u in ((low,) if low is high else (low, high)) for v in ends]
            low, high = min(products), max(products)
        return low

    def _bound(self, condition: _Condition, least: list[Number]) -> None:
        """The bounds that a condition p <= 0 gives by its terms in one variable alone."""
        position, poly = condition.position, condition.poly
        for k, (powers, c) in enumerate(condition.terms):
            if len(powers) != 1 or (c < 0 and powers[0][1] % 2 == 0):
                continue
            rest = _sum(least[:k] + least[k + 1 :], self.number(0))
            if rest == -inf:
                continue
            ((i, power),) = powers
            most: Number = -rest / c  # c*x^e <= -rest
            size = self.above(most if most >= 0 else -most, power)
            if power % 2 == 0:
                if most >= 0:
                    self._cut(position, poly, i, power, 1, size)
                    self._cut(position, poly, i, power, -1, -size)
            elif c > 0:
                self._cut(position, poly, i, power, 1, size if most >= 0 else -self.below(-most, power))
            else:
                self._cut(position, poly, i, power, -1, -size if most <= 0 else self.below(most, power))

    def _cut(self, position: int, poly: Poly, i: int, power: int, side: int, value: Number) -> None:
        """A bound, if it says more than what is known."""
        if side > 0 and value < self.high.get(i, inf):
            self.high[i] = value
        elif side < 0 and value > self.low.get(i, -inf):
            self.low[i] = value
        else:
            return
        self.bounds.append((position, poly.ring.names[i], power, side, value))


class _Rough(_Search):
    """The same in floating point, where what is near 0 counts as positive; beyond its range nothing is excluded."""

    __slots__ = ()

    def excludes(self, least: Sequence[Number], relation: Relation) -> bool:
        total, sizes = float(_sum(least, 0.0)), [abs(float(v)) for v in least]
        return total >= -SLACK * max(sizes) if isfinite(total) else total > 0

    def number(self, value: int) -> Number:
        return float(value)

    def above(self, value: Number, power: int) -> Number:
        root: float = float(value) ** (1 / power)
        return root

    below = above


def _sum(values: Sequence[Number], zero: Number) -> Number:
    """The sum of lower bounds."""
    return -inf if -inf in values else sum(values, zero)


def power_range(a: Number, b: Number, k: int) -> tuple[Number, Number]:
    """The least and the greatest value, perhaps infinite, of x^k for x from a to b."""
    ends = [(end if k % 2 else inf) if isinstance(end, float) and isinf(end) else end**k for end in (a, b)]
    if k % 2 == 0 and a < 0 < b:
        ends.append(Fraction(0))
    return min(ends), max(ends)


def times(a: Number, b: Number) -> Number:
    """The product, where zero times anything is zero."""
    if not a or not b:
        return a if not a else b
    if any(isinstance(v, float) and isinf(v) for v in (a, b)):
        return inf if (a > 0) is (b > 0) else -inf
    return a * b


def _root_below(value: Fraction, k: int) -> Fraction:
    """The k-th root of a number that is not negative, or a little less."""
    top, bottom = whole_root(value.numerator, k), whole_root(value.denominator, k)
    if (top**k, bottom**k) == (value.numerator, value.denominator):
        return Fraction(top, bottom)
    scale = 1 << BITS
    return Fraction(whole_root(value.numerator * scale**k // value.denominator, k), scale)


def _root_above(value: Fraction, k: int) -> Fraction:
    """The k-th root, or a little more."""
    root = _root_below(value, k)
    return root if root**k == value else root + Fraction(1, 1 << BITS)
