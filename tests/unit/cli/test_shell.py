"""The border to the shell: exit statuses, one line for each error, whole files or none."""

import json
import sys
from pathlib import Path

import pytest
import typer

from qe.cli import shell
from qe.errors import CertificateRejected, InputError, InternalError, Unable
from qe.processes.channel import WorkerStopped
from tests.tables import each


@each(
    (InputError("a number\n expected"), "input_error", 2, "a number expected"),
    (Unable("too hard"), "unable", 3, "unable: too hard"),
    (
        WorkerStopped("time limit", limit="time", known={"cells": 7}),
        "unable",
        3,
        "unable: time limit; known {'cells': 7}",
    ),
    (CertificateRejected("payload", "wrong"), "rejected", 4, "certificate rejected: payload: wrong"),
    (InternalError("odd"), "internal_error", 1, "internal error, please report: odd"),
    (ImportError("no", name="matplotlib"), "unable", 3, "unable: matplotlib is not installed"),
)
def test_errors(
    error: Exception,
    status: str,
    code: int,
    line: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("sys.excepthook", None)
    app = typer.Typer()

    @app.command()
    def fails(as_json: bool = typer.Option(False, "--json")) -> None:
        raise error

    assert shell.enter(app, [], name="prog") == code
    shown = capsys.readouterr()
    assert shown.out == "" and shown.err.startswith(f"prog: {line}") and shown.err.count("\n") == 1
    assert shell.enter(app, ["--json"], name="prog") == code
    data = json.loads(capsys.readouterr().out)
    assert (data["status"], data["exit"]) == (status, code) and "\n" not in data["message"]


@each((KeyboardInterrupt, "prog: interrupted\n"), (ValueError, "prog: internal"))
def test_what_nobody_expected_is_one_line(
    kind: type[BaseException], line: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Ctrl-C while a command was being loaded was called an internal error, to be reported."""
    monkeypatch.setattr("sys.excepthook", None)
    app = typer.Typer()

    @app.command()
    def works() -> None:
        """Nothing to do."""

    assert shell.enter(app, [], name="prog") == 0
    hook = sys.excepthook
    assert hook is not None
    hook(kind, kind("odd"), None)
    shown = capsys.readouterr().err
    assert shown.startswith(line) and shown.count("\n") == 1


def test_a_misspelt_option(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.excepthook", None)
    app = typer.Typer()

    @app.command()
    def works(timeout: float = 1.0) -> None:
        print("done")

    assert shell.enter(app, ["--timeout", "3"], name="prog") == 0
    assert shell.enter(app, ["--timout", "3"], name="prog") == 2
    assert "no such option: --timout; did you mean --timeout? (see prog --help)" in capsys.readouterr().err
    assert shell.enter(app, ["--", "--zzz"], name="prog") == 2
    assert "no such option" not in capsys.readouterr().err
    assert shell.enter(app, ["--zzz"], name="prog") == 2
    assert "did you mean" not in capsys.readouterr().err


def test_files_are_written_whole_or_not_at_all(tmp_path: Path) -> None:
    path = tmp_path / "out.txt"
    shell.write_file(path, "é")
    shell.write_file(path, b"second")
    assert path.read_bytes() == b"second" and list(tmp_path.iterdir()) == [path]
    with pytest.raises(InputError, match="cannot be written"):
        shell.write_file(tmp_path / "none" / "out.txt", "text")
    for wrong, reason in ((tmp_path, "a file name expected"), (tmp_path / "none" / "a", "does not exist")):
        with pytest.raises(InputError, match=reason):
            shell.check_writable(wrong)
    shell.check_writable(path)
    shell.check_writable(None)


def test_a_limit_is_for_the_whole_command(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shell, "age", lambda: 3.0)
    assert shell.remaining(10.0) == 7.0
    assert shell.remaining(3.2) == 0.8  # a quarter at least
    assert shell.age() > 0


@each((False, ["one", "--two"]), (True, ["one", "--two"]), (True, ["one", "--thre"]), (True, ["on"]), (False, ["two"]))
def test_the_command_that_is_named_is_built_alone_and_says_what_it_said(
    has_callback: bool, words: list[str], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sys.excepthook", None)
    app = typer.Typer()
    if has_callback:
        app.callback()(lambda: None)

    @app.command()
    def one(three: bool = False) -> None:
        print(three)

    @app.command()
    def two(two: bool = False) -> None:
        print(two)

    def said() -> tuple[int, str, str]:
        return shell.enter(app, words, name="prog"), *capsys.readouterr()

    alone = said()
    monkeypatch.setattr(shell, "_asked", lambda app, words: typer.main.get_command(app))
    assert alone == said()
