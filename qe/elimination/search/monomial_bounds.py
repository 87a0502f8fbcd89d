"""Atoms as linear bounds of their monomials: whether these can hold together.

A monomial counts as a variable of its own, at least 0 if it is a square; so atoms whose bounds contradict each other
cannot hold together at any point.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from fractions import Fraction

from qe.elimination.search.linear_forms import FormBounds, LinearForm, Monomial, over_monomials
from qe.exact.ring import Poly, Ring
from qe.formula.syntax import Atom, Relation

_UP = (Relation.GT, Relation.GE, Relation.EQ)
_DOWN = (Relation.LT, Relation.LE, Relation.EQ)


class MonomialBounds:
    """Asked about one conjunction after another over one ring; what the simplex method has learnt is kept."""

    def __init__(self, ring: Ring) -> None:
        self.ring = ring
        self.bounds = FormBounds()
        self.forms_of: dict[Poly, LinearForm] = {}
        self.known: dict[Atom, tuple[int, Fraction, Relation] | None] = {}
        self.offered: defaultdict[int, list[tuple[Fraction, Poly, bool]]] = defaultdict(list)

    def offer(self, polys: Iterable[Poly]) -> None:
        """Bounds by these polynomials may stand in reasons (``weakened``)."""
        for poly in polys:
            form = self.forms_of[poly] = over_monomials(poly)
            self.offered[self.bounds.of(form.direction)].append((form.bound, poly, form.scale > 0))
        for bounds in self.offered.values():
            bounds.sort(key=lambda bound: bound[0])

    def weakened(self) -> list[Atom]:
        """Atoms that contradict each other as those do that ``conflict`` found last, as weak as those offered can be:
        x <= 3 for x = 0 where that is enough. They follow from these one by one."""
        return [reason for reason in self.bounds.weakened(self._offered) if isinstance(reason, Atom)]

    def _offered(self, x: int, above: bool) -> Iterator[tuple[Fraction, bool, Hashable]]:
        """The bounds of a variable, the weakest first."""
        ordered = self.offered[x]
        for bound, poly, positive in reversed(ordered) if above else ordered:
            for relation in (Relation.LE, Relation.LT):
                yield bound, relation.is_strict, Atom(poly, relation if positive == above else relation.flipped)

    def conflict(self, atoms: Iterable[Atom], check: Callable[[], object]) -> set[Hashable] | None:
        """Atoms whose linear bounds contradict each other, with None where squares take part; or None."""
        self.bounds.clear()
        self.bounds.bound_squares()
        for given in atoms:
            check()
            found = self._bound(given)
            if found is None:
                continue
            x, bound, relation = found
            strict = relation.is_strict
            conflict: set[Hashable] | None = None
            if relation in _UP:
                conflict = self.bounds.at_least(x, bound, strict=strict, reason=given)
            if relation in _DOWN and conflict is None:
                conflict = self.bounds.at_most(x, bound, strict=strict, reason=given)
            if conflict is not None:
                return conflict
        return self.bounds.conflict(check)

    def start(self, values: Mapping[Monomial, Fraction]) -> None:
        """Look for the next point from here."""
        self.bounds.clear()
        for monomial, value in values.items():
            self.bounds.start(self.bounds.monomial(monomial), value)

    def point(self) -> dict[str, Fraction]:
        """Values of the variables, after ``conflict`` found none: those that they have as monomials."""
        point = dict.fromkeys(self.ring.names, Fraction(0))
        for monomial, value in self.bounds.values_of_monomials().items():
            if sum(power for _, power in monomial) == 1:
                point[self.ring.names[monomial[0][0]]] = value
        return point

    def sign(self, poly: Poly) -> int:
        """The sign of a polynomial where the monomials have the values that the last question left."""
        form = self.forms_of.get(poly)
        if form is None:
            form = self.forms_of[poly] = over_monomials(poly)
        side = self.bounds.side(self.bounds.of(form.direction), form.bound)
        return side if form.scale > 0 else -side

    def _bound(self, given: Atom) -> tuple[int, Fraction, Relation] | None:
        """The variable that an atom bounds, and how; None for p /= 0."""
        if given not in self.known:
            found = None
            if given.relation is not Relation.NE:
                form = over_monomials(given.poly)
                relation = given.relation if form.scale > 0 else given.relation.flipped
                found = self.bounds.of(form.direction), form.bound, relation
            self.known[given] = found
        return self.known[given]
