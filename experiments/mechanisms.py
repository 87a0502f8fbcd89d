"""Which mechanism decides what: for every attempt of the strategy, rule of preparation, rule of shortening and kind of
step that is to be proved how often it was tried, how often it was of use, for how many problems, and the processor
seconds of both. What one does on behalf of another counts for both. ``experiments mechanisms``.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, field, replace
from types import SimpleNamespace
from typing import Any
from unittest import mock

from experiments.problem import Problem
from qe.engine import run, shortening, strategy
from qe.errors import QEError
from qe.io.text import CONSTANTS, read
from qe.options import Budget, Options
from qe.proving.prover import Prover
from qe.rules import block


@dataclass(slots=True)
class Mechanism:
    """``seconds``: of all tries; ``vain``: of those that were of no use; ``served``: the problems of the others."""

    tried: int = 0
    used: int = 0
    seconds: float = 0.0
    vain: float = 0.0
    served: set[str] = field(default_factory=set)

    def __str__(self) -> str:
        return f"{self.tried:8} {self.used:7} {len(self.served):5} {self.seconds:9.2f} {self.vain:9.2f}"


class Counts(dict[tuple[str, str], Mechanism]):
    """The mechanisms by kind and name. ``problem``: the one that is being solved."""

    problem = ""

    def watched(self, call: Callable[..., Any], kind: str, name: str, used: Callable[..., bool]) -> Callable[..., Any]:
        """The call, counted; ``used`` is asked about its result and its arguments."""

        def counted(*given: Any) -> Any:
            row, begun, useful = self.setdefault((kind, name), Mechanism()), time.process_time(), False
            try:
                result = call(*given)
                useful = used(result, *given)
                return result
            finally:
                taken = time.process_time() - begun
                row.tried, row.used, row.seconds = row.tried + 1, row.used + useful, row.seconds + taken
                row.vain += 0 if useful else taken
                row.served.update([self.problem] if useful else [])

        return counted


@contextmanager
def watching() -> Iterator[Counts]:
    """Counts of all that is done while this lasts."""
    counts, load, own = Counts(), strategy.Attempt.load, Prover.own

    def loaded(attempt: strategy.Attempt) -> object:
        def kept(outcome: Any, problem: Any, context: object) -> bool:
            return outcome is not None and attempt.keep(outcome, problem)

        method, name = load(attempt), f"{attempt.scope.value}: {attempt.method}, {attempt.when.__name__}"
        run = counts.watched(method.run, "attempt", name, kept)
        return SimpleNamespace(name=method.name, suits=method.suits, run=run)

    def proved(prover: Prover, step: Any, context: Any) -> object:
        return counts.watched(own, "proof", step.rule, _is)(prover, step, context)

    def preparing(rule: Any) -> Any:
        name = " / ".join(sorted(kind.value for kind in rule.kinds))
        return replace(rule, apply=counts.watched(rule.apply, "preparation", name, _is))

    def shortens(rule: shortening.Rule) -> shortening.Rule:
        def changed(after: object, before: object, *_: object) -> bool:
            return after != before

        return replace(rule, apply=counts.watched(rule.apply, "shortening", rule.name, changed))

    with ExitStack() as stack:
        stack.enter_context(mock.patch.object(strategy.Attempt, "load", loaded))
        stack.enter_context(mock.patch.object(Prover, "own", proved))
        stack.enter_context(mock.patch.object(block, "RULES", tuple(map(preparing, block.RULES))))
        stack.enter_context(mock.patch.object(shortening, "RULES", tuple(map(shortens, shortening.RULES))))
        yield counts


def _is(found: object, *_: object) -> bool:
    return found is not None


def measured(problems: Iterable[Problem], seconds: float, *, certify: bool) -> Counts:
    """The counts over problems, of which each may take so many seconds."""
    with watching() as counts:
        for problem in problems:
            counts.problem = f"{problem.set} {problem.id}"
            with suppress(QEError):
                run.solve(read(problem.formula, known=CONSTANTS), Options(certify=certify), Budget(seconds))
    return counts


def lines(counts: Counts) -> Iterator[str]:
    """A table, kind by kind, with the problems of what served one alone."""
    yield "   tried    used problems  seconds   in vain"
    for (kind, name), row in sorted(counts.items()):
        alone = f" ({min(row.served)})" if len(row.served) == 1 else ""
        yield f"{row}  {kind}: {name}{alone}"
