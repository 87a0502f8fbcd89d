"""The equations of an answer by a better basis of their ideal."""

from __future__ import annotations

from qe.elimination.protocol import Context
from qe.errors import InternalError, Unable
from qe.formula.build import conj, convert, disj
from qe.formula.features import length
from qe.formula.syntax import And, Exists, Formula, Or
from qe.formula.traverse import atoms, ring_of
from qe.options import Stage
from qe.proof.run_log import RunLog
from qe.rules.block import reduce_block
from qe.rules.block_context import BlockContext
from qe.rules.step import POINTWISE_STEPS, StepKind
from qe.rules.tree import All, Any, Leaf, Node
from qe.simplify.simplify import simplify

UNTANGLE_WORK = 2000
"""Units of work for the bases."""

UNTANGLED_ATOMS = 120
"""The equations of an answer of more atoms are left as they are."""


def untangled(formula: Formula, context: Context) -> Formula:
    """The answer with its equations by a better basis of their ideal, factor by factor, where that makes it shorter.

    The rules about equations (``qe.rules.cases``) are equivalences at every point, of whatever variables the block is
    made: here of the free ones, so that what the side conditions exclude goes with the factor that it belongs to.
    """
    if sum(1 for _ in atoms(formula)) > UNTANGLED_ATOMS or Stage.EQUATIONS in context.options.without:
        return formula
    whole = _attempt(formula, context, POINTWISE_STEPS)
    return whole if whole != formula else _attempt(formula, context, POINTWISE_STEPS - {StepKind.FACTOR_SPLIT})


def _attempt(formula: Formula, context: Context, enabled: frozenset[StepKind]) -> Formula:
    """As ``untangled``, by these rules."""
    rules, steps = BlockContext(context.budget.part(UNTANGLE_WORK), enabled), RunLog()
    try:
        apart = _matrix(reduce_block(formula.free, formula, rules))
        shorter = simplify(apart, watch=context.budget.check)
    except Unable:
        context.budget.check("shorten")
        return formula
    ring = ring_of(formula)
    shorter = shorter if ring is None else convert(shorter, ring)
    if length(shorter) >= length(formula):
        return formula
    for step in rules.log.steps():
        rule = StepKind.SIMPLIFY.value if step.rule == StepKind.MINISCOPE.value else step.rule
        steps.step(rule, _unquantified(step.before), _unquantified(step.after), context=step.context)
    steps.step(StepKind.SIMPLIFY.value, apart, shorter)
    return context.log.step("equations taken apart", formula, shorter, evidence={"trace": steps})


def _matrix(node: Node) -> Formula:
    """What a tree says without quantifying the block: the rules that made it hold at every point."""
    match node:
        case Leaf(_, body):
            return body
        case Any(children):
            return disj(map(_matrix, children))
        case All(children):
            return conj(map(_matrix, children))
    raise InternalError("a rule that is no equivalence at every point")


def _unquantified(formula: Formula) -> Formula:
    """A formula of a block that is only there to say which variables there are; without it, parts are joined."""
    match formula:
        case Exists(_, body):
            return _unquantified(body)
        case And(args) | Or(args):
            return (conj if isinstance(formula, And) else disj)(map(_unquantified, args))
    return formula
