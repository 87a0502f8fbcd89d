"""Values that are no quotients of polynomials (roots, and terms with many cases), each behind a name of its own.

A comparison that uses such a name is freed of it at once. A square root is substituted: with s = sqrt(t) and t >= 0
every polynomial in s is a + b*s, and the sign of that is known from the signs of a, b and a^2 - b^2*t (V. Weispfenning,
Quantifier elimination for real algebra: the quadratic case and beyond, AAECC 8, 1997). Any other value s is bound by a
quantifier: as exactly one s fits its definition where it has a value at all, ``ex s. definition and F`` and
``all s. definition -> F`` mean the same there, and the form is chosen that joins the quantifier around it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists, forall, implies, map_children, neg
from qe.formula.syntax import Atom, Formula, Quantified, Relation

MOST_SUBSTITUTED = 2
"""Square roots of one comparison up to which they are substituted: each one doubles the degrees."""


class Auxiliary(NamedTuple):
    """A value called ``name``: the only one with ``definition`` where it is ``defined``.

    ``radicand``: the t of sqrt(t), where it is one. ``loose``: any value will do, which weakens the comparison where it
    is asserted and strengthens it where it is denied.
    """

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


def settled(formula: Formula, values: Mapping[str, Auxiliary], place: Place) -> Formula:
    """The comparison ``formula``, which says where its terms are defined, without the names of ``values``.

    ``values`` are in the order of their definitions, which may use earlier ones.
    """
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
    match formula:
        case Atom(poly, relation):
            return _with_root(poly, relation, name, radicand)
        case Quantified() if name not in formula.free:
            return formula
    return map_children(formula, lambda part: _substituted(part, name, radicand))


def _with_root(poly: Poly, relation: Relation, name: str, radicand: Poly) -> Formula:
    ring: Ring = poly.ring
    index = ring.index[name]
    if not poly.degree(index):
        return atom(poly, relation)
    a, b, even = ring.constant(0), ring.constant(0), ring.constant(1)
    for k, coefficient in enumerate(poly.coefficients(index)):
        if k % 2:
            b = b + coefficient * even
            even = even * radicand
        else:
            a = a + coefficient * even
    return _sign(a, b, a * a - b * b * radicand, relation)


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
