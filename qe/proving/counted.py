"""Evidence for the rule "comprehensive Gröbner system": what its checker asks about the parameters, proved. Nothing of
it is trusted."""

from __future__ import annotations

from qe.elimination.cad import certificate_for
from qe.errors import CertificateRejected, Unable
from qe.exact.ring import Ring
from qe.expert.counted_solutions import by_lemmas, sentences
from qe.formula.normal import rename_apart
from qe.formula.syntax import TRUE, Formula
from qe.kernel.block import check_block
from qe.kernel.step import Claim, Limits
from qe.options import Options
from qe.proof.entry import Entry, Json
from qe.proving.lemma_list import EMPTY
from qe.proving.lemmas import refuting

CASE_WORK = 20_000
"""Units of work for a decomposition that proves one case."""


def case_proofs(claim: Claim, options: Options, limits: Limits) -> Json:
    """Lemmas, or a certificate, for each case of a block over equations; None where neither is found."""
    proofs: list[Json] = []
    try:
        for sentence in sentences(claim, limits.tick):
            theory = _lemmas(sentence, claim.ring, limits)
            if theory is not None:
                proofs.append({"theory": theory})
                continue
            proof = certificate_for(rename_apart(sentence), TRUE, options, limits.budget.part(CASE_WORK))
            if proof is None:
                return None
            assert isinstance(proof.payload, dict)
            proofs.append(proof.payload)
    except CertificateRejected:
        return None
    except Unable:
        limits.budget.check("prove")
        return None
    return proofs


def _lemmas(sentence: Formula, ring: Ring, limits: Limits) -> Json | None:
    """Lemmas that make a sentence true, whatever its quantified parts say."""
    try:
        goals = check_block.obligations(by_lemmas(sentence, ring, Entry({"theory": EMPTY}, "evidence")), ())
        return refuting(goals, ring, limits)
    except Unable:
        limits.budget.check("prove")
        return None
