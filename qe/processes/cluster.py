"""Helpers for long work: the processes of a Dask cluster, a local one or any with a scheduler's address.

The cluster is started beside the work, once that has taken long. Calls go out a few ahead of the result that is
waited for, as many together as take about ``BATCH`` seconds: a message costs the scheduler and this process some
milliseconds, more than many a call. When a worker dies, the scheduler gives its calls to others; a call that takes
several workers down with it, and all calls of a cluster that is gone, are made here.
"""

from __future__ import annotations

import gc
import logging
import os
import pickle
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from itertools import islice
from threading import Event, Thread
from typing import Any

from qe.errors import InputError, QEError, Unable
from qe.extras import lacking
from qe.options import Call, Cluster, Helpers, Result

HELP_AFTER = 1.0
"""Seconds of work before helpers are started: before that, starting them would take longer than the work."""

AHEAD = 3
"""Batches under way for each worker."""

BATCH = 0.5
"""Seconds of work that are sent together."""

LARGEST = 16
"""Calls in a batch."""

CONNECTING, PATIENCE = 5.0, 60.0
"""Seconds to wait for a scheduler, and for its first worker."""

WAIT = 0.1
"""Seconds between two looks at the limits."""

LEASH = "qe.processes.leash"
"""Processes here end with the one that started them, however it ended."""

QUIET = {
    "distributed.worker.profile.enabled": False,
    "distributed.admin.system-monitor.gil.enabled": False,
    "distributed.admin.tick.interval": "500ms",
}
"""What workers here do not watch of themselves: it would take some percent of their time."""


@contextmanager
def helping(cluster: Cluster) -> Iterator[Helpers]:
    """The helpers of a cluster, started when they are first needed and ended with the block."""
    helpers = _Helpers(cluster)
    try:
        yield helpers
    finally:
        helpers.end()


@dataclass(frozen=True, slots=True)
class _Made:
    """Of a batch: the results up to the first error, pickled, and their number; that error; processor seconds."""

    packed: bytes
    count: int
    error: QEError | None
    seconds: float

    @property
    def results(self) -> list[Any]:
        """The results. Python's collector of cycles rests meanwhile: among so many new objects, none of them in a
        cycle, it would take most of the time."""
        resting = gc.isenabled()
        gc.disable()
        try:
            found: list[Any] = pickle.loads(self.packed)
        finally:
            if resting:
                gc.enable()
        return found


def _together(calls: list[Call[Any]]) -> _Made:
    """The calls of a batch, one after the other; what a worker does."""
    start, done, error = time.thread_time(), [], None
    try:
        for call in calls:
            done.append(call())
    except QEError as found:
        error = found
    return _Made(pickle.dumps(done), len(done), error, time.thread_time() - start)


class _Helpers:
    """See ``qe.options.Helpers``. A thread has the connection, from the start of the cluster to its end."""

    def __init__(self, cluster: Cluster) -> None:
        self.cluster = cluster
        self.width = max(cluster.workers, 1)
        self._start = time.process_time()
        self._client: Any = None
        self._error: Exception | None = None
        self._thread: Thread | None = None
        self._known, self._unneeded = Event(), Event()
        self._gone = False
        self._size = 1

    def ready(self) -> bool:
        """See ``qe.options.Helpers``. Raises ``InputError`` where no scheduler answers, ``Unable`` without Dask."""
        if self._thread is None:
            if time.process_time() - self._start < HELP_AFTER:
                return False
            self.start()
        if self._error is not None:
            raise self._error
        return self._client is not None

    def start(self) -> None:
        """Begins to start the cluster."""
        self._thread = Thread(target=self._connect, name="cluster")
        self._thread.start()

    def end(self) -> None:
        """Ends the cluster, if it was started."""
        self._unneeded.set()
        if self._thread is not None:
            self._thread.join()

    def _connect(self) -> None:
        try:
            with connection(self.cluster) as client:
                self.width = max(self.width, len(client.nthreads()))
                self._client = client
                self._known.set()
                self._unneeded.wait()
        except (QEError, OSError, RuntimeError) as error:  # raised where the helpers are asked for
            self._error = error
        finally:
            self._known.set()

    def _connected(self) -> Any:
        if self._thread is None:
            self.start()
        self._known.wait()
        if self._client is None:
            raise self._error or Unable("the cluster did not start")
        return self._client

    def results(self, calls: Iterable[Call[Result]], check: Callable[[], None]) -> Iterator[Result]:
        """See ``qe.options.Helpers``. Raises ``InputError`` where no scheduler answers, ``Unable`` without Dask."""
        client, waiting = self._connected(), iter(calls)
        running: deque[tuple[list[Call[Result]], Any]] = deque()
        try:
            while True:
                while len(running) < AHEAD * self.width and (batch := list(islice(waiting, self._size))):
                    running.append((batch, client.submit(partial(_together, batch), pure=False)))
                if not running:
                    return
                made = self._result(*running[0], check)
                running.popleft()
                if made.count:  # so many fit into the next batch
                    fitting = int(BATCH * made.count / max(made.seconds, 1e-9))
                    self._size = max(1, min(fitting, 2 * made.count, LARGEST))
                yield from made.results
                if made.error is not None:
                    raise made.error
        finally:
            client.cancel([future for _, future in running], force=True)

    def _result(self, batch: list[Call[Result]], future: Any, check: Callable[[], None]) -> _Made:
        from distributed import KilledWorker, TimeoutError, wait

        while not self._gone:
            check()
            try:
                wait(future, timeout=WAIT)
            except TimeoutError:
                self._gone = self._client.status != "running"
                continue
            try:
                found: _Made = future.result()
            except KilledWorker:
                break
            return found
        return _together(batch)


@contextmanager
def connection(cluster: Cluster) -> Iterator[Any]:
    """A Dask client of the cluster, which has a worker. Raises ``InputError`` where no scheduler answers, ``Unable``
    where it has no worker, or without Dask."""
    try:
        from distributed import Client
        from distributed.deploy.subprocess import SubprocessCluster
    except ImportError as error:
        raise lacking(error) or error from None
    if cluster.address is None:
        parent = [str(os.getpid())]
        with _silent():
            local = SubprocessCluster(
                n_workers=cluster.workers,
                threads_per_worker=1,
                dashboard_address=None,
                scheduler_kwargs={"preload": LEASH, "preload_argv": parent},
                worker_kwargs={
                    "memory_limit": 0,
                    "config": QUIET,
                    "preload_nanny": LEASH,
                    "preload_nanny_argv": parent,
                },
                silence_logs=logging.CRITICAL,
            )
        with local, Client(local) as client:
            yield client
        return
    try:
        remote = Client(cluster.address, timeout=CONNECTING)
    except (OSError, ValueError) as error:
        raise InputError(f"cluster: a Dask scheduler expected at {cluster.address}, none found ({error})") from None
    with remote as client:
        try:
            client.wait_for_workers(1, timeout=PATIENCE)
        except TimeoutError:
            raise Unable(f"the scheduler at {cluster.address} has no worker") from None
        yield client


@contextmanager
def _silent() -> Iterator[None]:
    """Processes that are started meanwhile do not tell that they load something; the environment is theirs too."""
    name = "DASK_LOGGING__DISTRIBUTED"
    before = os.environ.get(name)
    os.environ[name] = "critical"
    try:
        yield
    finally:
        if before is None:
            del os.environ[name]
        else:
            os.environ[name] = before
