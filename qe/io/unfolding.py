"""Comparisons with a greatest or least of several terms in a sum, unfolded: max(a, b) <= c says a <= c and b <= c.

THEOREM. Let c > 0. Then c*max(a_1, ..., a_n) + r <= 0 exactly if c*a_i + r <= 0 for all i, and >= 0 exactly if
c*a_i + r >= 0 for some i; likewise with < and >. For min, and for c < 0, "all" and "some" change places; abs(a) is
max(a, -a), and ``if p > 0 then a else b`` is max(a, b) where a - b is a positive multiple of p. PROOF. The maximum is
one of the a_i, and the others are not greater.

The terms a_i have values everywhere, as a maximum has none where one of them has none; r may have none. Otherwise in
place of every atom stands a case with a guard.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import reduce
from math import prod
from typing import TypeAlias

from qe.formula.build import conj, disj
from qe.formula.syntax import Formula, Relation
from qe.io import terms
from qe.io.sharing import chain
from qe.io.surface import Apply, Choice, Comparison, Minus, Product, Quotient, Sum, Term
from qe.io.terms import Value

With: TypeAlias = Callable[[Term], Term]
Unfolded: TypeAlias = tuple[Callable[[Iterable[Formula]], Formula], list[Term]]

MOST_TERMS = 64
"""Atoms of one comparison; with more its sides are valued by cases."""

ABOVE, BELOW = (Relation.GT, Relation.GE), (Relation.LT, Relation.LE)


@dataclass(frozen=True, slots=True)
class Sums:
    """Sums with such terms. ``known``: values of shared parts, which are taken as they are; ``value``: of any part."""

    known: Mapping[int, object]
    value: Callable[[Term], object]

    def unfolded(self, side: Term, relation: Relation) -> Unfolded | None:
        """Terms in place of a side of a comparison, and whether all or some are compared so; None without a part."""
        if relation in (Relation.EQ, Relation.NE) or not 1 < self.count(side) <= MOST_TERMS:
            return None
        if (place := self.first(side)) is None:
            return None
        rises, choices, within = place
        return conj if rises == (relation in BELOW) else disj, [within(choice) for choice in choices]

    def first(self, term: Term) -> tuple[bool, list[Term], With] | None:
        """Of the first such part in a sum: whether it is, with its sign, a maximum, of which terms, and the sum with
        another term in its place."""
        if id(term) in self.known:
            return None
        match term:
            case Apply() | Choice():
                return None if (known := self.extreme(term)) is None else (*known, lambda other: other)
            case Minus(part) if (place := self.first(part)) is not None:
                return not place[0], place[1], lambda other: Minus(place[2](other))
            case Sum(parts):
                places = [self.first(part) for part in parts]
                k = next((k for k, place in enumerate(places) if place is not None), len(places))
                if k < len(places) and (place := places[k]) is not None:
                    return *place[:2], lambda other: Sum([*parts[:k], place[2](other), *parts[k + 1 :]])
            case Product() | Quotient() if (scaled := self.scaled(term)) is not None:
                positive, part, product = scaled
                if (place := self.first(part)) is not None:
                    return place[0] == positive, place[1], lambda other: product(place[2](other))
        return None

    def count(self, term: Term) -> int:
        """How many terms come of a sum in the end, one within the other."""
        if id(term) in self.known:
            return 1
        match term:
            case Apply() | Choice() if (known := self.extreme(term)) is not None:
                return sum(map(self.count, known[1]))
            case Minus(part):
                return self.count(part)
            case Product() | Quotient() if (scaled := self.scaled(term)) is not None:
                return self.count(scaled[1])
            case Sum(parts):
                return prod(map(self.count, parts))
        return 1

    def extreme(self, term: Apply | Choice) -> tuple[bool, list[Term]] | None:
        """Whether it is a maximum or a minimum, and of which terms."""
        match term:
            case Apply("abs", [part]) if self.is_total(part):
                return True, [part, Minus(part)]
            case Apply("max" | "min", arguments) if all(map(self.is_total, arguments)):
                return term.function == "max", arguments
            case Choice(Comparison([left, right], [relation]), then, other) if not isinstance(other, Choice | None):
                values = [v for part in (left, right, then, other) if isinstance(v := self.value(part), Value)]
                if len(values) == 4 and relation in (*ABOVE, *BELOW):
                    p, gap = (terms.total([a, terms.negative(b)]).poly for a, b in (values[:2], values[2:]))
                    if p and gap and p.normal()[1] == gap.normal()[1]:
                        same = (p.normal()[0] > 0) == (gap.normal()[0] > 0)
                        return same == (relation in ABOVE), [then, other]
        return None

    def scaled(self, term: Product | Quotient) -> tuple[bool, Term, With] | None:
        """Of a product with one factor that is no number: whether the numbers are positive, the factor, and the product
        with another one in its place."""
        first, links = chain(term, self.known)
        factors = [first, *(link.right for link in links)]
        signs = list(map(self.sign, factors))
        others = [k for k, sign in enumerate(signs) if not sign]
        if len(others) != 1 or (others[0] and isinstance(links[others[0] - 1], Quotient)):
            return None

        def product(other: Term) -> Term:
            right = [other if k == others[0] else factor for k, factor in enumerate(factors)]
            return reduce(lambda left, k: links[k]._replace(left=left, right=right[k + 1]), range(len(links)), right[0])

        return prod(sign for sign in signs if sign) > 0, factors[others[0]], product

    def sign(self, term: Term) -> int:
        """The sign of a number; 0 of any other term, too."""
        value = self.value(term)
        number = value.poly.constant_value() if isinstance(value, Value) and value.poly.is_constant else 0
        return (number > 0) - (number < 0)

    def is_total(self, term: Term) -> bool:
        """Whether it is seen to have a value everywhere."""
        match term:
            case Apply() | Choice() if self.extreme(term) is not None:
                return True
            case Minus(part):
                return self.is_total(part)
            case Sum(parts):
                return all(map(self.is_total, parts))
        return isinstance(self.value(term), Value)
