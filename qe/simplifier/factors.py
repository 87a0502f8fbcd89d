"""Rules that look at the factors of one atom's polynomial.

For p = s * f1^e1 * ... * fk^ek (s = +1 or -1, fi irreducible), with the signs that the fi can have:
* a factor that is always positive, or nonzero with even exponent, is dropped; always negative: with a flip;
* in p = 0 and p /= 0 every exponent becomes 1 and factors that are never zero are dropped;
* p = 0 where 0 is the least value of p says that simpler polynomials vanish (``qe.simplifier.minima``);
* let E be the factors whose power fi^ei is never negative (after flips), O the others. Then
  p < 0  iff  (every E factor /= 0) and s*prod(O) < 0;   p <= 0  iff  (some E factor = 0) or s*prod(O) <= 0;
* f*(f + k) < 0, k > 0, says that f < 0 < f + k, and f*(f + k) > 0 that f > 0 or f + k < 0; likewise <= and >=. Linear
  factors stay together: x^2 - 1 <= 0 is short.
The sum over the atoms of total degree times number of variables never grows.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from math import prod

from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import FALSE, TRUE, Atom, Formula, Relation
from qe.simplifier.facts import Facts, factor_list
from qe.simplifier.minima import vanishing

MOST_MADE = 5_000
"""Atoms that are remembered: facts that say nothing live as long as the process."""


def atom_under(poly: Poly, relation: Relation, facts: Facts) -> Formula:
    """A formula equivalent to ``poly relation 0`` under the facts, by the rules above; a constant if they decide it."""
    made = facts.made.get((poly, relation))
    if made is None:
        if len(facts.made) >= MOST_MADE:
            facts.made.clear()
        made = facts.made[poly, relation] = _atom_under(poly, relation, facts)
    return made


def _atom_under(poly: Poly, relation: Relation, facts: Facts) -> Formula:
    given = atom(poly, relation)
    if not isinstance(given, Atom) or given.poly.total_degree == 1:
        return _decided(given, facts)
    parts = factor_list(given.poly)
    one = poly.ring.constant(1)
    if relation in (Relation.EQ, Relation.NE):
        kept = (f for f, _ in parts if 0 in facts.signs(f))
        return _decided(atom(prod(kept, start=one), relation), facts)
    sign, even, odd = _by_sign(parts, facts)
    return _assemble(given.relation, prod(odd, start=one) * sign, even, lambda made: _decided(made, facts))


def _decided(given: Formula, facts: Facts) -> Formula:
    """The atom, or a constant where the sign of the whole settles it."""
    if not isinstance(given, Atom):
        return given
    signs = facts.signs(given.poly)
    allowed = signs & given.relation.signs
    if allowed == signs:
        return TRUE
    if not allowed:
        return FALSE
    if allowed == {0}:
        zeros = vanishing(given.poly)
        return conj(atom(z, Relation.EQ) for z in reversed(zeros)) if zeros else Atom(given.poly, Relation.EQ)
    return given


def _by_sign(parts: Iterable[tuple[Poly, int]], facts: Facts) -> tuple[int, list[Poly], list[Poly]]:
    """(s, E, O) of the rule above, without the factors of known sign."""
    sign = 1
    even: list[Poly] = []
    odd: list[Poly] = []
    for factor, exponent in parts:
        signs = facts.signs(factor)
        if -1 in signs and 1 not in signs and exponent % 2:
            sign = -sign
        if exponent % 2 == 0 or not (-1 in signs and 1 in signs):
            if 0 in signs:
                even.append(factor)
        else:
            odd.append(factor)
    return sign, even, odd


def reduce_atom(given: Atom, facts: Facts, conjunctive: bool) -> Formula:
    """A formula equivalent to the atom under the facts, by the rules above; the atom itself if none applies.

    Products in /= are split where they stand in a conjunction, products in = where they stand in a disjunction.
    """
    parts = factor_list(given.poly)
    equation = given.relation in (Relation.EQ, Relation.NE)
    if not equation and len(parts) == 1 and parts[0][1] == 1:
        return given  # what the sign of the whole says is left to the ranges
    known = [facts.signs(factor) for factor, _ in parts]
    if frozenset() in known:
        return given  # contradictory facts: the caller finds out from the ranges
    if {0} in known:
        return TRUE if given.relation.holds(0) else FALSE
    if equation:
        kept = [f for (f, _), signs in zip(parts, known, strict=True) if 0 in signs]
        return _reduce_equation(given, parts, kept, conjunctive)
    sign, even, odd = _by_sign(parts, facts)
    if not even and sign == 1 and len(odd) == len(parts) and all(e == 1 for _, e in parts):
        return _between(given, odd)
    return _assemble(given.relation, prod(odd, start=given.poly.ring.constant(1)) * sign, even, lambda made: made)


def _between(given: Atom, factors: Sequence[Poly]) -> Formula:
    """The last rule above, for an inequality on the product of the factors; the atom where it does not apply."""
    if len(factors) != 2 or factors[0].total_degree < 2:
        return given
    first, second = factors
    for sign in (1, -1):
        gap = second * sign - first  # the product is sign * first * (first + gap)
        if gap.is_constant:
            low, high = (first, first + gap) if gap.constant_value() > 0 else (first + gap, first)
            relation = given.relation if sign > 0 else given.relation.flipped
            join = conj if relation in (Relation.LT, Relation.LE) else disj
            return join((atom(low, relation), atom(high, relation.flipped)))
    return given


def _assemble(relation: Relation, odd: Poly, even: Sequence[Poly], settled: Callable[[Formula], Formula]) -> Formula:
    """The last rule: ``odd`` stands for s*prod(O), ``settled`` may decide the atoms that are made."""
    rest = settled(atom(odd, relation))
    if not even:
        return rest
    square = prod(even, start=odd.ring.constant(1))
    if relation.is_strict:
        return conj((settled(atom(square, Relation.NE)), rest))
    return disj((settled(atom(square, Relation.EQ)), rest))


def _reduce_equation(
    given: Atom, parts: Sequence[tuple[Poly, int]], kept: Sequence[Poly], conjunctive: bool
) -> Formula:
    """The rules for = and /=; ``kept``: the factors that may vanish."""
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
