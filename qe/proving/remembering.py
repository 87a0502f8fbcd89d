"""Checkers that check no step twice: while a certificate is made, its steps are met again and again.

What they remember is the prover's; no verdict on a certificate that is read rests on it.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping

from qe.kernel.step import Check, Claim, Context, Limits

Accepted = set[tuple[object, ...]]
"""Steps that their checkers have accepted: rule, names, formulas, context and the digest of the evidence."""


def remembering(rules: Mapping[str, Check], accepted: Accepted) -> dict[str, Check]:
    """The same checkers, but that a step among those ``accepted`` is not checked once more, and others join them."""

    def remembered(check: Check) -> Check:
        def checked(claim: Claim, context: Context, limits: Limits) -> None:
            key = step_key(claim, context)
            if key not in accepted:
                check(claim, context, limits)
                accepted.add(key)

        return checked

    return {rule: remembered(check) for rule, check in rules.items()}


def step_key(claim: Claim, context: Context) -> tuple[object, ...]:
    """All that the checker of a step may depend on."""
    evidence = json.dumps(claim.evidence.value, sort_keys=True, separators=(",", ":"))
    digest = hashlib.sha256(evidence.encode()).digest()
    return claim.rule, claim.ring.names, claim.before, claim.after, context, digest
