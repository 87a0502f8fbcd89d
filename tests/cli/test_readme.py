"""What the README and the examples show is what happens."""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli import command
from tests.tables import each

ROOT = Path(__file__).resolve().parents[2]
README = (ROOT / "README.md").read_text()
BLOCKS = re.findall(r"```(\w*)\n(.*?)```", README, re.DOTALL)
PYTHON = [text for language, text in BLOCKS if language == "python"]
COMMANDS = [line for _, text in BLOCKS for line in text.splitlines() if line.startswith("qe ")]


def test_the_python_example() -> None:
    (text,) = PYTHON
    printing = [line for line in text.splitlines() if line.startswith("print(")]
    expected = [line.partition("# ")[2] or None for line in printing]
    out = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True).stdout.splitlines()
    assert len(out) == len(expected)
    for printed, promised in zip(out, expected, strict=True):
        assert promised is None or printed == promised.strip()


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("readme")
    script = "(set-logic QF_NRA)(declare-const x Real)(assert (= (* x x) 2))(check-sat)"
    (place / "problem.smt2").write_text(script)
    return place


def test_the_command_lines(folder: Path) -> None:
    """In the README's order: a later line may read what an earlier one wrote."""
    assert len(COMMANDS) >= 6
    for line in COMMANDS:
        shown, _, promised = line.partition(" # ")
        program, *arguments = shlex.split(shown)
        process = command.run(program, *arguments, cwd=folder)
        assert process.returncode == 0, (line, process.stderr)
        if promised and re.search(r"[=<>]", promised):
            assert process.stdout.strip() == promised.strip()


@each("first_steps.py", "ellipse_in_disc.py", "plan_in_python.py")
def test_examples(name: str) -> None:
    process = subprocess.run([sys.executable, ROOT / "examples" / name], capture_output=True, text=True, timeout=120)
    assert process.returncode == 0, process.stderr
    assert process.stdout.strip()


def test_links_lead_somewhere() -> None:
    missing = [target for target in re.findall(r"\]\(([^)#:]+)\)", README) if not (ROOT / target).exists()]
    assert not missing


def test_make_targets_exist() -> None:
    makefile = (ROOT / "Makefile").read_text()
    for target in re.findall(r"^make (\w+)", README, re.MULTILINE):
        assert re.search(rf"^{target}:", makefile, re.MULTILINE)
