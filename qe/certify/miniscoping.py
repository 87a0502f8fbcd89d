"""Rule "independent parts and miniscoping": conditions that share no variable of a block are quantified apart.

THEOREM. ex v (A or B) iff ex v A or ex v B; where v is not free in A, ex v A is A. ex v, w (A and B and C) iff A and
ex v B and ex w C where no variable of the block is free in A, none but v in B and none but w in C. Either side may
stand before.
"""

from __future__ import annotations

from qe.certify.step import Claim, Context, Limits, only
from qe.formula.build import conj, exists
from qe.formula.syntax import Exists, Formula, Or
from qe.formula.traverse import conjuncts


def check_miniscoping(claim: Claim, context: Context, limits: Limits) -> None:
    """One side, with its quantifiers drawn together again, is the other."""
    only(claim)
    before, after = claim.before, claim.after
    if not isinstance(before, Exists):
        before, after = after, before
    if not isinstance(before, Exists):
        raise claim.fail("expected an existential block")
    block, taken = set(before.variables), set[str]()
    if isinstance(before.body, Or):
        args = before.body.args
        apart = {exists(before.variables, a): a for a in args} | {a: a for a in args if block.isdisjoint(a.free)}
        if {apart.get(piece) for piece in (after.args if isinstance(after, Or) else (after,))} != set(args):
            raise claim.fail("expected the block before each part of the disjunction")
        return
    parts: list[Formula] = []
    for piece in conjuncts(after):
        own = block & set(piece.variables) if isinstance(piece, Exists) else set[str]()
        if block & set(piece.free) or own & taken:
            raise claim.fail("parts share a variable of the block")
        taken |= own
        if isinstance(piece, Exists) and own:
            piece = exists([v for v in piece.variables if v not in own], piece.body)
        parts.append(piece)
    if set(conjuncts(conj(parts))) != set(conjuncts(before.body)):
        raise claim.fail("the parts are not the conjuncts of the block")
