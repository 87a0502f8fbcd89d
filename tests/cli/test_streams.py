"""Commands whose output nobody can take: one line, an exit status, never a request to report a bug."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

FOLDER = Path(sys.executable).parent
needs_full = pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full here")
ELIMINATE = f"{FOLDER / 'qe'} eliminate 'ex x. x^2 = b'"


def shell(line: str) -> tuple[int, str]:
    """Exit status of the first command of a line, and what stands on stderr."""
    environment = {**os.environ, "LC_ALL": "C.UTF-8"}
    command = ["bash", "-c", line + "; exit ${PIPESTATUS[0]}"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, env=environment)
    return done.returncode, done.stderr


@pytest.mark.parametrize("command", [ELIMINATE, f"{FOLDER / 'qe'} --help"])
def test_a_reader_that_leaves_early(command: str) -> None:
    assert shell(f"{command} | head -0") == (0, "")


@needs_full
@pytest.mark.parametrize("command", [ELIMINATE, f"{FOLDER / 'bezier'} --help"])
def test_a_full_disc(command: str) -> None:
    status, message = shell(f"{command} > /dev/full")
    assert status == 3
    assert message.count("\n") == 1 and "No space left" in message and "report" not in message


@pytest.mark.parametrize(
    ("line", "status", "words"),
    [
        (f"{ELIMINATE} >&-", 3, "cannot be written"),
        (f"{ELIMINATE} >&- 2>&-", 3, ""),
        (f"{FOLDER / 'qe'} eliminate - <&-", 2, "empty"),
        (f"{FOLDER / 'qe'} eliminate 'x <' >&- 2>&- <&-", 2, ""),
    ],
)
def test_closed_streams(line: str, status: int, words: str) -> None:
    found, message = shell(line)
    assert found == status
    assert message.count("\n") == bool(words) and words in message and "report" not in message


@needs_full
def test_messages_that_nobody_can_read() -> None:
    assert shell(f"{FOLDER / 'qe'} eliminate 'x <' 2> /dev/full") == (2, "")


def test_letters_that_the_terminal_lacks() -> None:
    line = f"PYTHONIOENCODING=ascii {FOLDER / 'qe'} eliminate 'ä > 0'"
    assert shell(line) == (0, "")


def test_an_order_with_names_in_backquotes() -> None:
    line = f"{FOLDER / 'qe'} eliminate 'ex `a b`. `a b`*y + z > 0' --order '`a b`, y' --plain"
    assert shell(line) == (0, "")
