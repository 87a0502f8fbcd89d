"""A last look at a quantifier-free answer: is it short, and is it perhaps true or false everywhere?"""

from __future__ import annotations

from collections.abc import Callable

from qe.elimination.cad import decomposed, is_small, kept, length
from qe.elimination.protocol import Context
from qe.engine.constant import constant_value
from qe.engine.strategy import allows
from qe.errors import Unable
from qe.formula.syntax import Formula
from qe.formula.traverse import has_root_atoms
from qe.options import Method
from qe.proof.run_log import RunLog

SHORTEN_WORK, SETTLE_WORK = 2000, 500
"""Units of work for a shorter form, and for finding out that an answer is constant."""


def shortened(formula: Formula, context: Context) -> Formula:
    """A shorter equivalent of a small quantifier-free answer, read off a decomposition of its space."""
    if has_root_atoms(formula) or not allows(context.options, Method.CAD) or not is_small(formula):
        return formula
    try:
        found = decomposed(formula, context.options, context.budget.part(SHORTEN_WORK), RunLog())
    except Unable:
        context.budget.check("shorten")
        return formula
    if length(found.formula) >= length(formula):
        return formula
    return context.log.step("shorter", formula, found.formula, evidence=kept(found.certificate, context.options))


def settled(formula: Formula, context: Context, satisfiable: Callable[[Formula, Context], bool]) -> Formula:
    """TRUE or FALSE where the answer turns out to be that, if this is cheap to find out."""
    if has_root_atoms(formula):
        return formula
    part = Context(context.options, context.budget.part(SETTLE_WORK), RunLog())
    try:
        constant = constant_value(formula, lambda sentence: satisfiable(sentence, part))
    except Unable:
        context.budget.check("settle")
        return formula
    if constant is None:
        return formula
    context.log.choice("", (), f"the answer was decided to be {constant}")
    return context.log.step("constant", formula, constant)
