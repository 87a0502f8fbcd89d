"""What the checker says."""

from __future__ import annotations

from dataclasses import dataclass

from qe.errors import QEError

CRASHES = (QEError, ArithmeticError, AssertionError, AttributeError, LookupError, TypeError, ValueError)
"""In what a checker may end that does not understand what it reads."""


@dataclass(frozen=True, slots=True)
class Verdict:
    """``accepted``; otherwise ``step`` names the entry that fails, a path into the JSON form, and ``reason`` why.

    Without ``decided`` the checker has found nothing wrong, but not come to an end within its limits either: the
    certificate proves nothing then, and ``reason`` says which limit it was.
    """

    accepted: bool
    step: str = ""
    reason: str = ""
    decided: bool = True

    def __bool__(self) -> bool:
        return self.accepted

    def __str__(self) -> str:
        if not self.decided:
            return f"not decided: {self.reason}"
        return "accepted" if self.accepted else f"rejected at {self.step}: {self.reason}"
