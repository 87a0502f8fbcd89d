"""A sweep over a Dask cluster: a local one by default, or any with a scheduler's address.

Tasks go out in a window, so that a stopped sweep loses little; every outcome is in the file before it is told. When a
worker dies, the scheduler gives its tasks to others; a task that takes several workers down with it is sent again
``ATTEMPTS`` times and then recorded as failed.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from typing import Any

from experiments.sweep.grid import Task
from experiments.sweep.solve import Outcome, outcome, solve
from experiments.sweep.store import Store
from qe.errors import InputError, Unable

WINDOW = 4
"""Tasks under way per worker."""

ATTEMPTS = 3
CONNECTING = 5.0
"""Seconds to wait for a scheduler."""

PATIENCE = 60.0
"""Seconds to wait for the first worker."""


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
    with _client(scheduler, workers) as client:
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


@contextmanager
def _client(scheduler: str | None, workers: int) -> Iterator[Any]:
    try:
        from distributed import Client, LocalCluster
    except ImportError:
        raise InputError("a sweep needs the packages of the extra 'sweep': pip install 'bezier-qe[sweep]'") from None

    if scheduler is None:
        quiet = logging.CRITICAL
        with (
            LocalCluster(
                n_workers=workers, threads_per_worker=1, processes=True, dashboard_address=":0", silence_logs=quiet
            ) as cluster,
            Client(cluster) as client,
        ):
            yield client
        return
    try:
        remote = Client(scheduler, timeout=CONNECTING)
    except (OSError, ValueError) as error:
        raise InputError(f"--scheduler: a Dask scheduler at {scheduler} expected, none found ({error})") from None
    with remote as client:
        try:
            client.wait_for_workers(1, timeout=PATIENCE)
        except TimeoutError:
            raise Unable(f"the scheduler at {scheduler} has no worker") from None
        yield client
