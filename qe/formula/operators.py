"""Formulas connected by Python's operators, with values substituted, and shown in notebooks."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from qe.services import Service, service

LONGEST = 4000
"""Characters of LaTeX up to which a notebook sets a formula."""


class Connected:
    """``f & g``, ``f | g``, ``f ^ g``, ``~f``, ``f >> g`` (implication), with formulas of any kind that ``qe`` takes.

    The result is a ``Formula``, or a ``Statement`` where the other operand is one. Raises ``InputError`` for what is no
    formula.
    """

    __slots__ = ()

    def __and__(self, other: object) -> Any:
        return service(Service.CONNECTED)("and", self, other)

    def __rand__(self, other: object) -> Any:
        return service(Service.CONNECTED)("and", other, self)

    def __or__(self, other: object) -> Any:
        return service(Service.CONNECTED)("or", self, other)

    def __ror__(self, other: object) -> Any:
        return service(Service.CONNECTED)("or", other, self)

    def __xor__(self, other: object) -> Any:
        return service(Service.CONNECTED)("xor", self, other)

    def __rxor__(self, other: object) -> Any:
        return service(Service.CONNECTED)("xor", other, self)

    def __rshift__(self, other: object) -> Any:
        return service(Service.CONNECTED)("implies", self, other)

    def __rrshift__(self, other: object) -> Any:
        return service(Service.CONNECTED)("implies", other, self)

    def __invert__(self) -> Any:
        return service(Service.CONNECTED)("not", self)

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
