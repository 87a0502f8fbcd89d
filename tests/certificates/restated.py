"""Certificates whose sentence is read off the evidence of their one step: whether it is that, and it made anew."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

from bezier.proofs import branch, inverse_position, joint_motions
from qe.certify.claims import claim_of
from qe.certify.verify import verify
from qe.errors import CertificateRejected
from qe.expert import classification, optimum, solutions
from qe.expert.sentences import Sentence
from qe.kernel.renaming import is_same
from qe.kernel.verdict import CRASHES, Verdict
from qe.options import Budget
from qe.proof.certificate import Certificate, digest
from qe.proof.entry import Entry
from tests.certificates.mutation import PLACE, evidence_in

Data = dict[str, Any]
SENTENCES: dict[str, Callable[[Entry], Sentence]] = {
    "multipliers": lambda evidence: optimum.sentence(evidence, Budget()),
    "solutions": lambda evidence: solutions.sentence(evidence, Budget()),
    "classification": classification.sentence,
    "joint positions": inverse_position.sentence,
    "joint motions": joint_motions.sentence,
    "joints along curves": branch.sentence,
}
"""By the rule: what its evidence says."""


def is_stated(data: Data) -> bool:
    """Whether the certificate claims what the evidence of its one step says."""
    claim = claim_of(Certificate.from_json(json.dumps({**data, "digest": digest(data)}))).equivalence
    said = SENTENCES[data["payload"]["steps"][0]["rule"]](Entry(evidence_in(data), "evidence"))
    return claim is not None and all(is_same(one, other) for one, other in zip(claim, said, strict=True))


def restated(data: Data) -> Data:
    """The certificate with the sentence of its evidence; as it is where it is none of these, or says nothing."""
    steps = data["payload"].get("steps")
    rule = steps[0].get("rule") if isinstance(steps, list) and steps else None
    if rule not in SENTENCES:
        return data
    evidence = evidence_in(data)
    try:
        said = SENTENCES[rule](Entry(evidence, "evidence"))
        return {**data, "payload": Certificate.step(rule, (), *said, evidence).payload}
    except CRASHES:
        return data


def verdict_by(rule: str, evidence: Data) -> Verdict:
    """The verdict on what this evidence says, whatever that is."""
    try:
        said = SENTENCES[rule](Entry(evidence, PLACE))
    except CertificateRejected as error:
        return Verdict(False, error.step, error.reason)
    return verify(Certificate.step(rule, (), *said, evidence))


def evidence_of(certificate: Certificate) -> Data:
    """A copy of the evidence of a derivation by one step."""
    return json.loads(json.dumps(evidence_in({"payload": certificate.payload})))  # type: ignore[no-any-return]
