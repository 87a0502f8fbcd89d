"""Where a command's formula comes from: the argument itself, a file, or standard input."""

from __future__ import annotations

import re
import sys
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

from qe.errors import InputError
from qe.io.formats import BY_ENDING, Format

_FILE_LIKE = re.compile(rf"[^\s<>=]+({'|'.join(map(re.escape, BY_ENDING))})")


class ProofFormat(Enum):
    """Proof assistants for which certificates are written."""

    COQ = "coq"


@dataclass(frozen=True, slots=True)
class Source:
    """A text to read, its format, and the name to give in messages."""

    text: str
    format: Format
    name: str
    total_division: bool = False


def read_source(argument: str, wanted: Format | None) -> Source:
    """The text behind a command-line argument: ``-`` is standard input, an existing file is read, else the text.

    Without a wanted format a file's ending decides; otherwise the format is ``text``. Raises ``InputError``
    for a file that cannot be read or is not UTF-8 text.
    """
    if argument == "-":
        try:
            return Source(sys.stdin.read().removeprefix("\ufeff"), wanted or Format.TEXT, "<stdin>")
        except UnicodeDecodeError:
            raise InputError("<stdin>: UTF-8 text expected, other bytes found") from None
    if argument.startswith("--"):
        raise InputError(f"no such option: {argument.split('=')[0]}")
    path = Path(argument)
    if is_file(path):
        return Source(read_text(path), wanted or BY_ENDING.get(path.suffix.lower(), Format.TEXT), argument)
    if _FILE_LIKE.fullmatch(argument.strip()):
        raise InputError(f"{argument}: no such file")
    return Source(argument, wanted or Format.TEXT, "<argument>")


def no_file(name: str) -> InputError:
    """The error for a name at which there is no file to read."""
    return InputError(f"{name}: {'a file expected, a folder found' if is_folder(name) else 'no such file'}")


def is_folder(name: str) -> bool:
    """Whether there is a folder of this name."""
    try:
        return Path(name).is_dir()
    except (OSError, ValueError):
        return False


def is_file(path: Path) -> bool:
    """Whether the path names something to read; text that is no possible path is not one."""
    try:
        return path.exists() and not path.is_dir()
    except (OSError, ValueError):
        return False


def read_text(path: Path) -> str:
    """The content of a UTF-8 file, or ``InputError``."""
    try:
        return path.read_text(encoding="utf-8-sig")  # editors may put a mark in front of the text
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise InputError(f"{path}: UTF-8 text expected, other bytes found") from None
