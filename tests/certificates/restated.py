"""Certificates whose sentence is read off the evidence of their one step: whether it is that, and it made anew."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

from qe.certify.claims import claim_of
from qe.expert import classification, optimum, solutions
from qe.expert.sentences import Sentence
from qe.kernel.renaming import is_same
from qe.kernel.verdict import CRASHES
from qe.options import Budget
from qe.proof.certificate import Certificate, digest
from qe.proof.entry import Entry
from tests.certificates.mutation import evidence_in

Data = dict[str, Any]
SENTENCES: dict[str, Callable[[Entry], Sentence]] = {
    "multipliers": lambda evidence: optimum.sentence(evidence, Budget()),
    "solutions": lambda evidence: solutions.sentence(evidence, Budget()),
    "classification": classification.sentence,
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
