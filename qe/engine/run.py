"""The line from a formula to an answer: rename, prepare, eliminate by the strategy, shorten, certify.

Innermost quantifiers go first. Every block goes through the attempts of ``STRATEGY`` in their order until one ends;
what that one leaves quantified goes through them again. This is the only place that catches ``Unable`` and lets
another method try; every choice and every switch is in the log, and every change of a formula is a step of it.
"""

from __future__ import annotations

import time
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from fractions import Fraction

from qe.elimination.protocol import Context, Outcome
from qe.engine.reductions import gathered_block, lifted_values, to_dual
from qe.engine.redundant import Start
from qe.engine.strategy import SPARE, Attempt, Scope, Spare, alone, attempts, chosen_alone, complete
from qe.errors import Contradiction, Unable
from qe.exact.number import Values
from qe.exact.ring import Ring
from qe.formula.block import Block
from qe.formula.build import conj, convert, disj, exists, forall, neg
from qe.formula.counting import without_root_atoms
from qe.formula.evaluate import holds_at
from qe.formula.normal import nnf, rename_apart, without_clashes
from qe.formula.syntax import FALSE, TRUE, And, Constant, Formula, Not, Or
from qe.formula.traverse import bound_variables, has_root_atoms, subformulas
from qe.options import Budget, Options
from qe.proof.answer import Answer, Status
from qe.proof.run_log import RunLog
from qe.proving.certificates import certificate_of
from qe.rules.preparation import Prepared, prepare
from qe.rules.step import steps_without
from qe.simplifier.presented import presented
from qe.simplifier.simplify import simplify

MOST_TRIED = 200
"""Variables of a block whose values are tried: each condition of many takes time that grows with their number."""


def solve(formula: Formula, options: Options, budget: Budget) -> Outcome:
    """A quantifier-free formula equivalent to ``formula`` over R, with what else is known, and its certificate.

    Raises ``Unable`` (``BudgetExceeded`` at a limit) when no method finished.
    """
    return proved(formula, answered(formula, options, budget), options, budget)


def answered(formula: Formula, options: Options, budget: Budget) -> Outcome:
    """As ``solve``, with no certificate but one that a method made on its way."""
    started = time.perf_counter()
    run, free = _Run(options, budget), formula.free
    clear = run.log.step("renaming", formula, without_clashes(formula))
    plain = run.log.step("roots counted", clear, _counted(clear, options))
    outcome = run.outcome(run.log.step("renaming", plain, rename_apart(plain)))
    if outcome.make is None and outcome.certificate is None and not has_root_atoms(outcome.formula):
        shown = run.log.step("simplification", outcome.formula, presented(outcome.formula))
        outcome = replace(outcome, formula=shown)
    answer = convert(outcome.formula, Ring.of(free)) if free else outcome.formula
    run.log.seconds = round(time.perf_counter() - started, 6)
    return replace(outcome, formula=answer, log=run.log)


def proved(formula: Formula, outcome: Outcome, options: Options, budget: Budget) -> Outcome:
    """What was ``answered`` to a formula, with its certificate."""
    started, log = time.perf_counter(), outcome.log
    question = rename_apart(_counted(without_clashes(formula), options))
    proof = certificate_of(formula, question, outcome, log, options, budget)
    log.seconds = round((log.seconds or 0.0) + time.perf_counter() - started, 6)
    outcome = replace(outcome, certificate=proof.certificate, unchecked=proof.unchecked)
    return replace(outcome, checked=proof.checked, reason=proof.reason)


def _counted(formula: Formula, options: Options) -> Formula:
    """The formula without root atoms, unless it may keep them."""
    return formula if options.root_atoms and formula.is_quantifier_free else without_root_atoms(formula)


@dataclass(slots=True)
class _Run:
    options: Options
    budget: Budget
    log: RunLog = field(default_factory=RunLog)
    tried: set[Formula] = field(default_factory=set)
    short: set[Formula] = field(default_factory=set)
    asked: Formula = TRUE
    """What is asked, prepared: its answer is made shorter as a whole."""

    # --- the question as a whole ---------------------------------------------------------------
    def outcome(self, question: Formula) -> Outcome:
        """The answer; for sentences that begin with a quantifier also a witness or counterexample."""
        problem, mark = Block.of(question), self.log.mark()
        reduced = self.first_outcome(Scope.QUESTION, problem or Block((), question))
        outcome = self.outcome_at_length(question, problem) if reduced is None else reduced
        if problem is not None and outcome.witness is not None:
            outcome = replace(outcome, witness=exhibited(problem, outcome.witness))
        if reduced is not None:
            return outcome  # which is an answer to a question, too: nothing is to be shortened
        made = outcome.certificate is not None or outcome.make is not None
        if isinstance(outcome.formula, Constant):
            return outcome
        start = Start(question, mark, settled=made or outcome.shortest)
        return replace(outcome, formula=self.shortened(outcome.formula, start))

    def outcome_at_length(self, question: Formula, problem: Block | None) -> Outcome:
        """The same, not yet shortened."""
        if problem is not None:
            outcome = self.first_outcome_of_all(problem)
            if outcome is not None:
                return outcome
            if not problem.free:
                return self.outcome_of_sentence(problem)
        return self.outcome_of_formula(question)

    def outcome_of_sentence(self, problem: Block) -> Outcome:
        """A sentence of one outermost block, by its existential dual, with values for the block's variables."""
        dual, mark = problem.dual, self.log.mark()
        to_dual(problem, self.log)
        ready = self.prepared(dual.formula)
        if ready.formula == dual.formula and dual.is_flat:
            self.log.forget_steps(mark)
            return self.outcome_of_block(problem)
        outcome = self.outcome_of_parts(ready.formula)
        return Outcome(problem.asked(outcome.formula), lifted_values(ready, outcome, self.log))

    def outcome_of_formula(self, formula: Formula) -> Outcome:
        """A formula with parameters, or one that does not begin with a quantifier."""
        ready = self.asked = self.prepared(formula).formula
        gathered, mark, outcome = gathered_block(ready), self.log.mark(), None
        if gathered is not None:
            self.log.step("independent parts and miniscoping", ready, gathered.formula)
            outcome = self.first_outcome(Scope.PREPARED, gathered)
        if outcome is not None:
            return outcome
        self.log.forget_steps(mark)
        problem = Block.of(ready)
        if problem is None:
            return Outcome(self.without_quantifiers(ready))
        return self.first_outcome_of_all(problem) or self.eliminated(problem)

    def context(self, budget: Budget | None = None) -> Context:
        return Context(self.options, budget or self.budget, self.log, outcome_for)

    def shortened(self, formula: Formula, start: Start | None = None) -> Formula:
        from qe.engine.shortening import shortened  # which sentences do not need

        return shortened(formula, self.context(), start, self.short)

    def prepared(self, formula: Formula) -> Prepared:
        """Every block brought to its real dimension."""
        return prepare(formula, budget=self.budget, enabled=steps_without(self.options.without), log=self.log)

    # --- sentences, with their witnesses ---------------------------------------------------------
    def outcome_of_parts(self, formula: Formula) -> Outcome:
        """A sentence of existential blocks under conjunction and disjunction, with values when true."""
        match formula:
            case Constant(value):
                return Outcome(formula, {} if value else None)
            case And(args):
                return self.outcome_of_conjunction(args)
            case Or(args):
                outcomes = map(self.outcome_of_parts, args)
                return next((true for true in outcomes if true.formula == TRUE), Outcome(FALSE))
        problem = Block.of(formula)
        if problem is None:
            return Outcome(self.without_quantifiers(formula))
        return self.first_outcome_of_all(problem) or self.eliminated(problem)

    def outcome_of_conjunction(self, args: Iterable[Formula]) -> Outcome:
        values: Values = {}
        for arg in args:
            outcome = self.outcome_of_parts(arg)
            if outcome.formula == FALSE:
                return Outcome(FALSE)
            values |= outcome.witness or {}
        return Outcome(TRUE, values)

    # --- formulas ----------------------------------------------------------------------------------
    def without_quantifiers(self, formula: Formula, *, inner: bool = False) -> Formula:
        """All quantifiers removed, innermost first; with ``inner`` only those that an inner block's methods remove."""
        if formula.is_quantifier_free:
            return formula
        match formula:
            case And(args) | Or(args):
                parts = [self.without_quantifiers(a, inner=inner) for a in args]
                joined = (conj if isinstance(formula, And) else disj)(parts)
                return self.log.step("simplification", joined, simplify(joined, watch=self.budget.check))
            case Not(arg):
                return neg(self.without_quantifiers(arg, inner=inner))
        problem = Block.of(formula)
        assert problem is not None
        return self.without_inner_block(problem) if inner else self.eliminated(problem).formula

    def reduced(self, problem: Block) -> Block | Formula:
        """The problem, simplified, without the inner blocks that can be eliminated; a formula if no block remains."""
        body = self.without_quantifiers(problem.body, inner=True)
        if not body.is_quantifier_free:
            return replace(problem, body=body)
        before = replace(problem, body=body).formula
        simple = problem.asked(simplify(nnf(body, negate=problem.universal), watch=self.budget.check))
        after = (forall if problem.universal else exists)(problem.variables, simple)
        self.log.step("simplification", before, after)
        return Block.of(after) or after

    def eliminated(self, problem: Block) -> Outcome:
        """The block without quantifiers."""
        reduced = self.reduced(problem)
        if not isinstance(reduced, Block):
            return Outcome(reduced, {} if reduced == (FALSE if problem.universal else TRUE) else None)
        return self.outcome_of_block(reduced)

    def outcome_of_block(self, problem: Block) -> Outcome:
        """One block by the strategy; raises ``Unable`` where no attempt ends."""
        outcome = self.first_outcome(Scope.BLOCK if problem.is_flat else Scope.NESTED, problem)
        if outcome is None:
            raise chosen_alone(self.options.method)
        return outcome

    def without_inner_block(self, problem: Block) -> Formula:
        """A block inside another, eliminated if the strategy has an attempt that ends; as it was otherwise."""
        reduced = self.reduced(problem)
        if not isinstance(reduced, Block):
            return reduced
        outcome = self.first_outcome(Scope.INNER, reduced) if reduced.is_flat else None
        return reduced.formula if outcome is None else outcome.formula

    def first_outcome_of_all(self, problem: Block) -> Outcome | None:
        """What an attempt for whole questions gives; None where all were made before: nothing was there to prepare."""
        question = problem.dual.formula
        if question in self.tried:
            return None
        self.tried.add(question)
        return self.first_outcome(Scope.ASKED, problem)

    # --- the loop -------------------------------------------------------------------------------------
    def first_outcome(self, scope: Scope, problem: Block) -> Outcome | None:
        """What the first attempt gives that comes to an end; None if there is none."""
        last: Unable | None = None
        spare: Spare | None = None
        vain = set[str]()  # of what a closer look shows that it is not for this problem: more work does not change that
        for attempt, method, reason in attempts(scope, problem, self.options):
            if attempt.method in vain:
                continue
            mark, outcome = self.log.mark(), None
            try:
                outcome = method.run(problem, self.context(self.budget.part(SPARE if spare else attempt.work)))
                if outcome is None:
                    vain.add(attempt.method)
                elif attempt.keep(outcome, problem):
                    if outcome.back is None:
                        self.log.choice(method.name, problem.variables, reason, mark)
                    return self.completed(outcome, problem, attempt, method.name)
                else:
                    self.log.switch(method.name, "its answer is long, or leaves something to others")
            except Unable as error:
                self.budget.check("trying one method after the other")
                self.log.switch(method.name, error)
                last = error
            steps = self.log.forget_steps(mark)
            if spare is not None:
                break
            if outcome is not None and attempt.spare and complete(outcome, problem):
                spare = Spare(outcome, attempt, method.name, steps)
        if spare is not None:
            self.log.choice(spare.name, problem.variables, "its answer is long, but known")
            self.log.take_up(spare.steps)
            return self.completed(spare.outcome, problem, spare.attempt, spare.name)
        if last is not None and scope in (Scope.BLOCK, Scope.NESTED):
            raise last
        return None

    def completed(self, outcome: Outcome, problem: Block, attempt: Attempt, name: str) -> Outcome:
        """An outcome without what a method left quantified, and short where that is worth a look."""
        formula = outcome.formula
        if outcome.back is not None:
            return outcome.back(self.outcome(formula))
        if not formula.is_quantifier_free and attempt.scope is not Scope.INNER:
            if problem.formula in subformulas(formula):  # conditions around it would not change what comes next
                raise alone(name)
            self.log.switch(name, f"{', '.join(bound_variables(formula))} left for another method")
            formula = self.without_quantifiers(formula)
        if attempt.shorten and problem.free and problem.formula != self.asked:
            formula = self.shortened(formula)
        simple = self.log.step("simplification", formula, simplify(formula, watch=self.budget.check))
        return outcome if simple == outcome.formula else replace(outcome, formula=simple)


def exhibited(problem: Block, witness: Values) -> Values:
    """The values for all variables of a block. Raises ``Contradiction`` where they do not show what they should."""
    values = {v: witness.get(v, Fraction(0)) for v in problem.variables}
    numbers = {v: value for v, value in values.items() if isinstance(value, Fraction)}
    tried = problem.is_flat and not problem.free and len(values) == len(numbers) <= MOST_TRIED
    if tried and holds_at(problem.body, numbers) == problem.universal:
        raise Contradiction("the values that were found do not show the answer")
    return values


def outcome_for(question: Formula, options: Options, budget: Budget) -> Outcome:
    """The outcome for a question that comes up on the way to another, with a log of its own."""
    run = _Run(options.with_(root_atoms=False), budget)
    return replace(run.outcome(question), log=run.log)


def answer_to(question: Formula, outcome: Outcome) -> Answer:
    """The outcome as an answer, nothing verified yet."""
    return Answer(
        Status.SOLVED,
        outcome.formula,
        outcome.witness,
        outcome.certificate,
        reason=outcome.reason,
        unchecked_steps=outcome.unchecked,
        question=question,
        log=outcome.log,
    )
