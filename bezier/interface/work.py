"""The work on a plan from Python: its path at once, all that is proved and measured about it when it is asked for."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TypeVar

from bezier.paths.path import Path
from bezier.planner.planning import begin_plan, finish_plan, make_plan
from bezier.plans import Begun, Clock, Plan
from bezier.problem import Problem
from qe import arguments
from qe.errors import BudgetExceeded
from qe.options import Budget
from qe.processes.execution import perform
from qe.processes.limits import Limits

T = TypeVar("T")


def limited(work: Callable[[Budget], T], timeout: object, memory: object, progress: object) -> T:
    """The work under the limits of a caller, in a process that can be killed: at once where there are any limits, as
    solvers take long without a look at them. Raises ``InputError`` for what are none."""
    bounds = Limits(arguments.seconds(timeout), arguments.mebibytes(memory), arguments.listener(progress))
    return perform(work, bounds, at_once=bounds.timeout is not None)


def unlimited(work: Callable[[], T], budget: Budget) -> T:
    """Work that looks at no budget: it is killed at its limits."""
    return work()


class Work:
    """A plan in two parts, each done once and under the limits, whose time is for both together.

    Only a problem without obstacles, limits of the motion and arm has two parts: there the path is the optimum in its
    workspace, proved to stay inside. ``seconds``: what both parts took so far.
    """

    def __init__(self, problem: Problem, limits: Limits, *, proofs: bool = False) -> None:
        self.problem, self.limits, self.proofs = problem, limits, proofs
        self.seconds = 0.0
        self._begun: Begun | None = None
        self._plan: Plan | None = None
        self._lock = threading.RLock()

    def __reduce__(self) -> tuple[Callable[[Plan, float], Work], tuple[Plan, float]]:
        """What is stored is the whole plan: another process knows no limits of this one."""
        return Work.done, (self.plan, self.seconds)

    @staticmethod
    def done(plan: Plan, seconds: float = 0.0) -> Work:
        """A plan that is known."""
        work = Work(plan.problem, Limits())
        work._plan, work.seconds = plan, seconds
        return work

    def shows_path(self) -> bool:
        """Whether the first part alone shows that there is a path; else all is done. Raises as ``make_plan``."""
        if self._plan is None and self._begun is None and not self.proofs:
            self._begun = self._limited(partial(begin_plan, self.problem))
        return self._begun is not None and self._begun.outcome.is_success

    @property
    def known(self) -> Begun | Plan:
        """What is known already, with the problem, the outcome and the path: the plan, or its first part."""
        return self._begun if self._plan is None and self._begun is not None else self.plan

    @property
    def path(self) -> Path | None:
        """The path of the first part."""
        return self.known.path

    @property
    def plan(self) -> Plan:
        """The whole plan, worked out now if it was not before. Raises as ``make_plan``."""
        with self._lock:
            if self._plan is None:
                self._plan = self._limited(partial(_whole, self.problem, self._begun, self.proofs))
            return self._plan

    def _limited(self, work: Callable[[Clock], T]) -> T:
        """The work in what is left of the limits; where there are any, in a process that can be killed."""
        bounds, begin = self.limits, time.perf_counter()
        if bounds.timeout is not None:
            if self.seconds >= bounds.timeout:
                raise BudgetExceeded(f"time limit of {bounds.timeout:g} s reached before this was asked for")
            bounds = replace(bounds, timeout=bounds.timeout - self.seconds)
        try:
            if bounds.timeout is None and bounds.memory is None:
                return work(Clock(listener=bounds.progress))
            return perform(partial(_timed, work), bounds, at_once=True)
        finally:
            self.seconds += time.perf_counter() - begin


def _whole(problem: Problem, begun: Begun | None, proofs: bool, clock: Clock) -> Plan:
    if begun is None:
        return make_plan(problem, clock, proofs=proofs)
    clock.seconds.update(begun.seconds)
    return finish_plan(begun, clock, proofs=proofs)


def _timed(work: Callable[[Clock], T], budget: Budget) -> T:
    return work(Clock(limit=budget.remaining(), listener=budget.listener))
