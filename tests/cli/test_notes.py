"""Notes on what may have been meant otherwise: one line on stderr, in every command that reads a formula."""

from __future__ import annotations

import json

import pytest

from tests.cli import command

JOINED = "ex x. ax^2 + bx + c = 0"
NOTE = "qe: note: x does not occur; did you mean a*x^2?\n"


@pytest.mark.parametrize(
    "words",
    [
        *([name, JOINED] for name in ("eliminate", "region", "solve", "convert")),
        ["minimize", "ax^2", JOINED],
        ["solve", "ax^2 + bx + c = 0", "--variables", "x"],
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


def test_what_is_refused_is_told_in_one_line() -> None:
    done = command.run("qe", "decide", JOINED)
    assert done.returncode == 2 and done.stderr.count("\n") == 1 and "a product is written a*x" in done.stderr


def test_the_prompt_notes_each_time() -> None:
    done = command.run("qe", "prompt", stdin=f"{JOINED}\n{JOINED}\n:min e^2\n")
    assert done.stderr == 2 * NOTE + "qe: note: e is a variable here, no number\n"
