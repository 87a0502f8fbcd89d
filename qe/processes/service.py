"""A worker's end: it answers questions until who asks is gone."""

from __future__ import annotations

import contextlib
import gc
import math
import os
import pickle
import select
import signal
import sys
from collections.abc import Iterator
from functools import partial
from importlib import import_module
from typing import BinaryIO

from qe.errors import QEError
from qe.processes.channel import Channel, Message
from qe.processes.execution import OUTER
from qe.processes.portable import portable

LARGEST = 300
"""MiB that a worker may have when it is kept."""


def serve() -> None:
    """Answer the questions on standard input; whatever else reads or writes there gets and leaves nothing."""
    questions, home = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    nothing = os.open(os.devnull, os.O_RDWR)
    for number in range(3):
        os.dup2(nothing, number)
    if sys.platform != "win32":
        import resource

        signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for who asks, and that kills
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    with contextlib.suppress(EOFError):
        for name in pickle.load(questions):
            with contextlib.suppress(ImportError):
                import_module(name)
        gc.freeze()  # what is loaded stays: no collection looks at it again
        gc.set_threshold(20_000, 20, 50)  # there are few circles: looking for them took a fifth of the time
        _send(home, ("ready", None))
        while True:
            work, deadline, memory, general = pickle.load(questions)
            sys.path[:], recursion, digits = general
            sys.setrecursionlimit(recursion)
            sys.set_int_max_str_digits(digits)
            OUTER.set((deadline, math.inf if memory is None else memory))
            _answer(work, Channel(partial(_send, home), deadline), memory, questions, home)


def _send(home: BinaryIO, message: Message) -> None:
    _write(home, pickle.dumps(message))


def _write(home: BinaryIO, data: bytes) -> None:
    try:
        home.write(data)
        home.flush()
    except OSError:  # nobody is there any more
        os._exit(1)


def _answer(work: bytes, channel: Channel, memory: int | None, questions: BinaryIO, home: BinaryIO) -> None:
    try:
        with _bound_to(questions), _confined(memory):
            data = pickle.dumps(("result", pickle.loads(work)(channel)))
        is_fit = _size() <= LARGEST
    except BaseException as error:  # noqa: BLE001  # whatever it is, it is sent
        data = pickle.dumps(("error", portable(error)))
        is_fit = isinstance(error, QEError)  # after any other, modules may be half loaded
    _write(home, data + pickle.dumps(is_fit))


@contextlib.contextmanager
def _bound_to(questions: BinaryIO) -> Iterator[None]:
    """Within, this process ends with the one that asks, also in the middle of a call that nothing interrupts: then the
    pipe is closed, for which Linux sends a signal. Elsewhere it ends when it next has something to tell."""
    if sys.platform != "linux":
        yield
        return
    import fcntl

    fcntl.fcntl(questions, fcntl.F_SETOWN, os.getpid())
    flags = fcntl.fcntl(questions, fcntl.F_GETFL)
    fcntl.fcntl(questions, fcntl.F_SETFL, flags | os.O_ASYNC)
    if select.select([questions], [], [], 0)[0]:  # it was closed before
        os._exit(1)
    try:
        yield
    finally:
        fcntl.fcntl(questions, fcntl.F_SETFL, flags)


@contextlib.contextmanager
def _confined(memory: int | None) -> Iterator[None]:
    """Within, the address space has at most so many MiB, on systems that know such a limit."""
    if memory is None or sys.platform == "win32":
        yield
        return
    import resource

    from qe.processes.worker import end_idle

    before, hard = resource.getrlimit(resource.RLIMIT_AS)
    bounds = [v for v in (memory << 20, before, hard) if v != resource.RLIM_INFINITY]
    resource.setrlimit(resource.RLIMIT_AS, (min(bounds), hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (before, hard))
        end_idle()  # workers of this one that were started under the limit


def _size() -> int:
    """MiB that this process has in memory, where the system tells; elsewhere what it had at most, or 0."""
    if sys.platform == "win32":
        return 0
    try:
        with open("/proc/self/statm") as handle:
            return int(handle.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") >> 20
    except OSError:
        import resource

        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss >> 20
