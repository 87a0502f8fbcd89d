"""Rule "nested blocks of one kind gathered": quantifiers of one kind are drawn together.

THEOREM. ex x (f and ex y g) iff ex x, y (f and g), for y that are not free in f and not among x; dually all x (f or all
y g) iff all x, y (f or g). Several blocks are opened one after the other, each beside what stands there by then. Either
side may stand before: then variables move inwards.
"""

from __future__ import annotations

from qe.certify.step import Claim, Context, Limits, only
from qe.formula.build import conj, disj
from qe.formula.syntax import Exists, ForAll, Formula
from qe.formula.traverse import conjuncts, disjuncts


def check_gathering(claim: Claim, context: Context, limits: Limits) -> None:
    """The blocks whose variables stand outside afterwards are opened, and the result is compared."""
    only(claim)
    before, after = claim.before, claim.after
    if not isinstance(before, Exists | ForAll) or type(after) is not type(before):
        raise claim.fail("expected two blocks of one kind")
    if len(after.variables) < len(before.variables):
        before, after = after, before
    split, join = (conjuncts, conj) if isinstance(before, Exists) else (disjuncts, disj)
    names, pending, parts = set(before.variables), list(split(before.body)), list[Formula]()
    while pending:
        limits.tick()
        part = pending.pop(0)
        if isinstance(part, type(before)) and set(part.variables) <= set(after.variables):
            if set(part.variables) & names.union(*(other.free for other in (*pending, *parts))):
                raise claim.fail("a variable that is drawn outside is captured there")
            names |= set(part.variables)
            pending[:0] = split(part.body)
        else:
            parts.append(part)
    if names != set(after.variables) or set(split(join(parts))) != set(split(after.body)):
        raise claim.fail("not the block with the inner ones opened")
