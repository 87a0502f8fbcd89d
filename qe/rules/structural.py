"""The structural rules and the linear ones: each gives the tree for one block, or None where it does not apply."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from qe.exact.ring import format_poly
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import FALSE, Atom, Constant, Formula, Or, Relation
from qe.formula.traverse import conjuncts, connected, free_variables
from qe.rules.block_context import BlockContext, Recur, either
from qe.rules.lift import Solve
from qe.rules.linear import Pivot, choose_pivot, substitute
from qe.rules.step import StepKind
from qe.rules.tree import NEVER, All, Leaf, Lifted, Node
from qe.simplify.facts import Facts


def independent_parts(variables: tuple[str, ...], body: Formula, context: BlockContext, recur: Recur) -> Node | None:
    """ex over or: ex x (f or g) iff (ex x f) or (ex x g). ex over and: conjuncts that share no variable of the
    block are quantified separately, and those without one leave the scope.

    Lift: the values of the parts together, or those of a branch that is satisfied.
    """
    if StepKind.MINISCOPE not in context.enabled:
        return None
    if isinstance(body, Or):
        context.note(StepKind.MINISCOPE, "disjunction", len(body.args))
        return either([recur(variables, part, context) for part in body.args])
    block = frozenset(variables)
    outside, groups = connected(conjuncts(body), lambda part: block.intersection(free_variables(part)))
    count = len(groups) + bool(outside)
    if count < 2:
        return None
    context.note(StepKind.MINISCOPE, "conjunction", count)
    children: list[Node] = [Leaf((), conj(outside))] if outside else []
    for names, members in groups:
        inside = replace(context, facts=context.facts.extended(outside))
        child = recur(tuple(v for v in variables if v in names), conj(members), inside)
        context.splits = inside.splits
        if child.formula == FALSE:
            return NEVER
        children.append(child)
    return All(tuple(children))


def linear_equation(variables: tuple[str, ...], body: Formula, context: BlockContext, recur: Recur) -> Node | None:
    """The theorem of ``qe.rules.linear`` on the cheapest pivots that need no guard, all in a row."""
    if StepKind.LINEAR not in context.enabled:
        return None
    rules: list[Solve] = []
    while not isinstance(body, Constant):
        context.budget.check("prepare")
        parts = conjuncts(body)
        pivot = _pivot(parts, variables, context)
        solved = None if pivot is None or pivot.guarded else _solved(parts, pivot)
        if pivot is None or solved is None:
            break
        context.note(StepKind.LINEAR, _described(parts, pivot))
        rules.append(Solve(pivot.name, -pivot.rest, pivot.lead, Fraction(0) if pivot.alone else None))
        variables = tuple(v for v in variables if v != pivot.name)
        body = solved
    return Lifted(tuple(rules), recur(variables, body, context)) if rules else None


def _solved(parts: Sequence[Formula], pivot: Pivot) -> Formula | None:
    """What an equation without guard leaves of the conjunction."""
    others = _others(parts, pivot)
    if not pivot.alone:
        return substitute(others, pivot)
    if pivot.sign is not None:
        return others
    return conj((disj((_nonzero(pivot), atom(pivot.rest, Relation.EQ))), others))


def guarded_linear_equation(
    variables: tuple[str, ...], body: Formula, context: BlockContext, recur: Recur
) -> Node | None:
    """As ``linear_equation``, with the case distinction lead /= 0 or lead = rest = 0."""
    if StepKind.GUARDED_LINEAR not in context.enabled:
        return None
    parts = conjuncts(body)
    pivot = _pivot(parts, variables, context)
    if pivot is None or not pivot.guarded:
        return None
    others = _others(parts, pivot)
    replaced = substitute(others, pivot)
    if replaced is None or not context.may_split(StepKind.GUARDED_LINEAR, 2):
        return None
    context.note(StepKind.GUARDED_LINEAR, _described(parts, pivot), 2)
    remaining = tuple(v for v in variables if v != pivot.name)
    rule = Solve(pivot.name, -pivot.rest, pivot.lead)
    regular = Lifted((rule,), recur(remaining, conj((_nonzero(pivot), replaced)), context))
    vanishing = (atom(pivot.lead, Relation.EQ), atom(pivot.rest, Relation.EQ), others)
    return either([regular, recur(variables, conj(vanishing), context)])


def _pivot(parts: Sequence[Formula], variables: Sequence[str], context: BlockContext) -> Pivot | None:
    def facts(position: int) -> Facts:
        return context.facts.extended(p for k, p in enumerate(parts) if k != position and isinstance(p, Atom))

    return choose_pivot(parts, variables, facts)


def _others(parts: Sequence[Formula], pivot: Pivot) -> Formula:
    return conj(p for k, p in enumerate(parts) if k != pivot.position)


def _described(parts: Sequence[Formula], pivot: Pivot) -> str:
    equation = parts[pivot.position]
    text = format_poly(equation.poly) if isinstance(equation, Atom) else "?"
    return f"{pivot.name} from {text} = 0"


def _nonzero(pivot: Pivot) -> Formula:
    return atom(pivot.lead, Relation.NE)
