"""The worker: results, errors, limits, partial knowledge, and no process left behind."""

from __future__ import annotations

import os
import signal
import time

import pytest

import qe
from qe.errors import BudgetExceeded, CertificateRejected, InternalError, ParseError, Unable
from qe.exact.ring import Ring
from qe.formula.build import atom, exists
from qe.formula.syntax import Relation
from qe.processes.worker import Channel, Known, WorkerDied, WorkerStopped, run
from qe.progress import Event

pytestmark = pytest.mark.processes


@pytest.fixture(autouse=True)
def no_zombie():
    """After every test there is no child of this process, dead or alive, that ``run`` made."""
    before = _children()
    yield
    assert _children() <= before


def _children() -> set[int]:
    with open(f"/proc/self/task/{os.getpid()}/children") as handle:
        return {int(n) for n in handle.read().split()}


def test_result_and_events_arrive_in_order():
    seen: list[Event] = []

    def work(channel: Channel) -> dict[str, int]:
        for k in range(3):
            channel.event(Event("lift", k, 3))
        return {"pid": os.getpid()}

    result = run(work, progress=seen.append)
    assert [e.done for e in seen] == [0, 1, 2]
    assert result["pid"] != os.getpid()


def test_formulas_travel():
    ring = Ring.of(("x", "y"))
    x, y = ring.var("x"), ring.var("y")
    formula = exists(("y",), atom(x * x + y, Relation.LT))
    assert run(lambda channel: formula) == formula


def test_a_large_result_arrives_whole():
    assert run(lambda channel: b"x" * 3_000_000) == b"x" * 3_000_000


@pytest.mark.parametrize(
    "error",
    [
        ParseError("a bracket is open", source="f.txt", line=3, column=7, expected="')'"),
        CertificateRejected("cell 3", "sign"),
        Unable("too hard"),
        BudgetExceeded("cells", limit="cells"),
    ],
)
def test_own_errors_arrive_as_they_were(error):
    def work(channel: Channel) -> None:
        raise error

    with pytest.raises(type(error)) as caught:
        run(work)
    assert str(caught.value) == str(error)
    assert {k: v for k, v in vars(caught.value).items() if k != "known"} == vars(error)


def test_foreign_errors_arrive_as_internal_errors_with_their_place():
    with pytest.raises(InternalError, match=r"ZeroDivisionError at processes/test_worker.py:\d+: ") as caught:
        run(lambda channel: 1 // 0)
    assert "Traceback" in caught.value.trace


def test_an_unpicklable_result_is_an_internal_error():
    with pytest.raises(InternalError):
        run(lambda channel: lambda: None)


def test_the_time_limit_kills_and_keeps_what_was_known():
    def work(channel: Channel) -> None:
        channel.fact("variables left", 3)
        channel.event(Event("project", 4, 12))
        while True:
            signal.sigtimedwait([], 10)  # no Python-level check would ever end this

    start = time.monotonic()
    with pytest.raises(WorkerStopped) as caught:
        run(work, timeout=0.2, grace=0.05)
    assert time.monotonic() - start < 30  # without the limit it takes for ever
    assert caught.value.limit == "time"
    known = caught.value.known
    assert known.facts == {"variables left": 3}
    assert known.phases["project"].done == 4
    assert "variables left: 3; project 4 of 12" in str(known)


def test_a_long_flint_call_is_killed():
    from flint import fmpz

    start = time.monotonic()
    with pytest.raises(WorkerStopped):
        run(lambda channel: int(fmpz.fac_ui(10**9).bit_length()), timeout=0.3, memory=4000)
    assert time.monotonic() - start < 30  # without the limit it takes for ever


def test_a_soft_limit_reports_what_is_known():
    def work(channel: Channel) -> None:
        channel.event(Event("lift", 9))
        raise BudgetExceeded("time limit reached while doing: lift", limit="time")

    with pytest.raises(WorkerStopped) as caught:
        run(work, timeout=60)
    assert caught.value.known.phases["lift"].done == 9


def test_python_memory_limit():
    with pytest.raises(BudgetExceeded) as caught:
        run(lambda channel: len(bytearray(1 << 31)), memory=600)
    assert caught.value.limit == "memory"


def test_flint_abort_under_a_memory_limit(capfd):
    from flint import fmpz_poly

    with pytest.raises(BudgetExceeded) as caught:
        run(lambda channel: (fmpz_poly([1, 1]) ** 10**12).degree(), memory=600)
    assert caught.value.limit == "memory"
    assert capfd.readouterr().err == ""


def test_death_by_signal_is_a_clear_unable():
    with pytest.raises(WorkerDied) as caught:
        run(lambda channel: os.kill(os.getpid(), signal.SIGSEGV))
    assert caught.value.signal_number == signal.SIGSEGV
    assert "signal 11" in str(caught.value)


def test_a_failing_listener_leaves_no_worker():
    def work(channel: Channel) -> None:
        channel.event(Event("lift"))
        time.sleep(60)

    def listener(event: Event) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(work, progress=listener)


def test_known_is_filled_for_a_run_that_ends_well():
    known = Known()
    run(lambda channel: channel.fact("method", "vs"), known=known)
    assert known.facts == {"method": "vs"}
    assert known.seconds > 0


HARD = "ex a, b, c. all x, y. a*x^4*y + b*x*y^3 + c*x^2*y^2 + d*x + g*y + f > a^2*x^3 + b^2*y^5"


def test_the_public_function_answers_unable_at_a_hard_limit():
    answer = qe.eliminate(HARD, timeout=0.5, memory=2000)
    assert answer.status is qe.Status.UNABLE
    assert "limit" in answer.reason


def test_the_public_function_brings_whole_answers_home():
    seen: list[Event] = []
    answer = qe.eliminate("ex x. x^3 = 2", memory=2000, progress=seen.append)
    assert answer.truth is True
    assert answer.witness is not None
    assert float(answer.witness["x"]) == pytest.approx(2 ** (1 / 3))
    formula = "ex x. x^2 + b*x + c = 0"
    assert qe.eliminate(formula, memory=2000).formula == qe.eliminate(formula).formula
    assert seen


def test_threads_of_flint_do_not_stop_a_worker():
    """A worker waited for ever for threads that only its parent had."""
    import flint

    ring = flint.fmpz_mpoly_ctx.get(("x", "y", "z"), "lex")
    x, y, z = ring.gens()
    flint.ctx.threads = 2
    try:
        power = (x + 2 * y + 3 * z + 1) ** 20
        terms = len(power * power)
        assert run(lambda channel: len(power * power), timeout=120) == terms
        assert flint.ctx.threads == 2
    finally:
        flint.ctx.threads = 1
