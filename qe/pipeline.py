"""The line from a formula to an answer: rename, prepare, choose, eliminate, construct, answer.

Innermost quantifiers go first. A block that substitution cannot finish is handed to decomposition, alone when its
body is quantifier-free, together with the quantifiers inside it otherwise. This is the only place that catches
``Unable`` and goes on with another method; every switch is recorded in the statistics.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TypeVar

from qe.eliminate.vs.far import far_first
from qe.errors import Unable
from qe.evidence.certificate import Certificate, Root
from qe.evidence.elimination import Elimination
from qe.evidence.story import Story
from qe.exact.ring import Ring
from qe.formula.build import conj, convert, disj, exists, forall, neg
from qe.formula.counting import without_root_atoms
from qe.formula.features import features
from qe.formula.normal import nnf, rename_apart
from qe.formula.syntax import FALSE, TRUE, And, Constant, Exists, ForAll, Formula, Not, Or
from qe.formula.traverse import atoms, free_variables, has_root_atoms, is_quantifier_free
from qe.options import Budget, Method, Options, Stage
from qe.pipeline_cad import Values, certificate_for, claims, decomposed, is_small, length
from qe.pipeline_vs import substituted
from qe.plan.choice import allows, planned
from qe.prepare import Prepared, prepare
from qe.prepare.linear import conjuncts
from qe.prepare.nonzero import only_nonzero
from qe.prepare.rules import components
from qe.prepare.simplify import simplify
from qe.prepare.step import ALL_STEPS, EQUATION_STEPS
from qe.solution.constant import constant_value
from qe.solution.linear_proof import substitution_certificate

Found = TypeVar("Found")

FIRST_SHARE = 0.4
"""The share of the remaining time that the first method gets while another one could take over."""

PROBE_ABOVE, PROBE_SECONDS, PROBE_SHARE, PROBE_ATOMS = 3, 1.0, 0.1, 30
"""Substitution is tried for this long before a decomposition in more variables, and taken if its answer is small."""

CERTIFY_SHARE = 0.4
"""The share of the time left after the answer that a decomposition may take for nothing but its certificate."""

CONVEX_FROM = 4
"""Existential sentences in so many variables are first tried as convex problems; with fewer, the others are faster."""

CONVEX_PARTS = 24
"""In more variables, conditions that fall apart into some without common variables are not one convex problem."""

SHORTEN_CELLS, SHORTEN_SHARE, SHORTEN_SECONDS = 2000, 0.25, 0.7
SETTLE_CELLS = 500
"""Cells that may be built to find out that an answer is true or false everywhere."""


def solve(formula: Formula, options: Options, budget: Budget) -> Elimination:
    """A quantifier-free formula equivalent to ``formula`` over R, with what is known beside it.

    Raises ``Unable`` (``BudgetExceeded`` at a limit) when no method finished.
    """
    run, free = _Run(options, budget), free_variables(formula)
    if not (options.root_atoms and is_quantifier_free(formula)):
        formula = without_root_atoms(formula)
    renamed = rename_apart(formula)
    result, values = run.sentence_or_formula(renamed)
    run.keep_or_make_certificate(renamed, result)
    if free:
        result = convert(result, Ring.of(free))
    run.story.stats["seconds"] = round(time.perf_counter() - run.started, 6)
    return Elimination(result, values, run.certificate, run.story.stats)


@dataclass(slots=True)
class _Run:
    options: Options
    budget: Budget
    started: float = field(default_factory=time.perf_counter)
    story: Story = field(default_factory=Story)
    certificate: Certificate | None = None
    whole: Formula | None = None
    shortest: Formula | None = None  # the last answer of a decomposition, which needs no shortening

    # --- the outermost shape -----------------------------------------------------------------
    def sentence_or_formula(self, formula: Formula) -> tuple[Formula, Values | None]:
        """The answer; for sentences that begin with a quantifier also a witness or counterexample."""
        if isinstance(formula, ForAll) and self._by_witness(formula):
            return TRUE, None
        if isinstance(formula, ForAll) and not free_variables(formula):
            answer, values = self.existential(Exists(formula.variables, nnf(formula.body, negate=True)))
            return neg(answer), values
        if isinstance(formula, Exists) and not free_variables(formula):
            return self.existential(formula)
        self.whole = formula
        found = self._convex_universal(formula) if isinstance(formula, ForAll) else None
        if found is None:
            ready = self.prepared(formula)
            found = self._convex_block(ready) or self.eliminate(ready)
        if self.certificate is None:
            found = self._settled(self._shortened(found))
            self.certificate = substitution_certificate(formula, found)
        return found, None

    def _convex_universal(self, formula: ForAll) -> Formula | None:
        """The answer for a universal block whose truth set is seen to be convex, by critical values."""
        from qe.pipeline_critical import convex_universal

        return self._tried("convex set", lambda part: convex_universal(formula, self.options, part, self.story))

    def _convex_block(self, ready: Formula) -> Formula | None:
        """The answer for a convex existential block with the conditions that preparation moved out of it."""
        if is_quantifier_free(ready):
            return None
        from qe.pipeline_critical import convex_block  # a large part of the engine, loaded where it may serve

        block = convex_block(ready, self.options)
        if block is None:
            return None
        return self._tried("convex block", lambda part: self._by_critical_values(*block, part))

    def _by_witness(self, formula: ForAll) -> bool:
        """Whether polynomials in the universal variables solve the blocks inside; ``False`` says nothing."""
        if is_quantifier_free(formula.body) or self.options.method is not Method.AUTO:
            return False
        from qe.solution.polynomial_witness import find as polynomial_witnesses

        found = self._tried("witness in the parameters", lambda part: polynomial_witnesses(formula, budget=part))
        for proof in found or ():
            self.story.note("plan", f"witness in the parameters: {proof}")
        return found is not None

    def existential(self, formula: Exists) -> tuple[Formula, Values | None]:
        """An existential sentence, with values for its variables if it is true."""
        self.whole = formula
        answer, lifted = self._by_convexity(formula) or self._prepared_sentence(formula)
        if answer != TRUE or lifted is None:
            return answer, None
        found = {name: lifted.get(name, Fraction(0)) for name in formula.variables}
        if self.certificate is None and is_quantifier_free(formula.body):
            matrix = convert(formula.body, Ring.of(tuple(found)))
            self.certificate = Certificate.witness(matrix, tuple(found), [Root.of(v) for v in found.values()])
        return answer, found

    def _by_convexity(self, formula: Exists) -> tuple[Formula, Values | None] | None:
        """A sentence in many variables about a convex set, if it is one."""
        count = len(formula.variables)
        if count < CONVEX_FROM or self.options.method is not Method.AUTO:
            return None
        if count > CONVEX_PARTS and len(components(conjuncts(formula.body), formula.variables)) > 1:
            return None  # preparation takes the parts apart, and each is decided alone
        from qe.solution.convex_sentence import decide_convex

        found = self._tried("convexity", lambda part: decide_convex(formula, budget=part))
        if found is None:
            return None
        self.story.note("plan", f"convex optimisation: {len(formula.variables)} variables, a convex set")
        if found.values is None:
            self.certificate = found.certificate
            return FALSE, None
        return TRUE, dict(found.values)

    def _prepared_sentence(self, formula: Exists) -> tuple[Formula, Values | None]:
        """Prepared, decided, and the values carried back."""
        ready = self._prepare(formula)
        answer, values = self.with_values(ready.formula)
        if answer != TRUE or values is None:
            return answer, None
        try:
            return answer, ready.lift(values)
        except Unable as error:
            self.story.note("switches", f"no witness: {error}")
            return answer, None

    def with_values(self, formula: Formula) -> tuple[Formula, Values | None]:
        """A sentence of existential blocks under conjunction and disjunction, with values when true."""
        match formula:
            case Constant(value):
                return formula, {} if value else None
            case Exists(variables, body) if is_quantifier_free(body):
                return self.block(variables, body)
            case And(args):
                values: Values = {}
                for arg in args:
                    truth, found = self.with_values(arg)
                    if truth == FALSE:
                        return FALSE, None
                    values |= found or {}
                return TRUE, values
            case Or(args):
                for arg in args:
                    truth, found = self.with_values(arg)
                    if truth == TRUE:
                        return TRUE, found
                return FALSE, None
            case Exists(variables, body):
                inner = self.eliminate(body, substitution_only=True)
                if is_quantifier_free(inner):
                    return self.block(variables, inner)
                return self.decomposed(exists(variables, inner))
        return self.eliminate(formula), None

    def keep_or_make_certificate(self, formula: Formula, answer: Formula) -> None:
        """A certificate is kept if it is about this very answer; one that was asked for is made where time allows."""
        if self.certificate is not None and not claims(self.certificate, answer):
            self.certificate = None
        if self.certificate is not None or not self.options.certify:
            return
        try:
            self.certificate = certificate_for(formula, answer, self.options, self.budget.share(CERTIFY_SHARE))
        except Unable as error:
            self.story.note("switches", f"no certificate: {error}")

    # --- inner formulas ------------------------------------------------------------------------
    def prepared(self, formula: Formula) -> Formula:
        return self._prepare(formula).formula

    def _prepare(self, formula: Formula) -> Prepared:
        enabled = ALL_STEPS - EQUATION_STEPS if Stage.EQUATIONS in self.options.without else ALL_STEPS
        ready = prepare(formula, budget=self.budget, enabled=enabled)
        if ready.steps:
            self.story.note("preparation", [f"{s.kind.value}: {s.detail}" for s in ready.steps])
        return ready

    def eliminate(self, formula: Formula, *, substitution_only: bool = False) -> Formula:
        """All quantifiers removed, innermost first; with ``substitution_only`` those that substitution can remove."""
        if is_quantifier_free(formula):
            return formula
        match formula:
            case And(args):
                return simplify(conj(self.eliminate(a, substitution_only=substitution_only) for a in args))
            case Or(args):
                return simplify(disj(self.eliminate(a, substitution_only=substitution_only) for a in args))
            case Not(arg):
                return neg(self.eliminate(arg, substitution_only=substitution_only))
            case Exists(variables, body):
                return self._quantified(variables, body, universal=False, substitution_only=substitution_only)
            case ForAll(variables, body):
                return self._quantified(variables, body, universal=True, substitution_only=substitution_only)
        return formula

    def _quantified(
        self, variables: Sequence[str], body: Formula, *, universal: bool, substitution_only: bool
    ) -> Formula:
        inner = self.eliminate(body, substitution_only=self.options.method is not Method.CRITICAL)
        rebuilt = (forall if universal else exists)(variables, inner)
        if not is_quantifier_free(inner):
            return rebuilt if substitution_only else self.decomposed(rebuilt)[0]
        positive = simplify(nnf(inner, negate=universal))
        if substitution_only:
            if not allows(self.options, Method.VS):
                return rebuilt
            answer, _ = substituted(variables, positive, self.budget, self.story)
            if not is_quantifier_free(answer):
                return rebuilt
        else:
            answer = self.block(variables, positive, universal=universal)[0]
        return simplify(nnf(answer, negate=universal))

    # --- one existential block over a quantifier-free body ----------------------------------------
    def block(
        self, variables: Sequence[str], body: Formula, *, universal: bool = False
    ) -> tuple[Formula, Values | None]:
        """``exists variables. body`` by the methods that the planner proposes, in their order.

        With ``universal`` the block was the negation of a universal one: decomposition then works on that directly,
        so that its formula and its certificate are about the question that was asked.
        """
        if free_variables(exists(variables, body)) and self.options.method is Method.AUTO:
            settled = only_nonzero(variables, body)
            if settled is not None:
                self.story.note("plan", f"{', '.join(variables)}: only asked to be no root")
                return simplify(settled), None
            far = far_first(variables[0], body, budget=self.budget) if len(variables) == 1 else None
            if far is not None:
                self.story.note("plan", f"{variables[0]}: solutions near infinity first")
                return simplify(disj((far.solutions, self.eliminate(far.rest)))), None
        plan = planned(variables, body, self.options)
        self.story.note("plan", f"{plan.methods[0].value} first for {', '.join(variables)}: {plan.reason}")
        may_probe = plan.methods[0] is Method.CAD and allows(self.options, Method.VS)
        if may_probe and len(free_variables(body)) > PROBE_ABOVE:
            probed = self._probe(variables, body)
            if probed is not None:
                return probed
        for position, method in enumerate(plan.methods):
            last = position == len(plan.methods) - 1
            share = self.budget if last else self.budget.share(FIRST_SHARE)
            try:
                if method is Method.VS:
                    return self._by_substitution(variables, body, share)
                if method is Method.CRITICAL:
                    return self._by_critical_values(variables, body, share), None
                if universal:
                    answer, values = self._decomposed(forall(variables, nnf(body, negate=True)), share)
                    return nnf(answer, negate=True), values
                return self._decomposed(exists(variables, body), share)
            except Unable as error:
                if last:
                    raise
                self.budget.check("switch")
                self.story.note("switches", f"{method.value}: {error}")
        raise Unable("no method applies")

    def _probe(self, variables: Sequence[str], body: Formula) -> tuple[Formula, Values | None] | None:
        """A short try of substitution where decomposition is planned: a small complete answer is taken."""
        part = self.budget.brief(PROBE_SECONDS, PROBE_SHARE)
        try:
            result = substituted(variables, body, part, self.story)
        except Unable as error:
            self.story.note("switches", f"vs probe: {error}")
            return None
        formula, values = result
        if not is_quantifier_free(formula) or sum(1 for _ in atoms(formula)) > PROBE_ATOMS:
            return None
        return self._shortened(formula), values

    def _by_substitution(
        self, variables: Sequence[str], body: Formula, budget: Budget
    ) -> tuple[Formula, Values | None]:
        result = substituted(variables, body, budget, self.story)
        formula, values = result
        if not is_quantifier_free(formula):
            if not allows(self.options, Method.CAD):
                raise Unable("virtual substitution alone does not eliminate all quantifiers of this formula")
            self.story.note("switches", f"vs: {', '.join(features(formula).bound)} left for decomposition")
            if not free_variables(exists(variables, body)):
                return self._decomposed(exists(variables, body), budget)
            formula = self._finish(formula, budget)
        return self._shortened(formula), values

    def _finish(self, formula: Formula, budget: Budget) -> Formula:
        """Decompose the existential parts that substitution left."""
        match formula:
            case And(args):
                return simplify(conj(self._finish(a, budget) for a in args))
            case Or(args):
                return simplify(disj(self._finish(a, budget) for a in args))
            case Exists():
                return self._decomposed(formula, budget)[0]
        return formula

    def _shortened(self, formula: Formula) -> Formula:
        """A shorter equivalent of a small quantifier-free answer, read off a decomposition of its space."""
        if formula == self.shortest:
            return formula
        if has_root_atoms(formula) or not is_small(formula) or not allows(self.options, Method.CAD):
            return formula
        try:
            shorter, _ = self._decomposed(formula, self.budget.brief(SHORTEN_SECONDS, SHORTEN_SHARE, SHORTEN_CELLS))
        except Unable:
            return formula
        return shorter if length(shorter) < length(formula) else formula

    def _settled(self, formula: Formula) -> Formula:
        """TRUE or FALSE where the answer turns out to be that, if this is cheap to find out."""
        if has_root_atoms(formula):
            return formula
        limits = self.budget.brief(SHORTEN_SECONDS, SHORTEN_SHARE, SETTLE_CELLS)
        plain = self.options.with_(certify=False, root_atoms=False)

        def is_satisfiable(sentence: Formula) -> bool:
            return _Run(plain, limits).sentence_or_formula(sentence)[0] == TRUE

        try:
            constant = constant_value(formula, is_satisfiable)
        except Unable:
            return formula
        if constant is not None:
            self.story.note("plan", f"the answer was decided to be {constant}")
        return constant or formula

    def _tried(self, what: str, work: Callable[[Budget], Found | None]) -> Found | None:
        """A shortcut, with a share of the time; None where it does not lead to an answer."""
        try:
            return work(self.budget.share(FIRST_SHARE))
        except Unable as error:
            self.story.note("switches", f"{what}: {error}")
            return None

    def _by_critical_values(self, variables: Sequence[str], body: Formula, budget: Budget) -> Formula:
        plain = self.options.with_(root_atoms=False)  # an inner block's answer is read by the next elimination

        def decompose(formula: Formula, part: Budget) -> Formula:
            return decomposed(formula, plain, part, self.story).formula

        from qe.pipeline_critical import by_critical_values

        return by_critical_values(variables, body, self.options, budget, self.story, decompose)

    # --- decomposition -----------------------------------------------------------------------------
    def decomposed(self, formula: Formula) -> tuple[Formula, Values | None]:
        """Any formula, as a whole, by cylindrical algebraic decomposition."""
        if not allows(self.options, Method.CAD):
            raise Unable("virtual substitution alone does not eliminate all quantifiers of this formula")
        return self._decomposed(formula, self.budget)

    def _decomposed(self, formula: Formula, budget: Budget) -> tuple[Formula, Values | None]:
        found = decomposed(formula, self.options, budget, self.story)
        if self.certificate is None and formula == self.whole:
            self.certificate = found.certificate
        self.shortest = found.formula
        return found.formula, found.values
