"""Waits in tests end: every test has a limit, and what a test starts ends with it."""

from __future__ import annotations

import signal
import subprocess
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

AGAIN = 10.0
"""Seconds until what waits once more on its way out is ended, too."""


class NoEnd(BaseException):
    """A limit was reached; no ``Exception``, since code under test and Hypothesis take these for their own."""


@contextmanager
def limit(seconds: float) -> Iterator[None]:
    """Raise ``NoEnd`` in what has not ended after so many seconds, whatever it waits for, where the system can."""

    def late(number: int, frame: FrameType | None) -> None:
        raise NoEnd(f"no end after {seconds:g} s")

    if not hasattr(signal, "setitimer") or threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGALRM, late)
    outer, _ = signal.setitimer(signal.ITIMER_REAL, seconds, AGAIN)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, outer, AGAIN)
        signal.signal(signal.SIGALRM, before)


@contextmanager
def ending(process: subprocess.Popen[Any], seconds: float = 60) -> Iterator[subprocess.Popen[Any]]:
    """A process that is killed at the end, at the latest after so many seconds: reading from it and waiting end."""
    timer = threading.Timer(seconds, process.kill)
    timer.start()
    try:
        yield process
    finally:
        timer.cancel()
        process.kill()
        process.wait(seconds)
        for stream in (process.stdin, process.stdout, process.stderr):
            if stream is not None:
                stream.close()
