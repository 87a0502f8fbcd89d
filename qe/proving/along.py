"""Steps of the kernel for truth that is the same from many values of the parameters."""

from __future__ import annotations

from qe.formula.build import conj, exists
from qe.formula.evaluate import substituted
from qe.formula.syntax import FALSE, Exists, Formula, Not
from qe.kernel.negation import negation, normal
from qe.kernel.step import only
from qe.proof.entry import Json
from qe.proving.made import Made
from qe.proving.scaling import along, moves


def constant_along(made: Made, after: Formula) -> None:
    """Neither side holds where the other does not: parameters at 0, to which the others are moved, show it."""
    claim, limits, before = made.claim, made.limits, made.current
    directions, steps = only(claim, "directions", "steps")
    moved = []
    for direction in directions.items():
        variable, weights = direction.row("variable", "vector")
        moved.append((variable.text(), moves(weights, variable.text(), claim)))
    start, end = (substituted(side, {name: 0 for name, _ in moved}) for side in (claim.before, claim.after))
    if limits.replay(steps, start, (), claim.ring) != end:
        raise steps.fail("the steps do not lead there")
    lists: list[Json] = []
    for one, other in ((before, after), (after, before)):
        wrong = conj((normal(one), negation(other)))
        if wrong == FALSE:
            continue
        there = Made(claim, limits, exists(wrong.free, wrong))
        for name, vector in moved:
            block = there.current
            if isinstance(block, Exists) and name in block.variables:
                rest = [v for v in block.variables if v != name]
                others = {v: along(there.ring, v, -by, name) for v, by in vector.items() if v in rest}
                zero = {name: (there.ring.constant(0), there.ring.constant(1))}
                there.terms(block, exists(rest, substituted(block.body, {name: 0})), zero, others)
        if there.current != FALSE:
            body = there.current.body if isinstance(there.current, Exists) else there.current
            as_given = normal(one) == normal(claim.before) or normal(other) == negation(claim.before)
            whole = conj((start, negation(end))) if as_given else conj((normal(end), Not(start)))
            there.moved(body, whole)
            there.derived(start, end, steps.value)
            there.simplified(there.current, FALSE)
        lists.append(list(there.steps))
    made.step("no exception", before, after, {"exceptions": lists}, made.known)
