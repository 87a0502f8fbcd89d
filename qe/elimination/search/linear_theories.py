"""Bounds of linear forms as the theory of the SAT solver. A monomial counts as a variable of its own, as in
``monomial_bounds``.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Hashable, Iterable, Iterator
from fractions import Fraction
from typing import NamedTuple

from qe.elimination.search.linear_forms import Direction, FormBounds, Monomial, over_monomials
from qe.elimination.search.proposed_bounds import ProposedBounds
from qe.exact.linear_bounds import Value
from qe.exact.ring import Poly
from qe.formula.syntax import Relation


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
