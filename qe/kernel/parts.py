"""Rule "parts": where a formula is true, or false, by what is proved of its parts.

THEOREM. Let T imply A, and T' imply B. Then T or T' implies A or B, and T and T' implies A and B. A block over a
disjunction is the disjunction of the blocks (ex x (A or B) iff ex x A or ex x B), and a universal one over a
conjunction their conjunction. A block whose variables do not occur may go. FALSE implies every formula, and a formula
itself. So where what follows by this for a formula (for its negation) holds, it is true (false).

Evidence: ``proofs``: derivations, as those of certificates, each of an equivalence about a part of the formula, of
T and A <-> T, or of T and A <-> false.
"""

from __future__ import annotations

from collections.abc import Sequence

from qe.exact.ring import Ring
from qe.formula.build import conj, convert, disj, exists, forall
from qe.formula.syntax import FALSE, And, Constant, Exists, ForAll, Formula, Or
from qe.formula.traverse import conjuncts
from qe.kernel.negation import negation, normal
from qe.kernel.nested import proved
from qe.kernel.renaming import arranged, is_same
from qe.kernel.step import Claim, Context, Limits, only

Equivalence = tuple[Formula, Formula]


def check_parts(claim: Claim, context: Context, limits: Limits) -> None:
    """What the step takes for granted is what implies the formula."""
    entry = only(claim, "proofs")[0]
    if not isinstance(claim.after, Constant):
        raise claim.fail("expected what is true, or false, where this holds")
    known = [proved(proof, limits) for proof in entry.items()]
    formula = normal(claim.before) if claim.after.value else negation(claim.before)
    where = sufficient(formula, claim.ring, known, limits)
    if not is_same(where, conj(context)):
        raise entry.fail(f"the proofs give another condition: {where}")


def sufficient(formula: Formula, ring: Ring, known: Sequence[Equivalence], limits: Limits) -> Formula:
    """What implies a formula in negation normal form, by the theorem and the equivalences that are known."""
    limits.tick()
    if formula.is_quantifier_free:
        return formula
    for equivalence in known:
        where = true_where(equivalence, formula)
        if where is not None and set(where.free) <= set(formula.free):
            return convert(normal(where), ring)
    match formula:
        case Exists(variables, body) | ForAll(variables, body) if not set(variables) & set(body.free):
            return sufficient(body, ring, known, limits)
        case Or(args):
            return disj(sufficient(a, ring, known, limits) for a in args)
        case And(args):
            return conj(sufficient(a, ring, known, limits) for a in args)
        case Exists(variables, body) if isinstance(body, Or):
            return disj(sufficient(exists(variables, a), ring, known, limits) for a in body.args)
        case ForAll(variables, body) if isinstance(body, And):
            return conj(sufficient(forall(variables, a), ring, known, limits) for a in body.args)
    return FALSE


def true_where(equivalence: Equivalence, formula: Formula) -> Formula | None:
    """What implies the formula because of an equivalence; None where that is about something else.

    THEOREM. A <-> T, not A <-> not T, (T and A) <-> T, (T and not A) <-> false: each says that T implies A.
    """
    start, answer = equivalence
    opposite = negation(formula)
    if is_same(start, formula):
        return answer
    if is_same(start, opposite):
        return negation(answer)
    if answer == FALSE:
        return beside(start, opposite)
    where = beside(start, formula)
    return where if where is not None and is_same(where, answer) else None


def beside(formula: Formula, part: Formula) -> Formula | None:
    """T where the formula is the conjunction of T and the part; None where it is not."""
    whole, wanted = ([(arranged(m), m) for m in conjuncts(normal(f))] for f in (formula, part))
    known, found = ({shape for shape, _ in listed} for listed in (wanted, whole))
    return conj(m for shape, m in whole if shape not in known) if known <= found else None
