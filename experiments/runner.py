"""Runs every solver on every problem, in random order, under limits, and compares the answers with the expected ones.

A session is described by its jobs; those that have a result already are left out, which is how an interrupted session
goes on. Every result is in the file before the next one is shown.
"""

from __future__ import annotations

import json
import random
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from experiments.adapters.answer import Limits
from experiments.environment import now
from experiments.limits import BACKSTOP, Ending, Run, run_limited
from experiments.problem import ROOT, Problem
from experiments.results import Log, Result, Status
from experiments.solvers import Solver

START_UP = 15.0
"""Seconds for starting an interpreter and importing a solver, which are not solving time."""

COMPARING = 60.0
"""Seconds for comparing one answer with the expected one."""

LONGEST_ANSWER = 4000
"""Characters of an answer that are kept; a longer one is compared before it is cut."""

TRUTH_VALUES = ("true", "false")


@dataclass(frozen=True, slots=True)
class Job:
    """One run: which repetition of which solver on which problem."""

    problem: Problem
    solver: Solver
    repeat: int

    @property
    def key(self) -> tuple[str, str, str, int]:
        """The key of the job's result."""
        return self.problem.set, self.solver.name, self.problem.id, self.repeat


def plan(problems: Sequence[Problem], solvers: Sequence[Solver], *, repeat: int, seed: int) -> list[Job]:
    """All jobs in random order, so that no solver always runs on a machine that is warm, or busy, from another."""
    jobs = [Job(p, s, k) for p in problems for s in solvers for k in range(repeat)]
    random.Random(seed).shuffle(jobs)
    return jobs


def is_done(job: Job, log: Log, limits: Limits) -> bool:
    """Whether there is a result already: any answer, or a failure under a limit that was not lower."""
    row = log.results.get(job.key)
    return row is not None and (row.is_solved or row.limit >= limits.seconds or row.status is Status.WRONG)


def run_jobs(jobs: Sequence[Job], limits: Limits, *, workers: int = 1, environment: str = "") -> Iterator[Result]:
    """Results as they come; at most ``workers`` jobs run at a time."""
    with ThreadPoolExecutor(workers) as pool:
        futures = [pool.submit(run_one, job, limits, environment) for job in jobs]
        try:
            for future in as_completed(futures):
                yield future.result()
        finally:  # after an interruption: what has not begun does not begin
            pool.shutdown(wait=False, cancel_futures=True)


def run_one(job: Job, limits: Limits, environment: str = "") -> Result:
    """Solve one problem and compare the answer."""
    problem = job.problem
    told = {"formula": problem.formula, "limit": BACKSTOP * limits.seconds, "memory": limits.memory}
    run = run_limited(
        job.solver.command,
        json.dumps(told),
        seconds=limits.seconds,
        memory=limits.memory,
        start_up=START_UP,
        folder=job.solver.folder,
    )
    found = _outcome(run, limits)
    status = verdict(problem, found.answer, limits) if found.status is Status.SOLVED else found.status
    return Result(
        set=problem.set,
        solver=job.solver.name,
        id=problem.id,
        status=status,
        seconds=round(found.seconds, 4),
        wall=round(run.wall, 3),
        limit=limits.seconds,
        answer=found.answer[:LONGEST_ANSWER],
        message=found.message[-300:],
        repeat=job.repeat,
        size=problem.size,
        peak=round(run.peak, 1),
        cpu=round(found.cpu, 4),
        length=len(found.answer),
        environment=environment,
        date=now(),
    )


@dataclass(frozen=True, slots=True)
class Outcome:
    """What a run says of itself, before its answer is compared."""

    status: Status
    seconds: float
    answer: str = ""
    message: str = ""
    cpu: float = 0.0


def _outcome(run: Run, limits: Limits) -> Outcome:
    """The outcome of a run that ended by itself or at a limit."""
    if run.ending is Ending.TIME:
        return Outcome(Status.TIMEOUT, limits.seconds, cpu=limits.seconds)
    if run.ending is Ending.MEMORY:
        return Outcome(Status.MEMORY, run.wall, message=f"{run.peak:.0f} MiB")
    report = _report(run.out)
    if run.code != 0 or report is None:
        last = (run.err.strip().splitlines() or [""])[-1]
        ran_out = any(sign in run.err for sign in ("MemoryError", "bad_alloc", "allocate memory", "out of memory"))
        return Outcome(Status.MEMORY if ran_out else Status.CRASH, run.wall, message=f"exit {run.code}: {last}")
    status, seconds = Status(report["status"]), float(report["seconds"])
    cpu = float(report.get("cpu", seconds))
    if cpu > limits.seconds:
        return Outcome(Status.TIMEOUT, limits.seconds, cpu=limits.seconds)
    return Outcome(status, seconds, report.get("answer", ""), report.get("message", ""), cpu)


def _report(out: str) -> dict[str, Any] | None:
    """The last line that is a report."""
    for line in reversed(out.splitlines()):
        if line.startswith("{") and "status" in (report := json.loads(line)):
            return dict(report)
    return None


def verdict(problem: Problem, answer: str, limits: Limits) -> Status:
    """The status of an answer after comparison with the expected one."""
    if problem.expected is None:
        return Status.UNCOMPARED
    word = compared(answer, problem.expected, problem.assume, limits.memory)
    return {"equivalent": Status.SOLVED, "probed": Status.PROBED, "different": Status.WRONG}[word]


@lru_cache(maxsize=4096)  # repetitions give the same answer again
def compared(left: str, right: str, assume: str | None, memory: int) -> str:
    """The word of ``experiments.compare`` for two answers; "probed" where it takes too long."""
    left, right = left.strip(), right.strip()
    if left == right:
        return "equivalent"
    if assume is None and left in TRUTH_VALUES and right in TRUTH_VALUES:
        return "different"
    task = json.dumps({"answer": left, "expected": right, "assume": assume})
    command = [sys.executable, "-m", "experiments.compare"]
    run = run_limited(command, task, seconds=COMPARING, memory=memory, folder=ROOT)
    word = run.out.strip()
    return word if word in ("equivalent", "different") else "probed"
