"""The structural rules and the linear ones: each gives the tree for one block, or None where it does not apply."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from qe.exact.ring import format_poly
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import FALSE, Atom, Constant, Formula, Or, Relation
from qe.formula.traverse import free_variables
from qe.prepare.facts import Facts
from qe.prepare.lift import Solve
from qe.prepare.linear import Pivot, choose_pivot, conjuncts, substitute
from qe.prepare.step import StepKind
from qe.prepare.tree import NEVER, All, Leaf, Lifted, Node
from qe.prepare.workshop import Recur, Workshop, either


def independent_parts(variables: tuple[str, ...], body: Formula, shop: Workshop, recur: Recur) -> Node | None:
    """ex over or: ex x (f or g) iff (ex x f) or (ex x g). ex over and: conjuncts that share no variable of the
    block are quantified separately, and those without one leave the scope.

    Lift: the values of the parts together, or those of a branch that is satisfied.
    """
    if StepKind.MINISCOPE not in shop.enabled:
        return None
    if isinstance(body, Or):
        shop.note(StepKind.MINISCOPE, "disjunction", len(body.args))
        return either([recur(variables, part, shop) for part in body.args])
    parts = conjuncts(body)
    groups = components(parts, variables)
    if len(groups) < 2:
        return None
    outside = [part for names, members in groups if not names for part in members]
    shop.note(StepKind.MINISCOPE, "conjunction", len(groups))
    children: list[Node] = [Leaf((), conj(outside))] if outside else []
    for names, members in groups:
        if names:
            inside = replace(shop, facts=shop.facts.extended(outside))
            child = recur(tuple(v for v in variables if v in names), conj(members), inside)
            shop.splits = inside.splits
            if child.formula == FALSE:
                return NEVER
            children.append(child)
    return All(tuple(children))


def components(parts: Sequence[Formula], variables: Sequence[str]) -> list[tuple[set[str], list[Formula]]]:
    """Groups of conjuncts connected by shared variables of the block; all without one are the first group."""
    groups: list[tuple[set[str], list[Formula]]] = []
    free: list[Formula] = []
    block = set(variables)
    for part in parts:
        names = block & set(free_variables(part))
        if not names:
            free.append(part)
            continue
        touching = [g for g in groups if g[0] & names]
        members = [m for g in touching for m in g[1]] + [part]
        for g in touching:
            names |= g[0]
        groups = [g for g in groups if g not in touching] + [(names, members)]
    return ([(set(), free)] if free else []) + groups


def linear_equation(variables: tuple[str, ...], body: Formula, shop: Workshop, recur: Recur) -> Node | None:
    """The theorem of ``qe.prepare.linear`` on the cheapest pivots that need no guard, all in a row."""
    if StepKind.LINEAR not in shop.enabled:
        return None
    rules: list[Solve] = []
    while not isinstance(body, Constant):
        shop.budget.check("prepare")
        parts = conjuncts(body)
        pivot = _pivot(parts, variables, shop)
        solved = None if pivot is None or pivot.guarded else _solved(parts, pivot)
        if pivot is None or solved is None:
            break
        shop.note(StepKind.LINEAR, _told(parts, pivot))
        rules.append(Solve(pivot.name, -pivot.rest, pivot.lead, Fraction(0) if pivot.alone else None))
        variables = tuple(v for v in variables if v != pivot.name)
        body = solved
    return Lifted(tuple(rules), recur(variables, body, shop)) if rules else None


def _solved(parts: Sequence[Formula], pivot: Pivot) -> Formula | None:
    """What an equation without guard leaves of the conjunction."""
    others = _others(parts, pivot)
    if not pivot.alone:
        return substitute(others, pivot)
    if pivot.sign is not None:
        return others
    return conj((disj((_nonzero(pivot), atom(pivot.rest, Relation.EQ))), others))


def guarded_linear_equation(variables: tuple[str, ...], body: Formula, shop: Workshop, recur: Recur) -> Node | None:
    """As ``linear_equation``, with the case distinction lead /= 0 or lead = rest = 0."""
    if StepKind.GUARDED_LINEAR not in shop.enabled:
        return None
    parts = conjuncts(body)
    pivot = _pivot(parts, variables, shop)
    if pivot is None or not pivot.guarded:
        return None
    others = _others(parts, pivot)
    replaced = substitute(others, pivot)
    if replaced is None or not shop.may_split(StepKind.GUARDED_LINEAR, 2):
        return None
    shop.note(StepKind.GUARDED_LINEAR, _told(parts, pivot), 2)
    remaining = tuple(v for v in variables if v != pivot.name)
    rule = Solve(pivot.name, -pivot.rest, pivot.lead)
    regular = Lifted((rule,), recur(remaining, conj((_nonzero(pivot), replaced)), shop))
    vanishing = (atom(pivot.lead, Relation.EQ), atom(pivot.rest, Relation.EQ), others)
    return either([regular, recur(variables, conj(vanishing), shop)])


def _pivot(parts: Sequence[Formula], variables: Sequence[str], shop: Workshop) -> Pivot | None:
    def facts(position: int) -> Facts:
        return shop.facts.extended(p for k, p in enumerate(parts) if k != position and isinstance(p, Atom))

    return choose_pivot(parts, variables, facts)


def _others(parts: Sequence[Formula], pivot: Pivot) -> Formula:
    return conj(p for k, p in enumerate(parts) if k != pivot.position)


def _told(parts: Sequence[Formula], pivot: Pivot) -> str:
    equation = parts[pivot.position]
    text = format_poly(equation.poly) if isinstance(equation, Atom) else "?"
    return f"{pivot.name} from {text} = 0"


def _nonzero(pivot: Pivot) -> Formula:
    return atom(pivot.lead, Relation.NE)
