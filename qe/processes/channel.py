"""What a question reports on its way, wherever it is worked on: progress, partial results, what is known at an end."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from qe.errors import BudgetExceeded, Unable
from qe.options import Budget, Handover
from qe.progress import Event, Listener

KEPT = "result so far"
"""The fact under which a question tells what is its result should a limit end it."""
ANSWERED = "answer so far"
"""The same of a command: what it says then."""

Message = tuple[str, object]


@dataclass(slots=True)
class Known:
    """What is known so far about a run: seconds used, phases met (last event each), partial results."""

    seconds: float = 0.0
    phases: dict[str, Event] = field(default_factory=dict)
    facts: dict[str, object] = field(default_factory=dict)

    def take(self, message: Message, progress: Listener) -> bool:
        """Note a message of the work; whether it was news on the way, not the outcome."""
        match message:
            case "event", Event() as event:
                self.phases.pop(event.phase, None)  # they keep the order in which they were last active
                self.phases[event.phase] = event
                progress(event)
            case "fact", (str(name), value):
                self.facts[name] = value
            case _:
                return False
        return True

    def kept(self) -> list[Any]:
        """The result so far, if there is one."""
        return [self.facts[KEPT]] if KEPT in self.facts else []

    def __str__(self) -> str:
        """One line for people."""
        parts = [f"{key}: {value}" for key, value in self.facts.items()] + [_in_words(e) for e in self.phases.values()]
        return f"after {self.seconds:.1f} s: " + ("; ".join(parts) if parts else "nothing yet")


def _in_words(event: Event) -> str:
    count = f" {event.done}" if event.done else ""
    total = f" of {event.total}" if event.total is not None else ""
    note = f" ({event.note})" if event.note else ""
    return f"{event.phase}{count}{total}{note}"


class WorkerStopped(BudgetExceeded):
    """A limit ended the work; ``limit`` is "time" or "memory", ``known`` is what it had reported by then."""

    def __init__(self, message: str, *, limit: str, known: Known) -> None:
        self.known = known
        super().__init__(message, limit=limit)


class WorkerDied(Unable):
    """The worker process ended by a signal that no limit explains; ``known`` is what it had reported by then."""

    def __init__(self, message: str, *, signal_number: int, known: Known) -> None:
        self.signal_number, self.known = signal_number, known
        super().__init__(message)


@dataclass(frozen=True, slots=True)
class Channel:
    """What a question gets: a way for messages to who asked; ``deadline`` (of ``time.monotonic``), which its budget
    keeps to; ``handover``, which its budget calls where it may have to move."""

    send: Callable[[Message], None]
    deadline: float = math.inf
    handover: Handover | None = None

    def event(self, event: Event) -> None:
        """A progress listener."""
        self.send(("event", event))

    def fact(self, name: str, value: object) -> None:
        """A partial result worth keeping should the work be ended; ``value`` is picklable."""
        self.send(("fact", (name, value)))

    def keep(self, value: object) -> None:
        """A result that is worth having should the work be ended before it is done."""
        self.fact(KEPT, value)

    def budget(self) -> Budget:
        """The budget of all that is done for the question."""
        left = None if self.deadline == math.inf else max(0.0, self.deadline - time.monotonic())
        return Budget(left, listener=self.event, handover=self.handover, keep=self.keep)
