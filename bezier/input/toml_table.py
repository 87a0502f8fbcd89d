"""Tables with exact numbers, from TOML or from Python, and the one line of text that every bad value gets.

A message names file, line and key, what was expected and what was found. Tables inside arrays (``[[obstacle]]``)
are ``Table`` objects too, whose keys are reported as ``obstacle[0].radius``.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from enum import Enum
from fractions import Fraction
from pathlib import Path
from typing import Any, TypeVar

from bezier.input.numbers import NUMBER, Literal, NotANumber, describe, read, read_squared, shorten
from qe.errors import InputError

MAX_BYTES = 1_000_000


def read_bytes(path: Path, most: int) -> bytes:
    """The content of a file of at most so many bytes. Raises ``InputError`` when it cannot be read."""
    try:
        with path.open("rb") as file:
            data = file.read(most + 1)  # some files of devices never end
    except OSError as error:
        raise InputError(f"{path}: expected a readable file, found: {error.strerror or error}") from None
    if len(data) > most:
        raise InputError(f"{path}: expected at most {most} bytes, found more")
    return data


def read_text(path: Path) -> str:
    """The text of a file of at most ``MAX_BYTES``. Raises ``InputError`` when it cannot be read."""
    data = read_bytes(path, MAX_BYTES)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: expected UTF-8 text, found byte {data[error.start]:#04x} at {error.start}") from None


DIMENSION = 3
LARGEST = Fraction(10**50)
SIZES = "a number of at most 10^50, and at least 10^-50 unless it is 0"
"""Every file and picture that is written has such numbers, and their third powers, as floats."""
POINT = f"a point of {DIMENSION} numbers"
Choice = TypeVar("Choice", bound=Enum)


@dataclass(frozen=True, slots=True)
class Table:
    """One table: its values, the file it came from, and where it stands there (``prefix``, e.g. ``obstacle[0].``)."""

    values: Mapping[str, Any]
    source: str = "<problem>"
    lines: tuple[str, ...] = ()
    prefix: str = ""
    names: Mapping[str, str] = field(default_factory=dict)
    """For values that came from Python, what the keys of the whole file are called there."""

    @staticmethod
    def parse(text: str, source: str) -> Table:
        """The table of a whole file. Raises ``InputError`` for text that is not TOML."""
        lines = tuple(text.splitlines())
        try:
            return Table(tomllib.loads(text, parse_float=Literal), source, lines)
        except tomllib.TOMLDecodeError as error:
            raise InputError(_syntax(str(error), source, len(lines))) from None
        except (ValueError, RecursionError) as error:
            raise InputError(f"{source}: expected a TOML file, found: {' '.join(str(error).split())}") from None

    @staticmethod
    def load(file: Path) -> Table:
        """The table of a file. Raises ``InputError``."""
        return Table.parse(read_text(file), str(file))

    def error(self, key: str, expected: str, given: str) -> InputError:
        """The one line about a key of this table."""
        place = self.prefix + key
        where = f"{self.source}{_line_of(place, self.lines)}: {self._named(place)}"
        return InputError(f"{where}: expected {expected}, found {shorten(given, 160)}")

    def _named(self, place: str) -> str:
        head = re.match(r"\w*", place)
        name = head[0] if head else ""
        return self.names.get(name, name) + place[len(name) :]

    def only(self, known: Iterable[str]) -> None:
        """Refuse keys that are not known."""
        names = tuple(known)
        for key in self.values:
            if key not in names:
                here = [name if self.prefix else self._named(name) for name in names]
                unknown = f'the unknown key "{key}"{meant(key, here)}'
                raise self.error(key, f"one of the keys {', '.join(here)}", unknown)

    def required(self, key: str, expected: str) -> Any:
        """A value that must be there."""
        if key not in self.values:
            place = self._named(self.prefix + key)
            raise InputError(f"{self.source}: {place}: expected {expected}, found no such key")
        return self.values[key]

    def choice(self, key: str, choices: type[Choice], default: Choice | None = None) -> Choice:
        """A word out of an enumeration; required without ``default``."""
        words = [str(member.value) for member in choices]
        expected = " or ".join(f'"{word}"' for word in words)
        if key not in self.values and default is not None:
            return default
        raw = self.required(key, expected)
        if not isinstance(raw, str) or raw not in words:
            raise self.error(key, expected, describe(raw))
        return choices(raw)

    def number(self, key: str, default: Fraction | None = None) -> Fraction:
        """An exact number; required without ``default``."""
        if key not in self.values and default is not None:
            return default
        return self._exact(key, self.required(key, NUMBER))

    def positive(self, key: str, default: Fraction | None = None) -> Fraction:
        """An exact number above zero."""
        value = self.number(key, default)
        if value <= 0:
            raise self.error(key, "a number above zero", str(value))
        return value

    def not_negative(self, key: str) -> Fraction:
        """An exact number of at least 0, which is 0 without an entry."""
        value = self.number(key, Fraction(0))
        if value < 0:
            raise self.error(key, "a number that is not negative", str(value))
        return value

    def whole(self, key: str, usual: int, among: range) -> int:
        """A whole number of a range."""
        value = self.number(key, Fraction(usual))
        if value not in among:
            raise self.error(key, f"a whole number from {among[0]} to {among[-1]}", str(value))
        return int(value)

    def point(self, key: str) -> tuple[Fraction, ...]:
        """A required point of three exact numbers."""
        return self.as_point(key, self.required(key, POINT))

    def as_point(self, key: str, raw: object, size: int = DIMENSION) -> tuple[Fraction, ...]:
        """A value as a point of three exact numbers, or of ``size`` ones."""
        if not isinstance(raw, list) or len(raw) != size:
            raise self.error(key, POINT if size == DIMENSION else f"a point of {size} numbers", describe(raw))
        return tuple(self._exact(f"{key}[{i}]", entry) for i, entry in enumerate(raw))

    def words(self, key: str, choices: Iterable[str], what: str) -> tuple[str, ...]:
        """A required list of different words out of ``choices``, at least one."""
        known = tuple(choices)
        expected = f"a list of {what} out of {', '.join(known)}"
        raw = self.required(key, expected)
        if not isinstance(raw, list) or not raw:
            raise self.error(key, expected, describe(raw))
        for i, word in enumerate(raw):
            if word not in known or raw.index(word) != i:
                raise self.error(f"{key}[{i}]", expected, describe(word))
        return tuple(raw)

    def tables(self, key: str) -> tuple[Table, ...]:
        """The tables of an array ``[[key]]``; none when the key is missing."""
        raw = self.values.get(key, [])
        if not isinstance(raw, list) or not all(isinstance(entry, dict) for entry in raw):
            raise self.error(key, "a list of mappings" if self.names else f"tables [[{key}]]", describe(raw))
        return tuple(replace(self, values=entry, prefix=f"{self.prefix}{key}[{i}].") for i, entry in enumerate(raw))

    def inner(self, key: str) -> Table:
        """The table [key] of this file, empty when the key is missing."""
        raw = self.values.get(key, {})
        if not isinstance(raw, dict):
            raise self.error(key, "a mapping" if self.names else f"a table [{key}]", describe(raw))
        return replace(self, values=raw, prefix=f"{self.prefix}{key}.")

    def squared(self, key: str, expected: str) -> Fraction:
        """The exact square of a number above zero, which may be given as a root: ``expected`` says how."""
        try:
            square = read_squared(self.required(key, expected))
        except NotANumber as error:
            raise self.error(key, expected, str(error)) from None
        if not 0 < square <= LARGEST**2:
            wrong = ("a number of at most 10^50", "a larger one") if square else (expected, "zero")
            raise self.error(key, *wrong)
        return square

    def _exact(self, key: str, raw: object) -> Fraction:
        try:
            value = read(raw)
        except NotANumber as error:
            raise self.error(key, NUMBER, str(error)) from None
        if value and not 1 / LARGEST <= abs(value) <= LARGEST:
            raise self.error(key, SIZES, "a larger one" if abs(value) > 1 else "a smaller one")
        return value


def meant(word: str, known: Iterable[str]) -> str:
    """What was probably meant by an unknown word, to put behind it; empty where nothing is near."""
    near = get_close_matches(word.lower(), list(known), n=1)
    return f"; {near[0]} is probably meant" if near else ""


def _syntax(message: str, source: str, length: int) -> str:
    place = re.search(r"\(at (?:line (\d+), column (\d+)|end of document)\)", message)
    body = re.sub(r"\s*\(at .*\)", "", message)
    line = place[1] if place and place[1] else str(length)
    column = f":{place[2]}" if place and place[2] else ""
    return f"{source}:{line}{column}: expected a TOML file, found a syntax error: {body}"


def _line_of(place: str, lines: tuple[str, ...]) -> str:
    """``:7`` for the line of a key such as ``goal[1]`` or ``obstacle[0].radius``, as far as it is found."""
    head, _, rest = place.partition(".")
    name, _, index = head.rstrip("]").partition("[")
    numbers = [i for i, text in enumerate(lines, start=1) if _starts(name, text)]
    if not numbers:
        return ""
    if not rest:
        return f":{numbers[0]}"
    header = numbers[min(int(index or 0), len(numbers) - 1)]
    key = rest.partition("[")[0]
    for i, text in enumerate(lines[header:], start=header + 1):
        if text.lstrip().startswith("["):
            break
        if _starts(key, text):
            return f":{i}"
    return f":{header}"


def _starts(name: str, text: str) -> bool:
    """Whether a line begins with this key or with the header of its table."""
    return re.match(rf"""\s*\[*\s*["']?{re.escape(name)}["']?\s*[=.\]]""", text) is not None
