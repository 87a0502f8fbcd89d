"""From what is asked to an answer, with or without assumptions, and its certificate."""

from __future__ import annotations

from dataclasses import replace

from qe.elimination.protocol import Known
from qe.engine import run
from qe.exact.ring import Ring
from qe.formula.assumed import Aim, Posed, claimed
from qe.formula.build import convert
from qe.formula.counting import without_root_atoms
from qe.formula.normal import rename_apart, without_clashes
from qe.formula.syntax import TRUE
from qe.options import Budget, Options
from qe.proof.answer import Answer
from qe.proof.run_log import RunLog
from qe.proving.certificates import NOT_WANTED, derived_or_decomposed


def answered(problem: Posed, options: Options, budget: Budget) -> Known:
    """What is found, with no certificate but one that a method made on its way. Raises ``Unable``."""
    if problem.known == TRUE and problem.aim is Aim.EQUIVALENT:
        return Known(problem.formula, run.answered(problem.formula, options, budget), plainly=True)
    from qe.engine.assuming import answered_assuming, simplified

    clear = without_clashes(problem.formula)
    log = RunLog()
    log.step("renaming", problem.formula, clear)
    if problem.aim is Aim.SHORTER:
        made = simplified(clear, problem.known, options, budget)
    else:
        plain = log.step("roots counted", clear, without_root_atoms(clear))
        known = problem.known if plain.ring is None else convert(problem.known, plain.ring)
        made = answered_assuming(plain, known, options, budget, generic=problem.aim is Aim.GENERIC)
    made.outcome.log.entries[:0] = log.entries
    formula, ring = made.outcome.formula, Ring.of(problem.formula.free) if problem.formula.free else None
    outcome = made.outcome
    if ring is not None and formula.is_quantifier_free:
        outcome = replace(outcome, formula=convert(formula, ring))
    given = made.assuming if ring is None else convert(made.assuming, problem.formula.ring or ring)
    return replace(made, question=problem.formula, outcome=outcome, assuming=given)


def proved(known: Known, options: Options, budget: Budget) -> Known:
    """The same with its certificate, where one is wanted."""
    if known.plainly:
        return replace(known, outcome=run.proved(known.question, known.outcome, options, budget))
    if not options.certify:
        return replace(known, outcome=replace(known.outcome, reason=NOT_WANTED))
    problem, said = (claimed(known.assuming, known.question, f) for f in (known.question, known.outcome.formula))
    question = rename_apart(without_root_atoms(without_clashes(problem)))
    proof = derived_or_decomposed(problem, question, known.outcome.log, said, options, budget)
    outcome = replace(known.outcome, certificate=proof.certificate, unchecked=proof.unchecked)
    return replace(known, outcome=replace(outcome, checked=proof.checked, reason=proof.reason))


def answer_to(known: Known) -> Answer:
    """The outcome as an answer, nothing verified yet."""
    return replace(run.answer_to(known.question, known.outcome), assuming=known.assuming, generic=known.generic)
