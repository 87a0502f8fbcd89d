"""A last look at a quantifier-free answer: is it short, and is it perhaps true or false everywhere?"""

from __future__ import annotations

from collections.abc import Callable

from qe.elimination.protocol import Context
from qe.engine.constant import constant_value
from qe.engine.strategy import allows
from qe.errors import Unable
from qe.formula.features import is_small, length
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import conjuncts, disjuncts, has_root_atoms
from qe.options import Method
from qe.proof.run_log import RunLog

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
    formula: Formula, context: Context, satisfiable: Callable[[Formula, Context], bool], question: Formula
) -> Formula:
    """TRUE or FALSE where the answer to the question turns out to be that, if this is cheap to find out."""
    if has_root_atoms(formula):
        return formula
    part = Context(context.options, context.budget.part(SETTLE_WORK), RunLog())
    try:
        constant = constant_value(formula, lambda sentence: satisfiable(sentence, part), question)
    except Unable:
        context.budget.check("settle")
        return formula
    if constant is None:
        return formula
    context.log.choice("", (), f"the answer was decided to be {constant}")
    return context.log.step("constant", formula, constant)
