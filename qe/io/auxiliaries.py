"""The names of auxiliary values in one formula, and comparisons that are freed of them.

Values that are no quotients of polynomials (roots, and terms with many cases) have a name of their own, and a
comparison that uses it is freed of it at once. A square root is substituted: with s = sqrt(t) and t >= 0 every
polynomial in s is a + b*s, and the sign of that is known from the signs of a, b and a^2 - b^2*t (V. Weispfenning,
Quantifier elimination for real algebra: the quadratic case and beyond, AAECC 8, 1997). Any other value s is bound by a
quantifier: as exactly one s fits its definition where it has a value at all, ``ex s. definition and F`` and
``all s. definition -> F`` mean the same there, and the form is chosen that joins the quantifier around it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import combinations, product
from math import prod
from typing import NamedTuple, TypeAlias

from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists, forall, implies, map_children, neg
from qe.formula.syntax import TRUE, Atom, Formula, Relation
from qe.io import cases, terms
from qe.io.cases import Case, Cases
from qe.io.terms import Value
from qe.io.total import Fill, Total

Meaning: TypeAlias = Value | Cases

MOST_CASES = 64
"""Combinations of cases in one comparison; beyond them a term with cases gets a name."""
MOST_SUBSTITUTED = 2
"""Square roots of one comparison up to which they are substituted: each one doubles the degrees."""


class Auxiliary(NamedTuple):
    """A value called ``name``: the only one with ``definition`` where it is ``defined``. ``radicand``: the t of
    sqrt(t), where it is one. ``loose``: any value will do, which weakens the comparison where it is asserted and
    strengthens it where it is denied."""

    name: str
    definition: Formula
    defined: Formula
    radicand: Poly | None = None
    loose: bool = False


class Place(NamedTuple):
    """Where a formula stands: asserted or denied, and whether the quantifier around it acts as ``all``."""

    asserted: bool = True
    universal: bool = False

    @property
    def denied(self) -> Place:
        """The place inside a negation."""
        return self._replace(asserted=not self.asserted)

    def inside(self, universal: bool) -> Place:
        """The place inside a quantifier."""
        return self._replace(universal=universal is self.asserted)


class Exhausted(Exception):
    """There are not enough names for auxiliary values."""


class Auxiliaries:
    """Values behind the names ``extra`` of a ring; ``made`` are the auxiliary ones, in the order of their definitions
    (None: an unknown, which stays a variable), ``loose``: whether some of them stand for any value."""

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
            meant = [self.free_of_names(cases.holds(case, Relation.EQ), Place()) for case in cases.difference(s, value)]
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
        return disj([self.free_of_names(cases.holds(case, relation), place) for case in cases.difference(*few)])

    def defined(self, value: Cases, place: Place) -> Formula:
        """Where a term has a value."""
        return disj([self.free_of_names(conj(case.guards), place) for case in value])

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


def settled(formula: Formula, values: Mapping[str, Auxiliary], place: Place) -> Formula:
    """The comparison ``formula``, which says where its terms are defined, without the names of ``values``, which are in
    the order of their definitions."""
    needed = set(formula.free)
    for value in reversed(list(values.values())):
        if value.name in needed:
            needed.update(value.definition.free)
    direct = sum(value.radicand is not None and name in needed for name, value in values.items()) <= MOST_SUBSTITUTED
    for value in reversed(list(values.values())):
        if value.name not in formula.free:
            continue
        if value.radicand is not None and direct:
            formula = _substituted(formula, value.name, value.radicand)
        elif value.loose:
            formula = (exists if place.asserted else forall)((value.name,), formula)
        elif place.universal is place.asserted:
            formula = conj((value.defined, forall((value.name,), implies(value.definition, formula))))
        else:
            formula = exists((value.name,), conj((value.definition, formula)))
    return formula


def _substituted(formula: Formula, name: str, radicand: Poly) -> Formula:
    """The formula with the square root of ``radicand``, which is not negative, in the place of ``name``."""
    if name not in formula.free:
        return formula
    if not isinstance(formula, Atom):
        return map_children(formula, lambda part: _substituted(part, name, radicand))
    poly, ring = formula.poly, formula.poly.ring
    a, b, even = ring.constant(0), ring.constant(0), ring.constant(1)
    for k, coefficient in enumerate(poly.coefficients(ring.index[name])):
        if k % 2:
            b = b + coefficient * even
            even = even * radicand
        else:
            a = a + coefficient * even
    return _sign(a, b, a * a - b * b * radicand, formula.relation)


def _sign(a: Poly, b: Poly, norm: Poly, relation: Relation) -> Formula:
    """``a + b*s relation 0`` for s = sqrt(t) and ``norm`` = a^2 - b^2*t."""
    match relation:
        case Relation.EQ:
            return conj((atom(a * b, Relation.LE), atom(norm, Relation.EQ)))
        case Relation.GT:
            larger = conj((atom(a, Relation.GT), atom(norm, Relation.GT)))
            either = disj((atom(a, Relation.GT), atom(norm, Relation.LT)))
            return disj((larger, conj((atom(b, Relation.GT), either))))
        case Relation.LT:
            return _sign(-a, -b, norm, Relation.GT)
    return neg(_sign(a, b, norm, relation.negated))
