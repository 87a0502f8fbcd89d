"""A block whose body falls into parts, each solved by steps of its own, in steps of the kernel."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from qe.elimination.vs.trace import without
from qe.formula.build import conj, disj
from qe.formula.syntax import FALSE, Exists, Formula
from qe.formula.traverse import conjuncts
from qe.kernel.elimination_set import block_of
from qe.kernel.step import Claim, Context, Limits, only
from qe.proof.entry import Json, formula_from_json
from qe.proving.made import Made


@dataclass(frozen=True, slots=True)
class Part:
    """``steps`` lead from the block over ``body`` to ``end``; ``together``: with what stands beside all parts."""

    body: Formula
    end: Formula
    steps: Json
    together: bool = False


def alternatives(claim: Claim, context: Context, limits: Limits) -> list[Json]:
    """The parts of a disjunction."""
    pieces, parts = only(claim, "pieces", "parts")
    members, names = list[Part](), claim.block().variables
    for piece, steps in zip(pieces.items(), parts.items(), strict=True):
        body = formula_from_json(piece, claim.ring, quantified=True)
        end = limits.replay(steps, block_of(names, body, claim.ring), context, claim.ring)
        members.append(Part(body, end, steps.value))
    return by_alternatives(Made(claim, limits, claim.block(), context), names, members, claim.after)


def by_alternatives(made: Made, names: Sequence[str], parts: Sequence[Part], after: Formula) -> list[Json]:
    """Steps from the block over the disjunction of all bodies."""
    starts = [block_of(names, part.body, made.ring) for part in parts]
    made.moved(made.current, disj(starts))
    for start, part in zip(starts, parts, strict=True):
        made.derived(start, part.end, part.steps)
    return made.finished(after)


def independent_parts(claim: Claim, context: Context, limits: Limits) -> list[Json]:
    """Parts of a conjunction without a common variable of the block."""
    members, block = list[Part](), claim.block()
    beside = _beside(block.variables, block.body)
    for entry in only(claim, "pieces")[0].items():
        piece, together, steps = entry.fields("body", "together", "steps")
        body, known = formula_from_json(piece, claim.ring, quantified=True), beside if together.truth() else ()
        start = block_of(block.variables, conj((*known, body)), claim.ring)
        members.append(Part(body, limits.replay(steps, start, context, claim.ring), steps.value, bool(known)))
    return by_independent_parts(Made(claim, limits, block, context), block.variables, members, claim.after)


def by_independent_parts(made: Made, names: Sequence[str], parts: Sequence[Part], after: Formula) -> list[Json]:
    """Steps from the block over the conjunction of all bodies, of others, and of what has none of its variables."""
    body = made.current.body if isinstance(made.current, Exists) else made.current
    beside, inside = _beside(names, body), {f for part in parts for f in conjuncts(part.body)}
    others = conj(f for f in conjuncts(body) if f not in inside and f not in beside)
    starts = [block_of(names, part.body, made.ring) for part in parts]
    made.moved(made.current, conj((*beside, *starts, block_of(names, others, made.ring))))
    for start, part in zip(starts, parts, strict=True):
        if made.current == FALSE:
            break
        if part.together:
            whole = block_of(names, conj((*beside, part.body)), made.ring)
            made.signs(start, whole, used=beside)
            made.derived(whole, part.end, part.steps)
            for member in (f for f in conjuncts(part.end) if f not in beside and made.current != FALSE):
                made.signs(member, without(member, beside), used=beside)
        else:
            made.derived(start, part.end, part.steps)
    return made.finished(after)


def _beside(names: Sequence[str], body: Formula) -> tuple[Formula, ...]:
    return tuple(f for f in conjuncts(body) if not {*names} & {*f.free})
