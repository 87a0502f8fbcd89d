"""A formula without quantifiers as clauses over the signs of its polynomials, and back: what a model makes true.

Every polynomial has a literal for > 0, one for < 0 and one for = 0, tied together by clauses. Conjunctions and
disjunctions get literals of their own in one direction only, as the formula is in negation normal form (Plaisted,
Greenbaum 1986): a model of the clauses makes the formula true, and every model of the formula extends to one of them.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction
from itertools import chain, pairwise

from qe.elimination.search.linear_forms import over_monomials
from qe.exact.ring import Poly
from qe.formula.syntax import And, Atom, Constant, Formula, Or, Relation

Clause = list[int]


class Clauses:
    """The clauses of one formula; ``literal`` gives the number of an atom. ``orders``: the pairs of bounds of one
    linear form that the clauses exclude. ``needed``: the literals on which the truth of the formula rests; that others
    hold, or hold together, does not matter to it."""

    def __init__(self, formula: Formula) -> None:
        self.formula = formula
        self.clauses: list[Clause] = []
        self.orders: list[tuple[Atom, Atom]] = []
        self._signs: dict[Poly, tuple[int, int, int]] = {}
        self._nodes: dict[Formula, int] = {}
        self._count = 0
        self.needed: set[int] = set()
        self._assert(formula)
        self._order()

    @property
    def polys(self) -> Iterable[Poly]:
        """The polynomials that have literals."""
        return self._signs.keys()

    def literal(self, given: Atom) -> int:
        """The literal of an atom."""
        positive, negative, zero = self._of(given.poly)
        match given.relation:
            case Relation.GT:
                return positive
            case Relation.LE:
                return -positive
            case Relation.LT:
                return negative
            case Relation.GE:
                return -negative
            case Relation.EQ:
                return zero
        return -zero

    def inequalities(self) -> Iterator[tuple[int, Poly, Relation]]:
        """The literals that say p > 0, p <= 0, p < 0, p >= 0 of the polynomials."""
        for poly, (positive, negative, _) in self._signs.items():
            yield positive, poly, Relation.GT
            yield -positive, poly, Relation.LE
            yield negative, poly, Relation.LT
            yield -negative, poly, Relation.GE

    def triples(self) -> Iterable[tuple[int, int, int]]:
        """The literals for > 0, < 0 and = 0 of each polynomial."""
        return self._signs.values()

    def signs(self) -> Iterator[int]:
        """All of them."""
        return chain.from_iterable(self._signs.values())

    def says(self) -> dict[int, Atom]:
        """What the literals of signs say."""
        meanings = {literal: Atom(poly, relation) for literal, poly, relation in self.inequalities()}
        for poly, (_, _, zero) in self._signs.items():
            meanings[zero], meanings[-zero] = Atom(poly, Relation.EQ), Atom(poly, Relation.NE)
        return meanings

    def chosen(self, model: Iterable[int], sign: Callable[[Poly], int]) -> list[Atom]:
        """Atoms, true in the model, that make the formula true.

        Of several alternatives one that is chosen already, or holds where the polynomials have these signs. An
        inequation p /= 0 is chosen as p < 0 or p > 0 where p is linear.
        """
        true = set(model)
        known: dict[Formula, bool] = {}

        def holds(f: Formula) -> bool:
            value = known.get(f)
            if value is None:
                match f:
                    case Atom():
                        value = self.literal(f) in true
                    case And(args):
                        value = all(map(holds, args))
                    case Or(args):
                        value = any(map(holds, args))
                    case _:
                        value = f == Constant(True)
                known[f] = value
            return value

        taken: dict[Atom, None] = {}
        pending = [self.formula]
        while pending:
            match pending.pop():
                case Atom(poly, Relation.NE) if poly.total_degree == 1:
                    side = Relation.GT if self._of(poly)[0] in true else Relation.LT
                    taken[Atom(poly, side)] = None
                case Atom() as literal:
                    taken[literal] = None
                case And(args):
                    pending.extend(args)
                case Or(args):
                    alive = [a for a in args if holds(a)]
                    known_ones = (a for a in alive if a in taken)
                    near = (a for a in alive if isinstance(a, Atom) and a.relation.holds(sign(a.poly)))
                    pending.append(next(chain(known_ones, near, alive)))
        return list(taken)

    # --- building --------------------------------------------------------------------------------------
    def _new(self) -> int:
        self._count += 1
        return self._count

    def _of(self, poly: Poly) -> tuple[int, int, int]:
        found = self._signs.get(poly)
        if found is None:
            found = positive, negative, zero = self._new(), self._new(), self._new()
            self.clauses += [[-positive, -negative], [-zero, -positive], [-zero, -negative]]
            if poly.total_degree == 1:
                self.clauses.append([positive, negative, zero])
            self._signs[poly] = found
        return found

    def _assert(self, formula: Formula) -> None:
        match formula:
            case And(args):
                for arg in args:
                    self._assert(arg)
            case Or(args):
                self.clauses.append([self._named(arg) for arg in args])
            case Constant(value):
                self.clauses += [] if value else [[]]
            case _:
                self.clauses.append([self._named(formula)])

    def _named(self, formula: Formula) -> int:
        """A literal that implies the formula."""
        if isinstance(formula, Atom):
            self._need(formula)
            return self.literal(formula)
        found = self._nodes.get(formula)
        if found is None:
            found = self._nodes[formula] = self._new()
            match formula:
                case And(args):
                    self.clauses += [[-found, self._named(arg)] for arg in args]
                case Or(args):
                    self.clauses.append([-found, *(self._named(arg) for arg in args)])
                case _:
                    raise AssertionError(f"not in negation normal form: {formula}")
        return found

    def _need(self, given: Atom) -> None:
        """What says an atom to the theories: of equations and inequations the inequalities that they are made of."""
        positive, negative, _ = self._of(given.poly)
        match given.relation:
            case Relation.EQ:
                self.needed.update((-positive, -negative))
            case Relation.NE:
                self.needed.update((positive, negative))
            case _:
                self.needed.add(self.literal(given))

    def _order(self) -> None:
        """What bounds of one linear form say about each other: form > 3 implies form > 2."""
        bounds: defaultdict[object, list[tuple[Fraction, Poly, bool]]] = defaultdict(list)
        for poly in self._signs:
            form = over_monomials(poly)
            bounds[form.direction].append((form.bound, poly, form.scale > 0))
        for same in bounds.values():
            for lower, higher in pairwise(sorted(same, key=lambda bound: bound[0])):
                self.orders += _excluded(lower[1:], higher[1:])
        self.clauses += [[-self.literal(a), -self.literal(b)] for a, b in self.orders]


def _excluded(lower: tuple[Poly, bool], higher: tuple[Poly, bool]) -> Iterator[tuple[Atom, Atom]]:
    """What cannot hold of two bounds of one form, the lower one first: form <= 2 with form >= 3, and so on."""

    def compared(side: tuple[Poly, bool], relation: Relation) -> Atom:
        return Atom(side[0], relation if side[1] else relation.flipped)

    yield compared(lower, Relation.LE), compared(higher, Relation.GT)
    yield compared(lower, Relation.LT), compared(higher, Relation.GE)
    yield compared(lower, Relation.LE), compared(higher, Relation.GE)
