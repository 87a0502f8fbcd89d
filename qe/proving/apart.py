"""A block whose body falls into parts, each solved by steps of its own, in steps of the kernel."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from qe.elimination.vs.trace import without
from qe.formula.build import conj, disj
from qe.formula.syntax import FALSE, Exists, Formula
from qe.formula.traverse import conjuncts
from qe.kernel.elimination_set import block_of
from qe.proof.entry import Json
from qe.proving.made import Made


@dataclass(frozen=True, slots=True)
class Part:
    """``steps`` lead from the block over ``body`` to ``end``; ``together``: with what stands beside all parts."""

    body: Formula
    end: Formula
    steps: Json
    together: bool = False


def by_alternatives(made: Made, names: Sequence[str], parts: Sequence[Part], after: Formula) -> list[Json]:
    """Steps from the block over the disjunction of all bodies."""
    starts = [block_of(names, part.body, made.ring) for part in parts]
    made.moved(made.current, disj(starts))
    for start, part in zip(starts, parts, strict=True):
        made.derived(start, part.end, part.steps)
    return made.finished(after)


def by_independent_parts(made: Made, names: Sequence[str], parts: Sequence[Part], after: Formula) -> list[Json]:
    """Steps from the block over the conjunction of all bodies, of others, and of what has none of its variables."""
    body = made.current.body if isinstance(made.current, Exists) else made.current
    beside = tuple(f for f in conjuncts(body) if not {*names} & {*f.free})
    inside = {f for part in parts for f in conjuncts(part.body)}
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
