"""The cells of one line, and what holds of them around its sample."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

from qe.exact.ring import Poly
from qe.kernel.arithmetic.products import Signs
from qe.kernel.line import Line, Sample
from qe.kernel.projection import RESULTANT, Factor, Projected, factors
from qe.proof.cells import Cell


@dataclass(frozen=True, slots=True)
class Part:
    """A cell on its line: the first and last position, that of the sample, its own factors, and those with a root at
    its ends (None: it has none there). ``is_point``: it is one point of the line."""

    cell: Cell
    first: int
    last: int
    at: int
    own: frozenset[int]
    is_point: bool
    low: frozenset[int] | None
    high: frozenset[int] | None


@dataclass(frozen=True, slots=True)
class Neighbourhood:
    """A line, found correct, and the signs that are known around its sample."""

    line: Line
    signs: Signs
    projection: Projected

    def parts(self) -> list[Part]:
        """The cells, each without a root of its own factors or at one, and with such roots at its ends."""
        return [self._part(cell, place) for place, cell in enumerate(self.line.stack.cells)]

    def _part(self, cell: Cell, place: int) -> Part:
        line, entry, end = self.line, f"cells[{place}]", len(self.line.signs) - 1
        sections, used = line.stack.sections, frozenset(line.stack.used)
        first, last, at = cell.reach or (place, place, place)
        if not first <= at <= last <= end or (cell.reach is None and len(line.stack.cells) != end + 1):
            raise line.fail("cells", f"{len(line.stack.cells)} cells where {end + 1} are needed")
        if cell.reach is None:
            own = used if place % 2 else used.intersection(line.branches)
        elif cell.own is not None and not self.projection.evaluates and line.branches.keys() >= {*cell.own}:
            own = frozenset(cell.own)
        elif cell.own is None and line.sample.is_alone:
            return Part(cell, first, last, at, used, True, None, None)
        else:
            raise line.fail(f"{entry}.own", "factors of the line expected: what holds around the sample is needed")
        if not self.projection.evaluates:
            own -= line.zero
        is_point = any(own.intersection(section) for section in sections[first // 2 : (last + 1) // 2])
        if is_point and first < last:
            raise line.fail(entry, "it contains a root of one of its factors")
        if not is_point and (first % 2 or last % 2):
            raise line.fail(entry, "a cell that is no root begins and ends with a sector")
        low = own.intersection(sections[(first - 1) // 2]) if first else None
        high = own.intersection(sections[last // 2]) if last < end else None
        if frozenset() in (low, high):
            raise line.fail(entry, "none of its factors has a root at its end")
        return Part(cell, first, last, at, own, is_point, low, high)

    def sample_of(self, part: Part) -> Sample | None:
        """The sample of a cell, where it is needed: for what stands above, or for signs of factors besides a
        constraint's, which are put in the row of its position."""
        others = part.own.difference(self.line.branches) if part.cell.reach is None else ()
        if part.cell.stack is None and not others:
            return None
        row, k = self.line.signs[part.at], self.line.sample.depth
        deeper = self.line.sample.extended(self.line.number(part.at), row, alone=part.is_point)
        for i in others:
            row[i] = deeper.point.sign(deeper.factor(k, i))
        return deeper

    def known(self, part: Part) -> frozenset[int]:
        """The factors of the level whose signs at the sample are those on the whole cell."""
        row, sample = self.line.signs[part.at], self.line.sample
        if part.is_point and sample.is_alone:
            return frozenset(range(len(row)))
        if part.cell.reach is None and not self.line.zero and len(part.own) == len(row):
            return part.own
        zero = (i for i in self.line.zero if self._stays_zero(i, part))
        return part.own | frozenset(zero)

    def _stays_zero(self, i: int, part: Part) -> bool:
        """Whether a factor that is zero on the line over the sample is zero on the whole cell, and its order known
        where that is needed."""
        sample, f = self.line.sample, self.projection.lists.lists[self.line.sample.depth][i]
        if self.projection.evaluates:
            return True
        if part.cell.stack is not None:
            return sample.is_alone and self._has_order(f, part, sample)
        products = [self.projection.lists.decompose(c) for c in f.coefficients(sample.depth) if c]
        return sample.is_alone or all(p is not None and self._missing(factors(p)) is None for p in products)

    def _has_order(self, f: Poly, part: Part, sample: Sample) -> bool:
        """Whether a partial derivative, of the least order of which one is not zero on the line, has its factors among
        the cell's own."""
        partials = [f]
        while all(map(sample.is_zero, partials)):
            self.projection.budget.check("verify")
            partials = list({g.derivative(i): None for g in partials for i in g.variables})
        products = [self.projection.lists.decompose(g) for g in partials if not sample.is_zero(g)]
        return any(p and all(i in part.own for k, i in factors(p) if k == sample.depth) for p in products)

    def _missing(self, needed: Iterable[Factor]) -> Factor | None:
        """A factor that is not known to be invariant around the sample."""
        for level, i in needed:
            if self.signs[level][i] is None and self.line.sample.dimensions[level + 1]:
                return level, i
        return None

    def check_delineated(self, parts: Sequence[Part]) -> None:
        """Everything that the own factors of the cells need is invariant around the sample."""
        for own, order in dict.fromkeys((part.own, part.cell.stack is not None) for part in parts):
            core = own.intersection(self.line.branches)
            missing = self._missing(self.projection.needed(self.line.sample.depth, own, core, order=order))
            if missing is not None:
                where = f"factor {missing[1]} of level {missing[0]}"
                raise self.line.fail("cells", f"{where}, of the projection, may change its sign or order")
            for i in own if order else core:
                self._check_not_nullified(i)

    def _check_not_nullified(self, i: int) -> None:
        """A factor is not zero on a whole line around the sample: a coefficient, or a combination of these, is not zero
        there, and invariant. On level 1 the leading coefficient is not, or the sample is alone."""
        sample = self.line.sample
        if self.projection.evaluates or sample.depth == 1:
            return
        for witness in self.projection.not_nullified(sample.depth, i):
            product = self.projection.lists.decompose(witness)
            if product is None:
                if not sample.dimensions[witness.level + 1] and sample.sign(witness):
                    return
            elif self._missing(factors(product)) is None and sample.sign_of(product):
                return
        raise self.line.fail("used", f"factor {i} may vanish identically at a point of the cell (Brown 2001)")

    def check_cover(self, parts: Sequence[Part]) -> None:
        """Each cell begins where the one before ends, or before that, also around the sample."""
        line = self.line
        if any(part.cell.reach is not None and part.cell.own is None for part in parts):
            raise line.fail("cells", "a cell covers its sample only, and what holds around that is needed")
        if not parts or parts[0].first or parts[-1].last < len(line.signs) - 1:
            raise line.fail("cells", "the line is not covered to its ends")
        for place, (one, other) in enumerate(pairwise(parts)):
            if other.first > one.last + 1:
                raise line.fail("cells", f"there is a gap before cell {place + 1}")
            if line.sample.is_alone or one.high is None or other.low is None or one.high & other.low:
                continue
            pairs = (sorted((i, j)) for i in one.high for j in other.low)
            products = [self.projection.product(RESULTANT, line.sample.depth, i, j) for i, j in pairs]
            if not any(p and p.unit and self._missing(factors(p)) is None for p in products):
                raise line.fail("cells", f"cell {place} and the next need not meet around the sample")
