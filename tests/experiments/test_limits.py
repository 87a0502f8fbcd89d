"""Limits hold, for a whole group of processes."""

import os
import sys
import time

from experiments.limits import Ending, group_use, run_limited
from tests.experiments.fakes import BUSY, HOG, Solver, fake
from tests.tables import each

TASK = "{}"


def run(solver: Solver, *, seconds: float = 10.0, memory: int = 500, start_up: float = 10.0):
    return run_limited(solver.command, TASK, seconds=seconds, memory=memory, start_up=start_up)


def test_what_a_program_says_and_returns():
    program = "import sys; print(sys.stdin.read().upper() * 100000); print('oops', file=sys.stderr); sys.exit(7)"
    done = run_limited([sys.executable, "-c", program], "héllo", seconds=10, memory=500)
    assert (done.ending, done.code, done.err) == (Ending.FINISHED, 7, "oops\n")
    assert done.out == "HÉLLO" * 100000 + "\n"
    assert 0 < done.wall < 10 and done.peak > 1


def test_a_busy_loop_is_stopped_within_a_second_of_the_limit():
    done = run_limited([sys.executable, "-c", "while True: pass"], TASK, seconds=0.5, memory=500)
    assert done.ending is Ending.TIME and 0.5 <= done.wall < 9  # one second is asked; the machine may be busy


def test_the_limit_counts_from_the_first_output():
    done = run(BUSY, seconds=0.3)
    assert done.ending is Ending.TIME and done.wall < 9, "not the ten seconds of the start"


def test_a_silent_program_gets_the_time_of_its_start():
    program = [sys.executable, "-c", "import time; time.sleep(0.6); print('late')"]
    assert run_limited(program, TASK, seconds=0.3, memory=500, start_up=5.0).out == "late\n"
    assert run_limited(program, TASK, seconds=0.1, memory=500).ending is Ending.TIME


def test_a_program_that_waits_has_a_multiple_of_the_limit():
    program = [sys.executable, "-c", "import time; print('ready', flush=True); time.sleep(0.6); print('late')"]
    done = run_limited(program, TASK, seconds=0.4, memory=500, start_up=5.0)
    assert (done.ending, done.out) == (Ending.FINISHED, "ready\nlate\n")


def test_a_memory_hog_is_stopped_and_reported():
    done = run(HOG, memory=150)
    assert done.ending is Ending.MEMORY and 150 < done.peak < 700
    assert done.wall < 9, "long before the limit on time"


def test_memory_counts_for_the_whole_group():
    body = "subprocess.run([sys.executable, '-c', 'held = bytearray(1) * (200 << 20); import time; time.sleep(60)'])"
    done = run(fake("parent", body), memory=150)
    assert done.ending is Ending.MEMORY and done.wall < 9


def alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    with open(f"/proc/{pid}/stat") as file:  # a zombie has ended
        return file.read().rpartition(")")[2].split()[0] != "Z"


@each("", "while True: pass")
def test_a_helper_that_stays_behind_is_ended(after):
    body = f"helper = subprocess.Popen(['sleep', '60'])\nprint(helper.pid, flush=True)\n{after}"
    done = run(fake("parent", body), seconds=0.5)
    helper = int(done.out.splitlines()[1])
    deadline = time.monotonic() + 20
    while alive(helper) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not alive(helper)


def test_the_memory_and_the_processor_time_of_a_group_are_seen():
    memory, seconds = group_use(os.getpgrp())
    assert memory > 10 and seconds >= time.process_time() - 0.1
    assert group_use(2**22 + 1) == (0, 0)


def test_a_run_ends_even_when_nobody_watches():
    """Processor time has a limit of its own, some times the one that is watched."""
    body = "import resource\nprint(resource.getrlimit(resource.RLIMIT_CPU)[0], flush=True)"
    assert run(fake("watched", body), seconds=2.0, start_up=3.0).out.splitlines()[1] == "20"
