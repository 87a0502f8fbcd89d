"""A sweep over a Dask cluster: a local one by default, or any with a scheduler's address.

Tasks go out in a window, so that a stopped sweep loses little; every outcome is in the file before it is told. When a
worker dies, the scheduler gives its tasks to others; a task that takes several workers down with it is sent again
``ATTEMPTS`` times and then recorded as failed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict
from typing import Any

from experiments.sweep.grid import Task
from experiments.sweep.solve import Outcome, outcome, solve
from experiments.sweep.store import Store
from qe.options import Cluster
from qe.processes.cluster import connection

WINDOW = 4
"""Tasks under way per worker."""

ATTEMPTS = 3


def sweep(
    tasks: Sequence[Task],
    store: Store,
    *,
    scheduler: str | None = None,
    workers: int = 2,
    timeout: float | None = None,
    note: Callable[[Outcome], None] = lambda outcome: None,
) -> None:
    """Solve the tasks that the store does not have. ``note`` is called with every outcome once it is stored.

    Raises ``InputError`` when no scheduler answers at the address, ``Unable`` when it has no worker.
    """
    todo = [task for task in tasks if task.key not in store.outcomes]
    if not todo:
        return
    with connection(Cluster(workers, scheduler)) as client:
        _Sweep(client, todo, timeout).run(lambda record: note(store.add(record)))


class _Sweep:
    """The tasks under way on one cluster."""

    def __init__(self, client: Any, tasks: Sequence[Task], timeout: float | None) -> None:
        from distributed import as_completed

        self.client, self.waiting, self.timeout = client, iter(tasks), timeout
        self.attempts: dict[str, tuple[Task, int]] = {}
        self.running = as_completed()

    def run(self, store: Callable[[dict[str, Any]], None]) -> None:
        """Keep the window full until nothing is left."""
        self._fill()
        for future in self.running:
            task, attempt = self.attempts.pop(future.key)
            if future.status == "finished":
                store(future.result())
            elif attempt < ATTEMPTS:
                self._submit(task, attempt + 1)
            else:
                error = future.exception()
                store(asdict(outcome(task, solved=False, message=f"{type(error).__name__}: {error}")))
            self._fill()

    def _fill(self) -> None:
        size = WINDOW * max(1, sum(self.client.nthreads().values()))
        while len(self.attempts) < size and (task := next(self.waiting, None)) is not None:
            self._submit(task, 1)

    def _submit(self, task: Task, attempt: int) -> None:
        future = self.client.submit(solve, task, self.timeout, key=f"{task.key} attempt {attempt}", pure=False)
        self.attempts[future.key] = (task, attempt)
        self.running.add(future)
