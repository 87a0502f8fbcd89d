"""A session: what is still to do, a display of how far it is, and every result in the file at once."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from experiments.adapters.answer import Limits
from experiments.crosscheck import crosscheck
from experiments.display import progress
from experiments.environment import fingerprint
from experiments.measures import par2
from experiments.problem import Problem
from experiments.results import Appender, Result, Status, read_log
from experiments.runner import Job, is_done, plan, run_jobs, run_one
from experiments.solvers import Solver

WARM_UP = Problem("warm-up", "warm-up", "ex x. x^2 = 2 and x > 0", "true")

Work = Sequence[tuple[Sequence[Problem], Sequence[Solver]]]


class Session:
    """Runs work and adds its results to a file; ``log`` holds what the file holds."""

    def __init__(self, path: Path, limits: Limits, *, workers: int = 1, again: bool = False) -> None:
        self.path, self.limits, self.workers, self.again = path, limits, workers, again
        self.log = read_log([path])
        self._file = Appender(path)

    def run(self, work: Work, *, repeat: int = 1, seed: int = 1) -> None:
        """Run what has no result yet, then compare answers of problems without an expected one."""
        planned = (job for problems, solvers in work for job in plan(problems, solvers, repeat=repeat, seed=seed))
        jobs = list({job.key: job for job in planned}.values())  # two suites may share problems
        todo = [job for job in jobs if self.again or not is_done(job, self.log, self.limits)]
        usable = self._usable({job.solver for job in todo})
        todo = [job for job in todo if job.solver in usable]
        record = fingerprint(limit=self.limits.seconds, memory=self.limits.memory, jobs=self.workers, seed=seed)
        if todo:
            self._keep(record)
        with progress("runs", len(todo)) as (note, advance):
            for row in run_jobs(todo, self.limits, workers=self.workers, environment=record["name"]):
                self._keep(asdict(row))
                advance(1)
                note(line(row))
            problems = [p for listed, _ in work for p in listed]
            for c in crosscheck(problems, self.log, memory=self.limits.memory):
                self._keep({"kind": "comparison", **asdict(c)})
                if c.verdict == "different":
                    note(f"DISAGREEMENT: {c.left} and {c.right} on {c.set} {c.id}")
            for text in summary(self.log.results[job.key] for job in jobs if job.key in self.log.results):
                note(text)

    def _keep(self, record: Mapping[str, Any]) -> None:
        self._file.write(record)
        self.log.add(record)

    def _usable(self, solvers: Iterable[Solver]) -> set[Solver]:
        """Run the warm-up problem, unrecorded: it fills caches and shows which solvers are there."""
        found = set()
        for solver in sorted(solvers, key=lambda s: s.name):
            row = run_one(Job(WARM_UP, solver, 0), self.limits)
            if row.status not in (Status.UNSUPPORTED, Status.CRASH):
                found.add(solver)
            else:
                why = f"{row.status.value} on the warm-up problem: {row.message}"
                print(f"experiments: {solver.name} is left out: {why}", file=sys.stderr)
        return found


def line(row: Result) -> str:
    """One result for people."""
    return (
        f"{row.status.value:<11} {row.seconds:8.3f} s  {row.solver:<14} {row.set} {row.id}  {row.message[:80]}".rstrip()
    )


def summary(rows: Iterable[Result]) -> Iterator[str]:
    """One line per set and solver: counts and PAR-2."""
    groups: dict[tuple[str, str], list[Result]] = {}
    for row in rows:
        if row.status is Status.UNSUPPORTED:
            continue
        groups.setdefault((row.set, row.solver), []).append(row)
    for (name, solver), group in sorted(groups.items()):
        solved, wrong = sum(r.is_solved for r in group), sum(r.status is Status.WRONG for r in group)
        yield f"{name} {solver}: solved {solved} of {len(group)}, wrong {wrong}, PAR-2 {par2(group):.1f} s"
