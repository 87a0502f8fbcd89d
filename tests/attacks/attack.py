"""False claims made of true steps, and what today's checkers say of them.

``false_claim`` knows nothing of evidence. ``accepted_evidence`` offers a claim as a derivation of one step, with the
evidence of the true step, with the same after the near miss, with nested steps that begin and end as the claim says,
and with lemmas that are looked for anew. A step of an elaborated rule is offered as the steps that are made of it.
"""

from __future__ import annotations

import json
import random
from collections.abc import Iterator
from copy import deepcopy
from dataclasses import dataclass
from typing import Any

from qe.certify.registry import RULES
from qe.errors import CertificateRejected, QEError, Unable
from qe.exact.ring import Ring
from qe.formula.build import conj, exists
from qe.formula.syntax import And, Formula, Not
from qe.kernel.boolean import ByLemmas
from qe.kernel.derivation import check_derivation, limits_of, replaced
from qe.kernel.negation import negation, normal
from qe.kernel.step import Claim
from qe.kernel.verdict import CRASHES
from qe.options import Budget
from qe.proof.derivation import moved
from qe.proof.entry import Entry, Json, formula_from_json, formula_to_json
from qe.proving.elaborators import ELABORATORS
from qe.proving.lemma_list import EMPTY
from qe.proving.lemmas import refuting
from tests.attacks.falsity import Point, counterexample
from tests.attacks.near_misses import Change, Equivalence, NearMiss
from tests.attacks.true_steps import TrueStep
from tests.certificates.altered_derivations import polynomials, steps

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
    """Whether the kernel accepts the claim with this evidence; where the rule is elaborated, the steps made of it."""
    steps = elaborated(rule, claim, evidence) if rule in ELABORATORS else None
    if steps is not None and is_accepted("steps", claim, {"steps": steps}):
        return True
    if rule not in RULES:
        return False
    try:
        check_derivation(derivation(rule, claim, evidence), Budget(SECONDS), RULES)
    except (CertificateRejected, Unable):
        return False
    return True


def elaborated(rule: str, claim: Equivalence, evidence: Json) -> list[Json] | None:
    """The steps of primitives that are made of a step of another rule; None where there are none."""
    made = Claim(rule, claim.before, claim.after, claim.ring, Entry(evidence, "evidence"), "step")
    try:
        return ELABORATORS[rule](made, claim.facts, limits_of(Budget(SECONDS), RULES))
    except CRASHES:  # nothing is trusted here, and no step came of it
        return None


def evidences(step: TrueStep, false: FalseClaim) -> Iterator[Json]:
    """Evidence for a false claim: that of the true step, the same changed like the claim, and so that nested steps
    begin and end as the claim says; and the last ones with new lemmas."""
    changed, claim = step.evidence, false.claim
    yield changed
    if false.change is not None:
        changed = followed(changed, claim.ring, false.change)
        yield changed
    fitted = fitting(changed, equivalence(step), claim)
    if fitted != changed:
        yield fitted
    if step.rule in RULES:
        new = deepcopy(derivation(step.rule, claim, fitted))
        if with_new_lemmas(new, claim.ring):
            yield new["steps"][0]["evidence"]


def fitting(evidence: Json, true: Equivalence, false: Equivalence) -> Json:
    """The evidence with the formulas of the false claim in place of those of the true one, and with what a primitive
    derives from these."""
    others = {json.dumps(_json(old)): _json(new) for old, new in zip(_ends(true), _ends(false), strict=True)}

    def walk(node: Json) -> Json:
        if isinstance(node, list):
            other = others.get(json.dumps(node))
            return [walk(part) for part in node] if other is None else deepcopy(other)
        return {key: walk(part) for key, part in node.items()} if isinstance(node, dict) else node

    return walk(evidence)


def _ends(claim: Equivalence) -> Iterator[Formula]:
    """Formulas with which nested steps begin or end."""
    sides = (claim.before, claim.after)
    for one, other in (sides, sides[::-1]):
        body = conj((*map(normal, claim.facts), normal(one), negation(other)))
        yield from (one, negation(one), body, exists(body.free, body))


def with_new_lemmas(data: Json, ring: Ring) -> bool:
    """Whether there are any: lemmas are looked for anew for all steps in the data that need them, also nested ones."""
    limits, any_new = limits_of(Budget(TO_SEARCH), RULES), False
    try:
        for made in list(steps(data)):
            checker = RULES.get(made["rule"])
            if isinstance(checker, ByLemmas) and isinstance(made["evidence"], dict):
                made["evidence"]["theory"] = EMPTY
                before, after, *context = (
                    formula_from_json(Entry(f, ""), ring, quantified=True)
                    for f in (made["before"], made["after"], *made["context"])
                )
                claim = Claim(made["rule"], before, after, ring, Entry(made["evidence"], "evidence"), "step")
                theory = refuting(checker.obligations(claim, tuple(context)), ring, limits)
                if theory is None:
                    return False
                made["evidence"]["theory"], any_new = theory, True
    except (CertificateRejected, Unable):
        return False
    return any_new


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
