"""Rule "constant": a formula holds nowhere, or everywhere.

THEOREM. F is false at all values of its free variables x iff ex x F is false, and true at all of them iff ex x (not F)
is false.

Evidence: ``steps`` from that existential sentence to false; or ``certificate``, a cell table, as for "cells".
"""

from __future__ import annotations

from qe.certify.negation import negation, normal
from qe.certify.step import Claim, Context, Limits, only
from qe.certify.table import check_table
from qe.formula.build import exists
from qe.formula.syntax import FALSE, Constant


def check_constant(claim: Claim, context: Context, limits: Limits) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the entry that fails."""
    if isinstance(claim.evidence.value, dict) and "certificate" in claim.evidence.value:
        check_table(claim, context, limits)
        return
    steps = only(claim, "steps")[0]
    if not isinstance(claim.after, Constant):
        raise claim.fail("expected true or false")
    exception = negation(claim.before) if claim.after.value else normal(claim.before)
    if limits.replay(steps, exists(exception.free, exception), (), claim.ring) != FALSE:
        raise claim.fail("not shown that there is no exception")
