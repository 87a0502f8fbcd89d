"""Reading a block about the roots, or the sign, of one polynomial on the line, on an interval, or under a condition.

On an interval with the ends l and u the variable is replaced by (l + u*y)/(1 + y), which maps y > 0 onto it if l < u;
above l by l + y, below u by u - y. With the denominators multiplied out, which are positive, f becomes a polynomial in
y of the same degree at most, whose constant coefficient is a positive multiple of the value at l, or at u where there
is no l, and whose coefficient of degree n that at u where there are both.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import lcm

from qe.elimination.rootsigns.theory import REAL, Place, Root, RootType, Shape, count
from qe.errors import BudgetExceeded, Unable
from qe.exact.ring import Poly
from qe.formula.build import atom, conj, exists
from qe.formula.syntax import TRUE, Atom, Formula, Relation
from qe.formula.traverse import conjuncts

EQ, LT, LE, GT, GE = Relation.EQ, Relation.LT, Relation.LE, Relation.GT, Relation.GE
HIGHEST = {Place.LINE: 6, Place.RAY: 4, Place.CONDITION: 4}
"""Degrees up to which rows of signs are listed."""
MOST_TERMS = 2_000


@dataclass(frozen=True, slots=True)
class Question:
    """Whether some y, in the place, has f(y) relation 0. ``f``: coefficients, the constant one first, the last not 0.

    ``relation`` is one of =, <, <=. ``g``, ``sign``: what else is asked, in the place CONDITION. ``closed``: whether
    y = 0, and whether y = oo, takes part, in the place RAY. ``side``: a condition on the parameters besides.
    ``change``: numerator and denominator of what the block's variable is, linear in y; none where that is y.
    """

    f: tuple[Poly, ...]
    relation: Relation
    place: Place
    g: tuple[Poly, ...] = ()
    sign: Relation = GT
    closed: tuple[bool, bool] = (False, False)
    side: Formula = TRUE
    change: tuple[Poly, Poly] | None = None

    @property
    def degree(self) -> int:
        return len(self.f) - 1

    @property
    def shape(self) -> Shape:
        """Squares are needed only where rows of signs without them decide nothing."""
        invariant = self.degree == 4 and self.relation is LT
        return Shape(self.degree, self.place, len(self.g) % 2 == 0, False, invariant)

    def holds(self, lead: int, kind: RootType) -> bool:
        """The answer where the leading coefficient has the sign ``lead``, not 0, and the roots are such.

        Where f > 0 far out it is < 0 somewhere iff it changes its sign, at a root of odd multiplicity.
        """
        if self.place is Place.CONDITION:
            return count(kind, *(Root(s) for s in self.sign.signs)) > 0
        inside: tuple[Root, ...] = REAL if self.place is Place.LINE else (Root.POSITIVE,)
        if self.relation is LT:
            odd = any(r in inside and m % 2 for r, m in kind)
            return lead < 0 or odd or (self.place is Place.LINE and self.degree % 2 == 1)
        if self.closed[0]:
            inside = (Root.ZERO, Root.POSITIVE)
        return count(kind, *inside) > 0 or (self.relation is LE and lead < 0)

    def terms(self, x: Poly) -> tuple[tuple[Poly, Poly], tuple[Poly, Poly]]:
        """The variable of the block by y, and y by it, as quotients; both have the name x."""
        one = x.ring.constant(1)
        if self.change is None:
            return (x, one), (x, one)
        top, bottom = self.change
        t, k = (part.derivative(x.level) for part in self.change)
        return self.change, ((bottom - k * x) * x - (top - t * x), t - k * x)

    def degenerate(self, x: int) -> Formula:
        """The question where the leading coefficient is 0."""
        if self.closed[1] and self.relation is not LT:
            return TRUE
        y, ring = self.f[0].ring.gen(x), self.f[0].ring
        body: list[Formula] = [atom(_value(self.f[:-1], y), self.relation)]
        if self.place is Place.RAY:
            body.append(atom(y, GE if self.closed[0] else GT))
        if self.place is Place.CONDITION:
            body.append(atom(_value(self.g, y), self.sign))
        return exists([ring.names[x]], conj(body))


def read(body: Formula, x: int) -> Question | None:
    """The question that ``ex x. body`` asks, with the variable y named x; None for one of another kind."""
    parts = conjuncts(body)
    having = [a for a in parts if isinstance(a, Atom) and a.poly.degree(x) > 0]
    if len(having) < len(parts):
        return None
    bounds = [a for a in having if a.poly.degree(x) == 1 and a.poly.leading(x).is_constant and a.relation in _ENDS]
    others = [a for a in having if a not in bounds]
    equations = [a for a in others if a.relation is EQ]
    if len(others) == 2 and len(equations) == 1 and not bounds:
        return _under_condition(equations[0], next(a for a in others if a not in equations), x)
    if len(others) != 1 or others[0].relation is Relation.NE:
        return None
    if not 2 <= others[0].poly.degree(x) <= HIGHEST[Place.RAY if bounds else Place.LINE]:
        return None
    poly = others[0].poly
    relation: Relation = others[0].relation
    if others[0].relation in (GT, GE):
        relation, poly = others[0].relation.flipped, -poly
    if not bounds:
        return Question(poly.coefficients(x), relation, Place.LINE)
    return _on_interval(poly, relation, bounds, x)


_ENDS = (LT, LE, GT, GE)


def _under_condition(equation: Atom, condition: Atom, x: int) -> Question | None:
    f, g = equation.poly.coefficients(x), condition.poly.coefficients(x)
    if not 2 < len(f) <= HIGHEST[Place.CONDITION] + 1 or not 1 < len(g) <= len(f):
        return None
    return Question(f, EQ, Place.CONDITION, g, condition.relation)


@dataclass(frozen=True, slots=True)
class _End:
    """The end top/bottom, bottom > 0, of an interval to the right (``lower``) or left of it."""

    top: Poly
    bottom: int
    lower: bool
    closed: bool


def _end(bound: Atom, x: int) -> _End:
    rest, slope = bound.poly.coefficients(x)
    k = slope.constant_value()
    lower = (bound.relation in (GT, GE)) == (k > 0)
    return _End(-rest if k > 0 else rest, abs(k), lower, bound.relation in (LE, GE))


def _on_interval(poly: Poly, relation: Relation, bounds: Sequence[Atom], x: int) -> Question | None:
    ends = [_end(b, x) for b in bounds]
    lower, upper = [e for e in ends if e.lower], [e for e in ends if not e.lower]
    if len(lower) > 1 or len(upper) > 1:
        return None
    y, one = poly.ring.gen(x), poly.ring.constant(1)
    if not upper or not lower:
        (end,) = ends
        change = end.top + y * (end.bottom if end.lower else -end.bottom), one * end.bottom
        return Question(_moved(poly, x, *change), relation, Place.RAY, closed=(end.closed, False), change=change)
    (low,), (high,) = lower, upper
    common = lcm(low.bottom, high.bottom)
    l, u = low.top * (common // low.bottom), high.top * (common // high.bottom)
    change = l + u * y, (one + y) * common
    moved = _moved(poly, x, *change)
    if l == u or len(moved) <= poly.degree(x):
        return None
    side = atom(u - l, GE if low.closed and high.closed else GT)
    return Question(moved, relation, Place.RAY, closed=(low.closed, high.closed), side=side, change=change)


def _moved(poly: Poly, x: int, top: Poly, bottom: Poly) -> tuple[Poly, ...]:
    """The coefficients of the sum of f_i * top^i * bottom^(n-i), for a polynomial with the coefficients f_i."""
    try:
        return poly.at_quotient(x, top, bottom, most_terms=MOST_TERMS).coefficients(x)
    except BudgetExceeded:
        raise Unable("a polynomial grows past its limits on an interval") from None


def _value(f: Sequence[Poly], y: Poly) -> Poly:
    """The polynomial with these coefficients."""
    value = y.ring.constant(0)
    for c in reversed(f):
        value = value * y + c
    return value
