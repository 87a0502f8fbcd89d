"""This project's engine: with its default options, with one method, or with one stage left out."""

from __future__ import annotations

import time
from collections.abc import Callable

from experiments.adapters.answer import Answer, Limits
from experiments.solvers import OURS, WITHOUT
from qe.engine.run import solve
from qe.formula.syntax import Formula
from qe.io.text import write
from qe.options import Budget, Method, Options, Stage


def ours(name: str) -> Callable[[Formula, Limits], Answer]:
    """The adapter for ``ours``, ``ours-METHOD`` or ``ours-without-STAGE``.

    It asks the pipeline itself: the hard limits, for which ``qe.eliminate`` would fork a worker, are the runner's.
    """
    without = frozenset([Stage(name.removeprefix(WITHOUT))]) if name.startswith(WITHOUT) else frozenset()
    method = Method.AUTO if without or name == OURS else Method(name.removeprefix(f"{OURS}-"))

    def adapter(formula: Formula, limits: Limits) -> Answer:
        start = time.perf_counter()
        found = solve(formula, Options(method=method, without=without), Budget(limits.seconds))
        return Answer(write(found.formula), time.perf_counter() - start)

    return adapter
