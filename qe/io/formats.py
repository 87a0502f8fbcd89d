"""All formats by name: ``read(text, "smtlib")``, ``write(formula, "latex")``. Modules are loaded when first used."""

from __future__ import annotations

from enum import Enum
from importlib import import_module
from typing import Any

from qe import arguments
from qe.arguments import shown
from qe.errors import InputError
from qe.formula.syntax import Formula


class Format(Enum):
    """The formats; ``value`` is the name used on the command line and the name of the module."""

    TEXT = "text"
    SMTLIB = "smtlib"
    QEPCAD = "qepcad"
    REDLOG = "redlog"
    JSON = "json"
    LATEX = "latex"
    MATHML = "mathml"

    @property
    def readable(self) -> bool:
        """Whether there is a reader; a writer there is for all."""
        return self is not Format.MATHML


READABLE = tuple(f.value for f in Format if f.readable)
WRITABLE = tuple(f.value for f in Format)


def read(
    text: str, format: str | Format = Format.TEXT, *, source: str = "<text>", total_division: bool = False
) -> Formula:
    """The formula that ``text`` means; ``total_division`` as ``qe.io.text.read`` has it.

    Raises ``InputError`` (with line and column where the text is wrong).
    """
    chosen = checked(format)
    if not isinstance(text, str):
        raise InputError(f"text expected, {type(text).__name__} found")
    if not chosen.readable:
        raise InputError(f"the format {chosen.value} can only be written; readable: {', '.join(READABLE)}")
    if arguments.flag(total_division, "total_division") and chosen is Format.TEXT:
        whole: Formula = _module(chosen).read(text, source=source, total_division=True)
        return whole
    formula: Formula = _module(chosen).read(text, source=source)
    return formula


def write(formula: Formula, format: str | Format = Format.TEXT) -> str:
    """The text of ``formula``. Raises ``InputError`` where the format cannot express it (root atoms)."""
    chosen = checked(format)
    if not isinstance(formula, Formula):
        raise InputError(f"a formula expected, {type(formula).__name__} found")
    text: str = _module(chosen).write(formula)
    return text


def checked(name: str | Format) -> Format:
    """The format of this name. Raises ``InputError``, naming those there are."""
    try:
        return Format(name)
    except ValueError:
        raise InputError(f"unknown format {shown(name)}; known: {', '.join(WRITABLE)}") from None


def _module(chosen: Format) -> Any:
    return import_module(f"qe.io.{chosen.value}")
