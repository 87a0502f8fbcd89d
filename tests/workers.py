"""Tests reach into workers by questions, and look at the processes that are left."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import partial
from importlib import import_module

from qe.processes.channel import Channel
from qe.processes.execution import run
from qe.processes.limits import Limits
from qe.processes.worker import IDLE


def replace_in_worker(place: str, value: object) -> None:
    """In the worker that gets the next question, this name stands for ``value``, which can be pickled."""
    run(partial(_replaced, place, value), Limits(memory=1 << 20))  # limited: it moves in all tests


def stuck(*_: object, **__: object) -> None:
    """What is put in the place of work that takes too long, and never looks up."""
    time.sleep(600)


def large(*_: object, **__: object) -> bytes:
    """What is put in the place of work that takes too much memory."""
    return bytes(1 << 33)


def killed(*_: object, **__: object) -> None:
    """What is put in the place of work that a limit ends."""
    os.kill(os.getpid(), signal.SIGKILL)


def _replaced(place: str, value: object, channel: Channel) -> None:
    module, _, name = place.rpartition(".")
    holder = import_module(module)
    getattr(holder, name)  # it is there
    setattr(holder, name, value)


def children(pid: int | None = None) -> set[int]:
    """The processes that a process has started and not waited for, dead or alive."""
    pid = os.getpid() if pid is None else pid
    found: set[int] = set()
    for thread in os.listdir(f"/proc/{pid}/task"):
        # a thread may have ended since it was listed
        with suppress(FileNotFoundError, ProcessLookupError), open(f"/proc/{pid}/task/{thread}/children") as handle:
            found |= {int(n) for n in handle.read().split()}
    return found


@contextmanager
def only_idle_children() -> Iterator[None]:
    """Afterwards no process is left that was started on the way, but workers that wait."""
    before = children()
    yield
    assert children() - before <= {worker.process.pid for worker in IDLE}


def is_gone(pid: int, seconds: float = 10.0) -> bool:
    """Whether a process ends by itself within some seconds."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        try:
            with open(f"/proc/{pid}/stat") as handle:
                if handle.read().rpartition(")")[2].split()[0] in "ZX":
                    return True
        except OSError:
            return True
        time.sleep(0.02)
    return False
