"""Work moves to another process once it takes long: results, errors, limits, Ctrl-C, and the switches against it."""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator

import pytest

import qe
from qe.errors import BudgetExceeded, InputError, InternalError, Unable
from qe.formula.weight import may_block, text_may_block
from qe.options import Budget
from qe.processes.execution import HERE, SWITCH, Budgets, Limits, perform
from qe.progress import Event
from tests.conftest import ROOT
from tests.waiting import ending

pytestmark = pytest.mark.processes

HARD = "ex a, b, c. all x, y. a*x^4*y + b*x*y^3 + c*x^2*y^2 + d*x + g*y + f > a^2*x^3 + b^2*y^5"
"""No method finishes this in minutes."""


@pytest.fixture(autouse=True)
def no_child() -> Iterator[None]:
    """After every test there is no child of this process, dead or alive, that was made on the way."""
    before = children()
    yield
    assert children() <= before


def children() -> set[int]:
    with open(f"/proc/self/task/{os.getpid()}/children") as handle:
        return {int(n) for n in handle.read().split()}


def spent(seconds: float, then: Callable[[Budget], object] = lambda budget: os.getpid()) -> Callable[[Budgets], object]:
    """Work that checks its budget all the time, and says where it ended."""

    def work(budgets: Budgets) -> object:
        budget, end = budgets(), time.monotonic() + seconds
        part = budget.share(0.9).part(10)  # parts of a budget move with it
        while time.monotonic() < end:
            part.check("waiting")
            time.sleep(0.002)
        if seconds:
            part.check("at the end")  # a busy machine may have slept through all the checks before
        return then(budget)

    return work


def test_short_work_stays_and_long_work_moves():
    assert perform(spent(0.0), Limits()) == os.getpid()
    assert perform(spent(3 * HERE), Limits()) != os.getpid()
    assert perform(spent(0.0), Limits(), at_once=True) != os.getpid()


@pytest.mark.parametrize("limits", [Limits(process=False), Limits(timeout=60, process=False)])
def test_the_keyword_keeps_it_here(limits):
    assert perform(spent(2 * HERE), limits, at_once=True) == os.getpid()


def test_the_environment_keeps_it_here(monkeypatch):
    monkeypatch.setenv(SWITCH, "off")
    assert perform(spent(2 * HERE), Limits(timeout=60), at_once=True) == os.getpid()


def test_without_fork_limits_are_checked_between_steps(monkeypatch):
    monkeypatch.delattr(os, "fork")
    assert perform(spent(2 * HERE), Limits()) == os.getpid()
    with pytest.raises(BudgetExceeded):
        perform(spent(60), Limits(timeout=0.1))
    assert qe.eliminate("ex x. x^2 + b*x + c = 0", timeout=60).formula is not None


def test_what_was_done_before_the_move_is_not_done_again():
    done: list[int] = []

    def work(budgets: Budgets) -> list[int]:
        budget = budgets()
        for k in range(40):
            done.append(k)
            time.sleep(HERE / 10)
            budget.check("step")
        return done

    assert perform(work, Limits()) == list(range(40))
    assert 0 < len(done) < 40  # the rest was done elsewhere


def test_events_arrive_before_and_after_the_move():
    seen: list[Event] = []

    def work(budgets: Budgets) -> int:
        budget = budgets()
        for k in range(5):
            budget.listener(Event("count", k))
            time.sleep(HERE / 2)
            budget.check("step")
        return os.getpid()

    assert perform(work, Limits(progress=seen.append)) != os.getpid()
    assert [e.done for e in seen if e.phase == "count"] == list(range(5))


@pytest.mark.parametrize("seconds", [0.0, 2 * HERE])
@pytest.mark.parametrize("error", [InputError("wrong"), Unable("too hard"), BudgetExceeded("cells", limit="cells")])
def test_own_errors_are_the_same_on_both_sides(seconds, error):
    def fail(budget: Budget) -> None:
        raise error

    with pytest.raises(type(error), match=str(error)):
        perform(spent(seconds, fail), Limits())


def test_other_errors_of_moved_work_are_internal_errors():
    with pytest.raises(InternalError, match="ZeroDivisionError"):
        perform(spent(2 * HERE, lambda budget: 1 // 0), Limits())


def test_an_error_of_the_listener_ends_the_work():
    """Even an ``Unable``, which the engine would take for one of its own if it met it inside a method."""

    def listener(event: Event) -> None:
        raise Unable("enough")

    def work(budgets: Budgets) -> str:
        budget = budgets()
        time.sleep(2 * HERE)  # the first event comes from the other process
        try:
            while True:
                budget.check("step")
        except Unable:
            return "the work went on"

    with pytest.raises(Unable, match="enough"):
        perform(work, Limits(progress=listener))


def test_the_limit_kills_work_that_never_looks_up():
    def stuck(budget: Budget) -> None:
        signal.sigtimedwait([], 30)

    start = time.monotonic()
    with pytest.raises(BudgetExceeded) as caught:
        perform(spent(2 * HERE, stuck), Limits(timeout=0.3))
    assert caught.value.limit == "time" and time.monotonic() - start < 30


def test_inside_a_worker_only_an_earlier_limit_forks():
    def inside(budgets: Budgets) -> tuple[int, object, object, object]:
        late, early = Limits(timeout=100), Limits(timeout=1)
        moved = [perform(spent(0.0), limits, at_once=True) for limits in (Limits(), late, early)]
        return os.getpid(), *moved

    own, free, late, early = perform(inside, Limits(timeout=30), at_once=True)
    assert own == free == late != early


def test_one_journey_inside_another():
    def outer(budgets: Budgets) -> tuple[object, object, int]:
        budget = budgets()
        first = perform(spent(2 * HERE), Limits())  # moves and comes back
        budget.check("outer")  # moves here
        second = perform(spent(2 * HERE), Limits())  # stays in the worker
        return first, second, os.getpid()

    first, second, last = perform(outer, Limits())
    assert first != os.getpid() and second == last != os.getpid()


def test_work_of_a_thread_moves_too():
    found: list[object] = []
    thread = threading.Thread(target=lambda: found.append(perform(spent(2 * HERE), Limits())))
    thread.start()
    thread.join(30)
    assert found and found[0] != os.getpid()


CALLS = {
    "eliminate": f"qe.eliminate({HARD!r})",
    "find_instance": "qe.find_instance('all a, b. ex x. all y. a*x^4*y^3 + b*x^3*y^5 + x^2*y + z*x > a^2*y^4 + x*y')",
    "region": "qe.region('x^6*y^5+z^7*x-y*z^3+3 > 0 and x^7+y^6*z^5-x*y*z = 1')",
    "a long FLINT call": "perform(lambda budgets: fmpz.fac_ui(10**9), Limits(), at_once=True)",
}


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
def test_ctrl_c_ends_it_at_once_and_leaves_nothing_behind(call):
    code = f"""
import qe, signal
from flint import fmpz
from qe.processes.execution import Limits, perform
signal.pthread_sigmask(signal.SIG_UNBLOCK, {{signal.SIGINT}})  # whoever started this, and
signal.signal(signal.SIGINT, signal.default_int_handler)  # whatever was ignored there (nohup make test &)
print("go", flush=True)
try:
    {call}
except KeyboardInterrupt:
    import os
    left = open(f"/proc/self/task/{{os.getpid()}}/children").read().split()
    print("interrupted", left, flush=True)
"""
    with ending(subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)) as process:
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


def test_what_may_block_is_forked_at_once():
    from qe.io import formats

    for small in ("ex x. x^2 + b*x + c = 0", "x > 0 and y^3 < 2", "a*x^4 + b*x^2 + c*x < 0"):
        assert not may_block(formats.read(small, "text")) and not text_may_block(small)
    for large in ("x^200 = 2", "x^5*y^4*z + z^9 > 1", "x < 10^1000", " and ".join(f"x{k} > 0" for k in range(400))):
        assert may_block(formats.read(large, "text"))
    assert text_may_block("(x + y + 1)^90 > 0") and text_may_block("x" * 100_000)


def test_limits_are_pickled_without_the_listener():
    limits = Limits(3.0, 100, lambda event: None, process=False)
    assert pickle.loads(pickle.dumps(limits)) == Limits(3.0, 100, process=False)
