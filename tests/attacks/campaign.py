"""A campaign against one rule: questions on which it fires, their answers looked at, and its steps attacked.

``python -m tests.attacks.campaign FORMULAS CLAIMS [RULE ...]`` prints the counts of each rule and every hole.
"""

from __future__ import annotations

import json
import random
import sys
from collections import Counter
from dataclasses import dataclass, field

from qe.certify.registry import RULES as CHECKERS
from qe.errors import QEError, Unable
from qe.proving.elaborators import ELABORATORS
from qe.proving.primitive_names import BY_SIGNS, SIGNS
from tests.attacks.attack import accepted_evidence, derivation, equivalence, false_claim, is_accepted
from tests.attacks.falsity import points, truth
from tests.attacks.near_misses import CAPTURES, OTHERS
from tests.attacks.rules import METHODS, PRIMITIVES, RULES, STATED
from tests.attacks.true_steps import Answered, TrueStep, answered_with_steps, taken_alone

ATTACKED = tuple(r for r in dict.fromkeys((*CHECKERS, *ELABORATORS, *BY_SIGNS)) if r not in STATED)
"""What a step of a certificate, or of a derivation, may be called."""

QUESTIONS = 60
"""So many for each on which a rule is to fire, and for each false claim, are tried at most."""

STEPS = 3
"""Steps of one question that are attacked."""


@dataclass(slots=True)
class Counts:
    """``fired``: questions on whose way a rule or method was used; ``compared``: values of their answers at points;
    ``wrong``: those that differ; ``unproved``: questions where a step of the rule has no evidence. ``claims``: false
    ones, by near miss; ``holes``: derivations of such that are accepted; ``crashes``: errors that are no rejections."""

    fired: int = 0
    compared: int = 0
    claims: Counter[str] = field(default_factory=Counter)
    wrong: list[str] = field(default_factory=list)
    unproved: list[str] = field(default_factory=list)
    holes: list[str] = field(default_factory=list)
    crashes: list[str] = field(default_factory=list)


def campaign(name: str, seed: int, formulas: int, claims: int) -> Counts:
    """Against a rule, or with a method, until so many questions made it fire and so many claims were offered."""
    rng, counts = random.Random(f"{name} {seed}"), Counts()
    for _ in range(QUESTIONS * (formulas + claims)):
        if counts.fired >= formulas and counts.claims.total() >= claims:
            break
        for step in _steps(rng, name, counts, answer=counts.fired < formulas):
            _attacked(rng, step, counts, claims)
    return counts


def _steps(rng: random.Random, name: str, counts: Counts, *, answer: bool) -> list[TrueStep]:
    """Some true steps of a rule, by a random question; none by a method that is not a rule."""
    rule = rng.choice(PRIMITIVES.get(name, (name,)))
    row = RULES[rule] if rule in RULES else METHODS[rule]
    question, called = row.question(rng), SIGNS if name in BY_SIGNS else name
    steps = [step for step in taken_alone(question, rule) if step.rule == called]
    if answer or not steps:
        try:
            found = answered_with_steps(question, row.options)
        except Unable:
            return steps
        _looked_at(rng, name, found, counts)
        steps += [step for step in found.steps if step.rule == called]
    different = list({(step.before, step.after): step for step in steps}.values())
    return rng.sample(different, min(STEPS, len(different)))


def _looked_at(rng: random.Random, name: str, found: Answered, counts: Counts) -> None:
    """Whether the rule fired, its evidence was accepted, and the answer is right at some points."""
    if name not in found.rules and name not in found.methods:
        return
    counts.fired += 1
    text = f"{found.question} <-> {found.answer}"
    if name in found.unchecked and not found.is_witnessed:
        counts.unproved.append(text)
    for point in points(rng, (found.question, found.answer), found.question.free, 2):
        values = [truth(side, point) for side in (found.answer, found.question)]
        if None not in values:
            counts.compared += 1
            counts.wrong += [f"{text} at {point}"] if values[0] is not values[1] else []


def _attacked(rng: random.Random, step: TrueStep, counts: Counts, wanted: int) -> None:
    """Near misses of a step, offered until there are enough."""
    assert is_accepted(step.rule, equivalence(step), step.evidence), (step.rule, step.before, step.after)
    for near_miss in (*rng.sample(CAPTURES, 3), *rng.sample(OTHERS, 7)):
        if counts.claims.total() < wanted:
            false = false_claim(rng, step, near_miss)
            if false is not None:
                counts.claims[false.near_miss] += 1
                try:
                    evidence = accepted_evidence(step, false)
                except QEError as error:  # neither a rejection nor "not decided"
                    counts.crashes.append(f"{error!r}: {json.dumps(derivation(step.rule, false.claim, step.evidence))}")
                    continue
                if evidence is not None:
                    counts.holes.append(json.dumps(derivation(step.rule, false.claim, evidence)))


def main(formulas: int, claims: int, chosen: list[str]) -> int:
    """Print what comes of it; the number of holes and wrong answers."""
    total: Counter[str] = Counter()
    bad = 0
    for name in chosen or [*ATTACKED, *(m for m in METHODS if m not in ATTACKED)]:
        counts = campaign(name, 0, formulas, claims if name in ATTACKED else 0)
        total += counts.claims
        listed = (*counts.holes, *counts.crashes, *counts.wrong)
        bad += len(listed)
        print(
            f"{name:42} fired {counts.fired:4} compared {counts.compared:4} unproved {len(counts.unproved):3}",
            f"claims {counts.claims.total():5} accepted {len(counts.holes)} crashes {len(counts.crashes)}",
            f"wrong {len(counts.wrong)}",
        )
        print(*listed, sep="\n", end="\n" if listed else "", flush=True)
    print(f"{total.total()} false claims", dict(total), flush=True)
    return bad


if __name__ == "__main__":
    sys.exit(min(main(int(sys.argv[1]), int(sys.argv[2]), sys.argv[3:]), 1))
