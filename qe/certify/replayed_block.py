"""Rules "virtual substitution" and "equations taken apart": one step that is made of steps of its own.

THEOREM. Equivalence is transitive, and A <-> B iff not A <-> not B: the ``steps`` of the evidence lead from the
formula to what became of it; for a universal block both sides are negated.
"""

from __future__ import annotations

from qe.certify.block import existential
from qe.certify.step import Claim, Context, Limits, only


def check_replayed_block(claim: Claim, context: Context, limits: Limits) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the step that fails."""
    steps = only(claim, "steps")[0]
    before, after = existential(claim)
    if limits.replay(steps, before, context, claim.ring) != after:
        raise claim.fail("the steps do not lead there")
