"""What the tests of this folder let workers do. A worker loads this, and with it nothing of the tests themselves."""

import os
import signal
import sys
import time
from collections.abc import Callable
from functools import partial

from qe.errors import BudgetExceeded, ParseError, Unable
from qe.options import Budget
from qe.processes.channel import Channel
from qe.processes.execution import HERE, perform, run
from qe.processes.limits import Limits
from qe.progress import Event


def process(_: object) -> int:
    return os.getpid()


def given(value: object, _: object) -> object:
    return value


def failing(error: Exception, _: object) -> None:
    raise error


def killed(number: int, _: object) -> None:
    os.kill(os.getpid(), number)


def gone(_: object) -> str:
    os._exit(3)


def asleep(_: object) -> str:
    time.sleep(600)
    return "late"


def factorial(_: object) -> int:
    from flint import fmpz

    return int(fmpz.fac_ui(10**9).bit_length())


def large(_: object) -> int:
    return len(bytearray(1 << 31))


def a_gigabyte(_: object) -> int:
    return len(bytearray(1 << 30))


def power(_: object) -> int:
    from flint import fmpz_poly

    return int((fmpz_poly([1, 1]) ** 10**12).degree())


def platform(_: object) -> str:
    return sys.platform


def general(_: object) -> tuple[str, int, int]:
    return sys.path[0], sys.get_int_max_str_digits(), sys.getrecursionlimit()


def modules(_: object) -> set[str]:
    return {name for name in sys.modules if name.startswith("qe.")}


def parse_error(_: object) -> None:
    raise ParseError("a bracket is open", source="f.txt", line=3, column=7, expected="')'")


def wrong(_: object) -> float:
    return 1 // 0


def unpicklable(_: object) -> object:
    return lambda: None


class Unreadable:
    def __reduce__(self) -> tuple[object, tuple[object, ...]]:
        return only_in_a_worker, (os.getpid(),)


def unreadable(_: object) -> Unreadable:
    return Unreadable()


def only_in_a_worker(pid: int) -> str:
    assert pid == os.getpid()
    return "early"


grown: list[bytes] = []


def growing(_: object) -> int:
    grown.append(bytes(range(256)) * (4 << 20))
    return os.getpid()


def resting(k: int, _: object) -> tuple[int, int]:
    time.sleep(0.3)
    return k, os.getpid()


# --- that use what they get: a channel --------------------------------------------------------------------------------


def counting(channel: Channel) -> int:
    for k in range(3):
        channel.event(Event("lift", k, 3))
    return os.getpid()


def stuck(channel: Channel) -> None:
    channel.fact("variables left", 3)
    channel.event(Event("project", 4, 12))
    while True:
        signal.sigtimedwait([], 10)  # no Python-level check would ever end this


def out_of_budget(channel: Channel) -> None:
    channel.event(Event("lift", 9))
    raise BudgetExceeded("time limit reached while doing: lift", limit="time")


def knowing(channel: Channel) -> None:
    channel.fact("method", "vs")


def says_its_name(channel: Channel) -> None:
    channel.event(Event("here", os.getpid()))
    time.sleep(60)


def says_its_name_and_is_stuck(channel: Channel) -> int:
    channel.event(Event("here", os.getpid()))
    return factorial(channel)


def asks_another(channel: Channel) -> None:
    """A question of a worker to a worker of its own, since an earlier limit is to hold."""
    run(says_its_name_and_is_stuck, Limits(timeout=600, progress=channel.event))


def asking(inner: Limits, channel: Channel) -> int:
    return run(a_gigabyte, inner)


# --- a budget ---------------------------------------------------------------------------------------------------------


def spent(seconds: float, then: Callable[[Budget], object], budget: Budget) -> object:
    """Work that checks its budget all the time."""
    end = time.monotonic() + seconds
    part = budget.share(0.9).part(10)  # parts of a budget move with it
    while time.monotonic() < end:
        part.check("waiting")
        time.sleep(0.002)
    if seconds:
        part.check("at the end")  # a busy machine may have slept through all the checks before
    return then(budget)


def work(seconds: float, then: Callable[[Budget], object] = process) -> Callable[[Budget], object]:
    return partial(spent, seconds, then)


def loading(budget: Budget) -> int:
    time.sleep(2 * HERE)
    sys.modules[f"a module that is loaded by {os.getpid()}"] = sys
    budget.check("loaded")
    return os.getpid()


def noting(file: str, budget: Budget) -> int:
    try:
        return spent(3 * HERE, process, budget)  # type: ignore[return-value]
    finally:
        with open(file, "a") as handle:
            print(os.getpid(), file=handle)


def slowly_counting(budget: Budget) -> int:
    for k in range(5):
        budget.listener(Event("count", k))
        time.sleep(HERE / 2)
        budget.check("step")
    return os.getpid()


def heedless(budget: Budget) -> str:
    time.sleep(2 * HERE)
    try:
        while True:
            budget.check("step")
    except Unable:
        return "the work went on"


def inside(several: list[Limits], budget: Budget) -> list[object]:
    return [os.getpid(), *(perform(work(0.0), limits, at_once=True) for limits in several)]


def outer(first: Callable[[Budget], object], at_once: bool, budget: Budget) -> tuple[object, int]:
    return perform(first, Limits(), at_once=at_once), os.getpid()
