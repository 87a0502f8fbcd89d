"""Translations and rotations of a whole block, looked for before the blocks inside are touched: they break symmetry."""

from __future__ import annotations

from qe.formula.build import atom, conj, disj, exists, forall
from qe.formula.syntax import Exists, ForAll, Formula, Relation
from qe.rules.block_context import BlockContext
from qe.rules.change import Change
from qe.rules.lift import Solve
from qe.rules.rotation import invariant_plane
from qe.rules.step import StepKind


def without_rotations(formula: Exists | ForAll, context: BlockContext) -> tuple[tuple[str, ...], Formula, list[Solve]]:
    """The block with a coordinate fixed for every rotation that the corollary in ``qe.rules.rotation`` gives; and the
    values of these coordinates.

    One rotation after another: ``f`` below is equivalent to the question with or without each of the ``signs`` u >= 0.
    A rotation that moves such a u without making it the new one costs the sign. Dually for a universal block.
    """
    variables, body = formula.variables, formula.body
    signs: set[str] = set()
    turns: list[dict[str, object]] = []
    rules: list[Solve] = []
    while StepKind.ROTATION in context.enabled and len(variables) > 1:
        context.budget.check("prepare")
        turn = invariant_plane(variables, body, signs, context.watch)
        if turn is None:
            break
        v, signs = turn.zero, (signs - turn.moved) | {turn.half}
        turns.append(turn.proof)
        ring = body.ring
        assert ring is not None
        change = Change.to_number(v, 0, ring)
        variables, body = tuple(name for name in variables if name != v), change.image(body)
        rules += change.lifts
    if not rules:
        return variables, body, rules
    ring = rules[0].numerator.ring
    occurring = body.free
    halves = [ring.var(name) for name in sorted(signs) if name in occurring]
    if isinstance(formula, Exists):
        body = conj((*(atom(u, Relation.GE) for u in halves), body))
        after = exists(variables, body)
    else:
        body = disj((*(atom(u, Relation.LT) for u in halves), body))
        after = forall(variables, body)
    detail = ", ".join(f"{rule.variable} = 0" for rule in rules)
    context.step(StepKind.ROTATION.value, formula, after, detail, {"turns": turns})
    return variables, body, rules
