"""Output as JSON, and the package where nothing else is installed."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli import command
from tests.tables import each

QE = str(Path(sys.executable).parent / "qe")
HARD = "ex x, y, z. x^7 + y^7*a + z^7 + x*y*b*z = c and x^5 + z*y > y*a + b and z^4*x - y^5 > a*x"


def run(*words: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """The command; as a process of its own from the start where its environment is another."""
    if not environment:
        return command.run("qe", *words)
    surroundings = {**os.environ, **environment}
    return subprocess.run([QE, *words], capture_output=True, text=True, timeout=100, env=surroundings)


@each(
    (["eliminate", "ex x. x^2 = b"], "solved", 0),
    (["decide", "ex x. x^2 = 2"], "solved", 0),
    (["solve", "x*y = 1", "--variables", "y"], "solved", 0),
    (["minimize", "x^2 - x"], "optimal", 0),
    (["minimize", "x"], "unbounded", 0),
    (["minimize", "x", "x < 0 and x > 0"], "infeasible", 0),
    (["eliminate", "x <"], "input_error", 2),
    (["decide", "x > 0"], "input_error", 2),
    (["region", "x > 0", "--tmeout", "5"], "input_error", 2),
    (["check", "no-such-file"], "input_error", 2),
    (["eliminate", HARD, "--timeout", "0.5"], "unable", 3),
    (["eliminate", "ex x. a*x^5 + x = 1", "--method", "vs"], "unable", 3),
)
def test_every_outcome_is_an_object(words: list[str], status: str, code: int) -> None:
    done = run(*words, "--json")
    data = json.loads(done.stdout)
    assert (data["status"], done.returncode) == (status, code)
    if code:
        assert data["exit"] == code and data["message"] in done.stderr and done.stderr.count("\n") == 1
    else:
        assert data["seconds"] >= 0 and "exit" not in data


DOCUMENT = Path(__file__).resolve().parents[2] / "docs" / "formats.md"
WITHOUT_ANSWER = {"status", "message", "exit"}
BAD = {
    "eliminate": "x <",
    "decide": "x > 0",
    "region": "x +",
    "solve": "ex x x =",
    "minimize": "x > 0",
    "check": "no-such-file",
}
"""An input that each command refuses."""

GOOD = {
    "eliminate": [["ex x. x^2 = 2"], ["x > 0", "--output", "smtlib"]],
    "decide": [["all x. x > 0"], ["(assert false)", "--format", "smtlib"]],
    "solve": [["x*y = 1", "--variables", "y"]],
    "minimize": [["x"], ["x^3"], ["x", "x > 0"], ["x^3 - x", "0 < x < 1"], ["x^2 - a*x", "--parameters", "a"]],
}


def documented(when: str) -> list[set[str]]:
    """The keys of the table of the documentation, by row, where its second column says this."""
    rows = re.findall(r"^\| ((?:`\w+`(?:, )?)+) \| (.*?) \|", DOCUMENT.read_text(encoding="utf-8"), re.MULTILINE)
    return [set(re.findall(r"\w+", keys)) for keys, said in rows if re.search(when, said)]


@pytest.mark.parametrize("name", GOOD)
def test_answers_have_the_documented_keys(name: str) -> None:
    rows = documented(rf"`{name}\b")
    for words in GOOD[name]:
        done = run(name, *words, "--json")
        assert done.returncode == 0 and done.stderr == "", done.stderr
        found = set(json.loads(done.stdout)) - {"status", "seconds"}
        assert found and all(row <= found or not row & found for row in rows), (words, found)
        assert found <= set().union(*rows), (words, found)


@pytest.mark.parametrize("name", BAD)
def test_refusals_and_limits_have_the_documented_keys(name: str) -> None:
    assert {"status"}.union(*documented("^without an answer")) == WITHOUT_ANSWER
    for words, code in (([BAD[name]], 2), ([HARD, "--timeout", "0.4"], 3)):
        if name in ("check", "decide", "minimize") and code == 3:
            continue
        done = run(name, *words, "--json")
        data = json.loads(done.stdout)
        assert set(data) == WITHOUT_ANSWER and (data["exit"], done.returncode) == (code, code)


def test_a_folder_is_no_file_and_options_are_named(tmp_path: Path) -> None:
    assert "a folder found" in json.loads(run("check", str(tmp_path), "--json").stdout)["message"]
    assert json.loads(run("solve", "x = y", "--variables", "x x", "--json").stdout)["message"].startswith("--variables")


def test_checks_as_objects(tmp_path: Path) -> None:
    good, bad = tmp_path / "good.json", tmp_path / "bad.json"
    assert run("region", "x^2 <= 2", "--certificate", str(good)).returncode == 0
    data = json.loads(run("check", str(good), "--json").stdout)
    assert data["status"] == "accepted" and data["claims"] and data["trusts"] == []
    bad.write_text(good.read_text().replace('"x^2 - 2"', '"x^2 - 3"'))
    done = run("check", str(bad), "--json")
    assert json.loads(done.stdout)["status"] in ("rejected", "input_error") and done.returncode in (2, 4)


def test_solutions_line_by_line() -> None:
    done = run("solve", "x^2 = a", "--variables", "x")
    assert done.stdout == "a >= 0 and (x = -sqrt(a) or x = sqrt(a))\n"
    assert json.loads(run("solve", "x^2 < 0", "--json").stdout)["cases"] == []


def test_completion() -> None:
    done = run(COMP_WORDS="qe eli", COMP_CWORD="1", _QE_COMPLETE="complete_bash")
    assert done.stdout.split() == ["eliminate"]
    assert "_qe_completion" in run("--show-completion", "bash").stdout


def test_total_division_and_colours() -> None:
    assert run("region", "1/x > 0", "--total-division").stdout.count("x from 0 to infinity") == 1
    assert "\x1b" not in run("region", "x^2 < 2", NO_COLOR="1", TERM="xterm").stdout


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full here")
def test_an_error_that_finds_no_room() -> None:
    done = subprocess.run(f"{QE} eliminate 'x <' --json > /dev/full", shell=True, capture_output=True, text=True)
    assert done.returncode == 3 and done.stderr.count("\n") == 1 and "No space left" in done.stderr


ROOT = Path(__file__).resolve().parents[2]
BARE = """
import os, select, signal, subprocess, sys, tempfile  # which starts processes by what this system has
for module, names in (
    (os, ("fork", "forkpty", "WIFSIGNALED", "WTERMSIG", "WEXITSTATUS", "set_blocking", "killpg", "setsid")),
    (signal, ("SIGBUS", "SIGXCPU", "SIGALRM", "SIGCHLD", "pthread_sigmask", "SIG_BLOCK", "SIG_SETMASK", "alarm")),
    (select, ("poll", "epoll")),
):
    for name in names:
        if hasattr(module, name):
            delattr(module, name)
for name in ("resource", "fcntl", "termios", "pwd", "grp", "pty"):
    sys.modules[name] = None
"""


def run_bare(code: str, folder: Path) -> subprocess.CompletedProcess[str]:
    script = f"{BARE}\nsys.path.insert(0, {str(ROOT)!r})\n{code}"
    return subprocess.run([sys.executable, "-c", script], cwd=folder, capture_output=True, text=True, timeout=120)


INTERFACE = {
    "qe.eliminate('ex x. x^2 + b*x + c = 0').formula": "b^2 - 4*c >= 0",
    "qe.eliminate('ex x. x^2 = b', timeout=120, memory=2000).formula": "b >= 0",
    "qe.verify(qe.eliminate('ex x. x^2 = b', check=True).certificate, timeout=120)": "accepted",
    "qe.region('x^2 + y^2 <= 1', timeout=120).contains({'x': 0, 'y': 1})": "True",
    "qe.minimize('x', 'x >= 1/3', timeout=120).value": "1/3",
}


def test_interface(tmp_path: Path) -> None:
    done = run_bare("\n".join(["import qe", *(f"print({asked})" for asked in INTERFACE)]), tmp_path)
    assert done.stdout.splitlines() == list(INTERFACE.values()), done.stderr


COMMANDS = {
    ("eliminate", "ex x. x^2 = b", "--timeout", "20"): ["b >= 0", "status 0"],
    ("decide", "all x. x^2 > 0", "--timeout", "20"): ["false", "status 0"],
    ("decide", "all x. x^2 >"): ["status 2"],
}


def test_commands(tmp_path: Path) -> None:
    code = f"from qe.cli.app import main\nfor line in {list(COMMANDS)!r}: print('status', main(list(line)))"
    done = run_bare(f"{code}\nsys.exit(main(['minimize', 'x + y', 'x^2 + y^2 <= 1']))", tmp_path)
    printed = [line for shown in COMMANDS.values() for line in shown]
    assert done.returncode == 0 and done.stdout.splitlines()[: len(printed)] == printed, done.stderr
    assert "value -sqrt(2)" in done.stdout


def test_a_limit_holds(tmp_path: Path) -> None:
    hard = "all a, b. ex x, y, z. x^4 + y^3*z + a*z^2 = 1 and y^4 + z*x^3 + b*x = 2 and z^4 + x*y + a*b < 0"
    done = run_bare(f"from qe.cli.app import main\nsys.exit(main(['decide', {hard!r}, '--timeout', '0.3']))", tmp_path)
    assert done.returncode == 3, (done.stdout, done.stderr)
    assert "time" in done.stderr


def test_planning(tmp_path: Path) -> None:
    problem = ROOT / "examples" / "three_balls.toml"
    steps = f"main(['plan', {str(problem)!r}, '--out', 'out']) or main(['check', 'out'])"
    code = f"from bezier.cli import main\nsys.exit({steps})"
    done = run_bare(code, tmp_path)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "out" / "report.html").stat().st_size > 0
