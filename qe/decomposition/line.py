"""Lines over sample points: the intervals found on them, and what of a covering holds beside its sample."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from fractions import Fraction

from qe.decomposition.projection import FactorSet
from qe.decomposition.stack import is_nullified, sign_by_factors
from qe.errors import InternalError, NotWellOriented
from qe.exact.fibre_stack import Isolation, isolate_over
from qe.exact.ring import Poly
from qe.exact.sample import Point
from qe.formula.syntax import Atom
from qe.truth import Truth


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
class SampleTruth:
    """What is known at a ``sample`` of a line, a root of a polynomial (``at``) or rational, and why.

    ``reason``: the atoms that give the formula its truth value there, or the line over the sample.
    """

    sample: Point
    at: Bound | None
    truth: Truth
    reason: frozenset[Atom] | Cover

    @property
    def value(self) -> Fraction:
        """A rational sample's last coordinate."""
        value = self.sample.number(self.sample.depth - 1)
        assert isinstance(value, Fraction)
        return value

    def position(self, stack: Isolation) -> int:
        """That of the sample in a stack over the point of the line."""
        if self.at is not None:
            return 2 * self.at.section(stack) + 1
        below, is_section = stack.place_of(self.value)
        return 2 * below + is_section


@dataclass(frozen=True, slots=True)
class CoverInterval:
    """An open interval between two bounds (None: it is unbounded), or the one point ``lower`` = ``upper`` where
    ``is_point``, on which the formula is as at the sample of ``known``.

    ``own``: the polynomials in the variable of the line that were used, ``below``: those of lower level. ``zero``:
    polynomials used that are zero on the whole line. ``pinned``: this holds over the sample of the line only.
    ``is_bare``: the sample decides, and nobody asks what holds beside it.
    """

    lower: Bound | None
    upper: Bound | None
    is_point: bool
    own: tuple[Poly, ...]
    below: tuple[Poly, ...]
    known: SampleTruth
    zero: tuple[Poly, ...] = ()
    pinned: bool = False
    is_bare: bool = False

    def reach(self, stack: Isolation) -> tuple[int, int]:
        """The first and last position of a stack that it covers: sector k is 2*k, section k is 2*k + 1."""
        first = 0 if self.lower is None else 2 * self.lower.section(stack) + 1
        last = 2 * len(stack.sections) if self.upper is None else 2 * self.upper.section(stack) + 1
        if self.is_point:
            return first, last
        return first + (self.lower is not None), last - (self.upper is not None)


@dataclass(frozen=True, slots=True)
class Cover:
    """What is known of the line over a point: ``truth`` of the formula there (None for a free variable on whose value
    it depends), by intervals that cover the line, ascending, none of them superfluous; or by a single one, where the
    variable is quantified and one value decides.
    """

    point: Point
    truth: Truth
    intervals: tuple[CoverInterval, ...]

    @property
    def is_pinned(self) -> bool:
        """Whether it is known over the point only, and not beside it."""
        return any(interval.pinned for interval in self.intervals)


class Line:
    """The line over a point: the roots of the polynomials met so far, and the intervals found.

    ``whole``: every interval keeps the signs of all polynomials of all intervals; ``thom``: and of their derivatives.
    """

    def __init__(self, point: Point, polys: Iterable[Poly], *, whole: bool, thom: bool) -> None:
        """``polys``: those of the formula, of any level."""
        level = point.depth
        self.point, self.whole, self.thom = point, whole, thom
        self.intervals: list[CoverInterval] = []
        self._polys = [f for f in polys if f.level == level]
        self.isolation = isolate_over(point, tuple(FactorSet(self._polys).at(level)))

    def uncovered(self) -> int | None:
        """A position that no interval covers: sectors before sections, whose samples may be irrational."""
        size = 2 * len(self.isolation.sections) + 1
        free = [True] * size
        for interval in self.intervals:
            first, last = interval.reach(self.isolation)
            free[first : last + 1] = [False] * (last + 1 - first)
        left = [p for p in range(size) if free[p]]
        return min(left, key=lambda p: (p % 2, abs(p - size // 2)), default=None)

    def signs(self, position: int) -> dict[Poly, int]:
        """The signs at a position of the formula's polynomials of this level."""
        known = self.isolation.signs_at(position)

        def sign(factor: Poly) -> int:
            return known[factor] if factor in known else self.point.sign(factor)

        return {f: sign_by_factors(f, sign) for f in self._polys}

    # --- intervals ----------------------------------------------------------------------------------
    def known(self, position: int, sample: Point, truth: Truth, reason: frozenset[Atom] | Cover) -> SampleTruth:
        """What is known at a position, with the root that it is."""
        at = self._bound(position // 2, {*self.isolation.sections[position // 2].members}) if position % 2 else None
        return SampleTruth(sample, at, truth, reason)

    def add(self, known: SampleTruth, used: FactorSet) -> CoverInterval:
        """The interval around a sample on which the polynomials used keep their signs.

        Raises ``NotWellOriented`` where what is known there holds at the sample only, and no interval is that.
        """
        level = self.point.depth
        own, below = used.at(level), FactorSet(f for f in used if f.level < level)
        self._include(own)
        zero = tuple(f for f in own if self._is_zero(f))
        for f in zero:  # where its coefficients vanish, it does
            below.add(f.coefficients(level))
        pinned = bool(zero) and isinstance(known.reason, Cover)
        if pinned:  # its order is needed, too
            more = FactorSet(_delineating(self.point, f) for f in zero)
            own += more.at(level)
            below.add(f for f in more if f.level < level)
        own = [f for f in dict.fromkeys(own) if f not in zero]
        if self.whole:
            own = self._common(own)
        self._include(own)
        above = isinstance(known.reason, Cover) and known.reason.is_pinned
        pinned = pinned or above
        interval = self._around(CoverInterval(None, None, False, tuple(own), tuple(below), known, zero, pinned))
        if above and not interval.is_point:
            raise NotWellOriented(f"{self.point.ring.names[level]}: a polynomial is zero on a line over a sample")
        if self.whole:
            self.intervals = [self._around(replace(i, own=interval.own)) for i in self.intervals]
        self.intervals.append(interval)
        return interval

    def _include(self, polys: Iterable[Poly]) -> None:
        """Isolate the roots of these polynomials as well."""
        known = self.isolation.polys
        new = tuple(f for f in dict.fromkeys(polys) if f not in known)
        if new:
            self.isolation = isolate_over(self.point, (*known, *new), known=self.isolation.shapes)

    def _is_zero(self, poly: Poly) -> bool:
        return self.isolation.polys.index(poly) in self.isolation.nullified

    def _common(self, own: Iterable[Poly]) -> list[Poly]:
        """The polynomials of all intervals; with ``thom`` closed under derivation."""
        level = self.point.depth
        factors = FactorSet(own)
        for interval in self.intervals:
            factors.add(interval.own)
        if self.thom:
            for f in (listed := factors.at(level)):
                new = FactorSet(f.derivative(level) for _ in range(f.degree(level) > 1)).at(level)
                listed += [g for g in new if g not in listed]
            factors.add(listed)
        self._include(factors)
        return [f for f in factors if not self._is_zero(f)]

    def _around(self, interval: CoverInterval) -> CoverInterval:
        """The same with its ends: the next roots of its own polynomials on both sides of its sample."""
        position = interval.known.position(self.isolation)
        sections = self.isolation.sections
        mine = {self.isolation.polys.index(f) for f in interval.own}
        half = position // 2
        here = position % 2 and mine.intersection(sections[half].members)
        lower = half if here else next((k for k in range(half - 1, -1, -1) if mine & {*sections[k].members}), None)
        start = half if here else half + position % 2
        upper = next((k for k in range(start, len(sections)) if mine & {*sections[k].members}), None)
        ends = self._bound(lower, mine), self._bound(upper, mine)
        return replace(interval, lower=ends[0], upper=ends[1], is_point=bool(here))

    def _bound(self, section: int | None, mine: set[int]) -> Bound | None:
        """A section as a root of the simplest polynomial among ``mine`` that vanishes there."""
        if section is None:
            return None
        polys = self.isolation.polys
        members = mine.intersection(self.isolation.sections[section].members)
        chosen = min(members, key=lambda j: (polys[j].degree(self.point.depth), polys[j].total_degree, j))
        number = sum(chosen in s.members for s in self.isolation.sections[: section + 1])
        return Bound(polys[chosen], number)

    def chosen(self) -> tuple[CoverInterval, ...]:
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

    def with_all_signs(self, intervals: tuple[CoverInterval, ...]) -> tuple[CoverInterval, ...]:
        """The intervals with all polynomials that keep their sign there: on the first line nothing is projected, and
        the more signs are known, the shorter is an answer."""
        sections = [{self.isolation.polys[j] for j in s.members} for s in self.isolation.sections]
        polys = dict.fromkeys(f for interval in intervals for f in interval.own)
        widened = []
        for interval in intervals:
            first, last = interval.reach(self.isolation)
            inside = set() if interval.is_point else set[Poly]().union(*sections[first // 2 : (last + 1) // 2])
            own = (*interval.own, *(f for f in polys if f not in interval.own and f not in inside))
            widened.append(replace(interval, own=own))
        return tuple(widened)


def _delineating(point: Point, poly: Poly) -> Poly:
    """A partial derivative of least order that is not zero on the whole line over the point.

    The order of the polynomial is that of the derivative wherever on the line this one does not vanish.
    """
    partials = [poly]
    while True:
        partials = list(dict.fromkeys(f.derivative(i) for f in partials for i in f.variables))
        left = [f for f in partials if not is_nullified(point, f)]
        if left:
            return min(left, key=lambda f: (f.degree(point.depth), f.total_degree, f.term_count()))
