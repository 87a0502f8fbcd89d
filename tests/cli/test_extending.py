"""The page about extending is true: its files go into a copy of the packages; its sessions and commands run there."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BIN = Path(sys.executable).parent
TEXT = (ROOT / "docs" / "extending.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```(\w+)\n(.*?)```", TEXT, re.DOTALL)
SESSION = "\n".join(text for language, text in BLOCKS if language == "pycon")
DOCTEST = """
import doctest, pathlib, sys
session = pathlib.Path("session.txt").read_text(encoding="utf-8")
test = doctest.DocTestParser().get_doctest(session, {}, "extending", "docs/extending.md", 0)
outcome = doctest.DocTestRunner().run(test)
print(outcome.attempted)
sys.exit(outcome.failed > 0)
"""


def named(text: str) -> tuple[str, str]:
    """The file that a block names in its first line, and the rest."""
    first, _, rest = text.partition("\n")
    return first.removeprefix("# ").strip(), rest


def patched(before: str, change: str) -> str:
    """The text with the lines marked with + put below the others above them, each of which stands there once, and
    without those marked with -."""
    lines, place = before.splitlines(), None
    for line in change.splitlines():
        if line.startswith("+"):
            assert place is not None
            place += 1
            lines.insert(place, line[1:])
        else:
            (place,) = (k for k, old in enumerate(lines) if old == line[1:])
            if line.startswith("-"):
                del lines[place]
                place -= 1
    return "\n".join(lines) + "\n"


@pytest.fixture(scope="module")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("tree")
    for package in ("qe", "bezier", "paper_repro", "experiments"):
        shutil.copytree(ROOT / package, place / package, ignore=shutil.ignore_patterns("*.pyc.*"))  # compiled ones, too
    for language, text in BLOCKS:
        if language in ("python", "toml"):
            name, rest = named(text)
            assert not (place / name).exists()
            (place / name).write_text(rest, encoding="utf-8")
        elif language == "diff":
            name, rest = named(text)
            (place / name).write_text(patched((place / name).read_text(encoding="utf-8"), rest), encoding="utf-8")
    (place / "session.txt").write_text(SESSION, encoding="utf-8")
    return place


def run(tree: Path, *command: str | Path) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": str(tree)}
    return subprocess.run(command, cwd=tree, env=environment, capture_output=True, text=True, timeout=120)


def test_the_sessions(tree: Path) -> None:
    done = run(tree, sys.executable, "-c", DOCTEST)
    assert done.returncode == 0, done.stdout + done.stderr
    assert int(done.stdout.split()[-1]) == SESSION.count(">>> ") > 15


def test_the_commands(tree: Path) -> None:
    steps = "\n".join(text for language, text in BLOCKS if language == "console").split("$ ")[1:]
    assert len(steps) >= 2
    for command, *shown in (step.splitlines() for step in steps):
        program, *arguments = shlex.split(command)
        done = run(tree, BIN / program, *arguments)
        assert done.returncode == 0, (command, done.stderr)
        assert [line for line in shown if line] == done.stdout.splitlines()[: len(shown)], (command, done.stdout)


def test_the_style_of_the_new_files(tree: Path) -> None:
    new = [named(text)[0] for language, text in BLOCKS if language == "python"]
    assert len(new) == 6
    shutil.copy(ROOT / "pyproject.toml", tree)
    done = run(tree, sys.executable, "-m", "ruff", "check", "--ignore", "I001", *new)
    assert done.returncode == 0, done.stdout


def test_a_change_that_fits_nowhere_is_seen() -> None:
    assert patched("a\nb\n", " a\n+c\n+d\n b\n+e") == "a\nc\nd\nb\ne\n"
    assert patched("a\nb\n", "-a\n+c\n b\n+d") == "c\nb\nd\n"
    for before in ("b\n", "a\na\n"):
        with pytest.raises(ValueError):
            patched(before, " a\n+c")
