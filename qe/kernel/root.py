"""Primitive "root": a polynomial takes a value, because of its signs at two places, or far out.

THEOREM (intermediate values). A polynomial p in x with p <= 0 at one of two places and p >= 0 at the other has a root
between them, the places included. A place is a term, or one of the two ends of the line: near an end p has the sign
of its leading coefficient, times -1 at the left end where the degree is odd. Near an end p is as large as one likes,
so that p < 0, p <= 0, p > 0, p >= 0 or p /= 0 for some x as soon as the sign there is right.

So ex x (p = 0 and s <= x and x <= t) is true where s <= t; either bound may be missing, and is where there is no term
on its side. ex x (p rel 0) is true for other relations.

Evidence: ``low`` and ``high``, the places: [numerator, positive number] or null for the end of the line; ``rising``,
1 or -1, the sign with which p goes from at most 0 to at least 0, or 0 where that is not known, at two terms, or with
an odd degree at both ends (for other relations no place is a term, and ``rising`` says at which end, 0 at one of
them); ``theory``, by which the signs are known.
"""

from __future__ import annotations

from dataclasses import dataclass

from qe.exact.ring import Poly
from qe.formula.build import atom
from qe.formula.syntax import FALSE, TRUE, Atom, Exists, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.kernel.boolean import ByLemmas, Goal
from qe.kernel.negation import negation
from qe.kernel.step import Claim, Context, only, outside
from qe.kernel.terms import Quotient, at_terms
from qe.proof.entry import Entry

_AT_MOST = {1: Relation.LE, -1: Relation.GE}


@dataclass(frozen=True, slots=True)
class _Place:
    """A term, or the end of the line on a ``side`` (-1: left, 1: right)."""

    side: int
    term: Quotient | None

    def sign(self, poly: Poly, x: int, relation: Relation) -> Formula:
        """That the polynomial is on this side of 0 there: strictly, at an end of the line."""
        if self.term is not None:
            return atom(at_terms(poly, {x: self.term}), relation)
        turned = -1 if self.side < 0 and poly.degree(x) % 2 else 1
        strict = {Relation.LE: Relation.LT, Relation.GE: Relation.GT}.get(relation, relation)
        return atom(poly.leading(x) * turned, strict) if poly.degree(x) else FALSE

    def bound(self, x: int, ring_x: Poly) -> Formula:
        """That x is not past the place."""
        if self.term is None:
            return TRUE
        top, bottom = self.term
        return atom(bottom * ring_x - top, _AT_MOST[self.side])


def root_goals(claim: Claim, context: Context) -> list[Goal]:
    """The polynomial has the signs, and the bounds are those of the places."""
    low, high, rising, _ = only(claim, "low", "high", "rising", "theory")
    block = claim.before if claim.after == TRUE else claim.after
    if TRUE not in (claim.before, claim.after) or not isinstance(block, Exists) or len(block.variables) != 1:
        raise claim.fail("expected a block of one variable, which is true")
    (name,) = block.variables
    x, direction = claim.ring.index[name], rising.integer(-1)
    if direction > 1:
        raise rising.fail("expected 1, -1 or 0")
    places = _place(low, -1, x, claim), _place(high, 1, x, claim)
    bounds = {place.bound(x, claim.ring.gen(x)) for place in places} - {TRUE}
    rest = [part for part in conjuncts(block.body) if part not in bounds]
    part = rest[0] if len(rest) == 1 else None
    if not isinstance(part, Atom):
        raise claim.fail("expected one comparison, and bounds that are the places")
    known = outside(context, block.variables)
    if part.relation is not Relation.EQ:
        if bounds or places[0].term is not None or places[1].term is not None:
            raise claim.fail("expected one comparison and an end of the line")
        if not direction:  # one of the two ends has the sign that is asked for
            return [(*known, negation(sign)) for sign in _changes(part.poly, x, places, 0, claim)]
        side = places[0] if direction < 0 else places[1]
        return [(*known, negation(side.sign(part.poly, x, part.relation)))]
    goals: list[Goal] = [(*known, negation(sign)) for sign in _changes(part.poly, x, places, direction, claim)]
    if places[0].term is not None and places[1].term is not None:
        (s, m), (t, n) = places[0].term, places[1].term
        goals.append((*known, atom(t * m - s * n, Relation.LT)))
    return goals


check_root = ByLemmas(root_goals)


def _changes(poly: Poly, x: int, places: tuple[_Place, _Place], direction: int, claim: Claim) -> tuple[Formula, ...]:
    """That the polynomial has no two equal signs other than 0 at the places."""
    low, high = places
    if direction:
        return low.sign(poly, x, _AT_MOST[direction]), high.sign(poly, x, _AT_MOST[-direction])
    if low.term is not None and high.term is not None:
        return (atom(at_terms(poly, {x: low.term}) * at_terms(poly, {x: high.term}), Relation.LE),)
    if low.term is None and high.term is None and poly.degree(x) % 2:
        return (atom(poly.leading(x), Relation.NE),)
    raise claim.fail("expected two terms, or both ends of the line and an odd degree")


def _place(entry: Entry, side: int, x: int, claim: Claim) -> _Place:
    if entry.value is None:
        return _Place(side, None)
    top, bottom = (member.polynomial(claim.ring) for member in entry.row("numerator", "positive number"))
    if top.degree(x) or not bottom.is_constant or bottom.constant_value() <= 0:
        raise entry.fail("expected a term without the variable, over a positive number")
    return _Place(side, (top, bottom))
