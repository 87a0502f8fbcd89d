"""Virtual substitution as a method: one block, its figures, and values for its variables."""

from __future__ import annotations

import time
from collections.abc import Sequence

from qe.formula.syntax import TRUE, Formula
from qe.options import Budget
from qe.proof.elimination import Values
from qe.proof.run_log import Story
from qe.simplify.simplify import simplify


def substituted(variables: Sequence[str], body: Formula, budget: Budget, story: Story) -> tuple[Formula, Values | None]:
    """``exists variables. body`` as far as substitution goes (it may keep quantifiers), with values if it is true."""
    from qe.elimination.vs.block import eliminate_block  # a large part of the engine, loaded where it may serve
    from qe.elimination.vs.witness import witness

    start = time.perf_counter()
    result = eliminate_block(variables, body, budget=budget, simplify=simplify)
    story.note("vs", {"variables": list(variables), **result.stats, "seconds": round(time.perf_counter() - start, 6)})
    if result.remaining or result.formula != TRUE:
        return result.formula, None
    certain = next((found for found in result.answers if simplify(found.guard) == TRUE), None)
    return result.formula, None if certain is None else witness(certain, budget=budget)
