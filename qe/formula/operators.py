"""Formulas connected by Python's operators, with values substituted, and shown in notebooks."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from qe.services import Service, service

Operation = Callable[["Connected", object], Any]

LONGEST = 4000
"""Characters of LaTeX up to which a notebook sets a formula."""


def _operator(way: str) -> tuple[Operation, Operation]:
    """An operator, and the same where the formula stands on its right."""

    def operation(self: Connected, other: object) -> Any:
        return self._connect(way, self, other)

    def reflected(self: Connected, other: object) -> Any:
        return self._connect(way, other, self)

    return operation, reflected


class Connected:
    """``f & g``, ``f | g``, ``f ^ g``, ``~f``, ``f >> g`` (implication), with formulas of any kind that ``qe`` takes.

    The result is a ``Formula``, or a ``Statement`` where the other operand is one. Raises ``InputError`` for what is no
    formula.
    """

    __slots__ = ()

    __and__, __rand__ = _operator("and")
    __or__, __ror__ = _operator("or")
    __xor__, __rxor__ = _operator("xor")
    __rshift__, __rrshift__ = _operator("implies")

    def __invert__(self) -> Any:
        return self._connect("not", self)

    def _connect(self, way: str, *parts: object) -> Any:
        return service(Service.CONNECTED)(way, *parts)


class Substituting:
    """What formulas alone do."""

    __slots__ = ()

    def substitute(self, values: Mapping[Any, object]) -> Any:
        """The formula with numbers or terms in the place of free variables, all at once; others are left alone.

        Where all have rational values, a quantifier-free formula becomes true or false. Terms that are no polynomials,
        roots among them, are named by a quantified variable.
        Raises ``InputError`` for what is no mapping, no variable or no value.
        """
        return service(Service.SUBSTITUTED)(self, values)

    def _repr_latex_(self) -> str | None:
        """The formula as notebooks set it; None where it is too long for that."""
        text = service(Service.WRITTEN)(self, "latex").strip()
        return f"$\\displaystyle {text}$" if len(text) <= LONGEST else None
