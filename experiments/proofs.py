"""How much of what the engine answers is proved step by step, at what cost: ``experiments proofs``.

Every problem is answered twice: without a check, and with one. An answer counts as proved when its certificate was
accepted and no step of its derivation is left unchecked, as fallen back on when a decomposition of the whole problem
was accepted in place of unchecked steps. Seconds are of processor time, those of processes that were started included.
"""

from __future__ import annotations

import statistics
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import qe
from experiments.adapters.__main__ import processor_time
from experiments.problem import Problem
from qe.proof.answer import Answer, Guarantee, Status

TICK = 0.004
"""Seconds below which processor time may be counted as none."""


@dataclass(frozen=True, slots=True)
class Proved:
    """One problem: seconds without and with the check, seconds of the checker alone, bytes of the certificate.

    ``same``: whether the answer is the same with and without the check.
    """

    problem: Problem
    solved: bool
    checked: bool = False
    unchecked: tuple[str, ...] = ()
    same: bool = True
    plain: float = 0.0
    whole: float = 0.0
    check: float = 0.0
    size: int = 0

    @property
    def by_steps(self) -> bool:
        """Whether every step is proved."""
        return self.checked and not self.unchecked

    def over(self, seconds: float) -> float:
        """Seconds over those of the answer without a check."""
        return seconds / max(self.plain, TICK)

    def __str__(self) -> str:
        if not self.solved:
            return f"unsolved  {self.problem.set} {self.problem.id}"
        word = "proved   " if self.by_steps else "fallback " if self.checked else "derived  "
        times = f"{self.plain:8.3f} s  {self.whole:8.3f} s  {self.check:8.3f} s  {self.size:8d} B"
        return f"{word} {times}  {self.problem.set} {self.problem.id}  {', '.join(self.unchecked)}"


def measured(problem: Problem, limit: float, memory: int) -> Proved:
    """One problem, answered without and with the check in ``limit`` seconds each."""
    plain, seconds = _answered(problem, limit, memory, check=False)
    answer, whole = _answered(problem, limit, memory, check=True)
    if answer.status is not Status.SOLVED:
        return Proved(problem, solved=False)
    check, size = 0.0, 0
    if answer.certificate is not None:
        start = processor_time()
        qe.verify(answer.certificate)
        check, size = processor_time() - start, len(answer.certificate.to_json())
    checked = answer.guarantee is Guarantee.CHECKED
    same = plain.status is not Status.SOLVED or plain.formula == answer.formula
    return Proved(problem, True, checked, answer.unchecked_steps, same, seconds, whole, check, size)


def _answered(problem: Problem, limit: float, memory: int, *, check: bool) -> tuple[Answer, float]:
    start = processor_time()
    answer = qe.eliminate(problem.formula, timeout=limit, memory=memory, check=check)
    return answer, processor_time() - start


def lines(rows: Sequence[Proved]) -> Iterator[str]:
    """The figures, set by set."""
    for name in dict.fromkeys(row.problem.set for row in rows):
        yield from _of_set(name, [row for row in rows if row.problem.set == name])


def _of_set(name: str, rows: Sequence[Proved]) -> Iterator[str]:
    solved = [row for row in rows if row.solved]
    proved = [row for row in solved if row.by_steps]
    fallback = [row for row in solved if row.checked and row.unchecked]
    yield f"{name}: {len(rows)} problems, {len(solved)} solved with the check"
    yield f"  every step checked {len(proved)}, by a decomposition instead {len(fallback)}, not checked " + str(
        len(solved) - len(proved) - len(fallback)
    )
    if proved:
        yield f"  check time over solve time, median {_median(r.over(r.check) for r in proved):.2f}"
        yield f"  time with the check over time without, median {_median(r.over(r.whole) for r in proved):.2f}"
        yield f"  certificate size, median {_median(r.size for r in proved) / 1000:.1f} kB"
    names = Counter(rule for row in solved for rule in row.unchecked)
    if names:
        yield "  unchecked steps: " + ", ".join(f"{rule} ({count})" for rule, count in names.most_common())
    different = [row.problem.id for row in solved if not row.same]
    if different:
        yield f"  OTHER ANSWERS with the check: {', '.join(different)}"


def _median(values: Iterable[float]) -> float:
    return statistics.median(values)
