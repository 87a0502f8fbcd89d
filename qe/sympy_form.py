"""What SymPy takes a value for: it asks everything that it meets for ``_sympy_``.

A value need not know the module that writes it for SymPy, which knows the values. ``qe`` itself, which Python loads
before any of its parts and which knows both, says how that module is reached: ``written_by``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

_WRITERS: list[Callable[[Any], Any]] = []


def written_by(writer: Callable[[Any], Any]) -> None:
    """Set what gives values their form in SymPy; called when a form is asked for, not before."""
    _WRITERS[:] = [writer]


class SymPyForm:
    """A value that SymPy understands: ``sympy.sympify`` and the operators of SymPy take it as it is."""

    __slots__ = ()

    def _sympy_(self) -> Any:
        """The same in SymPy, exactly; ``InputError`` for what SymPy cannot express."""
        return _WRITERS[0](self)
