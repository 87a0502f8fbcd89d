"""Bounds of linear forms as theories for the SAT solver: differences of two variables by shortest paths, others by the
simplex method. A monomial counts as a variable of its own, as in ``monomial_bounds``.
"""

from __future__ import annotations

from bisect import bisect_left
from collections import defaultdict
from collections.abc import Callable, Hashable, Iterable, Iterator
from fractions import Fraction
from functools import partial
from importlib.util import find_spec
from math import lcm
from typing import NamedTuple

from qe.elimination.search.linear_forms import Direction, FormBounds, Monomial, over_monomials
from qe.elimination.search.proposed_bounds import ProposedBounds
from qe.exact.linear_bounds import Value
from qe.exact.ring import Poly
from qe.formula.syntax import Relation

MOST_VERTICES = 300
"""More variables are left to the simplex method: all paths between them are too many."""


class Said(NamedTuple):
    """What a literal says: the form ``direction`` is at most (``upper``) or at least ``bound``, or beyond it."""

    literal: int
    direction: Direction
    bound: Fraction
    upper: bool
    strict: bool

    def holds(self, side: int) -> bool:
        """Whether it holds where the form lies on this side of the bound (its sign)."""
        return (side == 0 and not self.strict) or (side != 0 and (side < 0) == self.upper)


def said(bounds: Iterable[tuple[int, Poly, Relation]]) -> Iterator[Said]:
    """What the literals of inequalities say."""
    last: Poly | None = None
    for literal, poly, relation in bounds:
        if poly is not last:
            last, form = poly, over_monomials(poly)
        upper = (relation in (Relation.LE, Relation.LT)) == (form.scale > 0)
        yield Said(literal, form.direction, form.bound, upper, relation.is_strict)


def difference(direction: Direction) -> tuple[Monomial, Monomial | None] | None:
    """(x, y) of a form x - y, (x, None) of x; None for any other."""
    match direction:
        case ((x, _),):
            return x, None
        case ((x, 1), (y, -1)):
            return x, y
    return None


class Differences:
    """Bounds of variables and of differences of two."""

    @staticmethod
    def suit(bounds: Iterable[Said]) -> bool:
        """Whether there are differences, not too many variables in them, and arrays for their paths."""
        pairs = [pair for one in bounds if (pair := difference(one.direction)) is not None]
        return 0 < len({m for pair in pairs for m in pair}) <= MOST_VERTICES and find_spec("numpy") is not None

    def __init__(self, bounds: Iterable[Said]) -> None:
        from qe.exact.difference_graph import DifferenceGraph  # and numpy

        vertices: dict[Monomial | None, int] = {None: 0}
        ends: list[tuple[Said, int, int]] = []
        for one in bounds:
            pair = difference(one.direction)
            if pair is not None:
                x, y = (vertices.setdefault(m, len(vertices)) for m in pair)
                ends.append((one, *((y, x) if one.upper else (x, y))))
        # a cycle has fewer edges than that: strict bounds are weak ones moved by one part of it
        size = len(vertices) + 1
        scale = size * lcm(*(one.bound.denominator for one, _, _ in ends))
        self.vertices, self.scale = vertices, scale
        self.edges: dict[int, tuple[int, int, int]] = {}
        self.watched: defaultdict[tuple[int, int], list[tuple[int, int]]] = defaultdict(list)
        for one, u, v in ends:
            length = int((one.bound if one.upper else -one.bound) * scale) - one.strict
            self.edges[one.literal] = u, v, length
            self.watched[u, v].append((length, one.literal))
        for listed in self.watched.values():
            listed.sort()
        self.graph = DifferenceGraph(len(vertices), 1 + sum(abs(w) for _, _, w in self.edges.values()))
        self.is_watched = self.graph.length < 0  # none so far
        self.is_watched[tuple(zip(*self.watched))] = True
        self.nearer: list[tuple[int, int, int]] = []

    def tell(self, literal: int) -> list[int] | None:
        """A literal is true: literals that cannot hold together, or None."""
        edge = self.edges.get(literal)
        if edge is None:
            return None
        found = self.graph.add(*edge, literal)
        if isinstance(found, list):
            return _literals(found)
        if found is not None:
            known = self.is_watched[found.starts, found.ends]
            columns = (found.starts[known], found.ends[known], found.lengths[known])
            self.nearer += zip(*(column.tolist() for column in columns))
        return None

    def settle(self) -> list[int] | None:
        """The same for all that were told so far."""
        return None

    def implied(self) -> Iterator[tuple[int, Callable[[], list[int]]]]:
        """Literals that follow from those told since the last call, each with those from which it does."""
        edges = len(self.graph.edges)
        for u, v, before in self.nearer:
            listed, now = self.watched[u, v], int(self.graph.length[u, v])
            for length, literal in listed[bisect_left(listed, (now, 0)) :]:
                if length >= before:
                    break
                yield literal, partial(self._reasons, u, v, edges)
        self.nearer.clear()

    def _reasons(self, u: int, v: int, edges: int) -> list[int]:
        return _literals(self.graph.reasons(u, v, edges))

    def mark(self) -> int:
        """The present state, for ``back``."""
        return len(self.graph.edges)

    def back(self, mark: int) -> None:
        self.nearer.clear()
        self.graph.keep(mark)

    def point(self) -> dict[Monomial, Fraction]:
        """Values that keep all bounds."""
        values = self.graph.potentials()
        return {m: Fraction(values[x] - values[0], self.scale) for m, x in self.vertices.items() if m is not None}


class Forms:
    """Bounds of all linear forms, by the exact simplex method if nothing else is asked for."""

    def __init__(
        self,
        bounds: Iterable[Said],
        check: Callable[[], object] = lambda: None,
        by: FormBounds | ProposedBounds | None = None,
    ) -> None:
        self.bounds, self.check = FormBounds() if by is None else by, check
        self.said: dict[int, tuple[int, Said]] = {}
        self.offered: defaultdict[int, list[Said]] = defaultdict(list)
        for one in bounds:
            x = self.bounds.of(one.direction)
            self.said[one.literal] = x, one
            self.offered[x].append(one)
        for listed in self.offered.values():
            listed.sort(key=lambda one: (one.bound, one.strict))
        self.changed = False
        self._seen: list[Value] = []
        if isinstance(self.bounds, ProposedBounds):
            self.bounds.offer((i, x, one.bound, one.upper, one.strict) for i, (x, one) in self.said.items())

    def tell(self, literal: int) -> list[int] | None:
        if literal not in self.said:
            return None
        x, one = self.said[literal]
        set_bound = self.bounds.at_most if one.upper else self.bounds.at_least
        self.changed = True
        conflict = set_bound(x, one.bound, strict=one.strict, reason=literal)
        return None if conflict is None else _literals(conflict)

    def settle(self, *, now: bool = False) -> list[int] | None:
        if not self.changed and not now:
            return None
        self.changed = False
        conflict = self.bounds.conflict(self.check, now=now)
        return None if conflict is None else _literals(self.bounds.weakened(self._offered))

    def implied(self) -> Iterator[tuple[int, Callable[[], list[int]]]]:
        return iter(())

    def mark(self) -> int:
        return self.bounds.mark()

    def back(self, mark: int) -> None:
        self.bounds.back(mark)

    def point(self) -> dict[Monomial, Fraction]:
        """Values that keep all bounds."""
        return self.bounds.values_of_monomials()

    def changes(self) -> list[int]:
        """The literals that hold at the present point, of those forms that have moved since the last call."""
        if isinstance(self.bounds, ProposedBounds):
            return self.bounds.changes()
        values, before = self.bounds.values, self._seen
        if values == before:
            return []
        self._seen = list(values)
        moved = [x for x, value in enumerate(values) if x >= len(before) or value != before[x]]
        listed = ((x, one) for x in moved for one in self.offered.get(x, ()))
        return [one.literal for x, one in listed if one.holds(self.bounds.side(x, one.bound))]

    def holds(self, literal: int) -> bool:
        """Whether a literal holds at the present point."""
        x, one = self.said[literal]
        return one.holds(self.bounds.side(x, one.bound))

    def _offered(self, x: int, above: bool) -> Iterator[tuple[Fraction, bool, Hashable]]:
        """The bounds of a variable, the weakest first."""
        for one in reversed(self.offered[x]) if above else self.offered[x]:
            if one.upper == above:
                yield one.bound, one.strict, one.literal


def _literals(reasons: Iterable[Hashable]) -> list[int]:
    """Those of the reasons that are literals: what holds of squares in any case is none."""
    return [r for r in reasons if isinstance(r, int)]
