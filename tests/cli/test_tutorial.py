"""The tutorial is true: its commands are run (its Python sessions with those of all pages)."""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BIN = Path(sys.executable).parent
TEXT = (ROOT / "docs" / "tutorial.md").read_text()
BLOCKS = re.findall(r"```(\w+)\n(.*?)```", TEXT, re.DOTALL)
CONSOLE = "\n".join(text for language, text in BLOCKS if language == "console")


def test_the_commands(tmp_path: Path) -> None:
    """What is shown is printed; a number alone is the exit status, which is 0 otherwise."""
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    steps = [step.splitlines() for step in CONSOLE.split("$ ")[1:]]
    assert len(steps) >= 3
    for command, *shown in steps:
        program, *arguments = shlex.split(command)
        done = subprocess.run([BIN / program, *arguments], cwd=tmp_path, capture_output=True, text=True, timeout=120)
        status = next((int(line) for line in shown if line.isdigit()), 0)
        assert done.returncode == status, (command, done.stderr)
        printed = done.stdout.splitlines()
        assert all(line in printed for line in shown if line and not line.isdigit()), (command, printed)


def test_the_problem_shown_is_the_example() -> None:
    (problem,) = (text for language, text in BLOCKS if language == "toml")
    lines = (ROOT / "examples" / "cubic_joins.toml").read_text().splitlines()
    assert problem.splitlines() == [line for line in lines if line and not line.startswith("#")]
