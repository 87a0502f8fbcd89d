"""False claims made of true steps, and what today's checkers say of them.

``false_claim`` knows nothing of evidence. ``accepted_evidence`` offers a claim as a derivation of one step, with the
evidence of the true step, with the same after the near miss, and with lemmas that are looked for anew.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from copy import deepcopy
from dataclasses import dataclass
from typing import Any

from qe.certify.boolean import ByLemmas
from qe.certify.derivation import check_derivation, limits_of, replaced
from qe.certify.registry import RULES
from qe.certify.step import Claim
from qe.certify.verify import check_certificate
from qe.errors import CertificateRejected, QEError, Unable
from qe.exact.ring import Ring
from qe.formula.syntax import And, Formula, Not
from qe.options import Budget
from qe.proof.derivation import moved
from qe.proof.entry import Entry, Json, formula_to_json
from qe.proving.lemma_list import EMPTY
from qe.proving.lemmas import refuting
from tests.attacks.falsity import Point, counterexample
from tests.attacks.near_misses import Change, Equivalence, NearMiss
from tests.attacks.true_steps import TrueStep
from tests.certificates.altered_derivations import polynomials

SPARE = "k"
"""A letter that a near miss may need."""
SECONDS, TO_SEARCH = 5.0, 0.5
"""Limits of one step, and of the search for its lemmas."""


@dataclass(frozen=True, slots=True)
class FalseClaim:
    """``claim`` is false: at ``point`` the facts hold, and only one side does; ``truth`` is that of ``before``."""

    claim: Equivalence
    near_miss: str
    change: Change | None
    point: Point
    truth: bool


def equivalence(step: TrueStep) -> Equivalence:
    """What the step claims, over a ring with a letter to spare."""
    names = step.ring.names
    ring = Ring.of((*names, next(n for n in (SPARE, SPARE * 2, SPARE * 3) if n not in names)))
    before, after, *facts = (moved(f, ring) for f in (step.before, step.after, *step.facts))
    return Equivalence(before, after, tuple(facts), ring)


def false_claim(rng: random.Random, step: TrueStep, near_miss: NearMiss) -> FalseClaim | None:
    """A near miss of what a step claims, if it is seen to be false."""
    made = near_miss(rng, equivalence(step))
    if made is None:
        return None
    claim, change = made
    at = counterexample(rng, claim.before, claim.after, claim.facts)
    return None if at is None else FalseClaim(claim, near_miss.__name__, change, *at)


def derivation(rule: str, claim: Equivalence, evidence: Json) -> dict[str, Any]:
    """A derivation whose one step makes the claim where its facts hold."""
    start, place = claim.before, []
    if claim.facts:
        start, place = And((*claim.facts, Not(Not(claim.before)))), [len(claim.facts), 0, 0]
    at: Json = [*place]
    _, answer = replaced(start, place, claim.before, claim.after, (), Entry(at, "at"))
    step = {"rule": rule, "at": at, "evidence": evidence, "context": [_json(f) for f in claim.facts]}
    step |= {"before": _json(claim.before), "after": _json(claim.after)}
    return {"order": list(claim.ring.names), "start": _json(start), "steps": [step], "answer": _json(answer)}


def _json(formula: Formula) -> Json:
    return formula_to_json(formula, quantified=True)


def is_accepted(rule: str, claim: Equivalence, evidence: Json) -> bool:
    """Whether the checker of the rule accepts the claim with this evidence."""
    try:
        check_derivation(derivation(rule, claim, evidence), Budget(SECONDS), RULES, check_certificate)
    except (CertificateRejected, Unable):
        return False
    return True


def evidences(step: TrueStep, false: FalseClaim) -> Iterator[Json]:
    """Evidence for a false claim: that of the true step, the same changed like the claim, and with new lemmas."""
    yield step.evidence
    if false.change is not None:
        yield followed(step.evidence, false.claim.ring, false.change)
    checker = RULES[step.rule]
    if isinstance(checker, ByLemmas) and isinstance(step.evidence, dict):
        evidence = {**step.evidence, "theory": EMPTY}
        made, entry = false.claim, Entry(evidence, "evidence")
        claim = Claim(step.rule, made.before, made.after, made.ring, entry, "step")
        limits = limits_of(Budget(TO_SEARCH), RULES, check_certificate)
        try:
            theory = refuting(checker.obligations(claim, made.facts), made.ring, limits)
        except (CertificateRejected, Unable):
            return
        if theory is not None:
            yield {**evidence, "theory": theory}


def followed(evidence: Json, ring: Ring, change: Change) -> Json:
    """The evidence with its names and polynomials changed; as it was where nothing comes of that."""
    data: dict[str, Any] = {"payload": {"order": list(ring.names), "evidence": deepcopy(evidence)}}
    try:
        polynomials(data, change.poly, change.name)
    except (QEError, LookupError, ValueError):
        return evidence
    changed: Json = data["payload"]["evidence"]
    return changed


def accepted_evidence(step: TrueStep, false: FalseClaim) -> Json:
    """Evidence with which a false claim is accepted: a hole. None where all is refused."""
    return next((e for e in evidences(step, false) if is_accepted(step.rule, false.claim, e)), None)
