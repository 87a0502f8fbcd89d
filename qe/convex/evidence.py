"""Certificates of optima: the sentence that multipliers prove, by one step."""

from __future__ import annotations

from typing import Any

from qe.expert.convex_problem import PROBLEM
from qe.expert.optimum import sentence
from qe.options import Budget
from qe.proof.certificate import Certificate
from qe.proof.entry import Entry
from qe.proof.multipliers import OptimumEvidence, to_payload


def optimum_certificate(evidence: OptimumEvidence) -> Certificate:
    """That this is the optimum, or that there is none."""
    data: Any = to_payload(evidence)
    entry = Entry(data, "evidence")
    order = Entry(data["problem"], "problem").fields(*PROBLEM)[0].names()
    return Certificate.step("multipliers", order, *sentence(entry, Budget()), data)
