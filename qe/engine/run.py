"""The line from a formula to an answer: rename, prepare, eliminate by the strategy, shorten, certify.

Innermost quantifiers go first. Every block goes through the attempts of ``STRATEGY`` in their order until one ends;
what that one leaves quantified goes through them again. This is the only place that catches ``Unable`` and lets
another method try; every choice and every switch is in the log, and every change of a formula is a step of it.
"""

from __future__ import annotations

import time
from collections.abc import Collection, Iterable
from dataclasses import dataclass, field, replace
from fractions import Fraction

from qe.elimination.protocol import Context, Outcome
from qe.engine.early import early_parts, equations, gathered_block
from qe.engine.finish import settled, shortened
from qe.engine.local import WORK, without_locals
from qe.engine.redundant import without_redundant_parts
from qe.engine.strategy import SHORTCUT, SPARE, Attempt, Scope, Spare, alone, attempts, chosen_alone, complete
from qe.errors import Unable
from qe.exact.number import Values
from qe.exact.ring import Ring
from qe.formula.block import Block
from qe.formula.build import conj, convert, disj, exists, forall, neg
from qe.formula.counting import without_root_atoms
from qe.formula.features import features
from qe.formula.normal import nnf, rename_apart, without_clashes
from qe.formula.syntax import FALSE, TRUE, And, Constant, Exists, ForAll, Formula, Not, Or
from qe.formula.traverse import subformulas
from qe.options import Budget, Method, Options, Stage
from qe.proof.answer import Answer, Status
from qe.proof.derivation import negated
from qe.proof.run_log import RunLog
from qe.proof.step import Nested
from qe.proving.certificates import certificate_of
from qe.rules.linear import may_define
from qe.rules.preparation import Prepared, prepare
from qe.rules.step import ALL_STEPS, StepKind, steps_without
from qe.simplify.simplify import simplify


def solve(formula: Formula, options: Options, budget: Budget) -> Outcome:
    """A quantifier-free formula equivalent to ``formula`` over R, with what is known beside it, and its certificate.

    Raises ``Unable`` (``BudgetExceeded`` at a limit) when no method finished.
    """
    return proved(formula, answered(formula, options, budget), options, budget)


def answered(formula: Formula, options: Options, budget: Budget) -> Outcome:
    """As ``solve``, with no certificate but one that a method made on its way."""
    started = time.perf_counter()
    run, free = _Run(options, budget), formula.free
    clear = run.log.step("renaming", formula, without_clashes(formula))
    plain = run.log.step("roots counted", clear, _counted(clear, options))
    found = run.question(run.log.step("renaming", plain, rename_apart(plain)))
    answer = convert(found.formula, Ring.of(free)) if free else found.formula
    run.log.seconds = round(time.perf_counter() - started, 6)
    return replace(found, formula=answer, log=run.log)


def proved(formula: Formula, found: Outcome, options: Options, budget: Budget) -> Outcome:
    """What was ``answered`` to a formula, with its certificate."""
    started, log = time.perf_counter(), found.log
    question = rename_apart(_counted(without_clashes(formula), options))
    proof = certificate_of(formula, question, found, log, options, budget)
    log.seconds = round((log.seconds or 0.0) + time.perf_counter() - started, 6)
    known = replace(found, certificate=proof.certificate, unchecked=proof.unchecked)
    return replace(known, checked=proof.checked, reason=proof.reason)


def _counted(formula: Formula, options: Options) -> Formula:
    """The formula without root atoms, unless it may keep them."""
    return formula if options.root_atoms and formula.is_quantifier_free else without_root_atoms(formula)


@dataclass(slots=True)
class _Run:
    options: Options
    budget: Budget
    log: RunLog = field(default_factory=RunLog)
    tried: set[Formula] = field(default_factory=set)

    # --- the question as a whole ---------------------------------------------------------------
    def question(self, formula: Formula) -> Outcome:
        """The answer; for sentences that begin with a quantifier also a witness or counterexample.

        What is there only to name a term is substituted first: no choice below depends on it.
        """
        if not may_define(formula):
            return self.unnamed(formula)
        mark = self.log.mark()
        ready = self.prepared(formula, {StepKind.DEFINITION})
        if not any(step.rule == StepKind.LINEAR.value for step in self.log.steps(mark)):
            self.log.forget_steps(mark)
            return self.unnamed(formula)
        gone, ring = {*features(formula).bound} - {*features(ready.formula).bound}, formula.ring
        assert ring is not None
        own = Ring.of(name for name in ring.names if name not in gone)  # as without the names: orders go by the ring
        found, problem = self.unnamed(convert(ready.formula, own)), Block.of(formula)
        found = replace(found, formula=convert(found.formula, ring))
        known = found.witness if type(ready.formula) is type(formula) else {}
        if problem is None or problem.free or known is None or found.formula != problem.asked(TRUE):
            return Outcome(found.formula, order=found.order)
        values = self.lifted(ready, known)
        return Outcome(found.formula, values and {v: values[v] for v in problem.variables})

    def unnamed(self, formula: Formula) -> Outcome:
        """As ``question``, for a formula without definitions."""
        problem, mark = Block.of(formula), self.log.mark()
        found = None
        if problem is not None:
            found = self.by_local_variables(problem) or self.whole(problem)
        if found is None and problem is not None and not problem.free:
            found = self.sentence(problem)
            if found.witness is not None:
                known = found.witness
                return replace(found, witness={v: known.get(v, Fraction(0)) for v in problem.variables})
            return found
        if found is None:
            found = self.formula(formula)
        off = Stage.SHORTENING in self.options.without
        if found.certificate is not None or isinstance(found.formula, Constant) or off:
            return found
        return replace(found, formula=self.finished(found.formula, formula, mark))

    def sentence(self, problem: Block) -> Outcome:
        """A sentence of one outermost block, by its existential dual, with values for the block's variables."""
        dual = problem.dual
        mark = self.log.mark()
        self.turned(problem)
        ready = self.prepared(dual.formula)
        if ready.formula == dual.formula and dual.is_flat:
            self.log.forget_steps(mark)
            return self.block(problem)
        return self.turned_back(ready, self.decided(ready.formula), problem)

    def turned(self, problem: Block) -> None:
        """The step from a problem to its existential dual."""
        rule = "duality" if problem.universal else "negation normal form"
        dual = problem.dual.formula
        self.log.step(rule, problem.formula, negated(dual) if problem.universal else dual)

    def turned_back(self, ready: Prepared, found: Outcome, problem: Block) -> Outcome:
        """The answer to a problem from that to its prepared dual, with the values of its variables."""
        truth = problem.asked(found.formula)
        if found.formula != TRUE or found.witness is None:
            return Outcome(truth)
        return Outcome(truth, self.lifted(ready, found.witness))

    def lifted(self, ready: Prepared, values: Values) -> Values | None:
        """The values of all variables of a block from those that preparation has left; None where they are too hard."""
        try:
            return ready.lift(values)
        except Unable as error:
            self.log.switch("no witness", error)
            return None

    def by_local_variables(self, problem: Block) -> Outcome | None:
        """A sentence by one without its local variables (``qe.engine.local``)."""
        if self.options.method is not Method.AUTO or Stage.MINISCOPING in self.options.without:
            return None
        shorter = without_locals(problem, self.options, self.shortly)
        if shorter is None:
            return None
        self.turned(problem)
        self.log.take_up(shorter.steps)
        found = self.question(shorter.formula)
        known = shorter.values(found, lambda sentence: self.apart(sentence, self.budget))
        return Outcome(problem.asked(found.formula), known)

    def shortly(self, block: Formula) -> Nested | None:
        """A block with parameters eliminated, if that takes little work and the answer need not be made shorter."""
        options = self.options.with_(without=self.options.without | {Stage.SHORTENING})
        try:
            return self.decision(block, Context(options, self.budget.part(WORK), self.log))
        except Unable:
            self.budget.check("local variables")
            return None

    def formula(self, formula: Formula) -> Outcome:
        """A formula with parameters, or one that does not begin with a quantifier."""
        ready = self.prepared(formula).formula
        gathered, mark = gathered_block(ready), self.log.mark()
        found = None
        if gathered is not None:
            self.log.step("independent parts and miniscoping", ready, gathered.formula)
            found = self.first_of(Scope.PREPARED, gathered)
        if found is None:
            self.log.forget_steps(mark)
        problem = Block.of(ready)
        if found is None and problem is not None:
            found = self.whole(problem) or self.eliminated(problem)
        return found if found is not None else Outcome(self.without_quantifiers(ready))

    def finished(self, formula: Formula, question: Formula, mark: int) -> Formula:
        """A last look: shorter, and TRUE or FALSE where it is that. ``mark``: where the question's own steps begin."""
        shorter = shortened(formula, self.context(), last=True)
        if Stage.REDUNDANT not in self.options.without:
            shorter = without_redundant_parts(shorter, replace(self.context(), decide=self.apart_without_points))
        return settled(shorter, self.context(), self.decision, question, mark)

    def decision(self, sentence: Formula, context: Context) -> Nested:
        """How a sentence is decided, in a run of its own within the limits of the context."""
        run = _Run(context.options.with_(root_atoms=False), context.budget)
        answer = run.question(sentence).formula
        return Nested(sentence, tuple(run.log.steps()), answer)

    def context(self, budget: Budget | None = None) -> Context:
        return Context(self.options, budget or self.budget, self.log, self.apart)

    def apart(self, sentence: Formula, budget: Budget) -> Outcome:
        """The outcome for a sentence, found in a run of its own, with its log."""
        run = _Run(self.options.with_(root_atoms=False), budget)
        return replace(run.question(sentence), log=run.log)

    def apart_without_points(self, sentence: Formula, budget: Budget) -> Outcome:
        """The same for a sentence that is likely to be false, so that trials at points would be in vain."""
        options = self.options.with_(without=self.options.without | {Stage.SAMPLES})
        return _Run(options, self.budget).apart(sentence, budget)

    # --- preparation ---------------------------------------------------------------------------
    def prepared(self, formula: Formula, kinds: Collection[StepKind] = ALL_STEPS) -> Prepared:
        """Every block brought to its real dimension by the rules of these kinds."""
        enabled = steps_without(self.options.without).intersection(kinds)
        return prepare(formula, budget=self.budget, enabled=enabled, log=self.log)

    # --- sentences, with their witnesses ---------------------------------------------------------
    def decided(self, formula: Formula) -> Outcome:
        """A sentence of existential blocks under conjunction and disjunction, with values when true."""
        match formula:
            case Constant(value):
                return Outcome(formula, {} if value else None)
            case And(args):
                return self.conjunction(args)
            case Or(args):
                return next((found for found in map(self.decided, args) if found.formula == TRUE), Outcome(FALSE))
            case Exists(variables, body) | ForAll(variables, body):
                problem = Block(variables, body, isinstance(formula, ForAll))
                return self.whole(problem) or self.eliminated(problem)
        return Outcome(self.without_quantifiers(formula))

    def conjunction(self, args: Iterable[Formula]) -> Outcome:
        values: Values = {}
        for arg in args:
            found = self.decided(arg)
            if found.formula == FALSE:
                return Outcome(FALSE)
            values |= found.witness or {}
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
            case Exists(variables, body) | ForAll(variables, body):
                problem = Block(variables, body, isinstance(formula, ForAll))
                return self.inner_block(problem) if inner else self.eliminated(problem).formula
        return formula

    def reduced(self, problem: Block) -> Block | Formula:
        """The problem, simplified, without the inner blocks that can be eliminated; a formula if none is left."""
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
        early = self.by_early_equations(problem)
        if early is not None:
            return early
        reduced = self.reduced(problem)
        if not isinstance(reduced, Block):
            return Outcome(reduced, {} if reduced == (FALSE if problem.universal else TRUE) else None)
        return self.block(reduced)

    def by_early_equations(self, problem: Block) -> Outcome | None:
        """The block by equations that some of its parts amount to (``qe.engine.early``), which prepare the others."""
        dual = problem.dual
        off = not self.options.without.isdisjoint((Stage.EQUATIONS, Stage.EARLY))
        parts = None if problem.is_flat or off else early_parts(dual.body)
        if parts is None:
            return None
        inner, (early, rest) = _Run(self.options.with_(certify=False), self.budget.part(SHORTCUT)), parts
        try:
            known = inner.question(early).formula
        except Unable as error:
            self.budget.check("trying one method after the other")
            self.log.switch("parts first", error)
            return None
        if not isinstance(known, Constant) and not any(equations(known, dual.variables)):
            self.log.switch("parts first", "they give no equations")
            return None
        self.turned(problem)
        self.log.take_up(tuple(inner.log.steps()))
        ready = self.prepared(exists(dual.variables, conj((known, rest))))
        found = Outcome(self.without_quantifiers(ready.formula)) if dual.free else self.decided(ready.formula)
        if problem.universal:
            self.log.step("negation normal form", negated(found.formula), problem.asked(found.formula))
        return self.turned_back(ready, found, problem)

    def block(self, problem: Block) -> Outcome:
        """One block by the strategy; raises ``Unable`` where no attempt ends."""
        found = self.first_of(Scope.BLOCK if problem.is_flat else Scope.NESTED, problem)
        if found is None:
            raise chosen_alone(self.options.method)
        return found

    def inner_block(self, problem: Block) -> Formula:
        """A block inside another, eliminated if the strategy has an attempt that ends; as it was otherwise."""
        reduced = self.reduced(problem)
        if not isinstance(reduced, Block):
            return reduced
        found = self.first_of(Scope.INNER, reduced) if reduced.is_flat else None
        return reduced.formula if found is None else found.formula

    def whole(self, problem: Block) -> Outcome | None:
        """What an attempt for whole questions gives; None where all were made before: nothing was there to prepare."""
        question = problem.dual.formula
        if question in self.tried:
            return None
        self.tried.add(question)
        return self.first_of(Scope.ASKED, problem)

    # --- the loop -------------------------------------------------------------------------------------
    def first_of(self, scope: Scope, problem: Block) -> Outcome | None:
        """What the first attempt gives that comes to an end; None if there is none."""
        last: Unable | None = None
        spare: Spare | None = None
        for attempt, method, reason in attempts(scope, problem, self.options):
            mark, found = self.log.mark(), None
            try:
                found = method.run(problem, self.context(self.budget.part(SPARE if spare else attempt.work)))
                if found is not None and attempt.keep(found, problem):
                    self.log.choice(method.name, problem.variables, reason, mark)
                    return self.whole_of(found, problem, attempt, method.name)
                if found is not None:
                    self.log.switch(method.name, "its answer is long, or leaves something to others")
            except Unable as error:
                self.budget.check("trying one method after the other")
                self.log.switch(method.name, error)
                last = error
            steps = self.log.forget_steps(mark)
            if spare is not None:
                return self.spared(spare, problem)
            if found is not None and attempt.spare and complete(found, problem):
                spare = Spare(found, attempt, method.name, steps)
        if spare is not None:
            return self.spared(spare, problem)
        if last is not None and scope in (Scope.BLOCK, Scope.NESTED):
            raise last
        return None

    def spared(self, spare: Spare, problem: Block) -> Outcome:
        """The outcome that was put aside."""
        self.log.choice(spare.name, problem.variables, "its answer is long, but known")
        self.log.take_up(spare.steps)
        return self.whole_of(spare.outcome, problem, spare.attempt, spare.name)

    def whole_of(self, found: Outcome, problem: Block, attempt: Attempt, name: str) -> Outcome:
        """An outcome without what a method left quantified, and short where that is worth a look."""
        formula = found.formula
        if not formula.is_quantifier_free and attempt.scope is not Scope.INNER:
            if problem.formula in subformulas(formula):  # conditions beside it would not change what comes next
                raise alone(name)
            self.log.switch(name, f"{', '.join(features(formula).bound)} left for another method")
            formula = self.without_quantifiers(formula)
        if attempt.shorten and problem.free and Stage.SHORTENING not in self.options.without:
            formula = shortened(formula, self.context())
        simple = self.log.step("simplification", formula, simplify(formula, watch=self.budget.check))
        return found if simple == found.formula else replace(found, formula=simple)


def answer_to(question: Formula, found: Outcome) -> Answer:
    """What was found as an answer, nothing verified yet."""
    return Answer(
        Status.SOLVED,
        found.formula,
        found.witness,
        found.certificate,
        reason=found.reason,
        unchecked_steps=found.unchecked,
        question=question,
        log=found.log,
    )
