"""Rule "disjuncts with equations apart": a block goes into a disjunction that is one of its conjuncts.

THEOREM. ex v (f and (g1 or ... or gk)) iff (ex v (f and g1)) or ... or (ex v (f and gk)).
"""

from __future__ import annotations

from qe.certify.step import Claim, Context, Limits, only
from qe.formula.build import conj, disj, exists
from qe.formula.syntax import Or
from qe.formula.traverse import conjuncts


def check_distribution(claim: Claim, context: Context, limits: Limits) -> None:
    """What one of the conjuncts gives is what stands after."""
    only(claim)
    block = claim.block()
    parts = conjuncts(block.body)
    for part in parts:
        limits.tick()
        rest = [other for other in parts if other != part]
        if isinstance(part, Or) and claim.after == disj(
            exists(block.variables, conj((*rest, case))) for case in part.args
        ):
            return
    raise claim.fail("not the cases of a disjunction in the block")
