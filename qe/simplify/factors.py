"""Rules that look at the factors of one atom's polynomial.

For p = s * f1^e1 * ... * fk^ek (s = +1 or -1, fi irreducible), with the signs that the fi can have:
* a factor that is always positive, or nonzero with even exponent, is dropped; always negative: with a flip;
* in p = 0 and p /= 0 every exponent becomes 1 and factors that are never zero are dropped;
* p = 0 where 0 is the least value of p says that simpler polynomials vanish (``qe.simplify.minima``);
* let E be the factors whose power fi^ei is never negative (after flips), O the others. Then
  p < 0  iff  (every E factor /= 0) and s*prod(O) < 0;   p <= 0  iff  (some E factor = 0) or s*prod(O) <= 0.
The sum over the atoms of total degree times number of variables never grows.
"""

from __future__ import annotations

from math import prod

from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import FALSE, TRUE, Atom, Formula, Relation
from qe.simplify.facts import Facts
from qe.simplify.minima import vanishing

_FACTORED_TERMS = 400  # above this many terms a polynomial is taken as one factor


def factor_list(poly: Poly) -> tuple[tuple[Poly, int], ...]:
    """The irreducible factors with exponents; a large polynomial counts as irreducible."""
    if poly.term_count() > _FACTORED_TERMS or poly.total_degree == 1:
        return ((poly, 1),)
    return poly.factors()[1]


def reduce_atom(given: Atom, facts: Facts, conjunctive: bool) -> Formula:
    """A formula equivalent to the atom under the facts, by the rules above; the atom itself if none applies.

    Products in /= are split where they stand in a conjunction, products in = where they stand in a disjunction.
    """
    parts = factor_list(given.poly)
    if given.relation in (Relation.EQ, Relation.NE):
        return _reduce_equation(given, parts, facts, conjunctive)
    if len(parts) == 1 and parts[0][1] == 1:
        return given  # what the sign of the whole says is left to the ranges
    sign = 1
    even: list[Poly] = []
    odd: list[Poly] = []
    for factor, exponent in parts:
        signs = facts.signs(factor)
        if not signs:
            return given  # contradictory facts: the caller finds out from the ranges
        if signs == {0}:
            return TRUE if given.relation.holds(0) else FALSE
        if -1 in signs and 1 not in signs and exponent % 2:
            sign = -sign
        one_sided = exponent % 2 == 0 or not (-1 in signs and 1 in signs)
        if one_sided:
            if 0 in signs:
                even.append(factor)
        else:
            odd.append(factor)
    if not even and sign == 1 and len(odd) == len(parts) and all(e == 1 for _, e in parts):
        return given
    return _assemble(given.relation, sign, even, odd, given.poly)


def _assemble(relation: Relation, sign: int, even: list[Poly], odd: list[Poly], model: Poly) -> Formula:
    one = model.ring.constant(1)
    rest = atom(prod(odd, start=one) * sign, relation)
    if not even:
        return rest
    square = prod(even, start=one)
    if relation.is_strict:
        return conj((atom(square, Relation.NE), rest))
    return disj((atom(square, Relation.EQ), rest))


def _reduce_equation(given: Atom, parts: tuple[tuple[Poly, int], ...], facts: Facts, conjunctive: bool) -> Formula:
    kept: list[Poly] = []
    for factor, _ in parts:
        signs = facts.signs(factor)
        if not signs:
            return given
        if signs == {0}:
            return TRUE if given.relation is Relation.EQ else FALSE
        if 0 in signs:
            kept.append(factor)
    if len(kept) > 1 and conjunctive == (given.relation is Relation.NE):
        pieces = [atom(f, given.relation) for f in kept]
        return conj(pieces) if conjunctive else disj(pieces)
    if len(kept) == len(parts) and all(e == 1 for _, e in parts):
        return _at_minimum(given, conjunctive)
    return atom(prod(kept, start=given.poly.ring.constant(1)), given.relation)


def _at_minimum(given: Atom, conjunctive: bool) -> Formula:
    """The equations that say where a non-negative polynomial vanishes (dually, where it does not), if not larger."""
    if conjunctive != (given.relation is Relation.EQ):
        return given
    zeros = vanishing(given.poly)
    if not zeros or sum(len(z.variables) * z.total_degree for z in zeros) > weight(given.poly):
        return given
    pieces = [atom(z, given.relation) for z in zeros]
    return conj(pieces) if conjunctive else disj(pieces)


def weight(poly: Poly) -> int:
    """The size of an atom that simplification does not increase: total degree times number of variables."""
    return poly.total_degree * len(poly.variables)
