"""Rule "redundant part": an argument of a conjunction or disjunction that makes no difference is left out.

THEOREM. Let F be built from atoms by "and" and "or" alone, and A an argument of a disjunction (conjunction) in F. Then
F without A has the truth value of F at every point but those where A is true (false), the other arguments beside it are
false (true), and on the way from F down to there the other arguments of every disjunction are false, and of every
conjunction true. PROOF. Where one of these fails, the disjunction (conjunction) on the way that it belongs to has the
same value whatever A is; otherwise its value is that of the argument on the way.

Evidence: ``at``, argument numbers from the root to A; ``steps``, from the sentence that there is an exception to false.
"""

from __future__ import annotations

from collections.abc import Sequence

from qe.certify.negation import negation
from qe.certify.step import Claim, Context, Limits, only
from qe.formula.build import conj, disj, exists
from qe.formula.syntax import FALSE, And, Atom, Formula, Or


def check_redundant(claim: Claim, context: Context, limits: Limits) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the entry that fails."""
    at, steps = only(claim, "at", "steps")
    place = [entry.integer() for entry in at.items()]
    if not place or not _is_monotone(claim.before):
        raise claim.fail("a place in a formula of conjunctions and disjunctions of atoms expected")
    rest, exception = _left_out(claim.before, place, claim)
    if claim.after != rest:
        raise claim.fail("not the formula without this part")
    body = conj(exception)
    if limits.replay(steps, exists(body.free, body), (), claim.ring) != FALSE:
        raise claim.fail("not shown that the part makes no difference")


def _left_out(formula: Formula, place: Sequence[int], claim: Claim) -> tuple[Formula, list[Formula]]:
    """The formula without what stands at the place, and the conditions of the theorem."""
    if not isinstance(formula, And | Or) or place[0] >= len(formula.args):
        raise claim.fail("there is no such place")
    both, k = isinstance(formula, And), place[0]
    part, beside = formula.args[k], formula.args[:k] + formula.args[k + 1 :]
    conditions = [arg if both else negation(arg) for arg in beside]
    if len(place) == 1:
        kept, last = beside, [negation(part) if both else part]
    else:
        inner, last = _left_out(part, place[1:], claim)
        kept = (*formula.args[:k], inner, *formula.args[k + 1 :])
    return (conj if both else disj)(kept), conditions + last


def _is_monotone(formula: Formula) -> bool:
    match formula:
        case And(args) | Or(args):
            return all(map(_is_monotone, args))
    return isinstance(formula, Atom)
