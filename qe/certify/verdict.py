"""What the checker says."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Verdict:
    """``accepted``; otherwise ``step`` names the entry that fails, a path into the JSON form, and ``reason`` why."""

    accepted: bool
    step: str = ""
    reason: str = ""

    def __bool__(self) -> bool:
        return self.accepted

    def __str__(self) -> str:
        return "accepted" if self.accepted else f"rejected at {self.step}: {self.reason}"
