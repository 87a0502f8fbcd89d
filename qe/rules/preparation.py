"""``prepare``: every quantifier block of a formula brought to its real dimension, innermost first."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING

from qe.formula.build import conj, disj, exists, forall
from qe.formula.normal import nnf
from qe.formula.syntax import And, Atom, Exists, ForAll, Formula, Or
from qe.options import Budget
from qe.proof.derivation import negated as negation
from qe.proof.run_log import RunLog
from qe.rules.block_context import BlockContext
from qe.rules.step import ALL_STEPS, StepKind
from qe.simplifier.simplify import simplify

if TYPE_CHECKING:
    from qe.rules.lift import Assignment, Value
    from qe.rules.tree import Node


@dataclass(frozen=True, slots=True)
class Prepared:
    """``formula`` is equivalent to the input over R.

    ``tree``: what became of the outermost quantifier block (None if the input does not start with one);
    ``universal``: that block is universal, and the tree is that of its negation.
    """

    formula: Formula
    tree: Node | None = None
    universal: bool = False
    variables: tuple[str, ...] = ()

    def lift(self, assignment: Assignment) -> dict[str, Value]:
        """Values for the whole outermost block from values of those of its variables that are left.

        For an existential block: from a witness of ``formula`` to one of the input; for a universal block: from
        a counterexample to a counterexample. Free variables keep their values. A variable that no
        longer occurs and has no rule gets 0:
        its value does not matter. Raises ``Unable`` when the assignment satisfies no branch.
        """
        values = dict(assignment) if self.tree is None else self.tree.lift(assignment)
        for name in self.variables:
            values.setdefault(name, Fraction(0))
        return values


def prepare(
    formula: Formula,
    *,
    budget: Budget | None = None,
    enabled: Collection[StepKind] = ALL_STEPS,
    log: RunLog | None = None,
) -> Prepared:
    """An equivalent formula with fewer and lower-degree quantified variables; every step is in the log.

    ``enabled`` switches single steps (for measurements). Raises ``BudgetExceeded``.
    """
    context = BlockContext(budget or Budget(), frozenset(enabled), log=log or RunLog())
    positive = nnf(formula)
    context.step("negation normal form", formula, positive)
    current = _simplified(positive, context)
    if not isinstance(current, Exists | ForAll):
        return Prepared(_simplified(_inside(current, context), context))
    universal, variables = isinstance(current, ForAll), current.variables
    tree = _block(current, context)
    result = _simplified(nnf(tree.formula, negate=universal), context)
    outer = formula.variables if isinstance(formula, Exists | ForAll) else variables
    return Prepared(result, tree, universal, outer)


def _simplified(formula: Formula, context: BlockContext) -> Formula:
    if StepKind.SIMPLIFY not in context.enabled:
        return formula
    simple = simplify(formula, watch=context.watch)
    context.log.step(StepKind.SIMPLIFY.value, formula, simple)
    return simple


def _block(formula: Exists | ForAll, context: BlockContext) -> Node:
    """The tree of an existential block, or of the negation of a universal one, inner blocks prepared first."""
    from qe.rules.block import reduce_block  # all rules, loaded where there is a block
    from qe.rules.gather import gathered
    from qe.rules.mirror import at_fixed_points
    from qe.rules.symmetry import without_rotations
    from qe.rules.tree import Lifted
    from qe.rules.zeros import without_implied_zeros

    formula = without_implied_zeros(gathered(formula, context), context)
    centred, rules = at_fixed_points(formula, context)
    variables: tuple[str, ...] = ()
    symmetric = centred
    if isinstance(centred, type(formula)):
        variables, symmetric, turns = without_rotations(centred, context)
        rules += turns
    body = _inside(symmetric, context)
    if isinstance(formula, Exists):
        tree = reduce_block(variables, body, context)
        return Lifted(tuple(rules), tree) if rules else tree
    negated = nnf(body, negate=True)
    context.step("duality", forall(variables, body), negation(exists(variables, negated)))
    tree = reduce_block(variables, negated, context)
    context.step("negation normal form", negation(tree.formula), nnf(tree.formula, negate=True))
    return Lifted(tuple(rules), tree) if rules else tree


def _reduced(formula: And | Or, assumed: tuple[Formula, ...], context: BlockContext) -> tuple[Formula, ...]:
    """The parts, those with quantifiers reduced by the equations assumed inside them: what these say need not be found
    out once more where it cannot be seen."""
    from qe.rules.cancelling import cancel_by
    from qe.rules.equations import reduce_by_equations, split_equations

    join, parts = conj if isinstance(formula, And) else disj, formula.args
    if StepKind.GROEBNER in context.enabled:
        parts = reduce_by_equations(assumed, parts, context.watch)
        context.step(StepKind.GROEBNER.value, formula, join(parts))
    if StepKind.CANCELLING in context.enabled:
        equations, before = split_equations(assumed)[0], parts
        parts = tuple(p if p.is_quantifier_free else cancel_by(equations, p, context.watch) for p in parts)
        context.step(StepKind.CANCELLING.value, join(before), join(parts))
    return parts


def _inside(formula: Formula, context: BlockContext) -> Formula:
    """Prepare the quantifier blocks inside a formula, innermost first, under their sibling atoms."""
    match formula:
        case And(args) | Or(args):
            plain = [a for a in args if isinstance(a, Atom)]
            if len(plain) == len(args):
                return formula
            # inside a conjunction its other members hold, inside a disjunction their negations
            assumed = tuple(nnf(a, negate=isinstance(formula, Or)) for a in plain)
            inner, parts = context.given(assumed), _reduced(formula, assumed, context)
            return (conj if isinstance(formula, And) else disj)(_inside(a, inner) for a in parts)
        case Exists(variables) | ForAll(variables):
            known = tuple(f for f in context.known if not set(variables) & set(f.free))
            tree = _block(formula, replace(context, facts=context.facts.without(variables), known=known))
            return nnf(tree.formula, negate=isinstance(formula, ForAll))
    return formula
