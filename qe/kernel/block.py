"""Primitive "signs": the quantifiers of a block stay, and what stands under them changes.

THEOREM. ex v (A or B) iff ex v A or ex v B. So if a body is equivalent to the disjunction of m_1, ..., m_k, then
ex v body iff ex v_1 m_1 or ... or ex v_k m_k, where v_i are variables of v, all that are free in m_i. A universal block
is the negation of an existential one. Without a block the formulas themselves are compared.

So are checked: simplification, cases (a product that is 0; p >= 0 as p > 0 or p = 0), equations replaced by others with
the same zeros (each of either side is a combination of the other side's, by an identity), signs of polynomials that an
identity says to be sums of squares, sums of squares that vanish, refutations by a Boolean search.
"""

from __future__ import annotations

from collections.abc import Sequence

from qe.formula.build import disj, exists
from qe.formula.syntax import Exists, ForAll, Formula
from qe.formula.traverse import disjuncts
from qe.kernel.boolean import ByLemmas, Goal, equivalence
from qe.kernel.negation import negation, normal
from qe.kernel.step import Claim, Context, only, outside


def block_goals(claim: Claim, context: Context) -> list[Goal]:
    """The body before, and the disjunction of the bodies after, have the same truth under the context."""
    only(claim, "theory")
    before, after = existential(claim)
    if not isinstance(before, Exists):
        return equivalence(before, after, context)
    names = before.variables
    bodies = disj(opened(piece, names, claim) for piece in disjuncts(after))
    return equivalence(before.body, bodies, outside(context, names))


check_block = ByLemmas(block_goals)


def existential(claim: Claim) -> tuple[Formula, Formula]:
    """Both sides, or both sides negated where a universal block stands before; negations in the atoms."""
    change = negation if isinstance(claim.before, ForAll) else normal
    return change(claim.before), change(claim.after)


def opened(piece: Formula, names: Sequence[str], claim: Claim) -> Formula:
    """A formula m such that the piece is equivalent to ``ex names. m``."""
    if set(names) & set(piece.free):
        raise claim.fail("a variable of the block is free in what becomes of it")
    if not isinstance(piece, Exists):
        return piece
    return exists([v for v in piece.variables if v not in names], piece.body)
