"""Workers: processes that are started once, answer questions one after the other, and can be killed at any time.

A worker is an interpreter of its own, started afresh on every system: it shares nothing with this process but two
pipes, so neither threads nor locks nor the main module of the caller matter to it. A question is a pickled callable
(``qe.processes.service`` has the other end). Whoever asks has a worker alone; a worker that has been killed or has
grown is replaced by a new one.
"""

from __future__ import annotations

import atexit
import contextlib
import math
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable

from qe.errors import BudgetExceeded, Unable, restored
from qe.processes.channel import Known, Message, WorkerDied, WorkerStopped
from qe.processes.limits import Limits

START = "import sys; sys.path[:] = sys.argv[1:]; from qe.processes.service import serve; serve()"
PACKAGES = ("qe.", "bezier.")
"""What is loaded of these in the process that asks is loaded before the first question, whose time it is not."""
MOST_IDLE = 4
"""Workers that are kept; more of them run only while as many threads ask at once."""

IDLE: list[Worker] = []
"""The workers of this process that wait for a question: they are kept, since it takes long to start one."""


class Worker:
    """A process that answers questions, for one asker at a time."""

    def __init__(self) -> None:
        command = [sys.executable, "-c", START, *sys.path]
        self.process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL
        )
        self.owner, self.is_late, self.is_fit, self.is_loaded = os.getpid(), False, True, False
        with contextlib.suppress(OSError):
            self.send(pickle.dumps([name for name in sys.modules if name.startswith(PACKAGES)]))

    def load(self) -> None:
        """Wait until it has loaded what is loaded here."""
        assert self.process.stdout is not None
        if not self.is_loaded:
            with contextlib.suppress(OSError, EOFError):  # where it has ended, that is the outcome of its question
                self.is_loaded = bool(pickle.load(self.process.stdout))

    @property
    def is_usable(self) -> bool:
        """Whether it can take a further question; a process that was forked from its owner must not ask it."""
        return self.owner == os.getpid() and self.is_fit and not self.is_late and self.process.poll() is None

    def send(self, question: bytes) -> None:
        """Begin a question. Raises ``OSError`` where the process has ended."""
        assert self.process.stdin is not None
        self.process.stdin.write(question)
        self.process.stdin.flush()

    def outcome(self, take: Callable[[Message], bool], until: float) -> Message | None:
        """The first message that ``take`` does not take; None where the process ended before, by ``until`` at last.

        The worker is free afterwards; it is gone where ``take`` raises, or what was sent cannot be read.
        """
        assert self.process.stdout is not None
        timer = threading.Timer(min(max(0.0, until - time.monotonic()), threading.TIMEOUT_MAX), self._kill_late)
        timer.daemon = True
        self.is_fit = False
        try:
            if until < math.inf:
                timer.start()
            message: Message = pickle.load(self.process.stdout)
            while take(message):
                message = pickle.load(self.process.stdout)
            self.is_fit = pickle.load(self.process.stdout)
            return message
        except (EOFError, pickle.UnpicklingError):
            self.process.wait()
            return None
        finally:
            if until < math.inf:
                timer.cancel()
                timer.join()
            self._release()

    def _kill_late(self) -> None:
        self.is_late = True
        self.process.kill()

    def _release(self) -> None:
        """It waits for the next question, or ends where it cannot or need not."""
        if self.is_usable and len(IDLE) < MOST_IDLE:
            IDLE.append(self)
        else:
            self.end()
            if self.is_late and not IDLE:
                with contextlib.suppress(OSError):
                    IDLE.append(Worker())  # it loads until there is a next question

    def kill(self) -> None:
        """The process is gone, whatever it was doing; who waits for its outcome gets None."""
        if self.owner == os.getpid():
            self.process.kill()
            self.process.wait()

    def end(self) -> None:
        """The process and its pipes are gone."""
        self.kill()
        for pipe in (self.process.stdin, self.process.stdout):
            assert pipe is not None
            with contextlib.suppress(OSError):  # what was not sent
                pipe.close()


@atexit.register
def end_idle() -> None:
    """End the workers that wait."""
    while IDLE:
        IDLE.pop().end()


def begun(work: bytes, limits: Limits, deadline: float) -> tuple[Worker, float]:
    """A worker that has this question, and its deadline: half of the time is left where the start of a worker took it.

    What holds for the whole of this interpreter goes with it.
    """
    general = list(sys.path), sys.getrecursionlimit(), sys.get_int_max_str_digits()
    start = time.monotonic()
    while True:
        try:
            worker, is_new = IDLE.pop(), False
        except IndexError:
            worker, is_new = Worker(), True
        is_sent = False
        try:
            if is_new or worker.is_usable:
                worker.load()
                until = max(deadline, time.monotonic() + (deadline - start) / 2)
                worker.send(pickle.dumps((work, until, limits.memory, general)))
                is_sent = True
                return worker, until
        except OSError:  # it was killed while it waited
            if is_new:
                raise
        finally:
            if not is_sent:
                worker.end()


def asked(work: bytes, limits: Limits, deadline: float, grace: float, known: Known) -> object:
    """What a worker makes of the work; see ``qe.processes.execution.run``."""
    worker, deadline = begun(work, limits, deadline)
    message = worker.outcome(lambda message: known.take(message, limits.progress), deadline + grace)
    return settled(worker, message, limits, known)


def settled(worker: Worker, message: Message | None, limits: Limits, known: Known) -> object:
    """The result in the outcome of a question. Raises its error, or what ended the worker."""
    if message is None:
        raise _ended(worker, limits, known)
    kind, value = message
    if kind == "result":
        return value
    error = restored(*value)  # type: ignore[misc]
    if type(error) is BudgetExceeded:  # a soft limit: the same story, told with what is known
        raise WorkerStopped(str(error), limit=error.limit, known=known)
    raise error


def _ended(worker: Worker, limits: Limits, known: Known) -> Unable:
    """The error for a worker that ended without an outcome."""
    if worker.is_late:
        return WorkerStopped(f"time limit of {limits.timeout:.4g} s reached", limit="time", known=known)
    status = worker.process.returncode
    number = max(-status, 0)
    if limits.memory is not None and number in _numbers("SIGABRT", "SIGSEGV", "SIGBUS", "SIGKILL"):
        return WorkerStopped(f"memory limit of {limits.memory} MiB reached", limit="memory", known=known)
    how = f"signal {number} ({signal.strsignal(number)})" if number else f"status {status}"
    hint = "; out of memory is the likely cause" if number in _numbers("SIGABRT", "SIGKILL") else ""
    return WorkerDied(f"the worker process ended by {how}{hint}", signal_number=number, known=known)


def _numbers(*names: str) -> set[int]:
    """The numbers of those signals that this system has."""
    return {getattr(signal, name) for name in names if hasattr(signal, name)}
