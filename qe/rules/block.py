"""Preparation of one existential block: rules applied to a fixed point, giving a tree of smaller problems."""

from __future__ import annotations

from collections.abc import Sequence

from qe.formula.build import exists
from qe.formula.syntax import FALSE, Formula
from qe.rules.block_context import BlockContext, Rule, rule
from qe.rules.cancelling import cancel_equations
from qe.rules.cases import groebner_equations, split_factors
from qe.rules.closed_forms import closed_form
from qe.rules.degree_shift import shift_degree
from qe.rules.exchange import exchange_variables
from qe.rules.generic import drop_inequations
from qe.rules.ranges import excluded_by_ranges
from qe.rules.scaling import fix_origin, fix_scale
from qe.rules.sphere import sphere_along_form
from qe.rules.square_alone import square_alone
from qe.rules.squares import known_signs, signs_before_substitution
from qe.rules.step import StepKind
from qe.rules.structural import (
    definitions,
    guarded_linear_equation,
    independent_parts,
    linear_equation,
    solvable_disjuncts,
)
from qe.rules.takes_value import drop_what_can_be_met
from qe.rules.tree import NEVER, All, Any, Leaf, Lifted, Node, Pending, Perturbed, either
from qe.simplifier.simplify import simplify_under

RULES: tuple[Rule, ...] = (
    rule(definitions, StepKind.DEFINITION),
    rule(excluded_by_ranges, StepKind.RANGES),
    rule(independent_parts, StepKind.MINISCOPE),
    closed_form(StepKind.BALLS),
    rule(sphere_along_form, StepKind.SPHERE),
    closed_form(StepKind.HALF_PLANE, StepKind.QUADRICS, StepKind.CUBIC_INTERVAL, StepKind.CLOSED_FORM),
    rule(signs_before_substitution, StepKind.SQUARES),
    rule(linear_equation, StepKind.LINEAR),
    rule(known_signs, StepKind.SQUARES),
    rule(drop_what_can_be_met, StepKind.TAKES_VALUE),
    rule(square_alone, StepKind.SQUARE_ALONE),
    rule(fix_origin, StepKind.TRANSLATION),
    rule(drop_inequations, StepKind.GENERIC),
    rule(cancel_equations, StepKind.CANCELLING),
    rule(groebner_equations, StepKind.GROEBNER),
    rule(shift_degree, StepKind.DEGREE_SHIFT),
    rule(exchange_variables, StepKind.EXCHANGE),
    rule(split_factors, StepKind.FACTOR_SPLIT),
    rule(fix_scale, StepKind.SCALING),
    rule(guarded_linear_equation, StepKind.GUARDED_LINEAR),
    rule(solvable_disjuncts, StepKind.DISTRIBUTION),
)
"""In the order in which they are tried."""


LOOKS = 5
"""So many rules that do not apply take less than a tenth of a second: then there is a look at the budget."""


def reduce_block(variables: Sequence[str], body: Formula, context: BlockContext) -> Node:
    """A tree whose formula is equivalent to ``exists variables. body`` where the facts hold.

    Every rule makes one step, and its pending leaves are reduced in turn; all steps are in the log. None leads back to
    what a step before it began with: an equation that was cancelled to a product is no smaller basis again.
    """
    context.budget.check("prepare")
    before = body
    if StepKind.SIMPLIFY in context.enabled:
        body = simplify_under(body, context.facts)
    occurring = body.free
    kept = tuple(v for v in variables if v in occurring)
    if body != before or len(kept) < len(variables):
        context.step(StepKind.SIMPLIFY.value, exists(variables, before), exists(kept, body))
    if body == FALSE:
        return NEVER
    if not kept:
        return Leaf((), body)
    for place, candidate in enumerate(RULES, 1):
        if place % LOOKS == 0:
            context.watch()
        found = None if candidate.kinds.isdisjoint(context.enabled) else candidate.apply(kept, body, context)
        if found is not None and not (isinstance(found.node, Pending) and found.node.body in context.path):
            context.step(found.kind.value, exists(kept, body), found.node.formula, found.detail, found.proof)
            context.path.append(body)
            tree = _reduced(found.node, context)
            context.path.pop()
            return tree
    return Leaf(kept, body)


def _reduced(node: Node, context: BlockContext) -> Node:
    """The tree with its pending leaves reduced."""
    match node:
        case Pending(variables, body, given):
            if not given:
                return reduce_block(variables, body, context)
            inside = context.given(given)
            child = reduce_block(variables, body, inside)
            context.splits = inside.splits
            return child
        case Lifted(rules, child):
            return Lifted(rules, _reduced(child, context))
        case Perturbed(variables, body, child):
            return Perturbed(variables, body, _reduced(child, context))
        case Any(children):
            return either(_reduced(child, context) for child in children)
        case All(children):
            parts: list[Node] = []
            for child in children:
                part = _reduced(child, context)
                if part.formula == FALSE:
                    return NEVER
                parts.append(part)
            return All(tuple(parts))
    return node
