"""A program under limits on time and memory, in a process group of its own that is ended as a whole."""

from __future__ import annotations

import contextlib
import math
import os
import signal
import subprocess
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import IO

POLL = 0.01
LOOK = 0.1
MIB = 1 << 20

# The shell sets the limits and then becomes the program, so that nothing runs between fork and exec here.
LIMITING = 'ulimit -c 0; ulimit -v "$1" 2>/dev/null; ulimit -t "$2"; shift 2; exec "$@"'
BACKSTOP = 4
"""One process may have this many times the memory as address space, in case it grows by leaps, and this many times the
time as processor time, in case nobody is left to end it; the clock on the wall may count as many times the limit, so
that a machine with other work to do does not end what has hardly run, and a program that only waits does end."""


class Ending(Enum):
    """How a run ended: by itself, or at a limit."""

    FINISHED = "finished"
    TIME = "time"
    MEMORY = "memory"


@dataclass(frozen=True, slots=True)
class Run:
    """``code`` is the exit status (negative: the signal); ``wall`` in seconds; ``peak`` resident MiB of the group."""

    ending: Ending
    code: int
    out: str
    err: str
    wall: float
    peak: float


def run_limited(
    command: Sequence[str], text: str, *, seconds: float, memory: int, start_up: float = 0.0, folder: Path | None = None
) -> Run:
    """Run a program on this standard input.

    ``seconds`` of processor time count from its first output, and for a silent program after ``start_up`` seconds;
    ``memory`` is in MiB. Both are those of all processes of the group together. Where there is no /proc only the
    address space and the clock on the wall are limited. A program started in a ``folder`` imports what is there,
    whatever this process imports from.
    """
    environment = os.environ if folder is None else {**os.environ, "PYTHONPATH": str(folder)}
    with tempfile.TemporaryFile() as source, tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        source.write(text.encode())
        source.seek(0)
        start = time.perf_counter()
        backstops = str(BACKSTOP * memory * 1024), str(math.ceil(BACKSTOP * (seconds + start_up)))
        child = subprocess.Popen(
            ["/bin/sh", "-c", LIMITING, "sh", *backstops, *command],
            stdin=source,
            stdout=out,
            stderr=err,
            cwd=folder,
            env=environment,
            start_new_session=True,
        )
        try:
            ending, peak = _watch(child, out, start, seconds, memory, start_up)
        finally:
            with contextlib.suppress(ProcessLookupError):  # also ends what the program left behind
                os.killpg(child.pid, signal.SIGKILL)
            code = child.wait()
        wall = time.perf_counter() - start
        return Run(ending, code, _text(out), _text(err), wall, peak)


def _watch(
    child: subprocess.Popen[bytes], out: IO[bytes], start: float, seconds: float, memory: int, start_up: float
) -> tuple[Ending, float]:
    """Wait for the end or a limit; (what it was, peak memory)."""
    peak, look, used = 0.0, 0.0, 0.0
    limit, deadline = start_up + seconds, start + BACKSTOP * (start_up + seconds)
    while True:
        status, usage = _reap(child)
        now = time.perf_counter()
        if status:
            return Ending.FINISHED, max(peak, usage)
        if now >= look:
            look = now + LOOK
            pages, used = group_use(child.pid)
            peak = max(peak, pages)
            if peak > memory:
                return Ending.MEMORY, peak
        if start_up and os.fstat(out.fileno()).st_size:
            start_up, limit, deadline = 0.0, min(limit, used + seconds), min(deadline, now + BACKSTOP * seconds)
        if used > limit or now > deadline:
            return Ending.TIME, peak
        time.sleep(POLL)


def _reap(child: subprocess.Popen[bytes]) -> tuple[bool, float]:
    """Whether the child has ended, and its peak of resident memory in MiB."""
    pid, status, usage = os.wait4(child.pid, os.WNOHANG)
    if not pid:
        return False, 0.0
    child.returncode = os.waitstatus_to_exitcode(status)
    return True, usage.ru_maxrss / 1024


def group_use(group: int) -> tuple[float, float]:
    """Resident MiB and seconds of processor time, ended children included, of all processes of a group; zeros where
    there is no /proc.
    """
    pages = ticks = 0
    for entry in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):  # it has just ended
            fields = entry.read_text().rpartition(")")[2].split()
            if int(fields[2]) == group:
                pages += int(fields[21])
                ticks += sum(map(int, fields[11:15]))
    return pages * os.sysconf("SC_PAGE_SIZE") / MIB, ticks / os.sysconf("SC_CLK_TCK")


def _text(stream: IO[bytes]) -> str:
    stream.seek(0)
    return stream.read().decode(errors="replace")
