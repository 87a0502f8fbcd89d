"""The commands without a shell: a process of their own, forked from this one, which has the modules already.

Start-up takes most of the time of a short command. What is seen is the same: output, message, exit status, files.
The console scripts themselves are run where a test says so.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import time
import traceback
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import IO

import pydantic

import bezier.check.recheck
import bezier.planner.command
import bezier.planner.outputs
import qe.certify.verify
import qe.cli.work
import qe.engine.run
from bezier.cli import main as bezier_main
from qe.cli.app import main as qe_main

LOADED = (
    pydantic.TypeAdapter,
    bezier.check.recheck,
    bezier.planner.command,
    bezier.planner.outputs,
    qe.certify.verify,
    qe.cli.work,
    qe.engine.run,
)
"""What the commands load when they need it: here once for all."""

PROGRAMS: dict[str, Callable[[Sequence[str]], int]] = {"bezier": bezier_main, "qe": qe_main}
IN_A_SHELL = {name: str(Path(sys.executable).parent / name) for name in PROGRAMS}


def run(
    program: str, *arguments: object, stdin: str | None = None, cwd: Path | None = None, seconds: float = 120
) -> subprocess.CompletedProcess[str]:
    """The finished command. Raises ``subprocess.TimeoutExpired`` after so many seconds."""
    words = [str(a) for a in arguments]
    with tempfile.TemporaryFile() as given, tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        given.write((stdin or "").encode())
        given.seek(0)
        child = os.fork()
        if not child:
            _become(program, words, cwd, (given, out, err))
        status = _ended(child, [program, *words], seconds)
        return subprocess.CompletedProcess([program, *words], status, _read(out), _read(err))


def in_a_shell(program: str, *arguments: object) -> subprocess.CompletedProcess[str]:
    """The console script, as it is installed."""
    return subprocess.run([IN_A_SHELL[program], *map(str, arguments)], capture_output=True, text=True, timeout=120)


def _become(program: str, words: list[str], cwd: Path | None, streams: Sequence[IO[bytes]]) -> None:
    """The child: the command, with nothing of the test process around it."""
    status = 1
    try:
        os.chdir(cwd or os.curdir)
        for number, stream in enumerate(streams):
            os.dup2(stream.fileno(), number)
        sys.stdin, sys.stdout, sys.stderr = open(0), open(1, "w"), open(2, "w")  # noqa: SIM115
        sys.argv = [IN_A_SHELL[program], *words]
        status = PROGRAMS[program](words)
    except SystemExit as end:
        status = end.code if isinstance(end.code, int) else int(end.code is not None)
    finally:
        if sys.exception() is not None:  # nothing may return into the test process
            traceback.print_exc()
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(status)


def _ended(child: int, command: list[str], seconds: float) -> int:
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        found, status = os.waitpid(child, os.WNOHANG)
        if found:
            return os.waitstatus_to_exitcode(status)
        time.sleep(0.002)
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    raise subprocess.TimeoutExpired(command, seconds)


def _read(file: IO[bytes]) -> str:
    file.seek(0)
    return file.read().decode()
