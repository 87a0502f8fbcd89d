"""What documents show of the commands: README, tutorial, notes, pages and help."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest
from typer.main import get_command
from typer.testing import CliRunner

import bezier.cli.app
import experiments.cli
import qe.cli.app
from qe import __version__
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


TEXT = (ROOT / "docs" / "tutorial.md").read_text()
TUTORIAL_BLOCKS = re.findall(r"```(\w+)\n(.*?)```", TEXT, re.DOTALL)
CONSOLE = "\n".join(text for language, text in TUTORIAL_BLOCKS if language == "console")


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
    (problem,) = (text for language, text in TUTORIAL_BLOCKS if language == "toml")
    lines = (ROOT / "examples" / "cubic_joins.toml").read_text().splitlines()
    assert problem.splitlines() == [line for line in lines if line and not line.startswith("#")]


JOINED = "ex x. ax^2 + bx + c = 0"
NOTE = "qe: note: ax is read as the product a*x; bx is read as the product b*x\n"


@pytest.mark.parametrize(
    "words",
    [
        *([name, JOINED] for name in ("eliminate", "region", "solve", "convert")),
        ["minimize", "a^2", JOINED],
    ],
)
def test_one_note_in_every_command(words: list[str]) -> None:
    """Answers were about names that nobody had meant, without a word."""
    done = command.run("qe", *words)
    assert (done.returncode, done.stderr) == (0, NOTE) and done.stdout and "note" not in done.stdout
    if words[0] != "convert":
        plain, data = command.run("qe", *words, "--plain"), command.run("qe", *words, "--json")
        assert plain.stderr == "" and data.stderr == NOTE and json.loads(data.stdout)


def test_all_notes_of_a_command_stand_in_one_line() -> None:
    done = command.run("qe", "minimize", "(e - 1)^2 + I^2", "ex x. a*e > 0")
    line = "qe: note: x does not occur; e is a variable here, no number; I is a variable here, no number\n"
    assert done.stderr == line
    assert command.run("qe", "decide", "all a. (ex x. a^2 >= 0)").stderr == "qe: note: x does not occur\n"
    done = command.run("qe", "solve", "ax^2 + bx + c = 0", "--variables", "x")
    assert done.stderr == NOTE


def test_what_is_refused_is_told_in_one_line() -> None:
    done = command.run("qe", "decide", "all a, b > 0. abc = 1 -> a + 2*b >= 2")
    note, error = done.stderr.splitlines()
    assert (
        done.returncode == 2 and "abc is one name; a product is written a*b*c" in note and "free here: abc (" in error
    )


def test_the_prompt_notes_each_time() -> None:
    done = command.run("qe", "prompt", stdin=f"{JOINED}\n{JOINED}\n:min e^2\n")
    assert done.stderr == 2 * NOTE + "qe: note: e is a variable here, no number\n"


APPS = {"qe": qe.cli.app.app, "bezier": bezier.cli.app.app, "experiments": experiments.cli.app}
NARROW = {"COLUMNS": "80", "TERMINAL_WIDTH": "80"}


def help_of(name: str, *words: str) -> str:
    found = CliRunner().invoke(APPS[name], [*words, "--help"], env=NARROW, prog_name=name, terminal_width=80)
    assert found.exit_code == 0
    return found.output


@pytest.mark.parametrize("name", APPS)
def test_the_version(name: str) -> None:
    assert CliRunner().invoke(APPS[name], ["--version"]).output == f"{name} {__version__}\n"


@pytest.mark.parametrize("name", APPS)
def test_no_line_of_a_help_is_cut(name: str) -> None:
    commands = getattr(get_command(APPS[name]), "commands")
    for words in ((), *((one,) for one in commands)):
        lines = help_of(name, *words).splitlines()
        assert not [line for line in lines if line.rstrip().endswith("...") and not line.startswith("Usage")]
        assert max(map(len, lines)) <= 80


@pytest.mark.parametrize("name", APPS)
def test_the_help_has_examples_that_name_commands(name: str) -> None:
    commands = getattr(get_command(APPS[name]), "commands")
    examples = help_of(name).partition("Examples:")[2].split("\n")
    words = [shlex.split(line) for line in examples if line.strip()]
    assert words and all(line[0] == name and line[1] in commands for line in words)


@pytest.mark.parametrize("name", APPS)
def test_completion_is_offered(name: str) -> None:
    assert "--show-completion" in help_of(name)
