"""The prompt, and commands whose output nobody can take: one line, an exit status, never a request to report a bug."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from bezier.cli import main as bezier_main
from bezier.input import stored, toml_table
from qe.arguments import content
from qe.cli.app import main as qe_main
from qe.cli.prompt import Session, is_open, run
from qe.cli.shell import check_writable, write_file
from qe.errors import InputError
from tests.tables import each
from tests.waiting import ending

FOLDER = Path(sys.executable).parent
EXAMPLES = Path(__file__).parents[2] / "examples"
needs_full = pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full here")
QE = FOLDER / "qe"
ELIMINATE = f"{QE} eliminate 'ex x. x^2 = b'"


def shell(line: str) -> tuple[int, str]:
    """Exit status of the first command of a line, and what stands on stderr."""
    environment = {**os.environ, "LC_ALL": "C.UTF-8"}
    command = ["bash", "-c", line + "; exit ${PIPESTATUS[0]}"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, env=environment)
    return done.returncode, done.stderr


@each(
    f"{ELIMINATE} | head -0",
    f"{QE} --help | head -0",
    f"PYTHONIOENCODING=ascii {QE} eliminate 'ä > 0'",
    f"{QE} eliminate 'ex `a b`. `a b`*y + z > 0' --order '`a b`, y' --plain",
)
def test_readers_that_leave_early_and_odd_letters_are_no_reason_for_a_word(line: str) -> None:
    assert shell(line) == (0, "")


FULL = "No space left"


@each(
    pytest.param(f"{ELIMINATE} > /dev/full", 3, FULL, marks=needs_full),
    pytest.param(f"{FOLDER / 'bezier'} --help > /dev/full", 3, FULL, marks=needs_full),
    pytest.param(f"{QE} eliminate 'x <' 2> /dev/full", 2, "", marks=needs_full),
    (f"{ELIMINATE} >&-", 3, "cannot be written"),
    (f"{ELIMINATE} >&- 2>&-", 3, ""),
    (f"{QE} eliminate - <&-", 2, "empty"),
    (f"{QE} eliminate 'x <' >&- 2>&- <&-", 2, ""),
)
def test_full_discs_and_closed_streams(line: str, status: int, words: str) -> None:
    found, message = shell(line)
    assert found == status
    assert message.count("\n") == bool(words) and words in message and "report" not in message


DRAWING = """
import time
from qe.cli import shell
from qe.progress import Event
shell.DISPLAY_AFTER = 0.0
with shell.Display(lines=True) as display:
    for _ in range(3):
        display(Event("at work", 1, 2))
        time.sleep(0.2)
"""


def on_a_terminal(command: list[str], **environment: str) -> bytes:
    """What a command writes to a terminal."""
    pty = pytest.importorskip("pty")
    ours, theirs = pty.openpty()
    known = {name: value for name, value in os.environ.items() if name not in ("NO_COLOR", "FORCE_COLOR")}
    started = subprocess.Popen(
        command, stdin=theirs, stdout=theirs, stderr=theirs, env={**known, "TERM": "xterm", **environment}
    )
    os.close(theirs)
    written = b""
    with ending(started):
        try:
            while piece := os.read(ours, 65536):
                written += piece
        except OSError:  # the other end is closed
            pass
        finally:
            os.close(ours)
        assert started.wait(60) in (0, 2)
    return written


NO_COLOR, DUMB = {"NO_COLOR": "1"}, {"TERM": "dumb"}


@each(
    ([sys.executable, "-c", DRAWING], NO_COLOR),
    ([sys.executable, "-c", DRAWING], DUMB),
    ([str(FOLDER / "qe"), "--help"], NO_COLOR),
    ([str(FOLDER / "bezier"), "plan", "missing.toml"], NO_COLOR),
)
def test_plain_text_where_no_codes_are_wanted(command: list[str], environment: dict[str, str]) -> None:
    """NO_COLOR left dim figures, a spinner and codes that moved the cursor."""
    written = on_a_terminal(command, **environment)
    assert b"\x1b" not in written and b"\r" not in written.replace(b"\r\n", b"")
    assert DRAWING not in command or b"at work" in written


def test_a_terminal_has_a_line_that_is_drawn_over() -> None:
    assert b"\x1b" in on_a_terminal([sys.executable, "-c", DRAWING])


def test_a_pipe_gets_no_codes() -> None:
    done = subprocess.run([sys.executable, "-c", DRAWING], capture_output=True, check=True, timeout=120)
    assert done.stderr.startswith(b"at work") and b"\x1b" not in done.stdout + done.stderr


@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="a file without an end is needed")
def test_a_file_without_an_end_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """Such a file filled the memory until the system killed the process."""
    monkeypatch.setattr("qe.arguments.MOST_BYTES", 1000)
    with pytest.raises(InputError, match="/dev/zero: at most 1,000 bytes expected, more found"):
        content(Path("/dev/zero"), "file")
    for read in (toml_table.read_text, stored.text):
        monkeypatch.setattr(f"{read.__module__}.MAX_BYTES", 1000)
        with pytest.raises(InputError, match=r"/dev/zero: expected .*at most 1000 bytes"):
            read(Path("/dev/zero"))


@each("", "x" * 300, "a\0b")
def test_the_name_of_a_file_that_cannot_be(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    """A long name ended in a traceback, and no name at all wrote a plan into the folder one stood in."""
    for words in (["plan", "p.toml", "--out", name], ["check", name], ["clearance", name], ["joints", "a", name]):
        assert bezier_main(words) == 2
        said = capsys.readouterr().err
        assert said.count("\n") == 1 and "the name of a file expected" in said
    assert qe_main(["region", "x > 0", "--plot", name]) == 2
    assert "--plot: the name of a file expected" in capsys.readouterr().err


def test_what_is_no_plain_file_is_written_to_and_never_replaced(tmp_path: Path) -> None:
    """``--certificate /dev/null`` put a file in the place of the device, for whom the system lets do that."""
    pipe, link, real = tmp_path / "pipe", tmp_path / "link", tmp_path / "real"
    os.mkfifo(pipe)
    with ending(subprocess.Popen(["cat", str(pipe)], stdout=subprocess.PIPE, text=True)) as reader:
        write_file(pipe, "certificate")
        assert reader.communicate(timeout=60)[0] == "certificate" and pipe.is_fifo()
    real.write_text("old")
    link.symlink_to(real)
    write_file(link, "new")
    assert link.is_symlink() and real.read_text() == "new"
    check_writable(Path(os.devnull))
    write_file(Path(os.devnull), "nothing")
    assert Path(os.devnull).is_char_device() and sorted(tmp_path.iterdir()) == [link, pipe, real]


@each([], ["--json"])
def test_an_interrupt_is_told(
    more: list[str], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The command line library keeps the interrupt to itself and makes it a status, so nothing was said."""

    def interrupted(*given: object, **named: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("qe.cli.app.limited", interrupted)
    assert qe_main(["eliminate", "ex x. x^2 = a", *more]) == 130
    told = capsys.readouterr()
    assert told.err == "qe: interrupted\n"
    assert not more or json.loads(told.out) == {"status": "interrupted", "message": "interrupted", "exit": 130}


def test_a_command_that_is_terminated_leaves_nothing_half_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """SIGTERM left a hidden folder beside the output."""
    before = signal.signal(signal.SIGTERM, signal.SIG_DFL)  # whoever started this may have ignored it

    def terminated(*given: object, **named: object) -> None:
        signal.raise_signal(signal.SIGTERM)

    monkeypatch.setattr("bezier.planner.outputs._move", terminated)
    assert bezier_main(["plan", str(EXAMPLES / "no_control_point.toml"), "--out", str(tmp_path / "out")]) == 143
    assert not list(tmp_path.iterdir()) and capsys.readouterr().err == "bezier: ended by a signal\n"
    assert signal.signal(signal.SIGTERM, before) is signal.SIG_DFL


def told(*lines: str) -> str:
    session = Session()
    return [session.reply(line) for line in lines][-1]


@each(
    (["ex x. x^2 + b*x + c = 0"], "b^2 - 4*c >= 0"),
    (["ex x. x^2 + b*x + c = 0", "% and b = 0"], "b = 0 and c <= 0"),
    (["x > 1", "`%` > 0"], "`%` > 0"),
    (["ex x. x^2 = 2"], "true\nwitness: x = sqrt(2)"),
    (["all x. x > 0"], "false\ncounterexample: x = 0"),
    ([":solve x: a*x = 1"], "a /= 0 and x = 1/a"),
    ([":solve x^2 = 2"], "x = -sqrt(2) or\nx = sqrt(2)"),
    ([":solve ex y: y^2 = x"], "x >= 0"),
    ([":instance x^3 = 8"], "x = 2"),
    ([":instance x < x"], "there is none"),
    ([":decide all x. x^2 >= 0"], "true"),
    ([":min x^2 - x"], "-1/4  (x = 1/2)"),
    ([":max x : x < 3"], "3  (not attained)"),
    ([":max x"], "unbounded"),
    ([":min (x - 2)^2", "x < %"], "x < 0"),
    ([":region x^2 < 2"], "dimension 1 in x\nx: (-sqrt(2), sqrt(2))\ncell: -sqrt(2) < x < sqrt(2)"),
    ([":region x < x"], "false"),
    ([":timeout 5"], "set: timeout 5"),
    ([":timeout off"], "set: nothing"),
    ([":method cad", ":root-atoms on"], "set: method cad, root_atoms True, timeout 60"),
    ([":order c,b", ":race vs,cad"], "set: order c,b, race cad,vs, timeout 60"),
    ([":method vs", ":decide ex x. x^2 = 2"], "true"),
    ([":order y,x", ":region x = 1 and y = 2"], "dimension 0 in y, x\ny: [2, 2]\nx: [1, 1]\ncell: y = 2 and x = 1"),
    ([":workers 2", ":workers off"], "set: timeout 60"),
    (["# nothing"], ""),
)
def test_questions(lines: list[str], answer: str) -> None:
    assert told(*lines) == answer


@each(
    ("x <", "expected a number"),
    ("%", "none yet"),
    (":regio x > 0", "did you mean :region"),
    (":xyz", ":help"),
    (":timeout soon", "soon"),
    (":race fastest", ":race: one of"),
    (":workers -1", ":workers: a natural"),
    (":metod cad", "did you mean :method"),
    (":timeout -1", "positive"),
    (":plot", "no answer to draw"),
    (":why", "no elimination"),
    (":decide x > 0", "free: x"),
    ("sin(x) > 0", "not algebraic"),
)
def test_slips_get_one_line(line: str, words: str) -> None:
    answer = told(line)
    assert words in answer and "\n" not in answer and answer.startswith("error: ")


def test_the_limit_holds() -> None:
    answer = told(":timeout 0.3", ":solve x^7 + y^7 + z^7 + x*y*z + w^5*x = 1 and x^4 + w*y > z^4")
    assert answer.startswith("unable: ")


def test_files_and_reasons(tmp_path) -> None:
    session = Session()
    session.reply("ex x. x^2 + b*x + c = 0")
    assert "cells" in session.reply(":why") or "1." in session.reply(":why")
    assert session.reply(f":plot {tmp_path / 'a.png'}").startswith("written: ") and (tmp_path / "a.png").exists()
    assert "ending in" in session.reply(f":plot {tmp_path / 'a.xyz'}") and ":solve" in session.reply(":help")


@each("x >", "(x > 0", "x > 0 and", "ex x.", "ex x, y", "x +", "x \\", ":solve (x", "f ->")
def test_what_goes_on(text: str) -> None:
    assert is_open(text) is (text != "ex x, y")


@each("", "x > 0", "(x > 0)", ":help", "`(` > 0", "x > 0 # and (", ":solve x:")
def test_what_is_whole(text: str) -> None:
    assert not is_open(text)


def test_the_loop() -> None:
    lines = iter(["ex x. x^2 +", "b*x + c = 0", "", "(%", ") and c = 1", ":quit", "x > 0"])
    shown: list[str] = []
    assert run(lambda prompt: next(lines), shown.append) == 0
    assert shown == ["b^2 - 4*c >= 0", "b^2 >= 4 and c = 1"] and next(lines) == "x > 0"


def test_interrupts_and_the_end() -> None:
    def ask(prompt: str, told: list[str] = []) -> str:
        told.append(prompt)
        raise KeyboardInterrupt if len(told) == 1 else EOFError

    shown: list[str] = []
    assert run(ask, shown.append) == 0 and shown == ["interrupted"]


def test_pipes() -> None:
    done = subprocess.run([QE, "prompt"], input="x > 1\n:quit\n", capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stdout, done.stderr) == (0, "x > 1\n", "")
    bare = subprocess.run([QE], input="", capture_output=True, text=True, timeout=60)
    first, _, rest = bare.stdout.partition("\n")
    assert bare.returncode == 0 and first.startswith("Usage: qe") and "...\n" not in rest


@pytest.mark.skipif(not hasattr(os, "openpty"), reason="no terminals here")
def test_a_terminal(tmp_path) -> None:
    leader, follower = os.openpty()
    environment = {**os.environ, "XDG_STATE_HOME": str(tmp_path), "TERM": "dumb", "NO_COLOR": "1"}
    process = subprocess.Popen([QE], stdin=follower, stdout=follower, stderr=follower, env=environment)
    os.close(follower)
    seen = ""
    with ending(process):
        for line, expected in (("", ":help lists"), ("ex x. x^2 = b\r", "b >= 0"), (":quit\r", "")):
            os.write(leader, line.encode())
            while expected and expected not in seen:
                seen += os.read(leader, 4096).decode(errors="replace")
        assert process.wait(60) == 0
    os.close(leader)
    assert "b >= 0" in seen and not re.search(r"\x1b\[[0-9;]*3[0-9]m", seen)
    assert (tmp_path / "bezier-qe" / "history").exists()
