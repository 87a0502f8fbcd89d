"""Preparation of one existential block: rules applied to a fixed point, giving a tree of smaller problems."""

from __future__ import annotations

from collections.abc import Sequence

from qe.formula.syntax import FALSE, Formula
from qe.formula.traverse import free_variables
from qe.rules.block_context import BlockContext, Rule
from qe.rules.cases import groebner_equations, split_factors, split_squares
from qe.rules.degree_shift import shift_degree
from qe.rules.generic import drop_inequations
from qe.rules.scaling import fix_scale
from qe.rules.step import StepKind
from qe.rules.structural import guarded_linear_equation, independent_parts, linear_equation
from qe.rules.translation import fix_origin
from qe.rules.tree import NEVER, Leaf, Node
from qe.simplify.simplify import simplify_under

RULES: tuple[Rule, ...] = (
    independent_parts,
    linear_equation,
    fix_origin,
    drop_inequations,
    split_squares,
    groebner_equations,
    shift_degree,
    split_factors,
    fix_scale,
    guarded_linear_equation,
)


def reduce_block(variables: Sequence[str], body: Formula, context: BlockContext) -> Node:
    """A tree whose formula is equivalent to ``exists variables. body`` where the facts hold."""
    context.budget.check("prepare")
    if StepKind.SIMPLIFY in context.enabled:
        body = simplify_under(body, context.facts)
    if body == FALSE:
        return NEVER
    occurring = free_variables(body)
    kept = tuple(v for v in variables if v in occurring)
    if not kept:
        return Leaf((), body)
    for rule in RULES:
        result = rule(kept, body, context, reduce_block)
        if result is not None:
            return result
    return Leaf(kept, body)
