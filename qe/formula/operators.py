"""Formulas connected by Python's operators, and shown in notebooks."""

from __future__ import annotations

from typing import Any

from qe.later import later

LONGEST = 4000
"""Characters of LaTeX up to which a notebook sets a formula."""


class Connected:
    """``f & g``, ``f | g``, ``~f``, ``f >> g`` (implication), with formulas of any kind that ``qe`` takes.

    The result is a ``Formula``, or a ``Statement`` where the other operand is one. Raises ``InputError`` for what is no
    formula.
    """

    __slots__ = ()

    def __and__(self, other: object) -> Any:
        return later("connected")("and", self, other)

    def __rand__(self, other: object) -> Any:
        return later("connected")("and", other, self)

    def __or__(self, other: object) -> Any:
        return later("connected")("or", self, other)

    def __ror__(self, other: object) -> Any:
        return later("connected")("or", other, self)

    def __rshift__(self, other: object) -> Any:
        return later("connected")("implies", self, other)

    def __rrshift__(self, other: object) -> Any:
        return later("connected")("implies", other, self)

    def __invert__(self) -> Any:
        return later("connected")("not", self)

    def _repr_latex_(self) -> str | None:
        """The formula as notebooks set it; None where it is too long for that."""
        text = later("formats").write(self, "latex").strip()
        return f"$\\displaystyle {text}$" if len(text) <= LONGEST else None
