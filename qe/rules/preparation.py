"""``prepare``: every quantifier block of a formula brought to its real dimension, innermost first."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING

from qe.formula.build import conj, disj
from qe.formula.normal import nnf
from qe.formula.syntax import And, Exists, ForAll, Formula, Or
from qe.options import Budget
from qe.rules.block_context import Workshop
from qe.rules.step import ALL_STEPS, Step, StepKind
from qe.simplify.simplify import simplify

if TYPE_CHECKING:
    from qe.rules.lift import Assignment, Value
    from qe.rules.tree import Node


@dataclass(frozen=True, slots=True)
class Prepared:
    """``formula`` is equivalent to the input over R. ``steps``: what was done, in order.

    ``tree``: what became of the outermost quantifier block (None if the input does not start with one);
    ``universal``: that block is universal, and the tree is that of its negation.
    """

    formula: Formula
    steps: tuple[Step, ...]
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


def prepare(formula: Formula, *, budget: Budget | None = None, enabled: Collection[StepKind] = ALL_STEPS) -> Prepared:
    """An equivalent formula with fewer and lower-degree quantified variables.

    ``enabled`` switches single steps (for measurements). Raises ``BudgetExceeded``.
    """
    steps: list[Step] = []
    shop = Workshop(budget or Budget(), frozenset(enabled), steps=steps)
    current = nnf(formula)
    if StepKind.SIMPLIFY in shop.enabled:
        current = simplify(current)
    if not isinstance(current, Exists | ForAll):
        return Prepared(_finish(_inside(current, shop), shop), tuple(steps))
    universal = isinstance(current, ForAll)
    body = _inside(nnf(current.body, negate=universal), shop)
    tree = _reduced(current.variables, body, shop)
    result = _finish(nnf(tree.formula, negate=universal), shop)
    outer = formula.variables if isinstance(formula, Exists | ForAll) else current.variables
    return Prepared(result, tuple(steps), tree, universal, outer)


def _reduced(variables: Sequence[str], body: Formula, shop: Workshop) -> Node:
    from qe.rules.block import reduce_block  # all rules, loaded where there is a block

    return reduce_block(variables, body, shop)


def _finish(formula: Formula, shop: Workshop) -> Formula:
    return simplify(formula) if StepKind.SIMPLIFY in shop.enabled else formula


def _inside(formula: Formula, shop: Workshop) -> Formula:
    """Prepare the quantifier blocks inside a formula, innermost first, under their sibling atoms."""
    match formula:
        case And(args):
            inner = replace(shop, facts=shop.facts.extended(args))
            return conj(_inside(a, inner) for a in args)
        case Or(args):
            return disj(_inside(a, shop) for a in args)
        case Exists(variables, body) | ForAll(variables, body):
            universal = isinstance(formula, ForAll)
            fresh = replace(shop, facts=shop.facts.without(variables))
            tree = _reduced(variables, nnf(_inside(body, fresh), negate=universal), replace(fresh))
            return nnf(tree.formula, negate=universal)
    return formula
