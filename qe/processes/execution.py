"""Where the work of a public function runs: here while it is short, in a forked process once it takes long.

A FLINT call cannot be interrupted, so work that must obey Ctrl-C and limits runs in a process that can be killed. A
process of its own for every call would cost a short one more than its own time. So the work starts here; at the first
``Budget.check`` after ``HERE`` seconds the process forks, the child goes on from there with its stack as it is, and the
parent waits for what the child sends, unwinds its own stack and gives that back. No work is done twice. Where
one operation could already be long before that, or a limit is given, the work is forked from the start.

What the work gives to ``Budget.keep`` is its result if a limit ends it later: an answer is not lost while it is proved.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from types import TracebackType
from typing import TYPE_CHECKING, Any, Generic, NoReturn, TypeVar, cast

from qe.errors import Unable
from qe.options import Budget, Handover, lost
from qe.processes.surroundings import surrounding_deadline
from qe.progress import Event, Listener, silent

if TYPE_CHECKING:  # row 0 knows itself; the worker, which only some systems can have, is loaded when one is needed
    from qe.processes.worker import Channel

T = TypeVar("T")
Budgets = Callable[[], Budget]
Work = Callable[[Budgets], T]

HERE = 0.05
"""Seconds that work takes in the process of the caller before it moves."""

SWITCH = "QE_PROCESS"
"""The environment variable that, set to ``off``, keeps all work in the process of the caller."""


@dataclass(frozen=True, slots=True)
class Limits:
    """``timeout``: seconds for one call; ``memory``: MiB; ``progress``: is told every event, in the caller's process.

    ``process``: whether other processes may be used; without them ``timeout`` is only checked between steps, and
    ``memory`` not at all. ``start``: when the time began to run (None: it begins with the work).
    """

    timeout: float | None = None
    memory: int | None = None
    progress: Listener = silent
    process: bool = True
    start: float | None = None

    def begun(self, start: float) -> Limits:
        """The same limits for a call that began at ``start`` (of ``time.monotonic``)."""
        return replace(self, start=start)

    def shared(self, share: float) -> Limits:
        """The same limits with a part of the time."""
        return self if self.timeout is None else replace(self, timeout=self.timeout * share)

    def __reduce__(self) -> tuple[object, tuple[object, ...]]:
        """A listener stays behind: it belongs to this process."""
        return Limits, (self.timeout, self.memory, silent, self.process)


def perform(work: Work[T], limits: Limits, *, at_once: bool = False) -> T:
    """``work(budgets)`` under the limits; ``budgets()`` makes the budget of all that is done in the time of the call.

    ``at_once``: a single operation may take long from the start. The result of work that moved has been
    pickled. Raises what the work raises, ``BudgetExceeded`` at a limit, and, where it moved, ``InternalError`` for
    errors that are none of this package, ``WorkerDied`` when a signal ended the process; in place of an ``Unable``
    the last thing that the work has kept is its result.
    """
    kept: list[T] = []
    try:
        return _performed(work, limits, at_once, kept)
    except Unable:
        if not kept:
            raise
        return kept[-1]


def _performed(work: Work[T], limits: Limits, at_once: bool, kept: list[T]) -> T:
    """The work wherever it runs; what it keeps is appended to ``kept``, in this process."""
    start = time.monotonic() if limits.start is None else limits.start
    if not limits.process or not _may_fork(limits, start):
        return work(lambda: _budget(limits, start, limits.progress, kept.append))
    if not at_once and limits.memory is None:
        return _Journey(limits, start, kept).made(work)
    from qe.processes.worker import Known, run

    known = Known()
    try:
        return run(
            lambda channel: work(lambda: _budget(limits, start, channel.event, channel.keep)),
            timeout=limits.timeout,
            memory=limits.memory,
            progress=limits.progress,
            known=known,
            start=start,
        )
    finally:
        kept += known.kept()


def _budget(
    limits: Limits,
    start: float,
    listener: Listener,
    keep: Callable[[Any], None] = lost,
    handover: Handover | None = None,
) -> Budget:
    left = None if limits.timeout is None else max(0.0, start + limits.timeout - time.monotonic())
    return Budget(left, listener=listener, handover=handover, keep=keep)


def _may_fork(limits: Limits, start: float) -> bool:
    """Whether there are processes, they are wanted, and one would serve: inside a worker only an earlier limit does."""
    if not hasattr(os, "fork") or os.environ.get(SWITCH, "").lower() in ("off", "0"):
        return False
    deadline = surrounding_deadline()
    if deadline is None or limits.memory is not None:
        return True
    return limits.timeout is not None and start + limits.timeout < deadline


class _Arrived(BaseException):
    """Unwinds the stack of the parent; the code on the way has nothing to do with what became of the child."""

    def __init__(self, journey: object, value: object, error: BaseException | None) -> None:
        self.journey, self.value, self.error = journey, value, error
        super().__init__()


class _Wait:
    """In the parent: whatever comes of it, also Ctrl-C or an error of the listener, nothing goes on with the work."""

    def __init__(self, journey: object) -> None:
        self.journey, self.value = journey, cast(object, None)

    def __enter__(self) -> _Wait:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> NoReturn:
        raise _Arrived(self.journey, self.value, error) from error


class _Journey(Generic[T]):
    """Work that may move to another process while it is done; in that process it has a channel."""

    def __init__(self, limits: Limits, start: float, kept: list[T]) -> None:
        self.limits, self.start, self.kept, self.process = limits, start, kept, os.getpid()
        self.handover = Handover(start + HERE, self.move)
        self.channel: Channel | None = None
        self.arrived: _Arrived | None = None

    def made(self, work: Work[T]) -> T:
        """The work, with the handover in every budget."""
        with self:
            value = work(lambda: _budget(self.limits, self.start, self.tell, self.keep, self.handover))
            if self.channel is not None:
                self.channel.deliver(lambda: value)
            return value
        assert self.arrived is not None
        if self.arrived.error is not None:
            raise self.arrived.error
        return cast(T, self.arrived.value)

    def __enter__(self) -> None:
        return None

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> bool:
        if error is not None and self.channel is not None:
            self.channel.fail(error)
        if isinstance(error, _Arrived) and error.journey is self:
            self.arrived = error
            return True
        return False

    def tell(self, event: Event) -> None:
        """The listener of the budgets: the caller's, wherever it is."""
        (self.limits.progress if self.channel is None else self.channel.event)(event)

    def keep(self, value: T) -> None:
        """Puts a result by where it outlives the work."""
        (self.kept.append if self.channel is None else self.channel.keep)(value)

    def move(self) -> None:
        """Fork: the child returns from here, the parent waits and unwinds."""
        if os.getpid() != self.process or not _may_fork(self.limits, self.start):
            return  # some other move has taken this work along
        from qe.processes.worker import Channel, Known, forked

        side = forked(self.start, self.limits.timeout, None)
        if isinstance(side, Channel):
            self.channel = side
            return
        with _Wait(self) as home:
            known = Known()
            try:
                home.value = side.outcome(self.limits.progress, known)
            finally:
                self.kept += known.kept()
