"""What proves a covering, for ``qe.kernel.covering``: its polynomials, and line by line roots and intervals."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from qe.cad.projection import FactorSet
from qe.coverings.line import Cover, Interval
from qe.exact.fibre_stack import Isolation, isolate_over
from qe.exact.ring import Poly
from qe.exact.sample import Point
from qe.formula.syntax import Formula


def evidence(cover: Cover, quantifiers: Sequence[str], matrix: Formula) -> dict[str, object]:
    """The prenex formula (``order``, ``quantifiers``, ``matrix``), ``factors`` by level, and the covering of the first
    line; see the checker for the parts of a line."""
    names = cover.point.ring.names
    levels: list[dict[Poly, int]] = [{} for _ in names]
    _collect(cover, levels)
    factors = [list(level) for level in levels]
    asked = {"order": list(names), "quantifiers": list(quantifiers), "matrix": matrix}
    return {**asked, "factors": factors, "line": _Writer(tuple(levels)).line(cover)}


def _collect(cover: Cover, levels: list[dict[Poly, int]]) -> None:
    """Every polynomial of the covering, and those whose roots are samples."""
    for interval in cover.intervals:
        at, reason = interval.found.at, interval.found.reason
        atoms = () if isinstance(reason, Cover) else FactorSet(a.poly for a in reason)
        for f in (*interval.own, *interval.below, *interval.zero, *atoms, *(() if at is None else (at.poly,))):
            levels[f.level].setdefault(f, len(levels[f.level]))
        if isinstance(reason, Cover):
            _collect(reason, levels)


@dataclass(frozen=True, slots=True)
class _Writer:
    levels: tuple[Mapping[Poly, int], ...]

    def line(self, cover: Cover) -> dict[str, object]:
        """One line: its factors with their roots, and the intervals in their order."""
        places = self.levels[cover.point.depth]
        at = {interval.found.at.poly for interval in cover.intervals if interval.found.at is not None}
        each = (f for i in cover.intervals for f in (*i.own, *i.zero, *_own_atoms(i, cover.point.depth)))
        used = sorted({*at, *each}, key=places.__getitem__)
        cuts = _Cuts(isolate_over(cover.point, tuple(used)), cover)
        members = [sorted(places[used[j]] for j in s.members) for s in cuts.stack.sections]
        return {
            "used": [places[f] for f in used],
            "sectors": cuts.sectors,
            "sections": [[] if k is None else members[k] for k in cuts.between],
            "intervals": [self._interval(interval, cuts) for interval in cover.intervals],
        }

    def _interval(self, interval: Interval, cuts: _Cuts) -> dict[str, object]:
        first, last = (cuts.moved(p) for p in interval.reach(cuts.stack))
        places = self.levels[cuts.stack.point.depth]
        own = None if interval.is_bare else sorted(places[f] for f in interval.own)
        found: dict[str, object] = {"first": first[0], "last": last[1], "at": cuts.sample(interval), "own": own}
        found["lower"] = None if interval.lower is None else places[interval.lower.poly]
        found["upper"] = None if interval.upper is None else places[interval.upper.poly]
        reason = interval.found.reason
        if isinstance(reason, Cover):
            found["line"] = self.line(reason)
        else:
            found["atoms"] = sorted(reason, key=str)
        return found


def _own_atoms(interval: Interval, level: int) -> list[Poly]:
    """The factors of a level of the atoms that decide on an interval."""
    reason = interval.found.reason
    return [] if isinstance(reason, Cover) else FactorSet(a.poly for a in reason).at(level)


class _Cuts:
    """A stack whose sectors are cut where they hold several samples: every rational sample is that of a sector."""

    def __init__(self, stack: Isolation, cover: Cover) -> None:
        self.stack, depth = stack, cover.point.depth
        within: list[set[Fraction]] = [set() for _ in stack.samples]
        for interval in cover.intervals:
            value = _rational(interval.found.sample, depth) if interval.found.at is None else None
            if value is not None and not stack.place_of(value)[1]:
                within[stack.place_of(value)[0]].add(value)
        self.sectors: list[Fraction] = []
        self.between: list[int | None] = []
        """Between two sectors the section of the stack, or None for a cut."""
        self._starts: list[int] = []
        for k, (values, usual) in enumerate(zip(within, stack.samples, strict=True)):
            self.between += [k - 1] if k else []
            self._starts.append(len(self.sectors))
            self.sectors += sorted(values) or [usual]
            self.between += [None] * (len(self.sectors) - self._starts[-1] - 1)

    def moved(self, position: int) -> tuple[int, int]:
        """The first and last position that a position of the stack has become."""
        half = position // 2
        if position % 2:
            place = 2 * self._starts[half + 1] - 1
            return place, place
        end = self._starts[half + 1] if half + 1 < len(self._starts) else len(self.sectors)
        return 2 * self._starts[half], 2 * (end - 1)

    def sample(self, interval: Interval) -> int:
        """The position of the sample of an interval."""
        found = interval.found
        if found.at is not None:
            return self.moved(2 * found.at.section(self.stack) + 1)[0]
        value = _rational(found.sample, self.stack.point.depth)
        place, met = self.stack.place_of(value)
        return self.moved(2 * place + 1)[0] if met else 2 * self.sectors.index(value)


def _rational(point: Point, depth: int) -> Fraction:
    value = point.number(depth)
    assert isinstance(value, Fraction)
    return value
