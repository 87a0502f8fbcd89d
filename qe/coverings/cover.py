"""Cylindrical algebraic coverings (Ábrahám, Davenport, England, Kremer 2021) of existential sentences.

Over a sample of the first variables the line of the next one is covered by intervals on each of which the formula is
false: by atoms that are false there (with a Boolean structure: by an implicant; Nalbach, Kremer 2024), or by a covering
of the lines above. From a covering that is complete the polynomials are projected on whose signs it depends, and they
give the interval of the line below. So only projections near the samples are computed, and only those that refute.

THEOREM. Let the intervals I_1, …, I_m cover the line over the sample s, let P_j be the irreducible polynomials in x_k
whose signs refute the formula on I_j, with bounds of I_j among their real roots, no other root of them inside, and none
of them zero on the whole line. On every connected neighbourhood of s on which these are order-invariant: the factors
below level k that refute on the I_j, the Brown–McCallum projection of each P_j, the resultants of an upper bound of
each interval with the lower bound of the next, the formula is false over every point. (P_j is delineable there:
McCallum 1998, Brown 2001; so its roots keep their order, and so do neighbouring bounds.)
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from qe.cad.projection import FactorSet, project
from qe.coverings.implicant import Decided, false_by, value
from qe.errors import InternalError, NotWellOriented
from qe.exact.fibre_stack import Isolation, isolate_over
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.exact.watch import Watch
from qe.formula.syntax import Atom, Formula
from qe.formula.traverse import atoms
from qe.options import Budget, Projection

_SIGN = {"+": 1, "-": -1, "0": 0}


@dataclass(frozen=True, slots=True)
class Bound:
    """A real root of a polynomial over the sample: the first one is number 1."""

    poly: Poly
    root: int

    def section(self, stack: Isolation) -> int:
        """The section of a stack that it is."""
        place, seen = stack.polys.index(self.poly), 0
        for k, section in enumerate(stack.sections):
            seen += place in section.members
            if seen == self.root:
                return k
        raise InternalError("a bound is no root")


@dataclass(frozen=True, slots=True)
class Interval:
    """An open interval between two bounds (None: it is unbounded), or the one point ``lower`` = ``upper`` where
    ``is_point``.

    ``own``: the polynomials in the variable of the line that were used, ``below``: those of lower level. ``sample``: a
    point of the interval, a root of a polynomial (``at``) or rational. ``reason``: the atoms that are false on it, or
    the covering over the sample.
    """

    lower: Bound | None
    upper: Bound | None
    is_point: bool
    own: tuple[Poly, ...]
    below: tuple[Poly, ...]
    sample: Point
    at: Bound | None
    reason: frozenset[Atom] | Cover

    def reach(self, stack: Isolation) -> tuple[int, int]:
        """The first and last position of a stack that it covers: sector k is 2*k, section k is 2*k + 1."""
        first = 0 if self.lower is None else 2 * self.lower.section(stack) + 1
        last = 2 * len(stack.sections) if self.upper is None else 2 * self.upper.section(stack) + 1
        if self.is_point:
            return first, last
        return first + (self.lower is not None), last - (self.upper is not None)


@dataclass(frozen=True, slots=True)
class Cover:
    """Intervals that cover the line over a point, ascending, none of them superfluous."""

    point: Point
    intervals: tuple[Interval, ...]


@dataclass(slots=True)
class Search:
    """``formula``: quantifier-free, in negation normal form, over ``ring``, whose variables are all existential.

    ``samples``: how many points were tried.
    """

    formula: Formula
    ring: Ring
    budget: Budget
    samples: int = 0

    def run(self) -> Point | Cover:
        """A point where the formula holds, or a covering of R that proves that there is none.

        Raises ``BudgetExceeded``, and ``NotWellOriented`` where a polynomial is zero on a whole line.
        """
        return self._over(Point(self.ring, watch=Watch(self.budget.check)), {})

    def _over(self, point: Point, decided: Decided) -> Point | Cover:
        level = point.depth
        line = _Line(point, _level_factors(self.formula, decided, level))
        while (position := line.uncovered()) is not None:
            self.samples += 1
            self.budget.spend(1 + len(line.isolation.sections))
            self.budget.check("cover", self.samples)
            sample = line.isolation.sample(position)
            known = {**decided, **line.truths(self.formula, decided, position)}
            truth = value(self.formula, known)
            if truth is True:
                return sample
            reason: frozenset[Atom] | Cover
            if truth is False:
                reason = false_by(self.formula, known)
                used = FactorSet(a.poly for a in reason)
            else:
                if level + 1 == len(self.ring.names):
                    raise InternalError("a formula is open at a full sample")
                found = self._over(sample, known)
                if isinstance(found, Point):
                    return found
                reason, used = found, characterization(found)
            line.add(position, sample, reason, used)
        return Cover(point, line.chosen())


def characterization(cover: Cover) -> FactorSet:
    """The factors, in the variables below the line, on whose signs a covering depends: see the theorem above."""
    level, found = cover.point.depth, FactorSet()
    for interval in cover.intervals:
        found.add(interval.below)
        found.add(project(interval.own, level, Projection.BROWN_MCCALLUM))
    for left, right in pairwise(cover.intervals):
        if left.upper is None or right.lower is None:
            raise InternalError("an interval in the middle of a covering is unbounded")
        if left.upper.poly != right.lower.poly:
            found.add((left.upper.poly.resultant(right.lower.poly, level),))
    return found


def _level_factors(formula: Formula, decided: Decided, level: int) -> tuple[Poly, ...]:
    """The factors in the main variable of a level of the atoms that are open until then."""
    open_atoms = (a for a in atoms(formula) if isinstance(a, Atom) and a not in decided and a.poly.level == level)
    return tuple(FactorSet(a.poly for a in open_atoms).at(level))


class _Line:
    """The line over a point: the roots of the polynomials met so far, and the intervals found."""

    def __init__(self, point: Point, polys: Iterable[Poly]) -> None:
        self.point, self.intervals = point, list[Interval]()
        self.isolation = self._isolated(tuple(polys))

    def _isolated(self, polys: tuple[Poly, ...]) -> Isolation:
        found = isolate_over(self.point, polys)
        if found.nullified:
            raise NotWellOriented(f"{polys[found.nullified[0]]} is zero on the line over a sample")
        return found

    def uncovered(self) -> int | None:
        """A position that no interval covers: sectors before sections, whose samples may be irrational."""
        size = 2 * len(self.isolation.sections) + 1
        free = [True] * size
        for interval in self.intervals:
            first, last = interval.reach(self.isolation)
            free[first : last + 1] = [False] * (last + 1 - first)
        left = [p for p in range(size) if free[p]]
        return min(left, key=lambda p: (p % 2, abs(p - size // 2)), default=None)

    def truths(self, formula: Formula, decided: Decided, position: int) -> dict[Atom, bool]:
        """The truth at a position of the atoms of this level."""
        text = self.isolation.sign_texts()[position]
        signs = {poly: _SIGN[character] for poly, character in zip(self.isolation.polys, text, strict=True)}
        level = self.point.depth
        found = {}
        for a in atoms(formula):
            if isinstance(a, Atom) and a not in decided and a.poly.level == level:
                found[a] = self._sign(a.poly, signs) in a.relation.signs
        return found

    def _sign(self, poly: Poly, signs: Mapping[Poly, int]) -> int:
        unit, factors = poly.factors()
        sign = 1 if unit > 0 else -1
        for factor, exponent in factors:
            own = signs[factor] if factor in signs else self.point.sign(factor)
            sign *= own if exponent % 2 else own * own
        return sign

    # --- intervals ----------------------------------------------------------------------------------
    def add(self, position: int, sample: Point, reason: frozenset[Atom] | Cover, used: FactorSet) -> None:
        """The interval around a sample on which the polynomials used keep their signs."""
        level = self.point.depth
        own, below = tuple(used.at(level)), tuple(f for f in used if f.level < level)
        at = self._bound(position // 2, {*self.isolation.sections[position // 2].members}) if position % 2 else None
        new = tuple(f for f in own if f not in self.isolation.polys)
        if new:
            self.isolation = self._isolated((*self.isolation.polys, *new))
            position = self._position(sample, at)
        sections, mine = self.isolation.sections, {self.isolation.polys.index(f) for f in own}
        half = position // 2
        here = position % 2 and mine.intersection(sections[half].members)
        lower = half if here else next((k for k in range(half - 1, -1, -1) if mine & {*sections[k].members}), None)
        start = half if here else half + position % 2
        upper = next((k for k in range(start, len(sections)) if mine & {*sections[k].members}), None)
        ends = self._bound(lower, mine), self._bound(upper, mine)
        self.intervals.append(Interval(*ends, bool(here), own, below, sample, at, reason))

    def _position(self, sample: Point, at: Bound | None) -> int:
        """The position of a sample."""
        if at is not None:
            return 2 * at.section(self.isolation) + 1
        value = sample.number(self.point.depth)
        assert isinstance(value, Fraction)
        place, met = self.isolation.place_of(value)
        return 2 * place + met

    def _bound(self, section: int | None, mine: set[int]) -> Bound | None:
        """A section as a root of the simplest polynomial among ``mine`` that vanishes there."""
        if section is None:
            return None
        polys = self.isolation.polys
        members = mine.intersection(self.isolation.sections[section].members)
        chosen = min(members, key=lambda j: (polys[j].degree(self.point.depth), polys[j].total_degree, j))
        number = sum(chosen in s.members for s in self.isolation.sections[: section + 1])
        return Bound(polys[chosen], number)

    def chosen(self) -> tuple[Interval, ...]:
        """As few of the intervals as cover the line, ascending."""
        ranges = [(*interval.reach(self.isolation), k) for k, interval in enumerate(self.intervals)]
        kept, reached, end = [], 0, 2 * len(self.isolation.sections)
        while reached <= end:
            last, k = max((last, -k) for first, last, k in ranges if first <= reached)
            if last < reached:
                raise InternalError("a covering has a gap")
            kept.append(self.intervals[-k])
            reached = last + 1
        return tuple(kept)
