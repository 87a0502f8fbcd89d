"""Primitive "root": a polynomial takes a value, because of its signs at a place and far out.

THEOREM (intermediate values). Near an end of the line a polynomial p in x has the sign of its leading coefficient,
times -1 at the left end where the degree is odd, and is as large as one likes. So ex x (p rel 0) is true for a strict
or weak relation rel if the sign is right at one of the ends, and for any relation if the degree is odd and the leading
coefficient is not 0; and ex x (p = 0 and s <= x), for a term s, if p <= 0 at s and p > 0 at the right end, or both the
other way round.

Evidence: ``low``, the place s: [numerator, positive number], or null; ``high``, always null: the right end;
``rising``: at s 1 or -1, the sign with which p goes from at most 0 to at least 0; otherwise the end at which the sign
is right, or 0 for an odd degree; ``theory``, by which the signs are known.
"""

from __future__ import annotations

from qe.exact.ring import Poly
from qe.formula.build import atom
from qe.formula.syntax import TRUE, Atom, Exists, Relation
from qe.formula.traverse import conjuncts
from qe.kernel.boolean import ByLemmas, Goal
from qe.kernel.negation import negation
from qe.kernel.step import Claim, Context, only, outside
from qe.kernel.terms import Quotient, at_terms
from qe.proof.entry import Entry

_STRICT = {Relation.LE: Relation.LT, Relation.GE: Relation.GT}


def root_goals(claim: Claim, context: Context) -> list[Goal]:
    """The polynomial has the signs, and the bound is that of the place."""
    low, high, rising, _ = only(claim, "low", "high", "rising", "theory")
    block = claim.before if claim.after == TRUE else claim.after
    if TRUE not in (claim.before, claim.after) or not isinstance(block, Exists) or len(block.variables) != 1:
        raise claim.fail("expected a block of one variable, which is true")
    x, direction = claim.ring.index[block.variables[0]], rising.integer(-1)
    if high.value is not None or direction > 1:
        raise rising.fail("expected 1, -1 or 0, and null for the right end")
    start = None if low.value is None else _place(low, x, claim)
    bound = TRUE if start is None else atom(start[1] * claim.ring.gen(x) - start[0], Relation.GE)
    rest = [part for part in conjuncts(block.body) if part != bound]
    part = rest[0] if len(rest) == 1 else None
    if not isinstance(part, Atom) or not part.poly.degree(x):
        raise claim.fail("expected one comparison, and the bound that is the place")
    signs = [negation(atom(poly, relation)) for poly, relation in _signs(part, x, start, direction, claim)]
    return [(*outside(context, block.variables), sign) for sign in signs]


check_root = ByLemmas(root_goals)


def _signs(part: Atom, x: int, start: Quotient | None, direction: int, claim: Claim) -> list[tuple[Poly, Relation]]:
    """What is needed of the comparison, by the theorem."""
    poly, lead, relation = part.poly, part.poly.leading(x), _STRICT.get(part.relation, part.relation)
    if start is not None and direction and relation is Relation.EQ:
        at_most, above = (Relation.LE, Relation.GT) if direction > 0 else (Relation.GE, Relation.LT)
        return [(at_terms(poly, {x: start}), at_most), (lead, above)]
    if start is None and not direction and poly.degree(x) % 2:
        return [(lead, Relation.NE)]
    if start is None and direction and relation is not Relation.EQ:
        return [(-lead if direction < 0 and poly.degree(x) % 2 else lead, relation)]
    raise claim.fail("expected an equation and a place, an end of the line, or an odd degree")


def _place(entry: Entry, x: int, claim: Claim) -> Quotient:
    top, bottom = (member.polynomial(claim.ring) for member in entry.row("numerator", "positive number"))
    if top.degree(x) or not bottom.is_constant or bottom.constant_value() <= 0:
        raise entry.fail("expected a term without the variable, over a positive number")
    return top, bottom
