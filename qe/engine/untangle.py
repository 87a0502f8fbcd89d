"""The equations of an answer by a better basis of their ideal."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from qe.elimination.protocol import Context
from qe.errors import InternalError, Unable
from qe.formula.build import conj, convert, disj
from qe.formula.features import length
from qe.formula.normal import matrix_of, nnf
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import atoms, conjuncts, disjuncts
from qe.proof.derivation import negated
from qe.proof.run_log import RunLog
from qe.rules.block import reduce_block
from qe.rules.block_context import BlockContext
from qe.rules.step import POINTWISE_STEPS, StepKind
from qe.rules.tree import All, Leaf, Node
from qe.rules.tree import Any as AnyOf
from qe.simplifier.simplify import simplify

UNTANGLE_WORK = 2000
"""Units of work for the bases."""

UNTANGLED_ATOMS = 120
"""The equations of an answer of more atoms are left as they are."""


Size = Callable[[Formula], Any]


def degrees(formula: Formula) -> int:
    """The total degrees of the polynomials: what decomposing costs goes by them."""
    return sum(poly.total_degree for poly in {a.poly for a in atoms(formula)})


def untangled(formula: Formula, context: Context, start: object = None, *, size: Size = length) -> Formula:
    """The answer with its equations by a better basis of their ideal, factor by factor, where that makes it shorter,
    or less in another ``size``.

    The rules about equations (``qe.rules.cases``) are equivalences at every point, of whatever variables the block is
    made: here of the free ones, so that what the side conditions exclude goes with the factor that it belongs to.
    """
    if sum(1 for _ in atoms(formula)) > UNTANGLED_ATOMS:
        return formula
    for enabled in (POINTWISE_STEPS, POINTWISE_STEPS - {StepKind.FACTOR_SPLIT}):
        try:
            shorter = _untangled_by(enabled, formula, context, size)
        except Unable:
            context.budget.check("shorten")
        else:
            if shorter != formula:
                return shorter
    return formula


def untangled_negation(formula: Formula, context: Context, start: object = None) -> Formula:
    """The same by the equations of the negation: in a disjunction with p /= 0 the others matter only where p = 0."""
    dual = nnf(formula, negate=True)
    if not has_equations(dual, context):
        return formula
    log = RunLog()
    shorter = untangled(dual, Context(context.options, context.budget, log))
    result = nnf(shorter, negate=True)
    if shorter == dual or length(result) >= length(formula):
        return formula
    context.log.step("negation normal form", formula, negated(dual))
    context.log.take_up(tuple(log.steps()))
    return context.log.step("negation normal form", negated(shorter), result)


def has_equations(formula: Formula, context: Context) -> bool:
    """Whether an equation stands in the formula, or in a disjunct of it."""
    parts = (conjuncts(part) for part in disjuncts(formula))
    return any(isinstance(a, Atom) and a.relation is Relation.EQ for part in parts for a in part)


def _untangled_by(enabled: frozenset[StepKind], formula: Formula, context: Context, size: Size) -> Formula:
    """As ``untangled``, by these rules."""
    rules, steps = BlockContext(context.budget.part(UNTANGLE_WORK), enabled), RunLog()
    matrix = _matrix(reduce_block(formula.free, formula, rules))
    shorter = simplify(matrix, watch=context.budget.check)
    ring = formula.ring
    shorter = shorter if ring is None else convert(shorter, ring)
    if size(shorter) >= size(formula):
        return formula
    for step in rules.log.steps():
        rule = StepKind.SIMPLIFY.value if step.rule == StepKind.MINISCOPE.value else step.rule
        steps.step(rule, matrix_of(step.before), matrix_of(step.after), context=step.context)
    steps.step(StepKind.SIMPLIFY.value, matrix, shorter)
    return context.log.step("equations taken apart", formula, shorter, evidence={"trace": steps})


def _matrix(node: Node) -> Formula:
    """What a tree says without quantifying the block: the rules that made it hold at every point."""
    match node:
        case Leaf(_, body):
            return body
        case AnyOf(children):
            return disj(map(_matrix, children))
        case All(children):
            return conj(map(_matrix, children))
    raise InternalError("a rule that is no equivalence at every point")
