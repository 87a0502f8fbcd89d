"""What proves a covering, for ``qe.kernel.cells``: a tree of its lines, with intervals for cells."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from qe.decomposition.line import Cover, CoverInterval
from qe.decomposition.projection import FactorSet
from qe.exact.fibre_stack import Isolation, isolate_over
from qe.exact.ring import Poly
from qe.formula.syntax import Atom, Formula
from qe.formula.traverse import polynomials
from qe.options import Projection
from qe.proof.cells import Cell, CellTable, Stack


def tree(cover: Cover, quantifiers: Sequence[str], matrix: Formula) -> CellTable:
    """The covering of a prenex formula, as a tree of cells; ``matrix`` is over the ring of the covering."""
    names = cover.point.ring.names
    levels: list[dict[Poly, int]] = [{} for _ in names]
    _collect(cover, levels)
    for f in FactorSet(polynomials(matrix)):
        levels[f.level].setdefault(f, len(levels[f.level]))
    root = Cell("", None if quantifiers[0] == "" else cover.truth, _Writer(tuple(levels)).line(cover))
    factors = tuple(tuple(level) for level in levels)
    return CellTable(names, tuple(quantifiers), matrix, Projection.BROWN_MCCALLUM, factors, root)


def _collect(cover: Cover, levels: list[dict[Poly, int]]) -> None:
    """Every polynomial of the covering, and those whose roots are samples."""
    for interval in cover.intervals:
        at, reason = interval.known.at, interval.known.reason
        for f in (*interval.own, *interval.below, *interval.zero, *(() if at is None else (at.poly,))):
            levels[f.level].setdefault(f, len(levels[f.level]))
        if isinstance(reason, Cover):
            _collect(reason, levels)


@dataclass(frozen=True, slots=True)
class _Writer:
    levels: tuple[Mapping[Poly, int], ...]

    def line(self, cover: Cover) -> Stack:
        """One line: its factors with their roots, and the intervals in their order."""
        level = cover.point.depth
        places = self.levels[level]
        at = {interval.known.at.poly for interval in cover.intervals if interval.known.at is not None}
        each = (f for i in cover.intervals for f in (*i.own, *i.zero, *FactorSet(a.poly for a in _atoms(i)).at(level)))
        used = sorted({*at, *each}, key=places.__getitem__)
        cuts = _Cuts(isolate_over(cover.point, tuple(used)), cover)
        members = [tuple(sorted(places[used[j]] for j in s.members)) for s in cuts.stack.sections]
        return Stack(
            used=tuple(places[f] for f in used),
            sectors=tuple(cuts.sectors),
            sections=tuple(() if k is None else members[k] for k in cuts.between),
            cells=tuple(self._interval(interval, cuts) for interval in cover.intervals),
        )

    def _interval(self, interval: CoverInterval, cuts: _Cuts) -> Cell:
        first, last = (cuts.moved(p) for p in interval.reach(cuts.stack))
        places = self.levels[cuts.stack.point.depth]
        own = None if interval.is_bare else tuple(sorted(places[f] for f in interval.own))
        reason = interval.known.reason
        above = self.line(reason) if isinstance(reason, Cover) else None
        return Cell("", None, above, (first[0], last[1], cuts.sample(interval)), own)


def _atoms(interval: CoverInterval) -> Iterator[Atom]:
    """The atoms that decide on an interval, or on lines over it."""
    reason = interval.known.reason
    if not isinstance(reason, Cover):
        yield from reason
    else:
        for above in reason.intervals:
            yield from _atoms(above)


class _Cuts:
    """A stack whose sectors are cut where they hold several samples: every rational sample is that of a sector."""

    def __init__(self, stack: Isolation, cover: Cover) -> None:
        self.stack = stack
        within: list[set[Fraction]] = [set() for _ in stack.samples]
        for interval in cover.intervals:
            position = interval.known.position(stack)
            if not position % 2:
                within[position // 2].add(interval.known.value)
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

    def sample(self, interval: CoverInterval) -> int:
        """The position of the sample of an interval."""
        position = interval.known.position(self.stack)
        return self.moved(position)[0] if position % 2 else 2 * self.sectors.index(interval.known.value)
