"""Exact numbers as people write them: ``3``, ``-4.5e-1``, ``"3/4"``, and for radii ``"sqrt(27)"``.

Nothing passes through floating point: 0.1 is one tenth. Sizes are capped before anything is expanded.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from fractions import Fraction

MAX_CHARACTERS = 400
MAX_EXPONENT = 400
NUMBER = 'an integer, a decimal or a fraction such as "3/4"'

_FRACTION = re.compile(r"([+-]?[0-9]+)\s*/\s*([+-]?[0-9]+)")
_DECIMAL = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE]([+-]?[0-9]+))?")
_ROOT = re.compile(r"(?:([^*()\s]+)\s*\*\s*)?sqrt\(\s*([^()]+?)\s*\)(?:\s*/\s*([^/()\s]+))?")


class NotANumber(ValueError):
    """The text is not an exact number; the message says why, without a place."""


@dataclass(frozen=True, slots=True)
class Literal:
    """A TOML float kept as its source text, so that it can be read exactly."""

    text: str


def parse(text: str, limit: int = MAX_CHARACTERS) -> Fraction:
    """The exact value of an integer, decimal or fraction of at most ``limit`` characters. Raises ``NotANumber``."""
    body = text.strip()
    if len(body) > limit:
        raise NotANumber(f"a number of {len(body)} characters (at most {limit})")
    if match := _FRACTION.fullmatch(body):
        top, bottom = int(match[1]), int(match[2])
        if bottom == 0:
            raise NotANumber(f'"{body}", which divides by zero')
        return Fraction(top, bottom)
    if match := _DECIMAL.fullmatch(body):
        exponent = match[1] or "0"
        if len(exponent) > 5 or abs(int(exponent)) > MAX_EXPONENT:
            raise NotANumber(f"{body}, whose exponent is beyond {MAX_EXPONENT}")
        return Fraction(body)
    raise NotANumber(f'"{shorten(body)}"')


def read(raw: object) -> Fraction:
    """The exact value of a TOML value (integer, float literal or string). Raises ``NotANumber``."""
    if isinstance(raw, bool):
        raise NotANumber(str(raw).lower())
    if isinstance(raw, int):
        if abs(raw).bit_length() > 4 * MAX_CHARACTERS:
            raise NotANumber(f"an integer of more than {MAX_CHARACTERS} digits")
        return Fraction(raw)
    if isinstance(raw, Literal):
        plain = raw.text.replace("_", "")
        if plain.lstrip("+-") in ("nan", "inf"):
            raise NotANumber(plain)
        return parse(plain)
    if isinstance(raw, str):
        return parse(raw)
    raise NotANumber(describe(raw))


def read_squared(raw: object) -> Fraction:
    """The exact square of a nonnegative number, which may be given as ``"sqrt(27)"`` or, as radii are printed,
    ``"3*sqrt(2)/2"``. Raises ``NotANumber``."""
    if isinstance(raw, str) and (match := _ROOT.fullmatch(raw.strip())):
        factor, radicand, below = parse(match[1] or "1"), parse(match[2]), parse(match[3] or "1")
        if radicand < 0:
            raise NotANumber(f'"{raw}", the root of a negative number')
        if factor < 0 or below <= 0:
            raise NotANumber(f'"{raw}", a number that is negative or divided by one that is not positive')
        return radicand * (factor / below) ** 2
    value = read(raw)
    if value < 0:
        raise NotANumber(f"the negative number {value}")
    return value * value


def describe(raw: object) -> str:
    """What was found, in TOML's own terms."""
    match raw:
        case None:
            return "nothing"
        case bool():
            return str(raw).lower()
        case str():
            return f'"{shorten(raw)}"'
        case Literal(text):
            return text
        case list():
            return f"an array of {len(raw)} value{'' if len(raw) == 1 else 's'}"
        case dict():
            return "a table"
        case int():
            return shorten(str(raw)) if abs(raw).bit_length() < 4000 else "a huge integer"
    name = type(raw).__name__
    return f"{'an' if name[0].lower() in 'aeiou' else 'a'} {name}"


def shorten(text: str, limit: int = 40) -> str:
    """One line of at most ``limit`` characters."""
    line = " ".join(text.split())
    return line if len(line) <= limit else f"{line[: limit - 1]}…"
