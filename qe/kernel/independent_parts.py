"""Rule "independent parts": conjuncts without a common variable of the block are solved apart.

THEOREM. Let C be free of v and w, B1 free of w, and B2 of v. Then ex v, w (C and B1 and B2) iff C and ex v B1 and ex
w B2. Moreover C and ex v B1 iff C and ex v (C and B1); if ex v (C and B1) iff A, then this is C and A', with true for
members of C in the and/or combination A. Evidence: ``pieces``, each with ``body`` Bi, ``together`` (true if it is
solved with C) and ``steps``. C is what is left of the conjuncts. Pieces after one that is false need not be listed.
"""

from __future__ import annotations

from collections.abc import Sequence

from qe.formula.build import conj, disj
from qe.formula.syntax import FALSE, TRUE, And, Formula, Or
from qe.formula.traverse import conjuncts
from qe.kernel.elimination_set import block_of
from qe.kernel.step import Claim, Context, Limits, only
from qe.proof.entry import formula_from_json


def check_independent_parts(claim: Claim, context: Context, limits: Limits) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the entry that fails."""
    pieces, block = only(claim, "pieces")[0], claim.block()
    names, members = set(block.variables), conjuncts(block.body)
    beside = tuple(m for m in members if not names & set(m.free))
    listed = [entry.fields("body", "together", "steps") for entry in pieces.items()]
    bodies = [formula_from_json(body, claim.ring, quantified=True) for body, _, _ in listed]
    _check_apart(bodies, names, members, claim)
    found = []
    for body, (_, together, steps) in zip(bodies, listed, strict=True):
        known = beside if together.truth() else ()
        answer = limits.replay(steps, block_of(names, conj((*known, body)), claim.ring), context, claim.ring)
        if names & set(answer.free):
            raise steps.fail("a variable of the block is left")
        found.append(_without(answer, known))
    left = {m for m in members if m not in beside} - {m for body in bodies for m in conjuncts(body)}
    if left and FALSE not in found:
        raise pieces.fail("a conjunct is missing")
    if claim.after != (FALSE if FALSE in found else conj((*beside, *found))):
        raise claim.fail("not the conjunction to which the parts lead")


def _check_apart(bodies: Sequence[Formula], names: set[str], members: Sequence[Formula], claim: Claim) -> None:
    taken = set[str]()
    for body in bodies:
        own = names & set(body.free)
        if own & taken or not own or not set(conjuncts(body)) <= set(members):
            raise claim.fail("parts that share a variable, or are not made of conjuncts of the block")
        taken |= own


def _without(formula: Formula, known: Sequence[Formula]) -> Formula:
    """The formula with TRUE for the known members."""
    if formula in known:
        return TRUE
    if isinstance(formula, And | Or):
        return (conj if isinstance(formula, And) else disj)(_without(a, known) for a in formula.args)
    return formula
