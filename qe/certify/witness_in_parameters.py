"""Rule "witness in the parameters": an existential block holds because terms are known that satisfy it.

THEOREM. If F[t/x] holds for a term t without x, then so does ex x F. So if F holds for terms t_1, ..., t_k in the
parameters in place of v_1, ..., v_k, wherever what is known does, then ex v F is true there.

Evidence: ``equations``: [variable, equation c*x + r = 0 with a number c] in the order in which they are put in;
``theory``: lemmas by which what is known implies the result.
"""

from __future__ import annotations

from qe.certify.boolean import ByLemmas, Goal
from qe.certify.linear_equation import substituted, term
from qe.certify.negation import negation
from qe.certify.step import Claim, Context, only, outside
from qe.formula.syntax import TRUE, Exists


def witness_goals(claim: Claim, context: Context) -> list[Goal]:
    """The terms are put in; what is known is to imply the result."""
    equations, block = only(claim, "equations", "theory")[0], claim.before
    if not isinstance(block, Exists) or claim.after != TRUE:
        raise claim.fail("expected an existential block that holds")
    body, names = block.body, set(block.variables)
    for entry in equations.items():
        body = substituted(term(entry, block.variables, body, claim), claim)
    if names & set(body.free):
        raise equations.fail("a variable of the block is left")
    return [(*outside(context, names), negation(body))]


check_witness_in_parameters = ByLemmas(witness_goals)
