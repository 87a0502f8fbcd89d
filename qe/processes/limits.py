"""The limits that a caller sets."""

from __future__ import annotations

from dataclasses import dataclass, replace

from qe.progress import Listener, silent


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
