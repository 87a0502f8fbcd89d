"""Systems without ``fork``, ``resource`` and POSIX signals, as Windows is: both commands and the interface work."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

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


def run(code: str, folder: Path) -> subprocess.CompletedProcess[str]:
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
    done = run("\n".join(["import qe", *(f"print({asked})" for asked in INTERFACE)]), tmp_path)
    assert done.stdout.splitlines() == list(INTERFACE.values()), done.stderr


COMMANDS = {
    ("eliminate", "ex x. x^2 = b", "--timeout", "20"): ["b >= 0", "status 0"],
    ("decide", "all x. x^2 > 0", "--timeout", "20"): ["false", "status 0"],
    ("decide", "all x. x^2 >"): ["status 2"],
}


def test_commands(tmp_path: Path) -> None:
    code = f"from qe.cli.app import main\nfor line in {list(COMMANDS)!r}: print('status', main(list(line)))"
    done = run(f"{code}\nsys.exit(main(['minimize', 'x + y', 'x^2 + y^2 <= 1']))", tmp_path)
    printed = [line for shown in COMMANDS.values() for line in shown]
    assert done.returncode == 0 and done.stdout.splitlines()[: len(printed)] == printed, done.stderr
    assert "value -sqrt(2)" in done.stdout


def test_a_limit_holds(tmp_path: Path) -> None:
    hard = "all a, b. ex x, y, z. x^4 + y^3*z + a*z^2 = 1 and y^4 + z*x^3 + b*x = 2 and z^4 + x*y + a*b < 0"
    done = run(f"from qe.cli.app import main\nsys.exit(main(['decide', {hard!r}, '--timeout', '0.3']))", tmp_path)
    assert done.returncode == 3, (done.stdout, done.stderr)
    assert "time" in done.stderr


def test_planning(tmp_path: Path) -> None:
    problem = ROOT / "examples" / "three_balls.toml"
    steps = f"main(['plan', {str(problem)!r}, '--out', 'out']) or main(['check', 'out'])"
    code = f"from bezier.cli import main\nsys.exit({steps})"
    done = run(code, tmp_path)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "out" / "report.html").stat().st_size > 0
