"""Helpers for long work: the processes of a Dask cluster, a local one or any with a scheduler's address.

Calls go out a few ahead of the result that is waited for. When a worker dies, the scheduler gives its calls to others;
a call that takes several workers down with it, and all calls of a cluster that is gone, are made here.
"""

from __future__ import annotations

import logging
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

from qe.errors import InputError, Unable
from qe.extras import lacking
from qe.options import Call, Cluster, Helpers, Result

AHEAD = 3
"""Calls under way for each worker."""

CONNECTING, PATIENCE = 5.0, 60.0
"""Seconds to wait for a scheduler, and for its first worker."""

WAIT = 0.1
"""Seconds between two looks at the limits."""


@contextmanager
def helping(cluster: Cluster) -> Iterator[Helpers]:
    """The helpers of a cluster, started when they are first needed and ended with the block."""
    with ExitStack() as stack:
        yield _Helpers(cluster, stack)


class _Helpers:
    """See ``qe.options.Helpers``."""

    def __init__(self, cluster: Cluster, stack: ExitStack) -> None:
        self.cluster, self.stack = cluster, stack
        self._client: Any = None
        self._gone = False
        self.width, self.started = max(cluster.workers, 1), False

    def results(self, calls: Iterable[Call[Result]], check: Callable[[], None]) -> Iterator[Result]:
        """See ``qe.options.Helpers``. Raises ``InputError`` where no scheduler answers, ``Unable`` without Dask."""
        client, waiting = self._connected(), iter(calls)
        running: deque[tuple[Call[Result], Any]] = deque()
        try:
            while True:
                while len(running) < AHEAD * self.width and (call := next(waiting, None)) is not None:
                    running.append((call, client.submit(call, pure=False)))
                if not running:
                    return
                yield self._result(*running[0], check)
                running.popleft()
        finally:
            client.cancel([future for _, future in running], force=True)

    def _result(self, call: Call[Result], future: Any, check: Callable[[], None]) -> Result:
        from distributed import KilledWorker, TimeoutError, wait

        while not self._gone:
            check()
            try:
                wait(future, timeout=WAIT)
            except TimeoutError:
                self._gone = self._client.status != "running"
                continue
            try:
                found: Result = future.result()
            except KilledWorker:
                break
            return found
        return call()

    def _connected(self) -> Any:
        if self._client is None:
            self._client = self.stack.enter_context(connection(self.cluster))
            self.width, self.started = max(self.width, len(self._client.nthreads())), True
        return self._client


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
        local = SubprocessCluster(
            n_workers=cluster.workers,
            threads_per_worker=1,
            dashboard_address=None,
            worker_kwargs={"memory_limit": 0},
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
