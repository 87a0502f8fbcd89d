"""Nested blocks of one kind as one block: ex x (f and ex y g) iff ex x, y (f and g), for y that f does not mention."""

from __future__ import annotations

from qe.formula.build import conj, disj, exists, forall
from qe.formula.syntax import Atom, Exists, ForAll, Formula, Relation
from qe.formula.traverse import conjuncts, disjuncts
from qe.rules.block_context import BlockContext
from qe.rules.step import StepKind


def gathered(formula: Exists | ForAll, context: BlockContext) -> Exists | ForAll:
    """The block with those of its kind that stand inside it under conjunction (a universal one: disjunction) alone.

    What can be solved for in the whole is more than what can be in an inner block by itself, where the variables
    outside are coefficients that may vanish. Blocks whose names would be captured stay inside; and where other blocks
    stay inside and no equation binds the variables, inner blocks are left to be eliminated first: they have fewer.
    """
    if StepKind.GATHERING not in context.enabled:
        return formula
    kind = type(formula)
    split, join = (conjuncts, conj) if kind is Exists else (disjuncts, disj)
    variables, pending, parts = list(formula.variables), list(split(formula.body)), list[Formula]()
    mentioned = _names(formula.body)
    while pending:
        part = pending.pop(0)
        if isinstance(part, kind) and mentioned.isdisjoint(part.variables) and not set(variables) & set(part.variables):
            variables += part.variables
            mentioned |= _names(part.body)
            pending[:0] = split(part.body)
        else:
            parts.append(part)
    if len(variables) == len(formula.variables) or not _gains(parts, frozenset(variables), kind):
        return formula
    after = (exists if kind is Exists else forall)(variables, join(parts))
    context.step(StepKind.GATHERING.value, formula, after)
    return after if isinstance(after, Exists | ForAll) else formula


def _names(formula: Formula) -> set[str]:
    return set(formula.free)


def _gains(parts: list[Formula], variables: frozenset[str], kind: type[Exists | ForAll]) -> bool:
    """Whether nothing else is quantified, or an equation (under a universal block: its negation) binds a variable."""
    if all(part.is_quantifier_free for part in parts):
        return True
    binding = Relation.EQ if kind is Exists else Relation.NE
    return any(isinstance(a, Atom) and a.relation is binding and variables.intersection(a.free) for a in parts)
