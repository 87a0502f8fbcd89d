"""The connected components of sets in space, exactly.

THEOREM. Let p be the sample of a cell B of the plane that lies in the closure of a cell A of it, and let no factor of
the third variable be zero on the whole line over p. Over A its roots are continuous functions that never meet; over
points of A near p, each lies near a root over p or is as large as one likes (roots depend continuously on
coefficients). Small boxes around p meet A in connected sets: a band between two functions on an interval, which have
limits at its end (``qe.regions.planar``), or its graph, or its side. So each root has one limit at p, finite or not. It
is the root r over p for which s < r < t, if s, t are numbers between the roots over p such that no factor is zero at
heights s and t over a connected set that joins p with a point q of A within A, and over q the root lies between them.
The limits vary continuously with p in B, along which the roots over B are functions, too: what holds at p holds on B.
So the closure of a cell over A contains or misses every cell over B, and the components are found as in the plane.

Where a factor is zero on a whole line over a point (finitely many: its coefficients have no common factor), the closure
over that line is left open. If any cells may meet there, and the number of components hangs on it, other orders of the
variables are tried, and coordinates x - a*z, y - b*z in which all polynomials have constant leading coefficients in z:
over these no factor is zero on a line. Components are the same in all of these.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from functools import partial
from itertools import pairwise, product

from qe.decomposition.decompose import decompose
from qe.decomposition.formulas import construct
from qe.decomposition.interval import Number
from qe.decomposition.sampled_cells import child, rational, root_place
from qe.errors import InternalError, Unable
from qe.exact.fibre_stack import isolate_over
from qe.exact.nearby import enclosure, without_zeros
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.formula.build import atom, convert
from qe.formula.syntax import Atomic, Formula
from qe.formula.traverse import map_atoms, polynomials
from qe.options import Budget
from qe.proof.cells import CellTable
from qe.regions.planar import WHOLE, Place, connected_parts, ends_of, frontiers, marked, nearer, stack_at, truths

DIMENSIONS = 3
_FIRST_BITS = 3

Side = tuple[Fraction, Fraction]
"""An interval with both ends."""


@dataclass(frozen=True, slots=True)
class Way:
    """A connected set, within a box with these ``sides``, that joins the sample of a cell with a point of another."""

    sides: tuple[Side, Side]
    end: Point


@dataclass(slots=True)
class Space:
    """The cells of a full decomposition for three variables."""

    table: CellTable
    budget: Budget
    truth: dict[Place, bool] = field(default_factory=dict)
    _samples: dict[Place, Point] = field(default_factory=dict)
    _at_heights: dict[Place, list[Poly]] = field(default_factory=dict)

    @staticmethod
    def of(formula: Formula, order: tuple[str, ...], budget: Budget, levels: frozenset[int] = frozenset()) -> Space:
        """The cells for a quantifier-free formula. Raises ``BudgetExceeded``."""
        extra: tuple[Poly, ...] = ()
        while True:
            table = decompose(
                formula, order, ("",) * 3, budget=budget, thom_levels=levels, tactics=WHOLE, extra=extra
            ).table
            lacking = _lacking(table)
            if not lacking:
                return Space(table, budget, dict(truths(table.root, (), 3)))
            extra += lacking

    def components(self) -> list[frozenset[Place]] | None:
        """The cells of each component, by their first cells; None where lines on which factors vanish leave it open."""
        own = frozenset(place for place, truth in self.truth.items() if truth)
        over: dict[Place, list[int]] = {}
        for *base, height in sorted(own):
            over.setdefault(tuple(base), []).append(height)
        pairs = {
            ((*base, low), (*base, high))
            for base, heights in over.items()
            for low, high in pairwise(heights)
            if high == low + 1
        }
        parts = connected_parts(own, pairs)
        unclear: list[tuple[set[Place], set[Place]]] = []
        closures = frontiers(self.table, 2, self.budget)
        # cells with cells of the set over them, the first in the closure of the second; simple samples first
        touching = [(near, cell) for cell in over for near in closures[cell] if near in over]
        for near, cell in sorted(touching, key=lambda pair: (sum(k % 2 for k in pair[0]), pair)):
            ours = {(*base, t) for base in (near, cell) for t in over[base]}
            if sum(not part.isdisjoint(ours) for part in parts) == 1:
                continue
            self.budget.check("adjacent cells", len(pairs))
            if self._is_special(near):
                unclear.append(({p for p in ours if p[:2] == near}, {p for p in ours if p[:2] == cell}))
                continue
            pairs |= set(self._meeting(near, cell, over))
            parts = connected_parts(own, pairs)
        open_questions = {(p, q) for left, right in unclear for p in left for q in right}
        return parts if len(connected_parts(own, pairs | open_questions)) == len(parts) else None

    def _meeting(self, near: Place, cell: Place, over: dict[Place, list[int]]) -> Iterator[tuple[Place, Place]]:
        """The cells of the set over ``near`` in the closures of those over ``cell``."""
        limits = self._limits(near, cell)
        last = 2 * len(stack_at(self.table, near).sections)
        for t in over[cell]:
            low, high = (limits[t // 2],) * 2 if t % 2 else ends_of(limits, t // 2, last)
            yield from (((*near, u), (*cell, t)) for u in over[near] if low <= u <= high)

    def _limits(self, near: Place, cell: Place) -> list[int]:
        """Where the roots over ``cell`` end over ``near``: positions there, -1 and 2m+1 for no finite limit."""
        barriers = self._barriers(near)
        bits = _FIRST_BITS
        while True:
            self.budget.check("a way between cells", bits)
            way = (self._upright if near[0] == cell[0] else self._sideways)(near, cell, bits)
            if without_zeros(barriers, way.sides, bits + 64):
                break
            bits *= 2
        stack = isolate_over(way.end, self.table.factors[2])
        if len(stack.sections) != len(stack_at(self.table, cell).sections):
            raise InternalError("two points of a cell have different numbers of roots above them")
        below = [stack.place_of(s)[0] for s in stack_at(self.table, near).sectors]
        return [2 * sum(count <= k for count in below) - 1 for k in range(len(stack.sections))]

    def _barriers(self, near: Place) -> list[Poly]:
        """The factors at the heights of the rational samples over a cell."""
        stored = self._at_heights.get(near)
        if stored is None:
            heights = stack_at(self.table, near).sectors
            stored = self._at_heights[near] = [f.at_rational(2, s) for s in heights for f in self.table.factors[2]]
        return stored

    def _upright(self, near: Place, cell: Place, bits: int) -> Way:
        """Along the line through the sample of a section, up or down into the sector next to it."""
        point = self._sample(near)
        low, high = self._around(near, bits)
        y = high if cell[1] > near[1] else low
        end = point.ancestor(1).extend(rational(y))
        return Way((enclosure(point, 0, bits + 64), (low, high)), end)

    def _sideways(self, near: Place, cell: Place, bits: int) -> Way:
        """Away from the line over a root of the first variable, at heights around the sample on that line."""
        point = self._sample(near)
        start = point.number(0)
        low, high = self._around(near, bits) if near[1] % 2 else (point.number(1),) * 2
        assert isinstance(low, Fraction) and isinstance(high, Fraction)
        factors, ring = self.table.factors[1], Ring.of(self.table.order)
        crossed = [f.at_rational(1, y) for f in factors for y in {low, high}]
        x = nearer(start, self._beyond(near, cell, start, bits), crossed)
        line = Point(ring).extend(rational(x))
        left, right = enclosure(point, 0, bits + 64)
        return Way(((min(left, x), max(right, x)), (low, high)), self._within(cell, line, low, high))

    def _within(self, cell: Place, line: Point, low: Fraction, high: Fraction) -> Point:
        """The point of a cell of the plane on a line, at a height between two numbers (or at both, if equal)."""
        if low == high:
            return line.extend(rational(low))
        factors, y = self.table.factors[1], line.ring.gen(1)
        cuts = tuple(y * q.denominator - q.numerator for q in (low, high))
        stack = isolate_over(line, (*factors, *cuts))
        below = 0
        for position, signs in enumerate(stack.sign_maps()):
            root = position % 2 == 1 and any(j < len(factors) for j in stack.sections[position // 2].members)
            if signs[cuts[0]] > 0 > signs[cuts[1]] and 2 * below + root == cell[1]:
                return stack.sample(position)
            below += root
        raise InternalError("a cell does not go on to the sample in its closure")

    def _around(self, near: Place, bits: int) -> tuple[Fraction, Fraction]:
        """Rational numbers below and above the second coordinate of a section's sample, no other section between."""
        point, sectors = self._sample(near), stack_at(self.table, near[:1]).sectors
        (low, high), half = enclosure(point, 1, bits + 64), Fraction(1, 2**bits)
        below, above = near[1] // 2, near[1] // 2 + 1
        return max(low - half, sectors[below]), min(high + half, sectors[above])

    def _beyond(self, near: Place, cell: Place, start: Number, bits: int) -> Fraction:
        """A rational number on the way from a root of the first variable into the interval beside it."""
        farthest = stack_at(self.table, ()).sectors[cell[0] // 2]
        (low, high), half = enclosure(self._sample(near), 0, bits + 64), Fraction(1, 2**bits)
        return min(farthest, high + half) if start < farthest else max(farthest, low - half)

    def _sample(self, place: Place) -> Point:
        """The sample point of a cell of the line or the plane."""
        if place not in self._samples:
            node = root_place(self.table)
            for position in place:
                node = child(self.table, node, position)
            self._samples[place] = node.point
        return self._samples[place]

    def _is_special(self, near: Place) -> bool:
        """Whether a factor is zero on the whole line over a cell of the plane."""
        if not all(k % 2 for k in near):
            return False
        point = self._sample(near)
        return any(not any(point.sign(c) for c in f.coefficients(2)) for f in self.table.factors[2])


def _lacking(table: CellTable) -> tuple[Poly, ...]:
    """Coefficients whose common zeros need not be cells of their own (the projection of Lazard leaves some out)."""
    known = {f for level in table.factors for f in level}
    lacking: dict[Poly, None] = {}
    for f in table.factors[2]:
        coefficients = [c for c in f.coefficients(2) if c]
        if not any(c.is_constant for c in coefficients):
            lacking |= {c: None for c in coefficients if any(g not in known for g, _ in c.factors()[1])}
    return tuple(lacking)


# --- formulas of the components ------------------------------------------------------------------------------------
def components(formula: Formula, order: tuple[str, ...], budget: Budget) -> list[Formula]:
    """Formulas of the connected components of a set in space, by their first cells in coordinates that settle it.

    Raises ``Unable`` where none do, ``BudgetExceeded``.
    """
    for chosen in coordinates(formula, order):
        given = chosen.of(formula)
        space = Space.of(given, chosen.order, budget)
        parts = space.components()
        if parts is not None and len(parts) < 2:
            return [formula] * len(parts)
        if parts is not None:
            return [chosen.of(f, -1) for f in _written(given, chosen.order, space, budget)]
    raise Unable("it stays open which cells meet over lines on which polynomials are zero")


def _written(formula: Formula, order: tuple[str, ...], space: Space, budget: Budget) -> Iterator[Formula]:
    """The formulas of components; a finer decomposition has the same ones in the same order."""
    known: dict[frozenset[int], Space] = {frozenset(): space}

    def table(k: int, levels: frozenset[int]) -> CellTable:
        if levels not in known:
            known[levels] = Space.of(formula, order, budget, levels)
        parts = known[levels].components()
        if parts is None:
            raise Unable("it stays open which cells meet over lines on which derivatives are zero")
        return marked(known[levels].table, parts[k])

    for k in range(len(space.components() or ())):
        yield construct(table(k, frozenset()), partial(table, k))[0]


# --- coordinates -------------------------------------------------------------------------------------------------
@dataclass(frozen=True, slots=True)
class Coordinates:
    """The variables in an ``order``; the first two with ``slant`` times the third added."""

    order: tuple[str, ...]
    slant: tuple[int, int] = (0, 0)

    def of(self, formula: Formula, sign: int = 1) -> Formula:
        """The formula in these coordinates (with sign -1: back from them)."""
        if not any(self.slant):
            return formula
        ring = Ring.of(self.order)
        z = ring.gen(2)
        moved = {i: ring.gen(i) + z * (sign * slope) for i, slope in enumerate(self.slant)}

        def change(atomic: Atomic) -> Formula:
            return atom(atomic.poly.compose(moved), atomic.relation)

        return map_atoms(convert(formula, ring), change)


def coordinates(formula: Formula, order: tuple[str, ...]) -> Iterator[Coordinates]:
    """Coordinates to try, one after the other."""
    for k in range(DIMENSIONS):
        yield Coordinates((*order[k:], *order[:k]))
    polys = polynomials(convert(formula, Ring.of(order)))
    forms = [p.ring.from_terms({e: c for e, c in p.terms() if sum(e) == p.total_degree}) for p in polys]  # leading ones
    for size in range(1, 2 + sum(form.total_degree for form in forms)):
        for a, b in product(range(size + 1), repeat=2):
            if max(a, b) == size and all(form.evaluate((a, b, 1)) for form in forms):
                yield Coordinates(order, (a, b))
                return
