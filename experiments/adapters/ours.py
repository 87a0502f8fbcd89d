"""This project's engine: with its default options, with one method, or with one stage left out."""

from __future__ import annotations

import time
from collections.abc import Callable

from experiments.adapters.answer import Answer, Limits
from experiments.solvers import OURS, WITHOUT
from qe.errors import Unable
from qe.formula.syntax import Formula
from qe.io.text import write

MEMORY_SHARE = 0.9
"""Of the runner's limit, so that the engine ends by itself and says so."""


def ours(name: str) -> Callable[[Formula, Limits], Answer]:
    """The adapter for ``ours``, ``ours-METHOD`` or ``ours-without-STAGE``."""
    without = (name.removeprefix(WITHOUT),) if name.startswith(WITHOUT) else ()
    method = "auto" if without or name == OURS else name.removeprefix(f"{OURS}-")

    def solve(formula: Formula, limits: Limits) -> Answer:
        import qe

        start = time.perf_counter()
        memory = int(MEMORY_SHARE * limits.memory)
        answer = qe.eliminate(formula, timeout=limits.seconds, memory=memory, method=method, without=without)
        seconds = time.perf_counter() - start
        if answer.formula is None:
            raise Unable(answer.reason or "no reason given")
        return Answer(write(answer.formula), seconds)

    return solve
