"""Work in this process and others: limits hold, of several methods the first answers, no process is left over."""

import gc
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import pytest

import qe
from qe.errors import BudgetExceeded, InputError, InternalError, QEError, Unable
from qe.formula.features import may_block, text_may_block
from qe.options import Budget
from qe.processes.channel import Channel, WorkerDied
from qe.processes.execution import COLD, HERE, SWITCH, grace_of, perform
from qe.processes.limits import Limits
from qe.processes.racing import first
from qe.processes.worker import IDLE, end_idle
from qe.progress import Event
from tests.conftest import ROOT
from tests.tables import each
from tests.unit.processes.works import (
    asleep,
    failing,
    given,
    gone,
    heedless,
    inside,
    loading,
    noting,
    outer,
    process,
    slowly_counting,
    spent,
    work,
    wrong,
)
from tests.waiting import ending, limit
from tests.workers import only_idle_children

# Work moves to another process once it takes long: results, errors, limits, Ctrl-C, and the switches against it.

pytestmark = pytest.mark.processes

HARD = "ex a, b, c. all x, y. a*x^4*y + b*x*y^3 + c*x^2*y^2 + d*x + g*y + f > a^2*x^3 + b^2*y^5"
"""No method finishes this in minutes."""


@pytest.fixture(autouse=True)
def no_process_is_left() -> Iterator[None]:
    """There is a worker, which has loaded this; none but those that wait is left."""
    perform(partial(spent, 0.0, process), Limits(), at_once=True)
    with only_idle_children():
        yield


def test_short_work_stays_and_long_work_moves() -> None:
    assert perform(work(0.0), Limits()) == os.getpid()
    assert perform(work(3 * HERE), Limits()) != os.getpid()
    assert perform(work(0.0), Limits(), at_once=True) != os.getpid()


def test_where_no_worker_runs_work_stays_as_long_as_one_takes_to_start() -> None:
    end_idle()
    assert perform(work(2 * HERE), Limits()) == os.getpid() and not IDLE
    assert perform(work(2 * COLD), Limits()) != os.getpid() and IDLE


def test_time_in_which_modules_are_loaded_does_not_count() -> None:
    try:
        assert perform(loading, Limits()) == os.getpid()
        assert perform(loading, Limits()) != os.getpid()  # it is there already
    finally:
        del sys.modules[f"a module that is loaded by {os.getpid()}"]


@each(Limits(process=False), Limits(timeout=60, process=False))
def test_the_keyword_keeps_it_here(limits: Limits) -> None:
    assert perform(work(2 * HERE), limits, at_once=True) == os.getpid()


def test_the_environment_keeps_it_here(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(SWITCH, "off")
    assert perform(work(2 * HERE), Limits(timeout=60), at_once=True) == os.getpid()


def test_without_processes_limits_are_checked_between_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "executable", "")  # as in an application that has Python inside
    assert perform(work(2 * HERE), Limits()) == os.getpid()
    with pytest.raises(BudgetExceeded):
        perform(work(60), Limits(timeout=0.1))
    assert qe.eliminate("ex x. x^2 + b*x + c = 0", timeout=60).formula is not None


def test_each_block_is_left_once_in_each_process(tmp_path: Path) -> None:
    """Forks in the middle of a computation ended every ``finally`` on the stack twice."""
    assert perform(partial(noting, str(tmp_path / "left")), Limits()) != os.getpid()
    lines = (tmp_path / "left").read_text().split()
    assert len(lines) == len(set(lines)) == 2 and lines[0] == str(os.getpid())


def test_events_arrive_before_and_after_the_move() -> None:
    seen: list[Event] = []
    assert perform(slowly_counting, Limits(progress=seen.append)) != os.getpid()
    done = [e.done for e in seen if e.phase == "count"]
    assert done[0] == 0 and done[-5:] == list(range(5)) and len(done) > 5


@each(0.0, 3 * HERE)
@each(InputError("wrong"), Unable("too hard"), BudgetExceeded("cells", limit="cells"))
def test_own_errors_are_the_same_on_both_sides(error: Exception, seconds: float) -> None:
    with pytest.raises(type(error), match=str(error)):
        perform(work(seconds, partial(failing, error)), Limits())


def test_other_errors_of_moved_work_are_internal_errors() -> None:
    with pytest.raises(InternalError, match="ZeroDivisionError"):
        perform(work(3 * HERE, partial(failing, ZeroDivisionError())), Limits())


def test_an_error_of_the_listener_ends_the_work() -> None:
    """Even an ``Unable``, which the engine would take for one of its own if it met it inside a method."""

    def listener(event: Event) -> None:
        raise Unable("enough")

    with pytest.raises(Unable, match="enough"):
        perform(heedless, Limits(progress=listener))


def test_the_limit_kills_work_that_never_looks_up() -> None:
    start = time.monotonic()
    with pytest.raises(BudgetExceeded) as caught:
        perform(work(2 * HERE, asleep), Limits(timeout=0.3))
    assert caught.value.limit == "time" and time.monotonic() - start < 30


def test_inside_a_worker_only_a_tighter_limit_needs_another() -> None:
    several = [Limits(), Limits(timeout=100), Limits(memory=5000), Limits(timeout=20), Limits(memory=3000)]
    this, *found = perform(partial(inside, several), Limits(timeout=60, memory=5000), at_once=True)
    assert [pid == this for pid in found] == [True, True, True, False, False] and this != os.getpid()


@each((3 * HERE, False), (0.0, True))
def test_a_question_inside_another_moves_with_it(seconds: float, at_once: bool) -> None:
    """Else the outer one would begin again after the inner one was answered."""
    first, last = perform(partial(outer, work(seconds), at_once), Limits())
    assert first == last != os.getpid()


def test_work_of_a_thread_moves_too() -> None:
    found: list[object] = []
    thread = threading.Thread(target=lambda: found.append(perform(work(3 * HERE), Limits())))
    thread.start()
    thread.join(30)
    assert found and found[0] != os.getpid()


CALLS = {
    "eliminate": f"qe.eliminate({HARD!r})",
    "find_instance": "qe.find_instance('all a, b. ex x. all y. a*x^4*y^3 + b*x^3*y^5 + x^2*y + z*x > a^2*y^4 + x*y')",
    "region": "qe.region('x^6*y^5+z^7*x-y*z^3+3 > 0 and x^7+y^6*z^5-x*y*z = 1')",
    "a long FLINT call": "perform(t.factorial, Limits(), at_once=True)",
}


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
def test_ctrl_c_ends_it_at_once_and_leaves_nothing_behind(call):
    code = f"""
import os, qe, signal, sys
sys.path.insert(0, os.getcwd())
from tests.unit.processes import works as t
from qe.processes.execution import perform
from qe.processes.limits import Limits
signal.pthread_sigmask(signal.SIG_UNBLOCK, {{signal.SIGINT}})  # whoever started this, and
signal.signal(signal.SIGINT, signal.default_int_handler)  # whatever was ignored there (nohup make test &)
print("go", flush=True)
try:
    {call}
except KeyboardInterrupt:
    left = open(f"/proc/self/task/{{os.getpid()}}/children").read().split()
    print("interrupted", left, flush=True)
"""
    with ending(subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True, cwd=ROOT)) as process:
        assert process.stdout is not None and process.stdout.readline() == "go\n"
        time.sleep(1.0)
        assert process.poll() is None, "it is no longer at work"
        start = time.monotonic()
        process.send_signal(signal.SIGINT)
        assert process.stdout.readline() == "interrupted []\n"
        assert time.monotonic() - start < 1, "0.2 s are asked; the machine may be busy"


def test_ctrl_c_is_tested_also_where_the_tests_were_started_without_it():
    """``nohup make test &`` never ended: a child waited for a signal that it had been told to ignore."""
    name = f"{__file__}::{test_ctrl_c_ends_it_at_once_and_leaves_nothing_behind.__name__}[eliminate]"
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        done = subprocess.run([sys.executable, "-m", "pytest", "-q", name], cwd=ROOT, capture_output=True, timeout=120)
    finally:
        signal.signal(signal.SIGINT, before)
    assert b"1 passed" in done.stdout and done.returncode == 0


def test_what_may_block_moves_at_once():
    from qe.io import formats

    for small in ("ex x. x^2 + b*x + c = 0", "x > 0 and y^3 < 2", "a*x^4 + b*x^2 + c*x < 0"):
        assert not may_block(formats.read(small, "text")) and not text_may_block(small)
    for large in ("x^200 = 2", "x^5*y^4*z + z^9 > 1", "x < 10^1000", " and ".join(f"x{k} > 0" for k in range(400))):
        assert may_block(formats.read(large, "text"))
    assert text_may_block("(x + y + 1)^90 > 0") and text_may_block("x" * 100_000)


def test_limits_are_pickled_without_the_listener():
    limits = Limits(3.0, 100, lambda event: None, process=False)
    assert pickle.loads(pickle.dumps(limits)) == Limits(3.0, 100, process=False)


# Methods side by side: the first answer wins, and no process is left behind.

EARLY, UNABLE = partial(given, "early"), partial(failing, qe.Unable("cannot"))


def raced(**works: Callable[[Channel], str]) -> tuple[str | None, dict[str, str | QEError]]:
    with only_idle_children():
        return first(works, lambda value: value == "early", Limits(timeout=60))


def test_the_first_answer_ends_the_others_and_errors_are_results() -> None:
    winner, found = raced(slow=asleep, fast=EARLY, wrong=UNABLE)
    assert winner == "fast" and found["fast"] == "early" and "slow" not in found
    winner, found = raced(wrong=UNABLE, dead=gone)
    assert winner is None and str(found["wrong"]) == "cannot" and isinstance(found["dead"], WorkerDied)
    winner, found = raced(bad=wrong, fast=EARLY)
    assert winner == "fast" and isinstance(found.get("bad", InternalError("")), InternalError)


def test_raced_methods_give_an_equivalent_answer() -> None:
    answer = qe.eliminate("ex x. x^2 + b*x + c = 0", race=("cad", "vs"), timeout=120)
    assert qe.equivalent(answer, "b^2 >= 4*c") and "the first answer was" in answer.explanation


def test_a_method_that_cannot_loses() -> None:
    answer = qe.eliminate("all x. x^6 + a*x > 0", race=["vs", "cad"], timeout=120, check=True)
    assert answer.status is qe.Status.SOLVED and answer.guarantee is qe.Guarantee.CHECKED
    alone = qe.eliminate("all x. x^6 + a*x > 0", race="vs", timeout=120)
    assert alone.status is qe.Status.UNABLE and alone.reason.startswith("vs: ")


def test_a_race_holds_the_limit() -> None:
    answer = qe.eliminate(HARD, race=("auto", "cad"), timeout=0.5)
    assert answer.status is qe.Status.UNABLE and "time" in answer.reason


@each({"method": "cad"}, {"workers": 2}, {"process": False})
def test_a_race_stands_alone(other: dict[str, object]) -> None:
    with pytest.raises(qe.InputError, match="race: cannot go with"):
        qe.eliminate("x > 0", race="cad", **other)  # type: ignore[arg-type]


def test_the_command_races() -> None:
    command = [Path(sys.executable).parent / "qe", "eliminate", "ex x. x^2 + b*x + c = 0", "--race", "vs,cad"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stdout) == (0, "b^2 - 4*c >= 0\n")
    refused = subprocess.run([*command[:-1], "fast"], capture_output=True, text=True, timeout=120)
    assert refused.returncode == 2 and "race" in refused.stderr


# Processes of a local cluster end with the process that started them, also where it is killed.

CHILD = "import os; from qe.processes import leash; print(os.getpid(), flush=True); leash.watch({parent})"
PARENT = "import subprocess, sys, os; subprocess.run([sys.executable, '-c', sys.argv[1].format(parent=os.getpid())])"


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


@each((0.1, 0.05), (2.0, 0.1), (3.0, 0.15), (60.0, 0.25), (None, 0.25))
def test_a_limit_of_two_seconds_was_overrun_by_an_eighth(timeout: float | None, grace: float) -> None:
    assert grace_of(timeout) == pytest.approx(grace)


def test_the_garbage_collector_is_as_it_was_after_a_question(monkeypatch: pytest.MonkeyPatch) -> None:
    """Also after one inside another, and one that fails."""
    monkeypatch.setattr(
        "qe.processes.execution.SELDOM", (30_000, 30, 60)
    )  # commands in this process have the usual ones
    before = gc.get_threshold()

    def outer_question(_: Budget) -> tuple[object, ...]:
        inner = perform(lambda _: gc.get_threshold(), Limits(process=False))
        return inner, gc.get_threshold()

    inner, during = perform(outer_question, Limits(process=False))
    assert inner == during != before
    with pytest.raises(ZeroDivisionError):
        perform(lambda _: 1 // 0, Limits(process=False))
    assert gc.get_threshold() == before
