"""Rule "instance": an existential sentence is true because numbers are known that satisfy it.

THEOREM. If f holds where v has certain values, then ex v. f is true.

Evidence: ``certificate``, of kind "witness", for the body of the block and all its variables. It is checked as any
other.
"""

from __future__ import annotations

from qe.certify.step import Claim, Context, Limits, only
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.formula.syntax import TRUE, Exists
from qe.proof.certificate import Kind
from qe.proof.entry import Entry, formula_from_json


def check_instance(claim: Claim, context: Context, limits: Limits) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the entry that fails."""
    inner, block = only(claim, "certificate")[0], claim.before
    if not isinstance(block, Exists) or set(block.body.free) - set(block.variables) or claim.after != TRUE:
        raise claim.fail("a true existential sentence expected")
    found = limits.leaf(inner)
    if found.kind is not Kind.WITNESS or not isinstance(found.payload, dict):
        raise inner.fail("a certificate of kind witness expected")
    payload = Entry(found.payload, f"{inner.path}.payload")
    order, matrix, _ = payload.fields("order", "matrix", "values")
    given = convert(formula_from_json(matrix, Ring.of(order.names())), claim.ring)
    if given != convert(block.body, claim.ring):
        raise matrix.fail("not the body of the block")
