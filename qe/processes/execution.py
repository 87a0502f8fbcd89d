"""Where the work of a public function runs: here while it is short, in a worker process once it takes long.

A FLINT call cannot be interrupted and may abort when memory runs out, so work that must obey Ctrl-C and limits runs in
a process that can be killed (``qe.processes.worker``). Sending every question there would cost a short one more than
its own time. So work starts here, unless a limit is given or one operation could already be long. At the first
``Budget.check`` after ``HERE`` seconds it is given up and asked again from its beginning, in the worker. Work is
therefore a callable that can be pickled, and that can be asked twice.

A question inside another one is a part of it: where it needs a worker, the whole moves; inside a worker it stays there,
unless an earlier limit is to hold. What the work gives to ``Budget.keep`` is its result if a limit ends it later: an
answer is not lost while it is proved.
"""

from __future__ import annotations

import gc
import math
import os
import sys
import time
from collections.abc import Callable
from contextvars import ContextVar
from functools import partial
from typing import TypeVar

from qe.errors import BudgetExceeded, Unable
from qe.options import Budget, Handover
from qe.processes.channel import Channel, Known, Message, WorkerStopped
from qe.processes.limits import Limits
from qe.progress import Listener

T = TypeVar("T")
Work = Callable[[Budget], T]

HERE, COLD = 0.05, 0.3
"""Seconds that work takes in the process of the caller before it moves: to a worker that runs, and to one that has to
be started first, which takes about as long. Time in which modules are loaded does not count."""

GRACE, SHORT_GRACE, SHARE = 0.25, 0.05, 0.05
"""Seconds past the time limit before the kill, so that a soft limit in the worker can answer first: a share of the
limit, between two bounds."""

SWITCH = "QE_PROCESS"
"""The environment variable that, set to ``off``, keeps all work in the process of the caller."""

SELDOM = 20_000, 20, 50
"""Thresholds of the garbage collector while a question is worked on: there are few circles of dead objects, and looking
for them among all that lives took a sixth of the time of small questions."""

Bounds = tuple[float, float]
"""When a limit ends a worker (of ``time.monotonic``), and the MiB that it may have; infinity where none does."""

OUTER: ContextVar[Handover | Bounds | None] = ContextVar("OUTER", default=None)
"""Of the question that is being worked on: how it moves while it is here, or the bounds of its worker."""


def grace_of(timeout: float | None) -> float:
    """The seconds past this time limit before the kill."""
    return GRACE if timeout is None else min(GRACE, max(SHORT_GRACE, SHARE * timeout))


class _Moves(BaseException):
    """Unwinds work that is to be asked again in a worker; the code on the way has nothing to do with it."""

    def __init__(self, handover: Handover) -> None:
        self.handover = handover
        super().__init__()


def perform(work: Work[T], limits: Limits, *, at_once: bool = False) -> T:
    """``work(budget)`` under the limits, as ``run`` does it; what it has kept last in place of an ``Unable``."""
    known = Known()
    try:
        return run(partial(_on_budget, work), limits, at_once=at_once, known=known)
    except Unable:
        if not known.kept():
            raise
        kept: T = known.kept()[0]
        return kept


def _on_budget(work: Work[T], channel: Channel) -> T:
    return work(channel.budget())


def run(
    work: Callable[[Channel], T],
    limits: Limits,
    *,
    at_once: bool = True,
    grace: float | None = None,
    known: Known | None = None,
) -> T:
    """``work(channel)`` under the limits; ``known`` is filled as it goes on.

    ``at_once``: a single operation may take long from the start. The worker is killed ``grace`` seconds after the time
    limit (None: ``grace_of`` it). Its memory is its address space, the interpreter included. Progress is heard here. No
    process is left behind at work, whatever happens. Work and result are pickled; work that cannot be stays here where
    nothing is limited.

    Raises ``WorkerStopped`` at a limit, and every ``QEError`` that the work itself raised; from a worker any other
    exception arrives as ``InternalError``, and ``WorkerDied`` says that a signal ended it.
    """
    known = Known() if known is None else known
    start = time.monotonic() if limits.start is None else limits.start
    deadline = math.inf if limits.timeout is None else start + limits.timeout
    outer = OUTER.get()
    here = partial(_done_here, work, limits.progress, known, deadline)
    try:
        if not _may_move(limits, deadline, outer):
            return here(outer if isinstance(outer, Handover) else None)
        at_once = at_once or limits.memory is not None
        if at_once:
            leave()
        else:
            handover = outer if isinstance(outer, Handover) else _handover()
            try:
                return here(handover)
            except _Moves as move:
                if move.handover is not handover or handover is outer:
                    raise
        from qe.processes.portable import packed
        from qe.processes.worker import asked

        sent = packed(work)
        if sent is None:
            if limits.timeout is not None or limits.memory is not None:
                raise Unable("the question cannot be sent to another process, where limits hold (process=False: here)")
            return here(None)
        past = grace_of(limits.timeout) if grace is None else grace
        found: T = asked(sent, limits, deadline, past, known)  # type: ignore[assignment]
        return found
    finally:
        known.seconds = time.monotonic() - start


def _may_move(limits: Limits, deadline: float, outer: Handover | Bounds | None) -> bool:
    """Whether processes are wanted, and one would serve: inside a worker only a tighter limit does."""
    if not limits.process or not sys.executable or os.environ.get(SWITCH, "").lower() in ("off", "0"):
        return False
    if not isinstance(outer, tuple):
        return True
    return deadline < outer[0] or (limits.memory is not None and limits.memory < outer[1])


def _done_here(
    work: Callable[[Channel], T], progress: Listener, known: Known, deadline: float, handover: Handover | None
) -> T:
    """The work in this process, from which it may move."""

    def take(message: Message) -> None:
        known.take(message, progress)

    token = None if handover is None else OUTER.set(handover)
    usual = gc.get_threshold()  # of a question inside another it is that already
    gc.set_threshold(*SELDOM)
    try:
        return work(Channel(take, deadline, handover))
    except BudgetExceeded as error:
        if type(error) is not BudgetExceeded:
            raise
        raise WorkerStopped(str(error), limit=error.limit, known=known) from error
    finally:
        if usual != SELDOM:  # also while another thread has a question
            gc.set_threshold(*usual)
        if token is not None:
            OUTER.reset(token)


def _handover() -> Handover:
    """What gives work up that begins now, once it has taken long in a process whose modules are loaded."""
    begin, loaded = time.monotonic(), len(sys.modules)

    def move() -> None:
        nonlocal begin, loaded
        from qe.processes.worker import IDLE

        now = time.monotonic()
        if len(sys.modules) > loaded:
            begin, loaded = now, len(sys.modules)
        handover.due = begin + (HERE if IDLE else COLD)
        if now >= handover.due:
            raise _Moves(handover)

    handover = Handover(begin + HERE, move)
    return handover


def leave() -> None:
    """To be called before workers are used other than by ``run``: a question that is worked on here moves first."""
    outer = OUTER.get()
    if isinstance(outer, Handover):
        raise _Moves(outer)
