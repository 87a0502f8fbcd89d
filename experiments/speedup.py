"""How much sooner a long decomposition is done with helpers: processor time of every process, and the clock.

The machine may have other work, so the clock alone says little. The processor times tell what free cores would give:
what this process does is done by one core; the workers share what they do, and the fuller one ends last. The true time
lies between that of no overlap (this process and the scheduler, then the fullest worker) and that of a perfect one.
"""

from __future__ import annotations

import time
from dataclasses import dataclass

import qe
from qe.options import Cluster
from qe.processes.cluster import connection

QUESTION = "ex z. z^4 + x*z^2 + y*z + 1 < 0 and z^3 + y*z^2 > x and x*y*z < 1"
"""A decomposition of 330,000 cells: some 20 s of a free core."""


@dataclass(frozen=True, slots=True)
class Speedup:
    """Seconds: of one process alone, and with helpers; ``same``: whether answer and certificate are equal."""

    alone: float
    alone_clock: float
    parent: float
    scheduler: float
    workers: tuple[float, ...]
    clock: float
    same: bool

    def __str__(self) -> str:
        least, most = self.bounds
        helped = " + ".join(f"{seconds:.1f}" for seconds in self.workers)
        return (
            f"alone: {self.alone:.1f} s of processor time, {self.alone_clock:.1f} s on the clock\n"
            f"with {len(self.workers)} workers: this process {self.parent:.1f} s "
            f"({100 * self.parent / self.alone:.0f} % of alone), scheduler {self.scheduler:.1f} s, workers {helped} s\n"
            f"same answer and certificate: {'yes' if self.same else 'NO'}\n"
            f"speed-up on free cores, by processor time: between {least:.2f} and {most:.2f}\n"
            f"speed-up on the clock, as it was: {self.alone_clock / self.clock:.2f} ({self.clock:.1f} s)"
        )

    @property
    def bounds(self) -> tuple[float, float]:
        """The speed-up without any overlap of this process and the workers, and with a perfect one."""
        everything = self.parent + self.scheduler + sum(self.workers)
        serial = self.parent + self.scheduler + max(self.workers)
        return self.alone / serial, self.alone / max(everything / len(self.workers), self.parent, max(self.workers))


def measured(question: str, workers: int, *, method: str = "cad") -> Speedup:
    """One run with helpers and one alone, in this process; both with a certificate, which is not verified.

    The workers are started before and count what they do for the question only: their start is on the clock of a call
    by itself, about 2 s, during which the work goes on.
    """
    with connection(Cluster(workers=workers)) as client:
        client.wait_for_workers(workers)
        before, scheduler = client.run(time.process_time), client.run_on_scheduler(time.process_time)
        helped, parent, clock = _timed(question, method, client.scheduler.address)
        after, end = client.run(time.process_time), client.run_on_scheduler(time.process_time)
    alone, own, alone_clock = _timed(question, method, None)
    same = (helped.formula, helped.certificate) == (alone.formula, alone.certificate)
    spent = tuple(after[name] - before[name] for name in before)
    return Speedup(own, alone_clock, parent, end - scheduler, spent, clock, same)


def _timed(question: str, method: str, address: str | None) -> tuple[qe.Answer, float, float]:
    start, processor = time.monotonic(), time.process_time()
    answer = qe.eliminate(question, method=method, cluster=address, process=False)
    return answer, time.process_time() - processor, time.monotonic() - start
