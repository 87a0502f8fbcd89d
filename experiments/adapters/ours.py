"""This project's engine, with the options that the name of the solver means."""

from __future__ import annotations

import time
from collections.abc import Callable

from experiments.adapters.answer import Answer, Limits
from experiments.solvers import ENGINES
from qe.engine.run import solve
from qe.formula.syntax import Formula
from qe.io.text import write
from qe.options import Budget


def ours(name: str) -> Callable[[Formula, Limits], Answer]:
    """The adapter for a name in ``ENGINES``.

    It asks the pipeline itself: the hard limits, for which ``qe.eliminate`` would ask a worker, are the runner's.
    """

    def adapter(formula: Formula, limits: Limits) -> Answer:
        start = time.perf_counter()
        found = solve(formula, ENGINES[name], Budget(limits.seconds))
        return Answer(write(found.formula), time.perf_counter() - start)

    return adapter
