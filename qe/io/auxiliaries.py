"""The names of auxiliary values in one formula, and comparisons that are freed of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import combinations, product
from math import prod
from typing import TypeAlias

from qe.exact.ring import Ring
from qe.formula.build import atom, conj, disj, implies
from qe.formula.syntax import TRUE, Formula, Relation
from qe.io import cases, terms
from qe.io.cases import Case, Cases
from qe.io.radicals import Auxiliary, Place, settled
from qe.io.terms import Value
from qe.io.total import Fill, Total

Meaning: TypeAlias = Value | Cases

MOST_CASES = 64
"""Combinations of cases in one comparison; beyond them a term with cases gets a name."""


class Exhausted(Exception):
    """There are not enough names for auxiliary values."""


class Auxiliaries:
    """Values behind the names ``extra`` of a ring.

    ``made``: the auxiliary values, in the order of their definitions (None: an unknown, which stays a variable).
    ``loose``: whether some of them stand for any value.
    """

    def __init__(self, ring: Ring, extra: Sequence[str], total: Total | None) -> None:
        self.ring, self.extra, self.total = ring, extra, total
        self.made: dict[str, Auxiliary | None] = {}
        self.known: dict[object, str] = {}
        self.unknowns: dict[str, tuple[str, list[Case]]] = {}
        self.loose = False
        if total is not None:
            total.begin()

    def named(self, key: object, make: Callable[[str], Auxiliary | None]) -> str:
        """The auxiliary name for what ``key`` describes."""
        name = self.known.get(key)
        if name is None:
            if len(self.made) == len(self.extra):
                raise Exhausted
            name = self.extra[len(self.made)]
            made = make(name)
            self.known[key], self.made[name] = name, made
        return name

    def few(self, *operands: Meaning) -> list[Cases]:
        """The operands, those with cases behind names where their combinations would be too many."""
        listed = [self.listed(operand) for operand in operands]
        if prod(map(len, listed)) <= MOST_CASES:
            return listed
        return [self.behind_name(operand) if len(operand) > 1 else operand for operand in listed]

    def behind_name(self, value: Cases) -> Cases:
        def made(name: str) -> Auxiliary:
            s = cases.plain(terms.variable(self.ring, name))
            meant = [self.settled(case, Relation.EQ, Place()) for case in cases.difference(s, value)]
            return Auxiliary(name, disj(meant), self.defined(value, Place()))

        name = self.named(("cases", value), made)
        auxiliary = self.made[name]
        assert auxiliary is not None
        return cases.guarded((auxiliary.defined,), Case((), terms.variable(self.ring, name)))

    def outside(self, function: str, argument: Case) -> Cases:
        """The value of a function at an argument outside its domain, where functions are total."""
        assert self.total is not None
        if self.total.fill is Fill.ARGUMENT:
            return (argument,)
        if self.total.fill is Fill.CONSTANT:
            name = self.named(("outside", function), lambda _: None)
            self.total.values[name] = (function, ())
            return cases.guarded(argument.guards, Case((), terms.variable(self.ring, name)))
        bare = argument._replace(guards=())
        loose = not self.total.bound.isdisjoint(self.names_in(bare))

        def made(name: str) -> Auxiliary | None:
            return Auxiliary(name, TRUE, TRUE, loose=True) if loose else None

        name = self.named(("outside", function, bare), made)
        if loose:
            self.loose = self.total.weakened = True
        else:
            arguments = self.unknowns.setdefault(name, (function, []))[1]
            arguments += [argument] if argument not in arguments else []
            self.total.values[name] = (function, tuple(arguments))
        return cases.guarded(argument.guards, Case((), terms.variable(self.ring, name)))

    def names_in(self, case: Case) -> set[str]:
        """The variables that a term depends on."""
        dependencies: set[str] = set()
        pending = [case.value.poly, *(factor for factor, _ in case.below)]
        names = {self.ring.names[i] for poly in pending for i in poly.variables}
        while names:
            name = names.pop()
            dependencies.add(name)
            if (auxiliary := self.made.get(name)) is not None:
                names.update(set(auxiliary.definition.free) - dependencies)
        return dependencies

    def agreements(self) -> list[Formula]:
        """Equal arguments outside a domain have equal values."""
        agreements = []
        for (a, (f, left)), (b, (g, right)) in combinations(self.unknowns.items(), 2):
            if f == g:
                same = atom(self.ring.var(a) - self.ring.var(b), Relation.EQ)
                for one, other in product(left, right):
                    equal = self.compared((one,), Relation.EQ, (other,), Place().denied)
                    agreements.append(implies(equal, same))
        return agreements

    # --- comparisons -----------------------------------------------------------------------------------------
    def compared(self, left: Cases, relation: Relation, right: Cases, place: Place) -> Formula:
        """``left relation right``, freed of auxiliary names."""
        few = self.few(left, right)
        return disj([self.settled(case, relation, place) for case in cases.difference(*few)])

    def defined(self, value: Cases, place: Place) -> Formula:
        """Where a term has a value."""
        return disj([self.free_of_names(conj(case.guards), place) for case in value])

    def settled(self, case: Case, relation: Relation, place: Place) -> Formula:
        return self.free_of_names(cases.holds(case, relation), place)

    def free_of_names(self, formula: Formula, place: Place) -> Formula:
        return settled(formula, {n: a for n, a in self.made.items() if a is not None}, place)

    def simple(self, value: Cases) -> Meaning:
        """A polynomial without auxiliary names where one case without guards is all."""
        if len(value) == 1 and not value[0].guards and not value[0].below:
            poly = value[0].value.poly
            if not any(name in self.made for name in map(self.ring.names.__getitem__, poly.variables)):
                return value[0].value
        return value

    def listed(self, value: Meaning) -> Cases:
        return cases.plain(value) if isinstance(value, Value) else value
