"""Answers of the engine with all their steps, those inside evidence too, as certificates have them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any
from unittest.mock import patch

from qe.engine.run import answered
from qe.exact.ring import Ring
from qe.formula.syntax import Formula
from qe.io.names import names_in
from qe.kernel.step import Limits
from qe.options import Budget, Options
from qe.proof.derivation import moved, put_together
from qe.proof.entry import Entry, Json, formula_from_json
from qe.proof.on_demand import completed
from qe.proof.run_log import Choice, RunLog
from qe.proof.step import Place, Step
from qe.proving.elaborators import ELABORATORS
from qe.proving.nested import names_within, proved_inside
from qe.proving.prover import Prover
from qe.rules.preparation import prepare
from qe.rules.step import StepKind
from tests.certificates.altered_derivations import steps

SECONDS, TO_PROVE = 2.0, 10.0
"""Limits of an answer and of its evidence."""
KINDS = {kind.value: kind for kind in StepKind}


@dataclass(frozen=True, slots=True)
class TrueStep:
    """``before`` <-> ``after`` wherever the ``facts`` hold, by the theorem of the ``rule``, with accepted evidence.

    Of a rule that is elaborated, the evidence is that from which the steps of primitives are made.
    """

    rule: str
    ring: Ring
    before: Formula
    after: Formula
    facts: tuple[Formula, ...]
    evidence: Json


@dataclass(frozen=True, slots=True)
class Answered:
    """A question, its answer, the steps between them, the ``rules`` that fired and those of ``unchecked`` steps (which
    need no evidence where a witness proves the answer), and the methods."""

    question: Formula
    answer: Formula
    steps: tuple[TrueStep, ...]
    rules: frozenset[str]
    unchecked: tuple[str, ...]
    methods: tuple[str, ...]
    is_witnessed: bool


def answered_with_steps(question: Formula, options: Options) -> Answered:
    """The engine's answer. Raises ``Unable`` where it has none within ``SECONDS``."""
    found = answered(question, options, Budget(SECONDS))
    with producing() as produced:
        taken, unchecked = proved(question, found.log, found.formula, options)
    methods = tuple(entry.method for entry in found.log.entries if isinstance(entry, Choice))
    rules = frozenset(produced) | {step.rule for step in taken}
    return Answered(question, found.formula, taken, rules, unchecked, methods, found.witness is not None)


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
    budget = Budget(TO_PROVE)
    derivation = put_together(question, tuple(completed(step, budget) for step in log.steps()), answer)
    formulas = (question, answer, *(s.before for s in derivation.steps))
    names = (*(n for f in formulas for n in names_in(f)), *names_within(list(derivation.steps)))
    prover = Prover(Ring.of(dict.fromkeys(names)), options, budget)
    with elaborated() as steps:
        prover.whole(derivation, moved(derivation.start, prover.ring), moved(answer, prover.ring))
    return (*_read(prover.steps, prover.ring), *steps), tuple(prover.unchecked)


@contextmanager
def elaborated() -> Iterator[list[TrueStep]]:
    """The steps of elaborated rules that provers take meanwhile, also inside evidence, with their own."""
    taken: list[TrueStep] = []
    original = Prover._at

    def at(prover: Prover, place: Place, step: Step, current: Formula) -> Formula:
        before = len(prover.steps)
        changed = original(prover, place, step, current)
        if step.rule in ELABORATORS and len(prover.steps) == before + 1:
            made = prover.steps[-1]
            assert isinstance(made, dict)
            evidence = own_evidence(prover, step, made)
            if evidence is not None:
                facts = _facts(made, prover.ring)
                taken.append(TrueStep(step.rule, prover.ring, step.before, step.after, facts, evidence))
        return changed

    with patch.object(Prover, "_at", at):
        yield taken


@contextmanager
def producing() -> Iterator[set[str]]:
    """The rules of the steps for which provers look for evidence meanwhile."""
    rules: set[str] = set()
    own, named = Prover.own, Prover._named

    def noted(prover: Prover, step: Step, context: tuple[Formula, ...]) -> tuple[str, Json] | None:
        rules.add(step.rule)
        return own(prover, step, context)

    def noted_inside(prover: Prover, rule: str, step: Step, *rest: Any) -> tuple[str, Json] | None:
        rules.add(step.rule)
        return named(prover, rule, step, *rest)

    with patch.object(Prover, "own", noted), patch.object(Prover, "_named", noted_inside):
        yield rules


def own_evidence(prover: Prover, step: Step, made: dict[str, Json]) -> Json:
    """The evidence from which the steps of a rule were made; None where it was proved otherwise."""
    proof = step.evidence.get("proof")
    if made["rule"] != "steps":
        return None
    facts = _facts(made, prover.ring)
    return _proved_inside(prover, step, prover._json(proof), facts) if isinstance(proof, Mapping) else {}


def _proved_inside(prover: Prover, step: Step, plain: Json, facts: tuple[Formula, ...]) -> Json:
    """Evidence with the steps of the derivations inside it."""
    claim = prover._claim(step.rule, step, plain)

    def read_by_it(limits: Limits) -> Json:
        ELABORATORS[step.rule](claim, facts, limits)
        return plain

    return proved_inside(read_by_it, prover.limits, prover.nested)


def _read(listed: list[Json], ring: Ring) -> Iterator[TrueStep]:
    for data in steps(listed):
        sides = (Entry(data[side], "") for side in ("before", "after"))
        before, after = (formula_from_json(side, ring, quantified=True) for side in sides)
        yield TrueStep(data["rule"], ring, before, after, _facts(data, ring), data["evidence"])


def _facts(data: dict[str, Json], ring: Ring) -> tuple[Formula, ...]:
    """What the step uses of its surroundings."""
    return tuple(formula_from_json(e, ring, quantified=True) for e in Entry(data["context"], "").items())
