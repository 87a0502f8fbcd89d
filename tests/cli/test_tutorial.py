"""The tutorial is true: its commands are run (its Python sessions with those of all pages)."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

from tests.cli import command

ROOT = Path(__file__).resolve().parents[2]
TEXT = (ROOT / "docs" / "tutorial.md").read_text()
BLOCKS = re.findall(r"```(\w+)\n(.*?)```", TEXT, re.DOTALL)
CONSOLE = "\n".join(text for language, text in BLOCKS if language == "console")


def test_the_commands(tmp_path: Path) -> None:
    """What is shown is printed; a number alone is the exit status, which is 0 otherwise."""
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    steps = [step.splitlines() for step in CONSOLE.split("$ ")[1:]]
    assert len(steps) >= 3
    for line, *shown in steps:
        program, *arguments = shlex.split(line)
        done = command.run(program, *arguments, cwd=tmp_path)
        status = next((int(text) for text in shown if text.isdigit()), 0)
        assert done.returncode == status, (line, done.stderr)
        printed = done.stdout.splitlines()
        assert all(text in printed for text in shown if text and not text.isdigit()), (line, printed)


def test_the_problem_shown_is_the_example() -> None:
    (problem,) = (text for language, text in BLOCKS if language == "toml")
    lines = (ROOT / "examples" / "cubic_joins.toml").read_text().splitlines()
    assert problem.splitlines() == [line for line in lines if line and not line.startswith("#")]
