"""Cylindrical algebraic coverings (Ábrahám, Davenport, England, Kremer 2021) of formulas with any prefix and parameters
(Kremer, Nalbach 2022; Nalbach, Kremer 2024).

Over a sample of the first variables the line of the next one is covered by intervals on each of which the formula has
one truth value: by atoms that decide it there (with a Boolean structure: by an implicant), or by what is known of the
lines above. Where the variable is quantified, one interval on which it is true (for ∃; for ∀ false) is enough;
otherwise they have the other value and cover the line. Of a free variable the line is covered by intervals of both
values. From these intervals the polynomials are projected on whose signs they depend, and they give the interval of
the line below. So only projections near the samples are computed, and only of what decides.

THEOREM. Let P_j be the irreducible polynomials in x_k on whose signs the interval I_j over the sample s depends, with
bounds of I_j among their real roots, no other root of them inside, and none of them zero on the whole line. On every
connected neighbourhood of s (a cell: a section or sector over one) on which these are order-invariant: the factors
below level k on which the I_j depend, the Brown–McCallum projection of each P_j, the resultants of an upper bound of
each interval with the lower bound of the next, there are such intervals over every point, with the same truth values,
which cover the line where the I_j do. (P_j is delineable there: McCallum 1998, Brown 2001; so its roots keep their
order, and so do neighbouring bounds.)

A polynomial that is zero on the whole line is so wherever its coefficients are zero. That is all that atoms need of it.
A line above needs its order, which is constant on {s} x I where a partial derivative of least order has no zero;
so what follows holds over the point s only, and the intervals below have to be points.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from qe.decomposition.implicant import Signs, implicant
from qe.decomposition.line import Cover, CoverInterval, Line, SampleTruth
from qe.decomposition.operators.brown_mccallum import BROWN_MCCALLUM
from qe.decomposition.projection import EFFORT_OF_A_CELL, FactorSet, effort, project
from qe.errors import InternalError
from qe.exact.ring import Ring
from qe.exact.sample import Point
from qe.exact.watch import Watch
from qe.formula.evaluate import truth_under
from qe.formula.syntax import Formula
from qe.formula.traverse import polynomials
from qe.options import Budget


@dataclass(slots=True)
class Search:
    """``formula``: quantifier-free, in negation normal form, over ``ring``. ``quantifiers``: by variable "" (free, and
    first), "E" or "A". At the levels ``whole`` of free variables all intervals of a line depend on the same
    polynomials; at ``thom`` these are closed under derivation, so that signs tell the intervals apart (Thom's lemma).

    ``samples``: how many points were tried.
    """

    formula: Formula
    ring: Ring
    quantifiers: Sequence[str]
    budget: Budget
    whole: frozenset[int] = frozenset()
    thom: frozenset[int] = frozenset()
    samples: int = 0

    def run(self) -> Cover:
        """What is known of the first line; that is everything.

        Raises ``BudgetExceeded``, and ``NotWellOriented`` where a polynomial is zero on a whole line and its order is
        needed beside it.
        """
        return self._over(Point(self.ring, watch=Watch(self.budget.check, self.budget.spend)), {})

    def _over(self, point: Point, signs: Signs) -> Cover:
        level = point.depth
        if level == len(self.ring.names):
            raise InternalError("a formula is open at a full sample")
        kind = self.quantifiers[level]
        line = Line(point, polynomials(self.formula), whole=level in self.whole, thom=level in self.thom)
        while (position := line.uncovered()) is not None:
            self.samples += 1
            self.budget.spend(1 + len(line.isolation.sections))
            self.budget.check("cover", self.samples)
            here = self._at(line, position, signs)
            ends = bool(kind) and here.truth is (kind == "E")
            if ends and self.is_leading(level):
                return Cover(point, here.truth, (CoverInterval(None, None, False, (), (), here, is_bare=True),))
            interval = line.add(here, self._used(here))
            if ends:
                return Cover(point, here.truth, (interval,))
        intervals = line.chosen()
        if level == 0 and not kind:
            intervals = line.with_all_signs(intervals)
        truths = {interval.known.truth for interval in intervals}
        return Cover(point, truths.pop() if len(truths) == 1 else None, intervals)

    def _at(self, line: Line, position: int, signs: Signs) -> SampleTruth:
        """What is known at a position of a line."""
        sample = line.isolation.sample(position)
        known = {**signs, **line.signs(position)}
        truth = truth_under(self.formula, known.get)
        if truth is not None:
            return line.known(position, sample, truth, implicant(self.formula, known, truth))
        above = self._over(sample, known)
        return line.known(position, sample, above.truth, above)

    def is_leading(self, level: int) -> bool:
        """Whether all variables so far have one quantifier, so that nobody asks what holds beside a sample that
        decides."""
        return len({*self.quantifiers[: level + 1]}) == 1

    def _used(self, known: SampleTruth) -> FactorSet:
        """The polynomials on whose signs it depends what is known at a sample."""
        if not isinstance(known.reason, Cover):
            return FactorSet(a.poly for a in known.reason)
        if self.budget.is_limited:
            level = known.sample.depth
            self.budget.spend(sum(effort(i.own, level) for i in known.reason.intervals) // EFFORT_OF_A_CELL)
        return characterization(known.reason)


def characterization(cover: Cover) -> FactorSet:
    """The factors, in the variables below the line, on whose signs a covering depends: see the theorem above."""
    level, factors = cover.point.depth, FactorSet()
    for interval in cover.intervals:
        factors.add(interval.below)
        factors.add(project(interval.own, level, BROWN_MCCALLUM))
    for left, right in pairwise(cover.intervals):
        if left.upper is None or right.lower is None:
            raise InternalError("an interval in the middle of a covering is unbounded")
        if left.upper.poly != right.lower.poly:
            factors.add((left.upper.poly.resultant(right.lower.poly, level),))
    return factors
