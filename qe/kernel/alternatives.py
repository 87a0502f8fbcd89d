"""Rule "alternatives": the parts of a disjunction are solved one by one.

THEOREM. ex v (A1 or ... or Ak) iff (ex v A1) or ... or (ex v Ak). Evidence: ``pieces`` A1, ..., Ak, and for each of
them in ``parts`` the steps from ex v Ai on (over those of v that occur in Ai). The claim is that the block is
equivalent to the disjunction of the formulas to which the steps lead.
"""

from __future__ import annotations

from qe.formula.build import disj
from qe.kernel.elimination_set import block_of, check_parts
from qe.kernel.step import Claim, Context, Limits, only
from qe.proof.entry import formula_from_json


def check_alternatives(claim: Claim, context: Context, limits: Limits) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the entry that fails."""
    pieces, parts = only(claim, "pieces", "parts")
    block = claim.block()
    bodies = [formula_from_json(piece, claim.ring, quantified=True) for piece in pieces.items()]
    if disj(bodies) != block.body:
        raise pieces.fail("not the parts of the disjunction")
    check_parts(claim, [block_of(block.variables, body, claim.ring) for body in bodies], parts, context, limits)
