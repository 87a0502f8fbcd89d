"""The tutorial is true: its Python sessions and its commands are run."""

from __future__ import annotations

import doctest
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BIN = Path(sys.executable).parent
TEXT = (ROOT / "docs" / "tutorial.md").read_text()
BLOCKS = re.findall(r"```(\w+)\n(.*?)```", TEXT, re.DOTALL)
SESSION = "\n".join(text for language, text in BLOCKS if language == "pycon")
CONSOLE = "\n".join(text for language, text in BLOCKS if language == "console")


def test_the_python_sessions() -> None:
    test = doctest.DocTestParser().get_doctest(SESSION, {}, "tutorial", "docs/tutorial.md", 0)
    assert len(test.examples) > 30
    outcome = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS).run(test)
    assert outcome.failed == 0


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


@pytest.mark.parametrize("name", ["tutorial.md", "paper.md"])
def test_links_lead_somewhere(name: str) -> None:
    targets = re.findall(r"\]\(([^)#:]+)\)", (ROOT / "docs" / name).read_text())
    assert all((ROOT / "docs" / target).exists() for target in targets)
