"""What an adapter gives back."""

from __future__ import annotations

from dataclasses import dataclass

from qe.errors import Unable


@dataclass(frozen=True, slots=True)
class Answer:
    """``text`` in the text syntax; ``seconds`` of solving, without start, imports and reading."""

    text: str
    seconds: float


@dataclass(frozen=True, slots=True)
class Limits:
    """``seconds`` and ``memory`` (MiB) that the runner enforces from outside."""

    seconds: float
    memory: int


class NotSupported(Unable):
    """The solver does not take this kind of problem, or is not installed."""


class OtherForm(Unable):
    """The solver answered in a form that is not translated back."""
