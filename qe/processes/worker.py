"""Hard limits: run a callable in a forked process that is killed when a limit is reached.

FLINT calls hold the interpreter lock, cannot be interrupted, and abort the whole process when memory
runs out. Soft limits (``qe.options.Budget``) are checked between such calls; a limit that must hold is
enforced here, from outside. The worker streams progress events and partial results back, so that a
killed worker still leaves behind what was known when it ended.
"""

from __future__ import annotations

import contextlib
import ctypes
import faulthandler
import math
import os
import pickle
import select
import signal
import struct
import sys
import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass, field
from types import TracebackType
from typing import Any, Generic, NoReturn, TypeVar

from qe.errors import BudgetExceeded, Unable
from qe.processes.portable import portable, rebuilt
from qe.processes.surroundings import MARK, surrounding_deadline
from qe.progress import Event, Listener, silent

T = TypeVar("T")

GRACE, KEPT = 0.25, "result so far"
"""Seconds past the time limit before the kill, so that a soft limit in the worker can answer first; and the fact under
which a worker tells what is its result should a limit end it."""

_HEADER = struct.Struct("!I")


@dataclass(slots=True)
class Known:
    """What is known so far about a run: seconds used, phases met (last event each), partial results."""

    seconds: float = 0.0
    phases: dict[str, Event] = field(default_factory=dict)
    facts: dict[str, object] = field(default_factory=dict)

    def add(self, event: Event) -> None:
        """Note an event; phases keep the order in which they were last active."""
        self.phases.pop(event.phase, None)
        self.phases[event.phase] = event

    def take(self, kind: str, value: object, progress: Listener) -> bool:
        """Note a message of the worker; whether it was news on the way, not the outcome."""
        if kind == "event" and isinstance(value, Event):
            self.add(value)
            progress(value)
        elif kind == "fact" and isinstance(value, tuple):
            self.facts[value[0]] = value[1]
        else:
            return False
        return True

    def kept(self) -> list[Any]:
        """The result so far, if there is one."""
        return [self.facts[KEPT]] if KEPT in self.facts else []

    def __str__(self) -> str:
        """One line for people."""
        parts = [f"{key}: {value}" for key, value in self.facts.items()] + [_in_words(e) for e in self.phases.values()]
        return f"after {self.seconds:.1f} s: " + ("; ".join(parts) if parts else "nothing yet")


def _in_words(event: Event) -> str:
    count = f" {event.done}" if event.done else ""
    total = f" of {event.total}" if event.total is not None else ""
    note = f" ({event.note})" if event.note else ""
    return f"{event.phase}{count}{total}{note}"


class WorkerStopped(BudgetExceeded):
    """A limit ended the worker; ``limit`` is "time" or "memory", ``known`` is what it had reported by then."""

    def __init__(self, message: str, *, limit: str, known: Known) -> None:
        self.known = known
        super().__init__(message, limit=limit)


class WorkerDied(Unable):
    """The worker process ended by a signal that no limit explains; ``known`` is what it had reported by then."""

    def __init__(self, message: str, *, signal_number: int, known: Known) -> None:
        self.signal_number, self.known = signal_number, known
        super().__init__(message)


class Channel:
    """The worker's end: what the work may tell the parent before it is done."""

    def __init__(self, descriptor: int) -> None:
        self._descriptor = descriptor

    def __enter__(self) -> None:
        return None

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Whatever is wrong, the worker does not go back into the code of the caller."""
        if error is not None:
            self.fail(error)

    def event(self, event: Event) -> None:
        """A progress listener."""
        self._send(("event", event))

    def fact(self, name: str, value: object) -> None:
        """A partial result worth keeping should the worker be killed; ``value`` is picklable."""
        self._send(("fact", (name, value)))

    def keep(self, value: object) -> None:
        """A result that is worth having should the worker be ended before it is done."""
        self.fact(KEPT, value)

    def deliver(self, work: Callable[[], object]) -> NoReturn:
        """Compute, send the result or the error home, and end the process."""
        delivery = _Delivery[object](self)
        with delivery:
            delivery.done(work())
        raise AssertionError("the process has ended")

    def fail(self, error: BaseException) -> NoReturn:
        """Send the error home, and end the process."""
        _Delivery[object](self).__exit__(type(error), error, error.__traceback__)

    def _send(self, message: tuple[str, object]) -> None:
        data = memoryview(b"".join(_framed(pickle.dumps(message))))
        while data:
            data = data[os.write(self._descriptor, data) :]


class _Here(Channel):
    """The channel of work that is done in this process, on systems without ``fork``."""

    def __init__(self, known: Known, progress: Listener) -> None:
        self._known, self._progress = known, progress

    def _send(self, message: tuple[str, object]) -> None:
        self._known.take(*message, self._progress)


def _framed(data: bytes) -> tuple[bytes, bytes]:
    return _HEADER.pack(len(data)), data


class _Delivery(Generic[T]):
    """Runs in the worker: whatever leaves the block is sent home, and the process ends there.

    ``os._exit`` leaves buffers, exit handlers and test frameworks of the parent untouched.
    """

    def __init__(self, channel: Channel) -> None:
        self._channel = channel

    def __enter__(self) -> _Delivery[T]:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> NoReturn:
        status = 0
        try:
            if error is not None:
                self._channel._send(("error", portable(error)))
        except BrokenPipeError:  # the parent is gone: nobody is left to tell
            status = 1
        finally:
            os._exit(status)

    def done(self, value: T) -> None:
        """Hand over the result."""
        self._channel._send(("result", value))


def run(
    work: Callable[[Channel], T],
    *,
    timeout: float | None = None,
    memory: int | None = None,
    progress: Listener = silent,
    known: Known | None = None,
    grace: float = GRACE,
    start: float | None = None,
) -> T:
    """``work(channel)``, computed in a forked worker under hard limits.

    ``timeout``: wall-clock seconds, from ``start`` (of ``time.monotonic``) or now; the worker is killed ``grace``
    seconds after it. ``memory``: MiB of address space of the worker, the interpreter included. ``progress`` is called
    here, in the parent, with every event the worker sends; ``known`` is filled as the work goes on. The result must be
    picklable. No process is left behind, whatever happens.

    Raises ``WorkerStopped`` at a limit, ``WorkerDied`` when a signal ended the worker otherwise, and every
    ``QEError`` that the work itself raised; any other exception there arrives as ``InternalError``. Systems without
    ``fork`` do the work here: only the limits that it checks by itself hold.
    """
    if not hasattr(os, "fork"):
        return _done_here(work, progress, Known() if known is None else known)
    side = forked(time.monotonic() if start is None else start, timeout, memory, grace)
    if isinstance(side, Channel):
        side.deliver(lambda: work(side))
    return side.outcome(progress, known)  # type: ignore[return-value]


def _done_here(work: Callable[[Channel], T], progress: Listener, known: Known) -> T:
    start = time.monotonic()
    try:
        return work(_Here(known, progress))
    except BudgetExceeded as error:
        raise WorkerStopped(str(error), limit=error.limit, known=known) from error
    finally:
        known.seconds = time.monotonic() - start


def forked(start: float, timeout: float | None, memory: int | None, grace: float = GRACE) -> Channel | Worker:
    """Fork: the worker, confined to the limits, gets its ``Channel`` and the parent its ``Worker``.

    The time counts from ``start`` (of ``time.monotonic``). The worker must end in ``Channel.deliver`` or ``fail``, and
    the parent must call ``outcome``. Until then it is deaf to Ctrl-C, so that no worker is left behind.
    """
    outer = surrounding_deadline()
    reading, writing = os.pipe()
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        pid = _quiet_fork()
    except OSError:  # no further process
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        raise
    if pid:
        os.close(writing)
        return Worker(pid, reading, mask, start, timeout, memory, grace)
    channel = Channel(writing)
    with channel:
        os.close(reading)
        _confine(start, timeout, memory, grace, math.inf if outer is None else outer)
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)
    return channel


def _quiet_fork() -> int:
    """``os.fork``, without the warning of Python 3.12 and later for processes with several threads, such as Jupyter's.

    It warns of locks that another thread may hold. The worker takes none: it computes, writes to its pipe, and ends
    without exit handlers; the interpreter and the C library make their own locks usable after a fork. FLINT's threads
    would be waited for in vain in the worker, so they are ended before and begun again in the parent.
    """
    flint = sys.modules.get("flint")
    threads = 1 if flint is None else flint.ctx.threads
    if flint is not None and threads > 1:
        flint.ctx.threads = 1
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        pid = os.fork()
    if flint is not None and pid and threads > 1:
        flint.ctx.threads = threads
    return pid


@dataclass(slots=True)
class Worker:
    """The parent's end: a process to be waited for, by ``outcome``, exactly once."""

    pid: int
    reading: int
    mask: set[int | signal.Signals]
    start: float
    timeout: float | None
    memory: int | None
    grace: float

    def outcome(self, progress: Listener = silent, known: Known | None = None) -> object:
        """The result, as ``run`` gives it, with its errors."""
        status: int | None = None
        known = Known() if known is None else known
        try:
            signal.pthread_sigmask(signal.SIG_SETMASK, self.mask)
            deadline = None if self.timeout is None else self.start + self.timeout + self.grace
            inbox = Inbox(self.reading)
            outcome = _follow(inbox, known, progress, deadline)
            if outcome is None and inbox.closed:
                _, status = os.waitpid(self.pid, 0)
        finally:
            known.seconds = time.monotonic() - self.start
            os.close(self.reading)
            if status is None:
                os.kill(self.pid, signal.SIGKILL)
                os.waitpid(self.pid, 0)
        if outcome is None:
            raise _ended(status, known, self.timeout, self.memory)
        kind, value = outcome
        if kind == "result":
            return value
        error = rebuilt(value)  # type: ignore[arg-type]
        if type(error) is BudgetExceeded:  # a soft limit: the same story, told with what is known
            raise WorkerStopped(str(error), limit=error.limit, known=known)
        raise error


def _confine(start: float, timeout: float | None, memory: int | None, grace: float, outer: float) -> None:
    """In the worker: set the limits, die with the parent, keep the abort messages of C libraries to itself."""
    import resource  # Unix only, as is fork

    deadline = math.inf if timeout is None else start + timeout
    os.environ[MARK] = f"{os.getpid()}:{min(deadline, outer)}"
    left = max(0.0, deadline - time.monotonic())
    quiet = os.open(os.devnull, os.O_WRONLY)
    os.dup2(quiet, 2)
    os.close(quiet)
    faulthandler.disable()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_DFL)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    if memory is not None:
        _lower(resource.RLIMIT_AS, memory << 20)
    if timeout is not None:  # should the parent be gone, processor time ends the worker
        used = resource.getrusage(resource.RUSAGE_SELF)
        _lower(resource.RLIMIT_CPU, int(used.ru_utime + used.ru_stime + left + grace) + 2)
    with contextlib.suppress(OSError, AttributeError):
        ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG, where the system is Linux


def _lower(which: int, value: int) -> None:
    import resource

    soft, hard = resource.getrlimit(which)
    bounds = [v for v in (value, soft, hard) if v != resource.RLIM_INFINITY]
    resource.setrlimit(which, (min(bounds), hard))


class Inbox:
    """The parent's end of the pipe: whole messages out of a stream of bytes."""

    def __init__(self, descriptor: int) -> None:
        self.descriptor, self.closed, self._data = descriptor, False, bytearray()
        os.set_blocking(descriptor, False)
        self._poll = select.poll()
        self._poll.register(descriptor, select.POLLIN | select.POLLHUP)

    def wait(self, seconds: float | None) -> None:
        """Read what is there, waiting for it at most this long."""
        if not self._poll.poll(None if seconds is None else max(0.0, seconds * 1000)):
            return
        try:
            chunk = os.read(self.descriptor, 1 << 20)
        except BlockingIOError:
            return
        self.closed = not chunk
        self._data += chunk

    def messages(self) -> list[tuple[str, object]]:
        """The messages that have arrived whole, taken out of the box."""
        out: list[tuple[str, object]] = []
        position = 0
        while len(self._data) - position >= _HEADER.size:
            (length,) = _HEADER.unpack_from(self._data, position)
            end = position + _HEADER.size + length
            if end > len(self._data):
                break
            out.append(pickle.loads(self._data[position + _HEADER.size : end]))
            position = end
        del self._data[:position]
        return out


def _follow(inbox: Inbox, known: Known, progress: Listener, deadline: float | None) -> tuple[str, object] | None:
    """Take messages until the outcome, the end of the stream, or the deadline (None for the last two)."""
    while not inbox.closed:
        left = None if deadline is None else deadline - time.monotonic()
        if left is not None and left <= 0:
            return None
        inbox.wait(left)
        for kind, value in inbox.messages():
            if not known.take(kind, value, progress):
                return kind, value
    return None


def _ended(status: int | None, known: Known, timeout: float | None, memory: int | None) -> Unable:
    """The error for a worker that ended without an outcome; ``status`` is None when the deadline passed."""
    if status is None:
        return WorkerStopped(f"time limit of {timeout:.4g} s reached", limit="time", known=known)
    number = os.WTERMSIG(status) if os.WIFSIGNALED(status) else 0
    if number == signal.SIGXCPU:
        return WorkerStopped(f"time limit of {timeout or 0:.4g} s reached", limit="time", known=known)
    if memory is not None and number in (signal.SIGABRT, signal.SIGSEGV, signal.SIGBUS, signal.SIGKILL):
        return WorkerStopped(f"memory limit of {memory} MiB reached", limit="memory", known=known)
    how = f"signal {number} ({signal.strsignal(number)})" if number else f"status {os.WEXITSTATUS(status)}"
    hint = "; out of memory is the likely cause" if number in (signal.SIGABRT, signal.SIGKILL) else ""
    return WorkerDied(f"the worker process ended by {how}{hint}", signal_number=number, known=known)
