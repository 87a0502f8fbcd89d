"""A last look at a quantifier-free answer: is it short, and is it perhaps true or false everywhere?"""

from __future__ import annotations

from collections.abc import Callable

from qe.elimination.protocol import Context
from qe.engine.constant import constant_value
from qe.engine.strategy import allows
from qe.errors import Unable
from qe.formula.build import exists
from qe.formula.features import SMALL_DEGREE, is_small, length
from qe.formula.normal import nnf
from qe.formula.syntax import TRUE, Atom, Formula, Relation
from qe.formula.traverse import conjuncts, disjuncts, has_root_atoms
from qe.options import Method
from qe.proof.derivation import negated
from qe.proof.run_log import RunLog
from qe.proof.step import Nested

SHORTEN_WORK, SETTLE_WORK = 2000, 2000
"""Units of work for a shorter form, and for finding out that an answer is constant."""

LONG, LONG_WORK = 40, 12_000
"""An answer of so many terms is worth more work: up to a second."""

SHORTEN_DEGREE = {**SMALL_DEGREE, 3: 6}
"""A shorter form is looked for up to these total degrees: it may well be found, and giving up costs little work."""


def shortened(formula: Formula, context: Context, *, last: bool = False) -> Formula:
    """A shorter equivalent of a small quantifier-free answer, read off a decomposition of its space.

    Only the ``last`` look gets more work for long answers: what comes between may make them shorter for nothing.
    """
    if has_root_atoms(formula):
        return formula
    formula = _untangled(formula, context)
    if not allows(context.options, Method.CAD) or not is_small(formula, SHORTEN_DEGREE):
        return formula
    from qe.elimination.cad import decomposed, kept

    try:
        work = LONG_WORK if last and length(formula)[1] >= LONG else SHORTEN_WORK
        found = decomposed(formula, context.options, context.budget.part(work), RunLog())
    except Unable:
        context.budget.check("shorten")
        return formula
    if length(found.formula) >= length(formula):
        return formula
    evidence = kept(formula, found.certificate, context.options)
    return context.log.step("shorter", formula, found.formula, evidence=evidence)


def _untangled(formula: Formula, context: Context) -> Formula:
    """The answer with its equations taken apart, and those of its negation: in a disjunction with p /= 0 the other
    parts matter only where p = 0."""
    dual = nnf(formula, negate=True)
    if not _has_equations(formula) and not _has_equations(dual):
        return formula
    from qe.engine.untangle import untangled

    if _has_equations(formula):
        formula = untangled(formula, context)
        dual = nnf(formula, negate=True)
    if not _has_equations(dual):
        return formula
    log = RunLog()
    shorter = untangled(dual, Context(context.options, context.budget, log))
    result = nnf(shorter, negate=True)
    if shorter == dual or length(result) >= length(formula):
        return formula
    context.log.step("negation normal form", formula, negated(dual))
    context.log.take_up(tuple(log.steps()))
    return context.log.step("negation normal form", negated(shorter), result)


def _has_equations(formula: Formula) -> bool:
    """Whether an equation stands in the formula, or in a disjunct of it."""
    parts = (conjuncts(part) for part in disjuncts(formula))
    return any(isinstance(a, Atom) and a.relation is Relation.EQ for part in parts for a in part)


def settled(
    formula: Formula, context: Context, decide: Callable[[Formula, Context], Nested], question: Formula, mark: int
) -> Formula:
    """TRUE or FALSE where the answer to the question turns out to be that, if this is cheap to find out.

    Where the question itself has no solution, the steps to the answer since ``mark`` are left out.
    """
    if has_root_atoms(formula):
        return formula
    part = Context(context.options, context.budget.part(SETTLE_WORK), RunLog())
    decisions: list[Nested] = []

    def satisfiable(sentence: Formula) -> bool:
        decisions.append(decide(sentence, part))
        return decisions[-1].answer == TRUE

    try:
        constant = constant_value(formula, satisfiable, question)
    except Unable:
        context.budget.check("settle")
        return formula
    if constant is None:
        return formula
    context.log.choice("", (), f"the answer was decided to be {constant}")
    (decision,) = decisions
    before = formula
    if decision.start == exists(question.free, question):
        context.log.forget_steps(mark)
        before = question
    return context.log.step("constant", before, constant, evidence={"proof": {"exceptions": [decision]}})
