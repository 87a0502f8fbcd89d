"""Shorter answers: rules, each with when it pays, that are tried one after the other."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from qe.elimination.protocol import Context
from qe.engine.constant import constant
from qe.engine.factor_signs import has_products, signs_of_factors
from qe.engine.implied import affine_hull_first
from qe.engine.redundant import Start, without_redundant_parts
from qe.engine.strategy import allows
from qe.engine.untangle import has_equations, untangled, untangled_negation
from qe.errors import Unable
from qe.formula.features import SMALL_DEGREE, is_small, length
from qe.formula.syntax import Formula
from qe.formula.traverse import has_root_atoms
from qe.options import Method, Stage
from qe.proof.run_log import RunLog

SHORTEN_WORK = 2000
"""Units of work for a form read off cells."""

LONG, LONG_WORK = 40, 12_000
"""An answer of so many terms is worth more work: up to a second."""

SHORTEN_DEGREE = {**SMALL_DEGREE, 3: 6}
"""A shorter form is looked for up to these total degrees: there may well be one, and giving up costs little work."""

SHORTEN_TERMS = 120
"""In three variables or more, an answer of more terms is left as it is: its projection alone is too much."""


@dataclass(frozen=True, slots=True)
class Rule:
    """One way to a shorter equivalent of a quantifier-free formula without root atoms.

    ``apply``: the formula, or a shorter one with the steps to it in the log; raises ``Unable`` where that is too much
    work. ``pays``: whether it is tried. ``stage``: without which it is not. ``last``: it is for whole answers only, as
    what comes between may become shorter for nothing; ``apply`` sees then where the answer comes from (``Start``).
    """

    name: str
    apply: Callable[[Formula, Context, Start | None], Formula]
    pays: Callable[[Formula, Context], bool] = lambda formula, context: True
    stage: Stage = Stage.SHORTENING
    last: bool = False


def read_off_cells(formula: Formula, context: Context, start: Start | None) -> Formula:
    """A shorter equivalent, read off a decomposition of its space; more work for a long answer at the end."""
    from qe.elimination.cad import decomposed, kept

    work = LONG_WORK if start is not None and length(formula)[1] >= LONG else SHORTEN_WORK
    outcome = decomposed(formula, context.options, context.budget.part(work), RunLog())
    if length(outcome.formula) >= length(formula):
        return formula
    evidence = kept(formula, outcome.make, context.options)
    return context.log.step("shorter", formula, outcome.formula, evidence=evidence)


def _has_few_cells(formula: Formula, context: Context) -> bool:
    if not allows(context.options, Method.CAD) or not is_small(formula, SHORTEN_DEGREE):
        return False
    return len(formula.free) < 3 or length(formula)[1] <= SHORTEN_TERMS


RULES: tuple[Rule, ...] = (
    Rule("equations", untangled, has_equations, Stage.EQUATIONS),
    Rule("equations of the negation", untangled_negation, stage=Stage.EQUATIONS),
    Rule("cells", read_off_cells, _has_few_cells),
    Rule("affine hull", affine_hull_first, stage=Stage.REDUNDANT, last=True),
    Rule("redundant parts", without_redundant_parts, stage=Stage.REDUNDANT, last=True),
    Rule("signs of factors", signs_of_factors, has_products, Stage.REDUNDANT, last=True),
    Rule("constant", constant, last=True),
)


def shortened(
    formula: Formula, context: Context, start: Start | None = None, known: set[Formula] | None = None
) -> Formula:
    """A shorter equivalent of a quantifier-free formula, as far as the rules know one; ``start``: of a whole answer.

    ``known`` collects what comes out: such a formula, if not long, is not decomposed again.
    """
    if Stage.SHORTENING in context.options.without or has_root_atoms(formula):
        return formula
    for rule in RULES:
        off = rule.stage in context.options.without or (rule.last and start is None)
        off |= start is not None and start.settled and rule.name != "affine hull"
        again = rule.name == "cells" and known is not None and formula in known and length(formula)[1] < LONG
        if off or again or not rule.pays(formula, context):
            continue
        mark = context.log.mark()
        try:
            formula = rule.apply(formula, context, start)
        except Unable:
            context.budget.check("shorten")
            context.log.forget_steps(mark)
    if known is not None:
        known.add(formula)
    return formula
