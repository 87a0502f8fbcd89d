"""The prompt: what is asked and answered, without a terminal and on one."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from qe.cli.prompt import Session, is_open, run
from tests.tables import each
from tests.waiting import ending

QE = Path(sys.executable).parent / "qe"


def told(*lines: str) -> str:
    session = Session()
    return [session.reply(line) for line in lines][-1]


@each(
    (["ex x. x^2 + b*x + c = 0"], "b^2 - 4*c >= 0"),
    (["ex x. x^2 + b*x + c = 0", "% and b = 0"], "b = 0 and c <= 0"),
    (["x > 1", "`%` > 0"], "`%` > 0"),
    (["ex x. x^2 = 2"], "true\nwitness: x = sqrt(2)"),
    (["all x. x > 0"], "false\ncounterexample: x = 0"),
    ([":solve x: a*x = 1"], "a < 0 and x = 1/a or\n0 < a and x = 1/a"),
    ([":solve x^2 = 2"], "x = -sqrt(2) or\nx = sqrt(2)"),
    ([":solve ex y: y^2 = x"], "0 <= x"),
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
    assert shown == ["b^2 - 4*c >= 0", "c - 1 = 0 and b^2 - 4 >= 0"] and next(lines) == "x > 0"


def test_interrupts_and_the_end() -> None:
    def ask(prompt: str, told: list[str] = []) -> str:
        told.append(prompt)
        raise KeyboardInterrupt if len(told) == 1 else EOFError

    shown: list[str] = []
    assert run(ask, shown.append) == 0 and shown == ["interrupted"]


def test_pipes() -> None:
    done = subprocess.run([QE, "prompt"], input="x > 1\n:quit\n", capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stdout, done.stderr) == (0, "x - 1 > 0\n", "")
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
