"""Where a command's formula comes from: the argument itself, a file, or standard input."""

from __future__ import annotations

import io
import re
import sys
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

from qe.errors import InputError
from qe.io.formats import BY_ENDING, Format

MOST_BYTES = 64 << 20
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
            given = sys.stdin.read(MOST_BYTES + 1)
        except UnicodeDecodeError:
            raise InputError("<stdin>: UTF-8 text expected, other bytes found") from None
        if len(given) > MOST_BYTES:
            raise InputError(f"<stdin>: at most {MOST_BYTES:,} characters expected, more found")
        return Source(given.removeprefix("\ufeff"), wanted or Format.TEXT, "<stdin>")
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
    """The content of a UTF-8 file, or ``InputError``; some files of devices never end."""
    try:
        with path.open("rb") as file:
            data = file.read(MOST_BYTES + 1)
        if len(data) > MOST_BYTES:
            raise InputError(f"{path}: at most {MOST_BYTES:,} bytes expected, more found")
        # editors may put a mark in front of the text
        return io.TextIOWrapper(io.BytesIO(data), encoding="utf-8-sig").read()
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise InputError(f"{path}: UTF-8 text expected, other bytes found") from None
