"""Points tried in floating point: existential sentences are often true at a point that a few hundred trials find. A
point counts only where exact arithmetic confirms it; none found says nothing.

Trials start at points drawn between the bounds. All variables go at once: to the border of one condition that is not
met after the other, as its slope says, and beyond where it is an inequality (relaxation: Agmon 1954; Motzkin,
Schoenberg 1954); of a disjunction the part that is nearest to holding counts. Where the point ends, each equation is
solved for a variable that those solved before do not have, where there are such; the values of others are rounded.
"""

from __future__ import annotations

import math
import random
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction

from qe.elimination.protocol import Context, Outcome, shown
from qe.errors import Unable
from qe.exact.algebraic import real_roots
from qe.exact.number import Values, simplest
from qe.exact.poly import Poly
from qe.formula.block import Block
from qe.formula.syntax import And, Atom, Formula, Or, Relation
from qe.formula.traverse import conjuncts, polynomials
from qe.options import Budget, Options
from qe.rules.lift import Solve, holds_at
from qe.rules.ranges import Number, ranges_of

STARTS, CURVED_FROM, OF_CURVED = 12, 3, 60
"""Points to start from; curved conditions from which on there are more of them."""

RELAXED, SWEEPS_OF_FEW, SWEEPS_OF_ALL, MARGIN, NEAR = 1.6, 20, 60, 1e-6, 1e-3
"""How far across the border inequalities go, and how often from a point, with few curved conditions and with more; how
far inside they hold for certain, and how far outside round numbers may yet meet them, in proportion to the terms."""

TERMS_OF_A_CELL = 20
"""Terms of a formula that are tried at all values of one variable in about the time of a cell."""

FAR = 1e3
"""Where a variable has no bound, points are drawn up to here, mostly close to zero."""

Terms = list[tuple[float, Sequence[tuple[int, int]]]]
"""A polynomial in floating point: coefficients with the variables and their powers."""

Condition = tuple[Atom, Terms, list[tuple[int, Terms]]]
"""An atom with its polynomial, which is to be positive where it is an inequality, and the slopes by variables."""

Pulls = Callable[[Sequence[float]], list[Condition]]
"""The conditions that count at a point."""


class SampledPoints:
    """Sentences in several variables that are true at a point which trials find."""

    name = "samples"

    def suits(self, problem: Block, options: Options) -> str | None:
        """Sentences of one block."""
        return None if not problem.is_flat or problem.free else "conditions that pull a point"

    def run(self, problem: Block, context: Context) -> Outcome | None:
        """A point that was verified; None says nothing."""
        known = find(problem.positive, context.budget)
        return None if known is None else shown(problem, known, context, "point or multipliers")


def find(body: Formula, budget: Budget) -> Values | None:
    """A point at which the quantifier-free body holds, or None. Raises ``BudgetExceeded``."""
    trials, rng = Trials.of(body), random.Random(0)
    if trials is None or body.ring is None:
        return None
    box = bounds(body, body.ring.size)
    starts = ([_drawn(rng, *limits) for limits in box] for _ in range(OF_CURVED if trials.many else STARTS))
    return next(filter(None, (trials.near(start, budget) for start in starts)), None)


@dataclass(frozen=True, slots=True)
class Trials:
    """What moves points to where a body holds; ``units`` of work of ten sweeps; ``many`` curved conditions or few."""

    body: Formula
    pulled: Pulls
    units: int
    many: bool

    @classmethod
    def of(cls, body: Formula) -> Trials | None:
        """Where the body has no quantifiers."""
        pulled = pulls(body)
        if pulled is None:
            return None
        polys = [*polynomials(body)]
        many = sum(poly.total_degree > 1 for poly in polys) >= CURVED_FROM
        return cls(body, pulled, 1 + sum(poly.term_count() for poly in polys) // TERMS_OF_A_CELL, many)

    def near(self, start: Iterable[float | Fraction], budget: Budget) -> Values | None:
        """Where a trial gets to from here, if the body holds there. Raises ``BudgetExceeded``."""
        with suppress(OverflowError):
            point = [*map(float, start)]
            if relaxed(self.pulled, point, budget, self.units, SWEEPS_OF_ALL if self.many else SWEEPS_OF_FEW):
                return _confirmed(self.body, self.pulled, point)
        return None


def _confirmed(body: Formula, conditions: Pulls, point: Sequence[float]) -> Values | None:
    """A point close by at which the body holds, with rational values but for what equations are solved for."""
    assert body.ring is not None
    order = _solvable([one for one in conditions(point) if one[0].relation is Relation.EQ], point)
    for rounded in _rounded(point) if order is not None else ():
        with suppress(Unable):
            known = _solved(order or (), dict(zip(body.ring.names, rounded, strict=True)), point)
            if known is not None and holds_at(body, known):
                return {name: known[name] for name in body.free}
    return None


def _solvable(equations: list[Condition], point: Sequence[float]) -> list[tuple[Poly, int]] | None:
    """The equations in an order in which each has a variable, given with it, that is in none of those before: best one
    that is linear, or else steep. None where there is no such order."""
    order: list[tuple[Poly, int]] = []
    while equations:
        count = Counter(i for _, _, slopes in equations for i, _ in slopes)
        alone = [
            (one[0].poly, i, abs(_value(terms, point))) for one in equations for i, terms in one[2] if count[i] == 1
        ]
        if not alone:
            return None
        poly, i, _ = max(alone, key=lambda choice: (choice[0].degree(choice[1]) == 1, choice[2]))
        order.insert(0, (poly, i))
        equations = [one for one in equations if one[0].poly is not poly]
    return order


def _solved(order: Sequence[tuple[Poly, int]], values: Values, point: Sequence[float]) -> Values | None:
    """The values with those that the equations give to their variables, near to the point. Raises ``Unable``."""
    for poly, i in order:
        names = poly.ring.names
        known = {j: value for j in poly.variables if j != i and isinstance(value := values[names[j]], Fraction)}
        one = poly.at_rationals(known)
        if one.degree(i) == 1:
            rest, lead = one.coefficients(i)
            values[names[i]] = Solve(names[i], -rest, lead).value(values)
        elif one.variables == (i,) and (roots := real_roots(one.to_univariate(i))):
            values[names[i]] = simplest(min(roots, key=lambda root: abs(float(root) - point[i])))
        else:
            return None
    return values


def pulls(body: Formula) -> Pulls | None:
    """The atoms in floating point; None for formulas with quantifiers or root atoms, and numbers beyond it."""
    match body:
        case Atom(poly, relation):
            try:
                slopes = [(i, _terms(poly.derivative(i), relation)) for i in poly.variables]
                condition: Condition = body, _terms(poly, relation), slopes
            except OverflowError:
                return None
            return lambda at: [condition]
        case And(args) | Or(args):
            parts = [part for arg in args if (part := pulls(arg)) is not None]
            if isinstance(body, And) and len(parts) == len(args):
                return lambda at: [condition for part in parts for condition in part(at)]
            if isinstance(body, Or) and parts:
                return lambda at: min(
                    (part(at) for part in parts), key=lambda chosen: sum([_amiss(c, at)[1] for c in chosen])
                )
    return None


def relaxed(conditions: Pulls, point: list[float], budget: Budget, units: int, sweeps: int) -> bool:
    """Whether the point is near to meeting the conditions, once it was moved along the slopes of those that it did not
    meet, inequalities ``RELAXED`` times as long as they say that the border is away. Raises ``OverflowError``."""
    worst = math.inf
    for sweep in range(sweeps):
        if not worst:
            break
        if not sweep % 10:
            budget.spend(units)
            budget.check("samples")
        worst = 0.0
        for condition in conditions(point):
            away, amiss = _amiss(condition, point)
            if away:
                worst = max(worst, amiss)
                slope = [(i, _value(terms, point)) for i, terms in condition[2]]
                steep = sum([d * d for _, d in slope])
                step = away if condition[0].relation is Relation.EQ else RELAXED * away
                for i, d in slope:
                    point[i] += step * d / steep if steep > 0 else 0.0
    return worst < NEAR


def _amiss(condition: Condition, at: Sequence[float]) -> tuple[float, float]:
    """What the polynomial of a condition lacks, and that in proportion to its terms; 0 where the condition is met."""
    relation = condition[0].relation
    values = [c * math.prod([at[i] ** k for i, k in powers]) for c, powers in condition[1]]
    total, size = sum(values), sum(map(abs, values))
    if relation is Relation.EQ:
        away = -total if abs(total) > 1e-12 * size else 0.0
    elif relation is Relation.NE:
        away = math.copysign(max(0.0, MARGIN * size - abs(total)), total)
    else:
        away = max(0.0, MARGIN * size - total)
    return away, abs(away) / size if away else 0.0


def _value(terms: Terms, at: Sequence[float]) -> float:
    return sum([c * math.prod([at[i] ** k for i, k in powers]) for c, powers in terms])


def _terms(poly: Poly, relation: Relation = Relation.GT) -> Terms:
    """What is positive where an inequality holds. Raises ``OverflowError``."""
    sign = -1.0 if relation in (Relation.LT, Relation.LE) else 1.0
    return [(sign * float(c), powers) for powers, c in poly.sparse_terms()]


def bounds(body: Formula, count: int) -> list[tuple[Number, Number]]:
    """For each variable of the ring an interval that the conjuncts allow, about."""
    conditions = [a for a in conjuncts(body) if isinstance(a, Atom) and a.relation is not Relation.NE]
    ranges = dict[int, tuple[Number, Number]]()
    with suppress(OverflowError):  # numbers beyond floating point
        ranges = ranges_of(conditions, rough=True)
    return [ranges.get(i, (-math.inf, math.inf)) for i in range(count)]


def _drawn(rng: random.Random, low: Number, high: Number) -> float:
    """A point of an interval, where it is long or has no end mostly close to its other end, or to zero."""
    far = math.pow(FAR, rng.random()) * rng.random()
    if math.isinf(low):
        return rng.choice((-far, far)) if math.isinf(high) else high - far
    if math.isinf(high):
        return low + far
    return low + (high - low) * math.pow(rng.random(), rng.choice((1, 1, 3)))


def _rounded(point: Sequence[float]) -> Iterator[list[Fraction]]:
    """Rational points close by, simple ones first; one has zeros for what is almost zero."""
    if all(map(math.isfinite, point)):
        for digits in ("1g", "2f", "2g", "3g", "6g", "12g"):
            yield [Fraction(f"{x:.{digits}}") for x in point]
        yield [Fraction(x) for x in point]
