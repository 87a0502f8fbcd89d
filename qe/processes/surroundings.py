"""Whether this process is a worker of another, and until when it may run."""

from __future__ import annotations

import os

MARK = "QE_WORKER"
"""The environment variable in which a worker notes its process and its deadline, for calls inside it."""


def surrounding_deadline() -> float | None:
    """When the limit ends this process (of ``time.monotonic``; infinity: none does), None if it is no worker."""
    pid, _, deadline = os.environ.get(MARK, "").partition(":")
    return float(deadline) if pid == str(os.getpid()) else None
