"""Preparation of one existential block: rules applied to a fixed point, giving a tree of smaller problems."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction

from qe.exact.ring import format_poly
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import FALSE, TRUE, Atom, Formula, Or, Relation
from qe.formula.traverse import free_variables
from qe.options import Budget
from qe.prepare.facts import NOTHING, Facts
from qe.prepare.lift import Solve
from qe.prepare.linear import Pivot, choose_pivot, conjuncts, substitute
from qe.prepare.simplify import simplify_under
from qe.prepare.step import Step, StepKind
from qe.prepare.tree import NEVER, All, Any, Leaf, Lifted, Node

_SPLITS = 24  # case distinctions allowed within one block


@dataclass(slots=True)
class Workshop:
    """What the rules of one block share: limits, switches, and the record of the steps taken."""

    budget: Budget
    enabled: frozenset[StepKind]
    facts: Facts = NOTHING
    splits: int = _SPLITS
    steps: list[Step] = field(default_factory=list)

    def note(self, kind: StepKind, detail: str, cases: int = 1) -> None:
        """Record a step."""
        self.steps.append(Step(kind, detail, cases))

    def may_split(self, kind: StepKind, cases: int) -> bool:
        """Whether a case distinction is allowed; if so, it is charged."""
        if kind not in self.enabled or cases - 1 > self.splits:
            return False
        self.splits -= cases - 1
        return True


Rule = Callable[[tuple[str, ...], Formula, Workshop], Node | None]


def reduce_block(variables: Sequence[str], body: Formula, shop: Workshop) -> Node:
    """A tree whose formula is equivalent to ``exists variables. body`` where the facts hold."""
    shop.budget.check("prepare")
    if StepKind.SIMPLIFY in shop.enabled:
        body = simplify_under(body, shop.facts)
    if body == FALSE:
        return NEVER
    occurring = free_variables(body)
    kept = tuple(v for v in variables if v in occurring)
    if not kept:
        return Leaf((), body)
    for rule in RULES:
        result = rule(kept, body, shop)
        if result is not None:
            return result
    return Leaf(kept, body)


def either(nodes: Sequence[Node]) -> Node:
    """The disjunction of nodes: without the impossible ones; one that is certain stands alone."""
    possible = [n for n in nodes if n is not NEVER and n.formula != FALSE]
    for node in possible:
        if node.formula == TRUE:
            return node
    if not possible:
        return NEVER
    return possible[0] if len(possible) == 1 else Any(tuple(possible))


def independent_parts(variables: tuple[str, ...], body: Formula, shop: Workshop) -> Node | None:
    """ex over or: ex x (f or g) iff (ex x f) or (ex x g). ex over and: conjuncts that share no variable of the
    block are quantified separately, and those without one leave the scope.

    Lift: the values of the parts together, or those of a branch that is satisfied.
    """
    if StepKind.MINISCOPE not in shop.enabled:
        return None
    if isinstance(body, Or):
        shop.note(StepKind.MINISCOPE, "disjunction", len(body.args))
        return either([reduce_block(variables, part, shop) for part in body.args])
    parts = conjuncts(body)
    groups = _components(parts, variables)
    if len(groups) < 2:
        return None
    outside = [part for names, members in groups if not names for part in members]
    shop.note(StepKind.MINISCOPE, "conjunction", len(groups))
    children: list[Node] = [Leaf((), conj(outside))] if outside else []
    for names, members in groups:
        if names:
            inside = replace(shop, facts=shop.facts.extended(outside))
            child = reduce_block(tuple(v for v in variables if v in names), conj(members), inside)
            shop.splits = inside.splits
            if child.formula == FALSE:
                return NEVER
            children.append(child)
    return All(tuple(children))


def _components(parts: Sequence[Formula], variables: Sequence[str]) -> list[tuple[set[str], list[Formula]]]:
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


def linear_equation(variables: tuple[str, ...], body: Formula, shop: Workshop) -> Node | None:
    """The theorem of ``qe.prepare.linear`` on the cheapest pivot of the conjunction; no guard needed."""
    if StepKind.LINEAR not in shop.enabled:
        return None
    return _solve(variables, body, shop, False)


def guarded_linear_equation(variables: tuple[str, ...], body: Formula, shop: Workshop) -> Node | None:
    """As ``linear_equation``, with the case distinction lead /= 0 or lead = rest = 0."""
    if StepKind.GUARDED_LINEAR not in shop.enabled:
        return None
    return _solve(variables, body, shop, True)


def _solve(variables: tuple[str, ...], body: Formula, shop: Workshop, guarded: bool) -> Node | None:
    parts = conjuncts(body)

    def facts(position: int) -> Facts:
        return shop.facts.extended(p for k, p in enumerate(parts) if k != position and isinstance(p, Atom))

    pivot = choose_pivot(parts, variables, facts)
    if pivot is None or pivot.guarded != guarded:
        return None
    others = conj(p for k, p in enumerate(parts) if k != pivot.position)
    name = pivot.lead.ring.names[pivot.variable]
    remaining = tuple(v for v in variables if v != name)
    text = format_poly(parts[pivot.position].poly)  # type: ignore[attr-defined]
    if pivot.alone:
        shop.note(StepKind.LINEAR, f"{name} from {text} = 0")
        solvable = TRUE if pivot.sign is not None else disj((_nonzero(pivot), atom(pivot.rest, Relation.EQ)))
        child = reduce_block(remaining, conj((solvable, others)), shop)
        return Lifted(Solve(name, -pivot.rest, pivot.lead, Fraction(0)), child)
    replaced = substitute(others, pivot)
    if replaced is None or (guarded and not shop.may_split(StepKind.GUARDED_LINEAR, 2)):
        return None
    kind = StepKind.GUARDED_LINEAR if guarded else StepKind.LINEAR
    shop.note(kind, f"{name} from {text} = 0", 2 if guarded else 1)
    rule = Solve(name, -pivot.rest, pivot.lead)
    if not guarded:
        return Lifted(rule, reduce_block(remaining, replaced, shop))
    regular = Lifted(rule, reduce_block(remaining, conj((_nonzero(pivot), replaced)), shop))
    vanishing = (atom(pivot.lead, Relation.EQ), atom(pivot.rest, Relation.EQ), others)
    return either([regular, reduce_block(variables, conj(vanishing), shop)])


def _nonzero(pivot: Pivot) -> Formula:
    return atom(pivot.lead, Relation.NE)


RULES: tuple[Rule, ...] = (independent_parts, linear_equation, guarded_linear_equation)
