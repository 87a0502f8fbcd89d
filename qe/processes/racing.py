"""Several ways to the same answer side by side, each in a process of its own: the first answer wins."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping
from queue import SimpleQueue
from threading import Thread
from typing import TypeVar

from qe.errors import QEError, Unable
from qe.options import lost
from qe.processes.channel import Channel, Known, Message
from qe.processes.execution import grace_of, leave
from qe.processes.limits import Limits

T = TypeVar("T")
Name = TypeVar("Name")


def first(
    works: Mapping[Name, Callable[[Channel], T]],
    wins: Callable[[T], bool],
    limits: Limits,
    *,
    kept: Callable[[T], None] = lost,
) -> tuple[Name | None, dict[Name, T | QEError]]:
    """The name of the work whose result wins first (None if none does), and what has come of each until then.

    ``kept`` gets what the works keep meanwhile. The limits are for each of them. Raises nothing that the works raise;
    ``Unable`` for one that cannot be sent to another process.
    """
    leave()
    from qe.processes.portable import packed
    from qe.processes.worker import Worker, begun, settled

    start = time.monotonic() if limits.start is None else limits.start
    deadline = math.inf if limits.timeout is None else start + limits.timeout
    news: SimpleQueue[tuple[Name, Message | None]] = SimpleQueue()
    running: dict[Name, Worker] = {}
    found: dict[Name, T | QEError] = {}

    def follow(name: Name, worker: Worker, until: float) -> None:
        def take(message: Message) -> bool:
            is_news = message[0] in ("event", "fact")
            if is_news:
                news.put((name, message))
            return is_news

        outcome = None
        try:
            outcome = worker.outcome(take, until)
        finally:
            news.put((name, outcome))

    try:
        for name, work in works.items():
            sent = packed(work)
            if sent is None:
                raise Unable(f"{name}: it cannot be sent to another process")
            running[name], until = begun(sent, limits, deadline)
            Thread(target=follow, args=(name, running[name], until + grace_of(limits.timeout)), daemon=True).start()
        while running:
            name, message = news.get()
            known = Known()
            if message is not None and known.take(message, limits.progress):
                for value in known.kept():
                    kept(value)
                continue
            try:
                found[name] = settled(running.pop(name), message, limits, known)  # type: ignore[assignment]
            except QEError as error:
                found[name] = error
            else:
                if wins(found[name]):  # type: ignore[arg-type]
                    return name, found
        return None, found
    finally:
        for worker in running.values():
            worker.kill()  # the thread that reads from it ends it
