"""Evidence for the rule "comprehensive Gröbner system": what its checker asks about the parameters, proved. Nothing here
is trusted."""

from __future__ import annotations

from qe.certify.block import check_block
from qe.certify.claims import is_about
from qe.certify.counted_solutions import sentences
from qe.certify.step import Claim, Limits
from qe.elimination.cad import certificate_for
from qe.errors import CertificateRejected, Unable
from qe.formula.normal import rename_apart
from qe.formula.syntax import TRUE, Formula
from qe.options import Options
from qe.proof.certificate import Certificate, written
from qe.proof.entry import Entry, Json
from qe.proving.lemma_list import EMPTY
from qe.proving.lemmas import refuting

CASE_WORK = 20_000
"""Units of work for a decomposition that proves one case."""


def case_proofs(claim: Claim, options: Options, limits: Limits) -> list[Json] | None:
    """A certificate for each case of a block over equations; None where one of them is not found."""
    found: list[Json] = []
    try:
        for sentence in sentences(claim, limits.tick):
            proof = _by_lemmas(sentence, limits) or certificate_for(
                rename_apart(sentence), TRUE, options, limits.budget.part(CASE_WORK)
            )
            if proof is None or is_about(proof, sentence) != TRUE:
                return None
            found.append(proof.to_data())
    except CertificateRejected:
        return None
    except Unable:
        limits.budget.check("prove")
        return None
    return found


def _by_lemmas(sentence: Formula, limits: Limits) -> Certificate | None:
    """The truth of a sentence for all signs that lemmas allow; quantified parts stay as they are."""
    ring = sentence.ring
    assert ring is not None
    claim = Claim("simplification", sentence, TRUE, ring, Entry({"theory": EMPTY}, "evidence"), "step")
    try:
        goals = check_block.obligations(claim, ())
        theory = refuting(goals, ring, limits) if goals else EMPTY
    except Unable:
        limits.budget.check("prove")
        return None
    if theory is None:
        return None
    step = written("simplification", (), sentence, TRUE, (), {"theory": theory})
    return Certificate.derivation(ring.names, sentence, [step], TRUE)
