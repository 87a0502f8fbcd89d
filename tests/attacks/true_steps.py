"""Answers of the engine with all their steps, those inside evidence too, as certificates have them."""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import dataclass

from qe.engine.run import answered
from qe.exact.ring import Ring
from qe.formula.syntax import Formula
from qe.io.names import names_in
from qe.io.text import read
from qe.options import Budget, Options
from qe.proof.derivation import moved, put_together
from qe.proof.entry import Entry, Json, formula_from_json
from qe.proof.run_log import Choice, RunLog
from qe.proof.step import Step
from qe.proving.prover import Prover
from qe.rules.preparation import prepare
from qe.rules.step import StepKind
from tests.attacks.questions import filled
from tests.attacks.rules import FORMER
from tests.certificates.altered_derivations import steps

SECONDS, TO_PROVE = 2.0, 10.0
"""Limits of an answer and of its evidence."""
KINDS = {kind.value: kind for kind in StepKind}


@dataclass(frozen=True, slots=True)
class TrueStep:
    """``before`` <-> ``after`` wherever the ``facts`` hold, by the theorem of the ``rule``, with accepted evidence."""

    rule: str
    ring: Ring
    before: Formula
    after: Formula
    facts: tuple[Formula, ...]
    evidence: Json


@dataclass(frozen=True, slots=True)
class Answered:
    """A question, its answer, the steps between them, the rules of ``unchecked`` ones (which need no evidence where a
    witness proves the answer), and the methods."""

    question: Formula
    answer: Formula
    steps: tuple[TrueStep, ...]
    unchecked: tuple[str, ...]
    methods: tuple[str, ...]
    is_witnessed: bool

    @property
    def rules(self) -> set[str]:
        """What fired."""
        return {step.rule for step in self.steps} | set(self.unchecked)


def answered_with_steps(question: Formula, options: Options) -> Answered:
    """The engine's answer. Raises ``Unable`` where it has none within ``SECONDS``."""
    found = answered(question, options, Budget(SECONDS))
    taken, unchecked = proved(question, found.log, found.formula, options)
    methods = tuple(entry.method for entry in found.log.entries if isinstance(entry, Choice))
    return Answered(question, found.formula, taken, unchecked, methods, found.witness is not None)


def taken_alone(question: Formula, rule: str) -> tuple[TrueStep, ...]:
    """What one rule of preparation does when it is the only one: other rules leave it fewer quantifiers."""
    if rule not in KINDS:
        return ()
    log = RunLog()
    answer = prepare(question, enabled={KINDS[rule]}, log=log).formula
    return proved(question, log, answer, Options())[0]


def proved(
    question: Formula, log: RunLog, answer: Formula, options: Options
) -> tuple[tuple[TrueStep, ...], tuple[str, ...]]:
    """The steps of a log for which evidence is accepted, those inside it too, and the rules of the others."""
    derivation = put_together(question, log.steps(), answer)
    formulas = (question, answer, *(s.before for s in derivation.steps))
    prover = Prover(Ring.of(dict.fromkeys(n for f in formulas for n in names_in(f))), options, Budget(TO_PROVE))
    prover.whole(derivation, moved(derivation.start, prover.ring), moved(answer, prover.ring))
    return tuple(_read(prover.steps, prover.ring)), tuple(prover.unchecked)


def former_step(rng: random.Random, rule: str) -> TrueStep:
    """A step of a rule that nothing makes any more."""
    seed = rng.random()
    before, after = (read(filled(random.Random(seed), text)) for text in FORMER[rule])
    ring = Ring.of(dict.fromkeys((*names_in(before), *names_in(after))))
    step = Step(rule, moved(before, ring), moved(after, ring))
    found = Prover(ring, Options(), Budget(TO_PROVE)).evidence(step, ())
    assert found is not None, step
    return TrueStep(rule, ring, step.before, step.after, (), found[1])


def _read(listed: list[Json], ring: Ring) -> Iterator[TrueStep]:
    for data in steps(listed):
        before, after, *facts = (
            formula_from_json(Entry(part, ""), ring, quantified=True)
            for part in (data["before"], data["after"], *data["context"])
        )
        yield TrueStep(data["rule"], ring, before, after, tuple(facts), data["evidence"])
