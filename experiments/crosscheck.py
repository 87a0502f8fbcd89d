"""Problems without a known answer: the answers of the solvers are compared with each other."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator, Mapping, Sequence

from experiments.measures import place
from experiments.problem import Problem
from experiments.results import Comparison, Log, Result, Status
from experiments.runner import LONGEST_ANSWER, compared


def crosscheck(problems: Iterable[Problem], log: Log, *, memory: int) -> Iterator[Comparison]:
    """Compare every answer with that of the first solver that has one; what is compared already is left out."""
    answers = answers_by_problem(log.results.values())
    for problem in problems:
        rows = answers.get((problem.set, problem.id), ())
        if problem.expected is not None or len(rows) < 2:
            continue
        first, *others = rows
        for other in others:
            known = log.comparisons.get((problem.set, problem.id, first.solver, other.solver))
            digest = _digest(first.answer, other.answer)
            if known is None or known.answers != digest:
                word = compared(first.answer, other.answer, problem.assume, memory)
                yield Comparison(problem.set, problem.id, first.solver, other.solver, word, digest)


def answers_by_problem(rows: Iterable[Result]) -> Mapping[tuple[str, str], Sequence[Result]]:
    """The whole uncompared answers, one per solver, in the usual order."""
    found: dict[tuple[str, str], dict[str, Result]] = {}
    for row in rows:
        if row.status is Status.UNCOMPARED and row.answer and len(row.answer) < LONGEST_ANSWER:
            found.setdefault((row.set, row.id), {})[row.solver] = row
    return {key: sorted(rows.values(), key=lambda r: place(r.solver)) for key, rows in found.items()}


def _digest(*texts: str) -> str:
    return hashlib.sha256("\0".join(texts).encode()).hexdigest()[:16]
