"""Progress events: what the engine is doing, reported to a callable that the user passes in."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Event:
    """One step of work: ``phase`` (e.g. ``"lift"``), ``done`` units so far, ``total`` if known."""

    phase: str
    done: int = 0
    total: int | None = None
    note: str = ""


Listener = Callable[[Event], None]


def silent(event: Event) -> None:
    """The listener that ignores everything."""
