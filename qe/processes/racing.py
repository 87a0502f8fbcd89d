"""Several ways to the same answer side by side, each in a process of its own: the first answer wins."""

from __future__ import annotations

import contextlib
import os
import select
import signal
import time
from collections.abc import Callable, Mapping
from typing import TypeVar

from qe.errors import QEError, Unable
from qe.options import lost
from qe.processes.portable import rebuilt
from qe.processes.worker import Channel, Inbox, Known, Worker, forked
from qe.progress import Listener

T = TypeVar("T")
Name = TypeVar("Name")


def first(
    works: Mapping[Name, Callable[[Channel], T]],
    wins: Callable[[T], bool],
    *,
    seconds: float | None,
    progress: Listener,
    kept: Callable[[T], None] = lost,
) -> tuple[Name | None, dict[Name, T | QEError]]:
    """The name of the work whose result wins first (None if none does), and what has come of each until then.

    To be called in a process that ends soon after: the processes of the losers are ended when a winner is home, or with
    this one. ``kept`` gets what the works keep meanwhile. Raises ``Unable`` on systems without ``fork``, and nothing
    that the works raise.
    """
    if not hasattr(os, "fork"):
        raise Unable("a race needs a system that forks processes")
    running: dict[int, tuple[Name, Worker, Inbox]] = {}
    found: dict[Name, T | QEError] = {}
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, ())
    try:
        for name, work in works.items():
            side = forked(time.monotonic(), seconds, None)
            if isinstance(side, Channel):
                side.deliver(lambda work=work, side=side: work(side))  # type: ignore[misc]
            running[side.reading] = name, side, Inbox(side.reading)
        poll = select.poll()
        for descriptor in running:
            poll.register(descriptor, select.POLLIN | select.POLLHUP)
        while running:
            for descriptor, _ in poll.poll():
                name, side, inbox = running[descriptor]
                outcome = _heard(inbox, progress, kept)
                if outcome is None and not inbox.closed:
                    continue
                poll.unregister(descriptor)
                del running[descriptor]
                _end(side)
                if outcome is not None:
                    kind, value = outcome
                    found[name] = value if kind == "result" else rebuilt(value)  # type: ignore[assignment, arg-type]
                    if kind == "result" and wins(value):  # type: ignore[arg-type]
                        return name, found
        return None, found
    finally:
        for _, side, _ in running.values():
            _end(side)
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)  # forking had made it deaf to Ctrl-C


def _heard(inbox: Inbox, progress: Listener, kept: Callable[[T], None]) -> tuple[str, object] | None:
    """What has come from a process, passed on; its outcome, if that is there."""
    inbox.wait(0)
    known = Known()
    outcome = next((m for m in inbox.messages() if not known.take(*m, progress)), None)
    for value in known.kept():
        kept(value)
    return outcome


def _end(side: Worker) -> None:
    """The process is gone, whatever it was doing."""
    os.close(side.reading)
    with contextlib.suppress(ProcessLookupError):
        os.kill(side.pid, signal.SIGKILL)
    os.waitpid(side.pid, 0)
