"""The structural rules and the linear ones: each gives the tree for one block, or None where it does not apply."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from qe.formula.build import atom, conj, disj
from qe.formula.normal import nnf
from qe.formula.syntax import Atom, Constant, Formula, Or, Relation
from qe.formula.traverse import conjuncts, connected
from qe.rules.block_context import BlockContext, Found
from qe.rules.lift import Solve
from qe.rules.linear import Pivot, choose_pivot, defining, linear_in, substitute
from qe.rules.step import StepKind
from qe.rules.tree import All, Any, Leaf, Node, Pending, solved
from qe.simplifier.facts import Facts


def independent_parts(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """ex over or: ex x (f or g) iff (ex x f) or (ex x g), where a disjunct without x stays, and fails where the others
    matter. ex over and: conjuncts that share no variable of the block are quantified separately, and those without one
    leave the scope.

    Lift: the values of the parts together, or those of a branch that is satisfied.
    """
    block = frozenset(variables)
    if isinstance(body, Or):
        plain = tuple(part for part in body.args if block.isdisjoint(part.free))
        fail = tuple(nnf(part, negate=True) for part in plain)
        others = (Pending(variables, part, fail) for part in body.args if part not in plain)
        return Found(StepKind.MINISCOPE, "disjunction", Any((*(Leaf((), part) for part in plain), *others)))
    outside, groups = connected(conjuncts(body), lambda part: block.intersection(part.free))
    if len(groups) + bool(outside) < 2:
        return None
    children: list[Node] = [Leaf((), conj(outside))] if outside else []
    for names, members in groups:
        shared = tuple(v for v in variables if v in names)
        children.append(Pending(shared, conj(members), tuple(outside)))
    return Found(StepKind.MINISCOPE, "conjunction", All(tuple(children)))


def linear_equation(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """The theorem of ``qe.rules.linear`` on the cheapest pivots that need no guard, all in a row."""
    pivots: list[Solved] = []
    while not isinstance(body, Constant):
        context.budget.check("prepare")
        parts = conjuncts(body)
        pivot = _pivot(parts, variables, context)
        after = None if pivot is None or pivot.guarded else _without(parts, pivot)
        if pivot is None or after is None:
            break
        pivots.append((pivot, parts[pivot.position]))
        variables = tuple(v for v in variables if v != pivot.name)
        body = after
    return _found(pivots, variables, body)


def definitions(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """The same for equations that do nothing but define a variable, all in a row (``qe.rules.linear.definitions``)."""
    solved_for: list[Solved] = []
    while not isinstance(body, Constant):
        context.budget.check("prepare")
        parts = conjuncts(body)
        pivots = defining(parts, variables)
        gone = {pivot.position for pivot in pivots}
        others = conj(p for k, p in enumerate(parts) if k not in gone)
        after = substitute(others, pivots[0]) if pivots and not pivots[0].alone else others
        if not pivots or after is None:
            break
        solved_for += [(pivot, parts[pivot.position]) for pivot in pivots]
        body = after
    return _found(solved_for, variables, body)


Solved = tuple[Pivot, Formula]
"""A variable that is solved for, and its equation."""


def _found(pivots: Sequence[Solved], variables: Sequence[str], body: Formula) -> Found | None:
    """The block without the variables that were solved for; None where there are none."""
    if not pivots:
        return None
    node = solved([_value(pivot) for pivot, _ in pivots], variables, body)
    return Found(StepKind.LINEAR, _described(pivots), node, _evidence(pivots))


def _value(pivot: Pivot) -> Solve:
    """The way back: where the variable occurs nowhere else, it may be 0 where its coefficient is."""
    return Solve(pivot.name, -pivot.rest, pivot.lead, Fraction(0) if pivot.alone else None)


def _without(parts: Sequence[Formula], pivot: Pivot) -> Formula | None:
    """What an equation without guard leaves of the conjunction."""
    others = _others(parts, pivot)
    if not pivot.alone:
        return substitute(others, pivot)
    if pivot.sign is not None:
        return others
    return conj((disj((_nonzero(pivot), atom(pivot.rest, Relation.EQ))), others))


def guarded_linear_equation(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """As ``linear_equation``, with the case distinction lead /= 0 or lead = rest = 0."""
    parts = conjuncts(body)
    pivot = _pivot(parts, variables, context)
    if pivot is None or not pivot.guarded:
        return None
    others = _others(parts, pivot)
    replaced = substitute(others, pivot)
    if replaced is None or not context.may_split(StepKind.GUARDED_LINEAR, 2):
        return None
    regular = solved([_value(pivot)], variables, conj((_nonzero(pivot), replaced)))
    vanishing = (atom(pivot.lead, Relation.EQ), atom(pivot.rest, Relation.EQ), others)
    node, one = Any((regular, Pending(variables, conj(vanishing)))), [(pivot, parts[pivot.position])]
    return Found(StepKind.GUARDED_LINEAR, _described(one), node, _evidence(one))


def solvable_disjuncts(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """ex x (f and (g or h)) iff (ex x (f and g)) or (ex x (f and h)), where every disjunct has an equation linear in a
    variable of the block: each part then loses one. Lift: a branch that is satisfied.
    """
    parts = conjuncts(body)
    for position, part in enumerate(parts):
        if not isinstance(part, Or) or not all(any(linear_in(conjuncts(arg), variables)) for arg in part.args):
            continue
        if not context.may_split(StepKind.DISTRIBUTION, len(part.args)):
            return None
        rest = [p for k, p in enumerate(parts) if k != position]
        node = Any(tuple(Pending(variables, conj((*rest, arg))) for arg in part.args))
        return Found(StepKind.DISTRIBUTION, f"{len(part.args)} cases", node)
    return None


def _pivot(parts: Sequence[Formula], variables: Sequence[str], context: BlockContext) -> Pivot | None:
    def facts(position: int) -> Facts:
        return context.facts.extended(p for k, p in enumerate(parts) if k != position and isinstance(p, Atom))

    return choose_pivot(parts, variables, facts)


def _others(parts: Sequence[Formula], pivot: Pivot) -> Formula:
    return conj(p for k, p in enumerate(parts) if k != pivot.position)


def _evidence(pivots: Sequence[Solved]) -> dict[str, object]:
    """The variables, their equations and what is known of the signs of their coefficients."""
    return {"solved": [(pivot.name, part.poly, pivot.sign) for pivot, part in pivots if isinstance(part, Atom)]}


def _described(pivots: Sequence[Solved]) -> str:
    return ", ".join(f"{pivot.name} from {part}" for pivot, part in pivots)


def _nonzero(pivot: Pivot) -> Formula:
    return atom(pivot.lead, Relation.NE)
