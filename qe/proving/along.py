"""Steps of the kernel for truth that is the same from many values of the parameters."""

from __future__ import annotations

from fractions import Fraction

from qe.formula.build import atom, conj, exists
from qe.formula.syntax import FALSE, Atomic, Exists, Formula, Not
from qe.formula.traverse import map_atoms
from qe.kernel.block import existential
from qe.kernel.negation import negation, normal
from qe.kernel.step import Claim, Context, Limits, only
from qe.proof.certificate import written
from qe.proof.entry import Entry, Json
from qe.proving.made import Made
from qe.proving.scaling import along, moves


def constant_along(claim: Claim, context: Context, limits: Limits) -> list[Json]:
    """Neither side holds where the other does not: parameters at 0, to which the others are moved, show it."""
    directions, steps = only(claim, "directions", "steps")
    moved = [_move(direction, claim) for direction in directions.items()]
    start, end = (_at_zero(side, [name for name, _ in moved]) for side in (claim.before, claim.after))
    if limits.replay(steps, start, (), claim.ring) != end:
        raise steps.fail("the steps do not lead there")
    before, after = existential(claim)
    lists: list[Json] = []
    for one, other in ((before, after), (after, before)):
        wrong = conj((normal(one), negation(other)))
        if wrong == FALSE:
            continue
        made = Made(claim, limits, exists(wrong.free, wrong))
        for name, vector in moved:
            block = made.current
            if isinstance(block, Exists) and name in block.variables:
                rest = [v for v in block.variables if v != name]
                others = {v: along(made.ring, v, -by, name) for v, by in vector.items() if v in rest}
                zero = {name: (made.ring.constant(0), made.ring.constant(1))}
                made.terms(block, exists(rest, _at_zero(block.body, [name])), zero, others)
        if made.current != FALSE:
            body = made.current.body if isinstance(made.current, Exists) else made.current
            as_given = normal(one) == normal(claim.before) or normal(other) == negation(claim.before)
            whole = conj((start, negation(end))) if as_given else conj((normal(end), Not(start)))
            made.moved(body, whole)
            made.derived(start, end, steps.value)
            made.simplified(made.current, FALSE)
        lists.append(list(made.steps))
    return [written("no exception", (), before, after, context, {"exceptions": lists})]


def _move(direction: Entry, claim: Claim) -> tuple[str, dict[str, Fraction]]:
    """A variable that moves, and how the others do where it moves by 1."""
    variable, weights = direction.row("variable", "vector")
    return variable.text(), moves(weights, variable.text(), claim)


def _at_zero(formula: Formula, names: list[str]) -> Formula:
    def change(given: Atomic) -> Formula:
        ring = given.poly.ring
        return atom(given.poly.compose({ring.index[v]: ring.constant(0) for v in names}), given.relation)

    return map_atoms(formula, change)
