"""What a problem costs beside its arithmetic, as the time of all over that of the core operations.

Core operations are the thin functions of ``qe.exact`` around FLINT's resultants, greatest common divisors,
factorisations, isolations of roots and evaluations. A first run has the time of all; in a second one every call of them
is counted and timed, without what it costs to look at the clock. An operation inside another belongs to the outer one.
All runs begin with what rings remember of a former one: what is computed once for a ring is in neither figure.
``experiments overhead``.
"""

from __future__ import annotations

import statistics
import time
from collections import defaultdict
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from typing import Any
from unittest import mock

from experiments.adapters.answer import Limits
from experiments.adapters.ours import ours
from experiments.problem import Problem
from experiments.solvers import OURS
from qe.exact import coincidence, fibre_stack, poly, sample
from qe.io.text import CONSTANTS, read

PROBLEMS = ("qepcad_app/#1", "fujisawa09#1", "chen14#3", "weispfenning98#2")
"""Of the literature, in which lifting takes most of the time."""

CORE: tuple[tuple[str, object, str], ...] = (
    ("resultants", poly.Poly, "resultant"),
    ("resultants", poly.Poly, "discriminant"),
    ("gcds", poly.Poly, "gcd"),
    ("factorisations", poly, "guarded_factor"),
    ("factorisations", fibre_stack, "irreducible_factors"),
    ("root isolations", fibre_stack, "irreducible_roots"),
    ("root isolations", sample, "certified_roots"),
    ("root isolations", sample, "quadratic_roots"),
    ("root isolations", sample, "distinct_roots"),
    ("root isolations", coincidence, "distinct_roots"),
    ("evaluations", sample.Point, "univariate"),
    ("evaluations", sample.Point, "enclose"),
    ("evaluations", poly.Poly, "at_rational"),
    ("evaluations", poly.Poly, "evaluate"),
)
"""By kind, where a function is looked up, and its name."""


@dataclass(frozen=True, slots=True)
class Overhead:
    """Processor seconds of a problem; calls and seconds of core operations by kind."""

    id: str
    seconds: float
    core: dict[str, tuple[int, float]]

    @property
    def ratio(self) -> float:
        """All over core operations."""
        return self.seconds / max(sum(seconds for _, seconds in self.core.values()), 1e-9)

    def __str__(self) -> str:
        kinds = ", ".join(f"{n} {kind} {1000 * s:.1f} ms" for kind, (n, s) in sorted(self.core.items()))
        return f"{self.id:28} {self.seconds:7.3f} s  all/core {self.ratio:5.1f}  {kinds}"


def measured(problem: Problem, repeat: int = 3, limit: float = 60.0) -> Overhead:
    """The medians of some runs without, and one with, a look at each operation. Raises ``Unable``."""
    solve, limits = ours(OURS), Limits(limit, 2048)

    def run() -> float:
        formula = read(problem.formula, known=CONSTANTS)
        begun = time.process_time()
        solve(formula, limits)
        return time.process_time() - begun

    run()  # loads what is loaded with the first question
    seconds = statistics.median(run() for _ in range(repeat))
    with _watched() as core:
        run()
    return Overhead(problem.id, seconds, {kind: (n, max(t, 0) / 1e9) for kind, (n, t) in core.items()})


@contextmanager
def _watched() -> Iterator[dict[str, tuple[int, int]]]:
    """Calls and nanoseconds by kind, while this lasts."""
    found: dict[str, tuple[int, int]] = defaultdict(lambda: (0, 0))
    clock, inside = time.process_time_ns, False
    look = min(-(clock() - clock()) for _ in range(1_000))

    def timed(kind: str, call: Callable[..., Any]) -> Callable[..., Any]:
        def operation(*given: Any, **named: Any) -> Any:
            nonlocal inside
            if inside:
                return call(*given, **named)
            inside, begun = True, clock()
            try:
                return call(*given, **named)
            finally:
                taken, inside = clock() - begun - look, False
                n, total = found[kind]
                found[kind] = n + 1, total + taken

        return operation

    with ExitStack() as stack:
        for kind, owner, name in CORE:
            stack.enter_context(mock.patch.object(owner, name, timed(kind, getattr(owner, name))))
        yield found
