"""A last look at a quantifier-free answer: is it short, and is it perhaps true or false everywhere?"""

from __future__ import annotations

from collections.abc import Callable

from qe.elimination.cad import decomposed, is_small, kept, length
from qe.elimination.protocol import Context
from qe.engine.constant import constant_value
from qe.engine.strategy import allows
from qe.errors import InternalError, Unable
from qe.formula.build import conj, convert, disj
from qe.formula.syntax import And, Atom, Exists, Formula, Or, Relation
from qe.formula.traverse import atoms, conjuncts, disjuncts, free_variables, has_root_atoms, ring_of
from qe.options import Method, Stage
from qe.proof.run_log import RunLog
from qe.rules.block_context import BlockContext
from qe.rules.step import POINTWISE_STEPS, StepKind
from qe.rules.tree import All, Any, Leaf, Node
from qe.simplify.simplify import simplify

SHORTEN_WORK, SETTLE_WORK = 2000, 2000
"""Units of work for a shorter form, and for finding out that an answer is constant."""

UNTANGLED_ATOMS = 120
"""The equations of an answer of more atoms are left as they are."""


def shortened(formula: Formula, context: Context) -> Formula:
    """A shorter equivalent of a small quantifier-free answer, read off a decomposition of its space."""
    if has_root_atoms(formula):
        return formula
    formula = untangled(formula, context)
    if not allows(context.options, Method.CAD) or not is_small(formula):
        return formula
    try:
        found = decomposed(formula, context.options, context.budget.part(SHORTEN_WORK), RunLog())
    except Unable:
        context.budget.check("shorten")
        return formula
    if length(found.formula) >= length(formula):
        return formula
    return context.log.step("shorter", formula, found.formula, evidence=kept(found.certificate, context.options))


def untangled(formula: Formula, context: Context) -> Formula:
    """The answer with its equations by a better basis of their ideal, factor by factor, where that makes it shorter.

    The rules about equations (``qe.rules.cases``) are equivalences at every point, of whatever variables the block is
    made: here of the free ones, so that what the side conditions exclude goes with the factor that it belongs to.
    """
    parts = (conjuncts(part) for part in disjuncts(formula))
    if not any(isinstance(a, Atom) and a.relation is Relation.EQ for part in parts for a in part):
        return formula
    if sum(1 for _ in atoms(formula)) > UNTANGLED_ATOMS or Stage.EQUATIONS in context.options.without:
        return formula
    from qe.rules.block import reduce_block

    rules, steps = BlockContext(context.budget.part(SHORTEN_WORK), POINTWISE_STEPS), RunLog()
    try:
        apart = _matrix(reduce_block(free_variables(formula), formula, rules))
        shorter = simplify(apart)
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
