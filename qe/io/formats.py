"""All formats by name: ``read(text, "smtlib")``, ``write(formula, "latex")``. A format is one line of ``Format`` and
the module of its name next to this one, which is loaded when first used."""

from __future__ import annotations

import re
from enum import Enum
from importlib import import_module
from typing import TYPE_CHECKING, Any

from qe import arguments
from qe.arguments import shown
from qe.errors import InputError
from qe.io.tokens import REDLOG
from qe.spelling import NUMBERS, quoted

if TYPE_CHECKING:
    from qe.formula.syntax import Formula


class Format(Enum):
    """The formats; ``value`` is the name used on the command line and the name of the module. ``endings``: of files in
    the format. ``readable``: whether the module has a reader; a writer all have."""

    TEXT = "text", (".qe", ".txt")
    SMTLIB = "smtlib", (".smt2", ".smt")
    QEPCAD = "qepcad", (".qepcad",)
    REDLOG = "redlog", (".red",)
    JSON = "json", (".json",)
    LATEX = "latex", (".tex",)
    MATHML = "mathml", (), False

    endings: tuple[str, ...]
    readable: bool

    def __new__(cls, name: str, endings: tuple[str, ...], readable: bool = True) -> Format:
        """A member: its value is the name."""
        member = object.__new__(cls)
        member._value_, member.endings, member.readable = name, endings, readable
        return member


_BEGINNINGS = {
    Format.QEPCAD: re.compile(r"\s*\[[^\]]*\]\s*\([\w\s,']*\)\s*[0-9]+\s*\("),
    Format.REDLOG: re.compile(rf"\s*{REDLOG}\b"),
    Format.SMTLIB: re.compile(r"\s*\((?:set-(?:logic|info|option)|declare-|define-|assert\s*\()"),
}
"""What no text begins with."""
READABLE = tuple(f.value for f in Format if f.readable)
WRITABLE = tuple(f.value for f in Format)
BY_ENDING = {ending: f for f in Format for ending in f.endings}


def read(
    text: str, format: str | Format = Format.TEXT, *, source: str = "<text>", total_division: bool = False
) -> Formula:
    """The formula that ``text`` means; ``total_division`` as ``qe.io.text.read`` has it. Raises ``InputError``."""
    from qe.formula.build import conj

    return conj(reversed(read_posed(text, format, source=source, total_division=total_division)))


def read_posed(
    text: str, format: str | Format = Format.TEXT, *, source: str = "<text>", total_division: bool = False
) -> tuple[Formula, Formula]:
    """As ``read``; over the same ring what the text assumes (in QEPCAD, a theory of Redlog), TRUE without."""
    from qe.formula.syntax import TRUE

    chosen = checked(format)
    if not isinstance(text, str):
        raise arguments.wrong("text", "a text", text)
    if not chosen.readable:
        raise InputError(f"the format {chosen.value} can only be written; readable: {', '.join(READABLE)}")
    if chosen is Format.TEXT and re.search(REDLOG, text):
        from qe.io.scripts import last_command

        text = last_command(text)
    chosen = kind(text, chosen)
    module, total = _module(chosen), arguments.flag(total_division, "total_division")
    more = {"total_division": True} if total and chosen is Format.TEXT else {}
    if hasattr(module, "read_posed"):
        both: tuple[Formula, Formula] = module.read_posed(text, source=source, **more)
        return both
    return module.read(text, source=source, **more), TRUE


def kind(text: str, chosen: Format) -> Format:
    """The format of a text that is said to be in the chosen one."""
    return next((f for f, begins in _BEGINNINGS.items() if chosen is Format.TEXT and begins.match(text)), chosen)


def write(formula: Formula, format: str | Format = Format.TEXT) -> str:
    """The text of ``formula``. Raises ``InputError`` where the format cannot express it (root atoms)."""
    from qe.formula.syntax import Formula

    chosen = checked(format)
    if not isinstance(formula, Formula):
        raise arguments.wrong("formula", "a Formula", formula)
    if chosen in (Format.SMTLIB, Format.QEPCAD, Format.REDLOG) and (found := {*NUMBERS}.intersection(formula.free)):
        raise InputError(f"the format {chosen.value} has no word for {', '.join(map(quoted, found))}")
    text: str = _module(chosen).write(formula)
    return text


def checked(name: str | Format) -> Format:
    """The format of this name. Raises ``InputError``, naming those there are."""
    for known in Format:
        if isinstance(name, str | Format) and name in (known, known.value):
            return known
    raise InputError(f"unknown format {shown(name)}; known: {', '.join(WRITABLE)}")


def _module(chosen: Format) -> Any:
    return import_module(f"qe.io.{chosen.value}")
