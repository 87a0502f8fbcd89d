"""What a worker does with one problem of a sweep."""

from __future__ import annotations

import os
import platform
import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from fractions import Fraction
from typing import Any

import qe
from bezier.methods.cubic import formula as cubic
from bezier.methods.quadratic import formula as quadratic
from bezier.problem import read_problem
from experiments.sweep.grid import Method, Task
from qe.errors import Unable

VOLUME_ERROR = 0.05
"""Relative; a volume within 1 % takes several times as long and looks the same in a picture."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """One line of a sweep. ``solved`` is false where the engine gave up, ``message`` says why.

    ``volume_low`` and ``volume_high`` enclose the volume of the region of (8); ``objective`` is that of (7), rounded,
    and ``objective_exact`` as it is. ``worker`` is machine and process.
    """

    key: str
    half_width: str
    height: str
    radius: str
    method: str
    solved: bool
    feasible: bool | None = None
    volume_low: float | None = None
    volume_high: float | None = None
    objective: float | None = None
    objective_exact: str | None = None
    seconds: float = 0.0
    worker: str = ""
    message: str = ""


def solve(task: Task, timeout: float | None = None) -> dict[str, Any]:
    """The outcome as a record; an inability of the engine is an outcome, a bug is raised."""
    start = time.perf_counter()
    work = _quadratic if task.method is Method.QUADRATIC else _cubic
    try:
        found = {"solved": True, **work(task, timeout)}
    except Unable as error:
        found = {"solved": False, "message": str(error)}
    return asdict(outcome(task, seconds=round(time.perf_counter() - start, 4), worker=_worker(), **found))


def outcome(task: Task, **found: Any) -> Outcome:
    """An outcome for this task."""
    d, k, r = (str(value) for value in (task.half_width, task.height, task.radius))
    return Outcome(task.key, d, k, r, task.method.value, **found)


def _worker() -> str:
    return f"{platform.node()}:{os.getpid()}"


def _problem(task: Task) -> Any:
    d, k, r = task.half_width, task.height, task.radius
    return read_problem(
        f'via = [["{-d}", 0, "{k}"], ["{d}", 0, "{k}"]]\nstart = ["{-r}", 0, 0]\ngoal = [0, "{r}", 0]\nradius = "{r}"'
    )


def _quadratic(task: Task, timeout: float | None) -> Mapping[str, Any]:
    """Is there a Q1, and how much room has it?"""
    conditions = quadratic.system(_problem(task)).in_free_points().formula
    region = qe.region(conditions, order=quadratic.FREE, timeout=timeout)
    if region.is_empty:
        return {"feasible": False, "volume_low": 0.0, "volume_high": 0.0}
    low, high = region.volume(VOLUME_ERROR)
    return {"feasible": True, "volume_low": float(low), "volume_high": float(high)}


def _cubic(task: Task, timeout: float | None) -> Mapping[str, Any]:
    """The least |Q1 - Q0|^2 + |Q2 - Q1|^2 + |R0 - Q2|^2 under the conditions of (7), which can always be met."""
    system = cubic.system(_problem(task))
    optimum = qe.minimize(system.objective().polynomial, system.in_free_points().formula, timeout=timeout)
    if not optimum.is_optimal:
        return {"feasible": False}
    value: Fraction | Any = optimum.value
    return {"feasible": True, "objective": float(value), "objective_exact": str(value)}
