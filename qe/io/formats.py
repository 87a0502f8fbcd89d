"""The formats a formula can be read from and written to, by name."""

from __future__ import annotations

from importlib import import_module

from qe.errors import InputError
from qe.formula.syntax import Formula

READABLE = ("text", "smtlib", "qepcad", "redlog", "json")
WRITABLE = ("text", "smtlib", "qepcad", "redlog", "latex", "json")


def read(text: str, format: str = "text", *, source: str = "<text>") -> Formula:
    """The formula that ``text`` states in this format; ``InputError`` with line and column otherwise."""
    if format not in READABLE:
        raise InputError(f"format: one of {', '.join(READABLE)} expected, {format!r} found")
    formula: Formula = import_module(f"qe.io.{format}").read(text, source=source)
    return formula


def write(formula: Formula, format: str = "text") -> str:
    """The formula in this format."""
    if format not in WRITABLE:
        raise InputError(f"format: one of {', '.join(WRITABLE)} expected, {format!r} found")
    text: str = import_module(f"qe.io.{format}").write(formula)
    return text
