"""Questions in a worker: results, errors, limits, partial knowledge, and no process left behind at work."""

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from functools import partial

import pytest

import qe
from qe.errors import BudgetExceeded, CertificateRejected, InternalError, ParseError, Unable
from qe.exact.ring import Ring
from qe.formula.build import atom, exists
from qe.formula.syntax import Relation
from qe.processes import worker
from qe.processes.channel import Known, WorkerDied, WorkerStopped
from qe.processes.execution import run
from qe.processes.limits import Limits
from qe.processes.worker import IDLE, MOST_IDLE, end_idle
from qe.progress import Event
from tests.conftest import ROOT
from tests.tables import each
from tests.unit.processes import works
from tests.waiting import ending
from tests.workers import children, is_gone, only_idle_children

pytestmark = pytest.mark.processes


@pytest.fixture(autouse=True)
def no_process_is_left() -> Iterator[None]:
    with only_idle_children():
        yield


def test_result_and_events_arrive_in_order() -> None:
    seen: list[Event] = []
    assert run(works.counting, Limits(progress=seen.append)) != os.getpid()
    assert [e.done for e in seen] == [0, 1, 2]


def test_a_worker_is_kept_for_the_next_question() -> None:
    assert len({run(works.process, limits) for limits in (Limits(), Limits(timeout=60), Limits(memory=4000))}) == 1


def test_a_worker_has_loaded_what_is_loaded_here(monkeypatch: pytest.MonkeyPatch) -> None:
    """The time of a question is not that of its modules."""
    import qe.coq.text

    end_idle()
    loaded = {name for name in sys.modules if name.startswith("qe.coq.")}
    assert qe.coq.text.__name__ in loaded and not loaded & run(works.modules, Limits())
    end_idle()
    monkeypatch.setattr(worker, "PACKAGES", ("qe.coq.",))
    assert loaded <= run(works.modules, Limits())


def test_what_holds_for_the_whole_interpreter_holds_in_the_worker(monkeypatch: pytest.MonkeyPatch) -> None:
    run(works.process, Limits())
    before = sys.get_int_max_str_digits(), sys.getrecursionlimit()
    monkeypatch.syspath_prepend("/nowhere")
    sys.set_int_max_str_digits(7000)
    sys.setrecursionlimit(1234)
    try:
        assert run(works.general, Limits()) == ("/nowhere", 7000, 1234)
    finally:
        sys.set_int_max_str_digits(before[0])
        sys.setrecursionlimit(before[1])


def test_formulas_travel() -> None:
    ring = Ring.of(("x", "y"))
    x, y = ring.var("x"), ring.var("y")
    formula = exists(("y",), atom(x * x + y, Relation.LT))
    assert run(partial(works.given, formula), Limits()) == formula


def test_large_questions_and_results_arrive_whole() -> None:
    assert run(partial(works.given, b"x" * 3_000_000), Limits()) == b"x" * 3_000_000


@pytest.mark.parametrize(
    "error",
    [CertificateRejected("cell 3", "sign"), Unable("too hard"), BudgetExceeded("cells", limit="cells")],
    ids=lambda error: type(error).__name__,
)
def test_own_errors_arrive_as_they_were(error: Exception) -> None:
    with pytest.raises(type(error)) as caught:
        run(partial(works.failing, error), Limits())
    assert str(caught.value) == str(error)
    assert {k: v for k, v in vars(caught.value).items() if k != "known"} == vars(error)


def test_the_place_in_a_text_arrives_with_its_error() -> None:
    with pytest.raises(ParseError) as caught:
        run(works.parse_error, Limits())
    assert (caught.value.line, caught.value.column) == (3, 7)


def test_foreign_errors_arrive_as_internal_errors_with_their_place() -> None:
    with pytest.raises(InternalError, match=r"ZeroDivisionError at processes/works.py:\d+: ") as caught:
        run(works.wrong, Limits())
    assert "Traceback" in caught.value.trace


def test_after_a_foreign_error_the_worker_is_replaced() -> None:
    before = run(works.process, Limits())
    with pytest.raises(InternalError):
        run(works.wrong, Limits())
    assert run(works.process, Limits()) != before


def test_an_unpicklable_result_is_an_internal_error() -> None:
    with pytest.raises(InternalError):
        run(works.unpicklable, Limits())


def test_a_result_that_cannot_be_read_here_ends_its_worker() -> None:
    """The rest of it was still in the pipe, and the next question got that for its answer."""
    before = run(works.process, Limits())
    with pytest.raises(AssertionError):
        run(works.unreadable, Limits())
    assert run(works.process, Limits()) != before


def test_work_that_cannot_be_sent_stays_here_where_nothing_is_limited() -> None:
    assert run(lambda channel: os.getpid(), Limits()) == os.getpid()
    for limits in (Limits(timeout=60), Limits(memory=4000)):
        with pytest.raises(Unable, match="cannot be sent"):
            run(lambda channel: os.getpid(), limits)


def test_the_time_limit_kills_and_keeps_what_was_known() -> None:
    run(works.process, Limits())
    start = time.monotonic()
    with pytest.raises(WorkerStopped) as caught:
        run(works.stuck, Limits(timeout=0.2), grace=0.05)
    assert time.monotonic() - start < 30  # without the limit it takes for ever
    assert caught.value.limit == "time"
    known = caught.value.known
    assert known.facts == {"variables left": 3}
    assert known.phases["project"].done == 4
    assert "variables left: 3; project 4 of 12" in str(known)


def test_a_long_flint_call_is_killed() -> None:
    start = time.monotonic()
    with pytest.raises(WorkerStopped):
        run(works.factorial, Limits(timeout=0.3, memory=4000))
    assert time.monotonic() - start < 30  # without the limit it takes for ever


@each(Limits(timeout=60), Limits(process=False))
def test_a_soft_limit_reports_what_is_known(limits: Limits) -> None:
    with pytest.raises(WorkerStopped) as caught:
        run(works.out_of_budget, limits)
    assert caught.value.known.phases["lift"].done == 9


@each(works.large, works.power)
def test_memory_limits_hold_also_where_a_library_aborts(work: object, capfd: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(BudgetExceeded) as caught:
        run(work, Limits(memory=600))  # type: ignore[arg-type]
    assert caught.value.limit == "memory"
    assert capfd.readouterr().err == ""


def test_a_memory_limit_is_that_of_one_question() -> None:
    with pytest.raises(BudgetExceeded):
        run(works.a_gigabyte, Limits(memory=600))
    first = run(works.process, Limits(memory=600))
    assert run(works.a_gigabyte, Limits()) == 1 << 30 and run(works.process, Limits()) == first


def test_workers_of_a_worker_have_its_memory_limit_for_as_long() -> None:
    inner = Limits(timeout=100)
    with pytest.raises(BudgetExceeded):
        run(partial(works.asking, inner), Limits(timeout=200, memory=600))
    assert run(partial(works.asking, inner), Limits(timeout=200)) == 1 << 30


def test_a_worker_that_has_grown_is_replaced() -> None:
    assert run(works.growing, Limits()) != run(works.process, Limits())


def test_death_by_signal_is_a_clear_unable() -> None:
    with pytest.raises(WorkerDied) as caught:
        run(partial(works.killed, signal.SIGSEGV), Limits())
    assert caught.value.signal_number == signal.SIGSEGV
    assert "signal 11" in str(caught.value)


def test_a_worker_that_was_killed_while_it_waited_is_replaced() -> None:
    before = run(works.process, Limits())
    os.kill(before, signal.SIGKILL)
    assert is_gone(before) and run(works.process, Limits()) != before


def test_where_the_limit_killed_a_worker_the_next_one_loads_before_it_is_asked() -> None:
    end_idle()
    for killed in (False, True):
        with pytest.raises(WorkerStopped):
            run(works.stuck, Limits(timeout=0.1))
        (spare,) = IDLE
        if killed:  # also while it loads
            spare.kill()
        assert (run(works.process, Limits()) == spare.process.pid) != killed


def test_a_worker_that_is_killed_from_outside_is_a_clear_unable() -> None:
    pids: list[int] = []

    def kill(event: Event) -> None:
        pids.append(event.done)
        os.kill(event.done, signal.SIGTERM)

    with pytest.raises(WorkerDied, match="signal 15"):
        run(works.says_its_name, Limits(progress=kill))
    assert pids and run(works.process, Limits()) not in pids


@each(KeyboardInterrupt, Unable)
def test_a_failing_listener_leaves_no_worker(error: type[BaseException]) -> None:
    def listener(event: Event) -> None:
        raise error("enough")

    before = children()
    with pytest.raises(error, match="enough"):
        run(works.says_its_name, Limits(progress=listener))
    assert children() <= before


def test_known_is_filled_for_a_run_that_ends_well() -> None:
    known = Known()
    run(works.knowing, Limits(), known=known)
    assert known.facts == {"method": "vs"}
    assert known.seconds > 0


HARD = "ex a, b, c. all x, y. a*x^4*y + b*x*y^3 + c*x^2*y^2 + d*x + g*y + f > a^2*x^3 + b^2*y^5"


def test_the_public_function_answers_unable_at_a_hard_limit() -> None:
    answer = qe.eliminate(HARD, timeout=0.5, memory=2000)
    assert answer.status is qe.Status.UNABLE
    assert "limit" in answer.reason


def test_the_public_function_brings_whole_answers_home() -> None:
    seen: list[Event] = []
    answer = qe.eliminate("ex x. x^3 = 2", memory=2000, progress=seen.append)
    assert answer.truth is True
    assert answer.witness is not None
    assert float(answer.witness["x"]) == pytest.approx(2 ** (1 / 3))
    formula = "ex x. x^2 + b*x + c = 0"
    assert qe.eliminate(formula, memory=2000).formula == qe.eliminate(formula).formula
    assert seen


def test_threads_ask_side_by_side() -> None:
    end_idle()
    wait, found = threading.Barrier(6), []

    def ask(k: int) -> None:
        wait.wait()
        found.append((k, run(partial(works.resting, k), Limits(timeout=60))))

    threads = [threading.Thread(target=ask, args=(k,)) for k in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
    assert sorted(k for k, _ in found) == list(range(6)) and all(k == answer[0] for k, answer in found)
    assert len({answer[1] for _, answer in found}) > 1
    assert len(IDLE) == MOST_IDLE == len(children() & {w.process.pid for w in IDLE})


def test_two_hundred_calls_leave_no_process_behind_and_are_quick() -> None:
    """At most 10 ms more than in this process: by the lower quartile of many, as other tests run beside it."""
    end_idle()
    question, here, there = "ex x. x^2 + b*x + c = 0", [], []
    qe.eliminate(question, timeout=60)
    for _ in range(200):
        for times, keywords in ((here, {}), (there, {"timeout": 60})):
            start = time.perf_counter()
            qe.eliminate(question, **keywords)  # type: ignore[arg-type]
            times.append(time.perf_counter() - start)
    assert len(IDLE) == 1
    assert sorted(there)[50] - sorted(here)[50] < 0.02


def test_it_is_not_the_main_module_of_the_caller_that_is_run_again(tmp_path) -> None:  # type: ignore[no-untyped-def]
    """``multiprocessing`` runs scripts without a guard a second time."""
    script = tmp_path / "script.py"
    script.write_text("import qe\nprint('once')\nprint(qe.eliminate('ex x. x^2 = b', timeout=60).formula)\n")
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, timeout=120, env=environment)
    assert done.stdout == "once\nb >= 0\n" and not done.stderr


def in_another(code: str) -> subprocess.Popen[str]:
    text = f"import os, sys\nsys.path.insert(0, os.getcwd())\nfrom tests.unit.processes import works as t\n{code}"
    return subprocess.Popen([sys.executable, "-c", text], stdout=subprocess.PIPE, text=True, cwd=ROOT)


SAYS = "say = lambda event: print(event.done, flush=True)\n"


@each("says_its_name", "says_its_name_and_is_stuck", "asks_another")
def test_workers_end_with_the_process_that_asks_however_it_ends(work: str) -> None:
    with ending(in_another(f"{SAYS}t.run(t.{work}, t.Limits(progress=say))")) as parent:
        assert parent.stdout is not None
        pid = int(parent.stdout.readline())
        time.sleep(0.1)
        parent.send_signal(signal.SIGKILL)
        assert is_gone(pid)


def test_workers_that_wait_end_with_the_process() -> None:
    with ending(in_another("print(t.run(t.process, t.Limits()), flush=True)")) as parent:
        assert parent.stdout is not None
        pid = int(parent.stdout.readline())
        assert parent.wait(60) == 0 and is_gone(pid, 1)


def test_a_forked_process_has_workers_of_its_own() -> None:
    code = """
mine = t.run(t.process, t.Limits())
child = os.fork()
if not child:
    os._exit(int(t.run(t.process, t.Limits()) == mine))
print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), t.run(t.process, t.Limits()) == mine, flush=True)
"""
    with ending(in_another(code)) as parent:
        assert parent.communicate(timeout=60)[0] == "0 True\n"


def test_a_process_that_was_forked_while_a_worker_loads_does_not_wait_for_it() -> None:
    code = """
from qe.processes import worker
worker.IDLE.append(worker.Worker())
child = os.fork()
if not child:
    os._exit(t.run(t.process, t.Limits()) == os.getppid())
print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), t.run(t.process, t.Limits()) > 0, flush=True)
"""
    with ending(in_another(code)) as parent:
        assert parent.communicate(timeout=60)[0] == "0 True\n"


WITHOUT = """
import os, sys, flint, tests.unit.processes.works  # the standard library has branches of its own
for name in ("resource", "fcntl", "termios", "pwd", "grp"):
    sys.modules[name] = None
sys.platform = "win32"
"""


def test_a_system_with_nothing_but_processes(monkeypatch: pytest.MonkeyPatch) -> None:
    """As on Windows: no signals to speak of, no limits of the system's; all but the limit of memory is the same."""
    end_idle()
    monkeypatch.setattr(worker, "START", f"import sys; sys.path[:] = sys.argv[1:]\n{WITHOUT}\n{worker.START}")
    try:
        assert run(works.platform, Limits()) == "win32"
        assert qe.eliminate("ex x. x^2 + b*x + c = 0", timeout=60) is not None
        with pytest.raises(WorkerStopped):
            run(works.factorial, Limits(timeout=0.3))
        assert run(works.a_gigabyte, Limits(memory=600)) == 1 << 30
    finally:
        end_idle()
