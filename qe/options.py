"""Frozen options, and the budget (time, cells) with cancellation that is passed into every step."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from enum import Enum

from qe.errors import BudgetExceeded
from qe.progress import Event, Listener, silent


class Method(Enum):
    """Elimination methods that a caller can ask for; ``AUTO`` lets the planner choose."""

    AUTO = "auto"
    VS = "vs"
    CAD = "cad"
    CRITICAL = "critical"


class Projection(Enum):
    """Projection operators of the cylindrical algebraic decomposition."""

    BROWN_MCCALLUM = "brown-mccallum"
    LAZARD = "lazard"


class Stage(Enum):
    """Stages of the engine that can be left out, to measure what each gains; the answers stay equivalent.

    ``EQUATIONS``: linear equations and Gröbner bases before anything else. ``SUBSTITUTION``: virtual substitution.
    ``CONSTRAINTS``: projection and lifting restricted by equational constraints. ``PARTIAL``: stacks are left as
    soon as their truth is known. ``OPEN``: sectors only where all atoms are strict. ``MCCALLUM``: Brown–McCallum
    projection before Lazard's. ``ORDER``: the variable order is chosen, not taken as written.
    """

    EQUATIONS = "equations"
    SUBSTITUTION = "substitution"
    CONSTRAINTS = "constraints"
    PARTIAL = "partial"
    OPEN = "open"
    MCCALLUM = "mccallum"
    ORDER = "order"


@dataclass(slots=True)
class Handover:
    """What ``Budget.check`` does once ``time.monotonic()`` has passed ``due``: ``move()``, and never again.

    ``qe.execution`` moves long work to another process by it.
    """

    due: float
    move: Callable[[], None]

    def __call__(self) -> None:
        self.due = math.inf
        self.move()


class Budget:
    """Soft limits, checked between FLINT calls: ``check`` raises ``BudgetExceeded``.

    ``seconds`` counts from construction; ``cells`` bounds the number of CAD cells built.
    A budget can be narrowed for a part of the work by ``share``; the tighter deadline wins.
    """

    __slots__ = ("_cancelled", "_last_note", "cells", "deadline", "handover", "listener", "used_cells")

    def __init__(
        self,
        seconds: float | None = None,
        cells: int | None = None,
        listener: Listener = silent,
        handover: Handover | None = None,
    ) -> None:
        self.deadline = None if seconds is None else time.monotonic() + seconds
        self.cells, self.used_cells, self.listener = cells, 0, listener
        self.handover = handover
        self._cancelled, self._last_note = False, 0.0

    def cancel(self) -> None:
        """Make the next ``check`` raise; safe to call from another thread."""
        self._cancelled = True

    def remaining(self) -> float | None:
        """Seconds left, or None without a time limit."""
        return None if self.deadline is None else self.deadline - time.monotonic()

    def share(self, fraction: float) -> Budget:
        """A budget for a part of the work: at most ``fraction`` of the time that remains."""
        left = self.remaining()
        part = Budget(None if left is None else max(0.0, left * fraction), self.cells, self.listener, self.handover)
        part.used_cells = self.used_cells
        return part

    def brief(self, seconds: float, fraction: float, cells: int | None = None) -> Budget:
        """A budget for something that is not needed: a short time, and little of what remains."""
        left = self.remaining()
        return self.apart(seconds if left is None else min(seconds, fraction * left), cells)

    def apart(self, seconds: float | None = None, cells: int | None = None) -> Budget:
        """A budget for a part of the work with its own time (at most what remains) and its own count of cells."""
        left = self.remaining()
        limits = [max(0.0, s) for s in (left, seconds) if s is not None]
        return Budget(min(limits) if limits else None, cells, self.listener, self.handover)

    def check(self, phase: str = "work", done: int = 0, total: int | None = None) -> None:
        """Report progress (at most ten times a second) and raise ``BudgetExceeded`` past a limit."""
        if self._cancelled:
            raise BudgetExceeded("cancelled", limit="cancel")
        now = time.monotonic()
        if self.handover is not None and now > self.handover.due:
            self.handover()
        if self.deadline is not None and now > self.deadline:
            raise BudgetExceeded(f"time limit reached while doing: {phase}", limit="time")
        if self.cells is not None and self.used_cells > self.cells:
            raise BudgetExceeded(f"limit of {self.cells} cells reached", limit="cells")
        if now - self._last_note > 0.1:
            self._last_note = now
            self.listener(Event(phase, done, total))


@dataclass(frozen=True, slots=True, kw_only=True)
class Options:
    """What a caller can set; every public function takes these as keywords."""

    method: Method = Method.AUTO
    projection: Projection = Projection.BROWN_MCCALLUM
    order: tuple[str, ...] | None = None
    timeout: float | None = None
    memory: int | None = None
    root_atoms: bool = False
    without: frozenset[Stage] = frozenset()
    certify: bool = False
    progress: Listener = field(default=silent)

    def with_(self, **changes: object) -> Options:
        """A copy with some fields replaced."""
        return replace(self, **changes)  # type: ignore[arg-type]
