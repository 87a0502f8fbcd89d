"""Every wait of a test ends: the limit that all tests have, and processes that do not end by themselves."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
import time

import pytest

from tests.waiting import NoEnd, ending, limit

WAITS = {
    "a pipe": lambda: os.read(os.pipe()[0], 1),
    "an event": lambda: threading.Event().wait(),
    "a lock": lambda: [lock.acquire() for lock in [threading.Lock()] * 2],
    "a process": lambda: subprocess.run([sys.executable, "-c", "import time; time.sleep(100)"]),
    "two waits": lambda: _stubborn(),
}


def _stubborn() -> None:
    try:
        threading.Event().wait()
    finally:
        threading.Event().wait()


@pytest.mark.parametrize("name", WAITS)
def test_a_wait_ends(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """A test that waited for what never came kept all the others from running."""
    monkeypatch.setattr("tests.waiting.AGAIN", 0.1)
    start = time.monotonic()
    with limit(60), pytest.raises(NoEnd), limit(0.1):
        WAITS[name]()
    assert time.monotonic() - start < 30


def test_what_ends_in_time_is_not_disturbed() -> None:
    with limit(0.05):
        pass
    time.sleep(0.1)


def test_a_process_that_would_go_on_ends_with_the_test() -> None:
    code = "import signal, time; signal.signal(signal.SIGTERM, signal.SIG_IGN); print(1, flush=True); time.sleep(100)"
    with ending(subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE), seconds=1.0) as process:
        assert process.stdout is not None and process.stdout.read() in (b"1\n", b"")
    assert process.returncode == -9
