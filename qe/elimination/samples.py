"""Points tried in floating point: existential sentences of inequalities that hold in some open set are often true at a
point that a few hundred trials find. A point counts only where exact arithmetic confirms it; none found says nothing.

Trials go down the total violation, the sum over conjuncts and the least over disjuncts of how far an atom is from
holding, one variable at a time (coordinate search: Hooke, Jeeves 1961), from points drawn between the bounds. Where
several curved conditions pull in different directions, as in packings, all variables go at once: to the border of one
violated condition after the other, as its slope says, and beyond (relaxation: Agmon 1954; Motzkin, Schoenberg 1954).
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from fractions import Fraction

from qe.elimination.protocol import Context, Outcome, witness_of
from qe.exact.number import Values
from qe.exact.ring import Poly
from qe.formula.block import Block
from qe.formula.evaluate import holds_at
from qe.formula.syntax import TRUE, And, Atom, Formula, Or, Relation
from qe.formula.traverse import conjuncts, polynomials
from qe.options import Budget, Options

STARTS, ROUNDS = 8, 12
"""Points to start from, and sweeps over the variables from each."""

CURVED_FROM, RELAXED, SWEEPS_OF_ALL = 3, (1.3, 1.7), 60
"""Curved conditions from which on all variables go at once, how far across the border, and how often from a point."""

TERMS_OF_A_CELL = 20
"""Terms of a formula that are tried at all values of one variable in about the time of a cell."""

SWEEPS = 3
"""Times that the bounds of variables are put into each other."""

FAR = 1e3
"""Where a variable has no bound, points are drawn up to here, mostly close to zero."""

Violation = Callable[[Sequence[float]], float]
Box = Sequence[tuple[float, float]]


class SampledPoints:
    """Sentences of inequalities in several variables that are true at a point which trials find."""

    name = "samples"

    def suits(self, problem: Block, options: Options) -> str | None:
        """Sentences of one block without equations."""
        if not problem.is_flat or problem.free or violation(problem.positive) is None:
            return None
        return "inequalities alone"

    def run(self, problem: Block, context: Context) -> Outcome | None:
        """A point that was verified; None says nothing."""
        dual = problem.dual
        known = find(dual.body, context.budget)
        if known is None:
            return None
        values: Values = {name: known.get(name, Fraction(0)) for name in dual.variables}
        evidence = {"proof": {"certificate": witness_of(dual, values)}}
        answer = context.log.step("point or multipliers", problem.formula, problem.asked(TRUE), evidence=evidence)
        return Outcome(answer, values)


def find(body: Formula, budget: Budget) -> dict[str, Fraction] | None:
    """A rational point at which the quantifier-free body holds, or None. Raises ``BudgetExceeded``."""
    measure, ring = violation(body), body.ring
    if measure is None or ring is None:
        return None
    rng, places = random.Random(0), [ring.index[name] for name in body.free]
    box = bounds(body, len(ring.names))
    units = 1 + sum(poly.term_count() for poly in polynomials(body)) // TERMS_OF_A_CELL
    conditions = sloping(body)
    for k in range(SWEEPS_OF_ALL if conditions else 0):
        point = [_drawn(rng, *limits) for limits in box]
        if relaxed(conditions, point, RELAXED[k % 2], budget, units) and (known := _confirmed(body, point)):
            return known
    for _ in range(STARTS):
        point = [_drawn(rng, *limits) for limits in box]
        if _descended(measure, point, places, box, budget, units) <= 0 and (known := _confirmed(body, point)):
            return known
    return None


def _confirmed(body: Formula, point: Sequence[float]) -> dict[str, Fraction] | None:
    """A rational point close by at which the body holds."""
    assert body.ring is not None
    for rounded in _rounded(point):
        named = dict(zip(body.ring.names, rounded, strict=True))
        if holds_at(body, named):
            return {name: named[name] for name in body.free}
    return None


Terms = list[tuple[float, Sequence[tuple[int, int]]]]
"""A polynomial that is to be positive, in floating point: coefficients with the variables and their powers."""

Condition = tuple[Terms, list[tuple[int, Terms]]]


def sloping(body: Formula, curved: int = CURVED_FROM) -> list[Condition]:
    """The atoms of a conjunction of inequalities of which so many are curved, each with its slope by variables; [] for
    others."""
    sides = Relation.EQ, Relation.NE
    atoms = [part for part in conjuncts(body) if isinstance(part, Atom) and part.relation not in sides]
    if len(atoms) < len(conjuncts(body)) or sum(a.poly.total_degree > 1 for a in atoms) < curved:
        return []
    try:
        return [
            (_terms(a.poly, a.relation), [(i, _terms(a.poly.derivative(i), a.relation)) for i in a.poly.variables])
            for a in atoms
        ]
    except OverflowError:
        return []


def relaxed(conditions: list[Condition], point: list[float], far: float, budget: Budget, units: int) -> bool:
    """Whether the point meets all conditions in floating point, once it was moved along the slopes of those that it did
    not meet, ``far`` times as long as they say that the border is away."""
    with suppress(OverflowError):
        for sweep in range(SWEEPS_OF_ALL):
            if not sweep % 10:
                budget.spend(units)
                budget.check("samples")
            holds = True
            for terms, slopes in conditions:
                values = [c * math.prod([point[i] ** k for i, k in powers]) for c, powers in terms]
                short = 1e-6 * sum(map(abs, values)) - sum(values)
                if short > 0:
                    holds = False
                    slope = [(i, sum([c * math.prod([point[j] ** k for j, k in p]) for c, p in t])) for i, t in slopes]
                    steep = sum([d * d for _, d in slope])
                    for i, d in slope:
                        point[i] += far * short * d / steep if steep > 0 else 0.0
            if holds:
                return True
    return False


def violation(body: Formula) -> Violation | None:
    """How far a formula of inequalities is from holding at a point, 0 where it does; None for other formulas."""
    match body:
        case Atom(poly, relation) if relation is not Relation.EQ:
            return _of_atom(poly, relation)
        case And(args) | Or(args):
            parts = [violation(arg) for arg in args]
            known = [part for part in parts if part is not None]
            if isinstance(body, And) and len(known) == len(parts):
                return lambda at: sum([part(at) for part in known])
            if isinstance(body, Or) and known:
                return lambda at: min([part(at) for part in known])
    return None


def _terms(poly: Poly, relation: Relation) -> Terms:
    """What is positive where the atom holds. Raises ``OverflowError``."""
    sign = 1.0 if relation in (Relation.GT, Relation.GE) else -1.0
    return [(sign * float(c), powers) for powers, c in poly.sparse_terms()]


def _of_atom(poly: Poly, relation: Relation) -> Violation:
    """Relative to the sum of the absolute values of its terms; a little beyond the border is asked for."""
    try:
        terms = _terms(poly, relation)
    except OverflowError:
        return lambda at: math.inf

    def measured(at: Sequence[float]) -> float:
        total = size = 0.0
        try:
            for c, powers in terms:
                for i, k in powers:
                    c *= at[i] ** k
                total += c
                size += abs(c)
        except OverflowError:
            return 1.0
        if relation is Relation.NE:
            total = abs(total)
        return max(0.0, 1e-9 - total / size) if 0.0 < size < math.inf else 1.0

    return measured


def bounds(body: Formula, count: int) -> Box:
    """For each variable of the ring an interval that the linear conjuncts allow, each seen alone, a few times.

    Conditions with numbers beyond floating point are passed over.
    """
    box = [(-math.inf, math.inf)] * count
    linear: list[tuple[dict[int, float], float]] = []
    for part in conjuncts(body):
        if isinstance(part, Atom) and part.relation not in (Relation.EQ, Relation.NE) and part.poly.total_degree == 1:
            sign = 1 if part.relation in (Relation.GT, Relation.GE) else -1
            try:
                terms = [(powers, sign * float(c)) for powers, c in part.poly.sparse_terms()]
            except OverflowError:  # longer than a float
                continue
            rest = sum(c for powers, c in terms if not powers)
            linear.append(({powers[0][0]: c for powers, c in terms if powers}, rest))
    for _ in range(SWEEPS):
        for leads, rest in linear:
            highest = {i: max(c * box[i][0], c * box[i][1]) for i, c in leads.items()}
            for i, c in leads.items():
                end = -(rest + sum(most for k, most in highest.items() if k != i)) / c  # c*x >= c*end
                low, high = box[i]
                box[i] = (max(low, end), high) if c > 0 else (low, min(high, end))
    return box


def _drawn(rng: random.Random, low: float, high: float) -> float:
    """A point of an interval, where it is long or has no end mostly close to its other end, or to zero."""
    far = math.pow(FAR, rng.random()) * rng.random()
    if math.isinf(low) and math.isinf(high):
        return rng.choice((-far, far))
    if math.isinf(high):
        return low + far
    if math.isinf(low):
        return high - far
    return low + (high - low) * math.pow(rng.random(), rng.choice((1, 1, 3)))


def _descended(
    measure: Violation, point: list[float], places: Sequence[int], box: Box, budget: Budget, units: int
) -> float:
    """The violation at a point that is moved along one variable after the other as long as it falls; ``units`` of work
    for each."""
    best = measure(point)
    for k in range(ROUNDS):
        before = best
        for place in places:
            budget.spend(units)
            budget.check("samples")
            kept = point[place]
            for value in _moves(kept, 0.5 / 2**k, *box[place]):
                if best <= 0:
                    return best
                point[place] = value
                size = measure(point)
                if size < best:
                    best, kept = size, value
            point[place] = kept
        if best <= 0 or (best == before and k > ROUNDS // 2):
            return best
    return best


def _moves(value: float, step: float, low: float, high: float) -> Iterator[float]:
    """Other values of a variable: doubled, halved, turned, a step up and down, and into the interval from its ends."""
    if low < high < math.inf and low > -math.inf:
        width = (high - low) * step
        yield from (x for x in (value - width, value + width, high - width / 2, low + width / 2) if low <= x <= high)
    reach = max(abs(value), 1.0) * 2 * step
    yield from (x for x in (2 * value, value / 2, -value, value - reach, value + reach) if low <= x <= high)


def _rounded(point: Sequence[float]) -> Iterator[list[Fraction]]:
    """Rational points close by, simple ones first."""
    if all(map(math.isfinite, point)):
        for digits in (1, 2, 3, 6, 12):
            yield [Fraction(f"{x:.{digits}g}") for x in point]
        yield [Fraction(x) for x in point]
