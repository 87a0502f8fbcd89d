"""Rules "inequations that remove no interior" and "only asked to be no root".

THEOREM. Let f be open in the variables v of a block: every comparison in it that contains one of them is <, > or /=,
and stands under conjunctions and disjunctions only. Its solutions form an open set, and a nonempty open set is not
inside the zeros of finitely many polynomials that are not the zero polynomial. So
ex v (f and p_1 /= 0 and ...) iff ex v (f and, for each i, some coefficient of p_i with respect to v is not 0).
Where f does not contain v at all, nothing is left to be quantified.
"""

from __future__ import annotations

from qe.formula.build import atom, conj, disj, exists
from qe.formula.syntax import And, Atom, Constant, Exists, Formula, Or, Relation
from qe.formula.traverse import conjuncts
from qe.kernel.block import existential
from qe.kernel.boolean import ByLemmas, Goal, equivalence
from qe.kernel.step import Claim, Context, Limits, only, outside


def check_inequations(claim: Claim, context: Context, limits: Limits) -> None:
    """The conditions on coefficients take the place of the inequations."""
    only(claim)
    block = claim.block()
    if claim.after != exists(block.variables, generic(block, claim)):
        raise claim.fail("not what the theorem gives")


def only_nonzero_goals(claim: Claim, context: Context) -> list[Goal]:
    """What stands after is to be equivalent to the conditions on coefficients, without the block."""
    only(claim, "theory")
    before, after = existential(claim)
    if not isinstance(before, Exists):
        raise claim.fail("expected a block")
    conditions = generic(before, claim)
    if set(before.variables) & set(conditions.free):
        raise claim.fail("more is asked of the variables of the block than that polynomials do not vanish")
    return equivalence(conditions, after, outside(context, before.variables))


check_only_nonzero = ByLemmas(only_nonzero_goals)


def generic(block: Exists, claim: Claim) -> Formula:
    """The body with conditions on coefficients in place of the inequations that contain the block's variables."""
    names = frozenset(block.variables)
    indices = frozenset(claim.ring.index[v] for v in names)
    kept: list[Formula] = []
    conditions: list[Formula] = []
    for part in conjuncts(block.body):
        if isinstance(part, Atom) and part.relation is Relation.NE and names & set(part.free):
            conditions.append(disj(atom(c, Relation.NE) for c in part.poly.coefficients_in(indices)))
        elif _is_open(part, names):
            kept.append(part)
        else:
            raise claim.fail("what stands beside the inequations is not seen to be open")
    return conj((*kept, *conditions))


def _is_open(formula: Formula, names: frozenset[str]) -> bool:
    match formula:
        case Constant():
            return True
        case Atom(_, relation):
            return relation in (Relation.LT, Relation.GT, Relation.NE) or not names & set(formula.free)
        case And(args) | Or(args):
            return all(_is_open(a, names) for a in args)
    return not names & set(formula.free)
