"""A last look at a quantifier-free answer: is it short, and is it perhaps true or false everywhere?"""

from __future__ import annotations

from collections.abc import Callable

from qe.elimination.protocol import Context
from qe.engine.constant import constant_value
from qe.engine.strategy import allows
from qe.errors import Unable
from qe.formula.build import exists
from qe.formula.features import is_small, length
from qe.formula.syntax import TRUE, Atom, Formula, Relation
from qe.formula.traverse import conjuncts, disjuncts, has_root_atoms
from qe.options import Method
from qe.proof.run_log import RunLog
from qe.proof.step import Nested

SHORTEN_WORK, SETTLE_WORK = 2000, 2000
"""Units of work for a shorter form, and for finding out that an answer is constant."""


def shortened(formula: Formula, context: Context) -> Formula:
    """A shorter equivalent of a small quantifier-free answer, read off a decomposition of its space."""
    if has_root_atoms(formula):
        return formula
    if _has_equations(formula):
        from qe.engine.untangle import untangled

        formula = untangled(formula, context)
    if not allows(context.options, Method.CAD) or not is_small(formula):
        return formula
    from qe.elimination.cad import decomposed, kept

    try:
        found = decomposed(formula, context.options, context.budget.part(SHORTEN_WORK), RunLog())
    except Unable:
        context.budget.check("shorten")
        return formula
    if length(found.formula) >= length(formula):
        return formula
    return context.log.step("shorter", formula, found.formula, evidence=kept(found.certificate, context.options))


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
    return context.log.step("constant", before, constant, evidence={"proof": {"steps": decision}})
