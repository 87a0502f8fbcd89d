"""Processes of a local cluster end with the process that started them, also where it is killed."""

import os
import subprocess
import sys

import pytest

from tests.waiting import ending, limit

CHILD = "import os; from qe.processes import leash; print(os.getpid(), flush=True); leash.watch({parent})"
PARENT = "import subprocess, sys, os; subprocess.run([sys.executable, '-c', sys.argv[1].format(parent=os.getpid())])"

pytestmark = pytest.mark.processes


def test_a_process_ends_when_its_parent_is_killed() -> None:
    pytest.importorskip("click")
    with ending(subprocess.Popen([sys.executable, "-c", PARENT, CHILD], stdout=subprocess.PIPE, text=True)) as parent:
        assert parent.stdout is not None
        watching = int(parent.stdout.readline())
        os.kill(watching, 0)
        parent.kill()
        with limit(60):
            assert parent.stdout.read() == ""  # comes only when both processes, which have the other end, are gone


def test_a_process_ends_when_its_parent_was_gone_before_it_looked() -> None:
    pytest.importorskip("click")
    code = "from qe.processes import leash; leash.watch(1 << 30)"
    assert subprocess.run([sys.executable, "-c", code], timeout=60).returncode == 1
