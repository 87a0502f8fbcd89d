"""What all three commands say about themselves: version, help on a narrow terminal, examples, completion."""

from __future__ import annotations

import shlex

import pytest
from typer.main import get_command
from typer.testing import CliRunner

import bezier.cli.app
import experiments.cli
import qe.cli.app
from qe import __version__

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
    for words in ((), *((command,) for command in commands)):
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
