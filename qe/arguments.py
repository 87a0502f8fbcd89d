"""The one place where arguments of public functions are checked: each function returns the value or says what is wrong.

Every complaint is an ``InputError`` of one line, ``argument: what was expected, what was found``. Names may be given as
SymPy symbols; a float, where a number is asked for, is the decimal number that it prints.
"""

from __future__ import annotations

import math
import os
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from decimal import Decimal
from enum import Enum
from fractions import Fraction
from numbers import Integral, Rational, Real
from pathlib import Path
from typing import Any, TypeVar

from qe.errors import InputError
from qe.spelling import QUOTED, unquoted

Choice = TypeVar("Choice", bound=Enum)
T = TypeVar("T")

LONGEST_TIME = 1e9
"""Seconds; a longer limit is a mistake, and no clock of the system takes it."""

MOST_MEMORY = 1 << 40
MOST_BYTES = 64 << 20
LONGEST_PART = 255
"""Bytes of the name of a file or a folder, on all usual systems."""
LONGEST_NUMBER = 4000
"""Characters of a number, and the largest exponent of ten in one."""

_TIMES = ("timedelta64", "datetime64")
_NAMES = re.compile(rf"\s*(?:({QUOTED})|([^\s,`]+))(?:\s*,\s*(?=\S)|\s+|$)")
_DECIMAL = re.compile(r"\s*[-+]?[0-9]*\.?[0-9]*(?:[eE]([-+]?[0-9]{1,5}))?\s*")
_FRACTION = re.compile(r"\s*[-+]?[0-9]+\s*/\s*[0-9]+\s*")


def wrong(what: str, expected: str, found: object) -> InputError:
    """The error for an argument."""
    return InputError(f"{what}: {expected} expected, {shown(found)} found")


def shown(value: object) -> str:
    """A value in a message: short values as they are, all others by their type."""
    if isinstance(value, int) and not isinstance(value, bool) and value.bit_length() > 200:
        return "a large integer"
    if value is None or isinstance(value, bool | int | float | Fraction | str):
        text = str(value) if isinstance(value, Fraction) else repr(value)
        return text if len(text) <= 60 else f"{text[:57]}…"
    return type(value).__name__


def content(given: bytes | bytearray | Path, what: str) -> tuple[str, str]:
    """The text of bytes or of a file, and the ending of its name. Raises ``InputError`` where it cannot be read."""
    data, ending = given if isinstance(given, bytes | bytearray) else b"", ""
    try:
        if isinstance(given, Path):
            what, ending = str(given), given.suffix.lower()
            with given.open("rb") as file:
                data = file.read(MOST_BYTES + 1)  # some files of devices never end
        if len(data) > MOST_BYTES:
            raise InputError(f"{what}: at most {MOST_BYTES:,} bytes expected, more found")
        return data.decode("utf-8-sig"), ending
    except OSError as error:
        raise InputError(f"{what}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise InputError(f"{what}: UTF-8 text expected, other bytes found") from None


def instance(value: object, kind: type[T], what: str, expected: str) -> T:
    """A value of this type."""
    if not isinstance(value, kind):
        raise wrong(what, expected, value)
    return value


def text(value: object, what: str) -> str:
    """A string."""
    return instance(value, str, what, "text")


def flag(value: object, what: str) -> bool:
    """``True`` or ``False`` themselves: what merely counts as one of them is often a slip."""
    return instance(value, bool, what, "True or False")


def listener(value: object, what: str = "progress") -> Callable[..., Any]:
    """Something that can be called."""
    if not callable(value):
        raise wrong(what, "a function of one event", value)
    return value


def _is_number(given: object, kind: type) -> bool:
    """Whether it is a number of this kind (``numbers.Real``, ``numbers.Integral``), no truth value and no time of
    numpy's, which its type calls an integer although it counts units of its own."""
    return isinstance(given, kind) and not isinstance(given, bool) and type(given).__name__ not in _TIMES


def _number(given: Any, kind: type, fits: Callable[[Any], bool], what: str, expected: str) -> Any:
    """A number of this kind that fits; what is not a number does not fit any bounds."""
    if not _is_number(given, kind) or not fits(given):
        raise wrong(what, expected, given)
    return given


def seconds(given: object, what: str = "timeout") -> float | None:
    """A limit on time: a positive number of seconds, or None for no limit."""
    if given is None:
        return None
    return float(_number(given, Real, lambda value: 0 < value < LONGEST_TIME, what, "a positive number of seconds"))


def mebibytes(given: object, what: str = "memory") -> int | None:
    """A limit on memory: a positive number of MiB, or None for no limit."""
    if given is None:
        return None
    return int(_number(given, Integral, lambda value: 0 < value < MOST_MEMORY, what, "a positive whole number of MiB"))


def whole(given: object, what: str, most: float = math.inf) -> int:
    """A natural number, up to ``most``."""
    expected = "a natural number" if most == math.inf else f"a natural number up to {most}"
    return int(_number(given, Integral, lambda value: 0 <= value <= most, what, expected))


def integers(value: object, what: str) -> list[int]:
    """Integers in order."""
    if not isinstance(value, Iterable) or isinstance(value, str | bytes | bytearray | Mapping | set | frozenset):
        raise wrong(what, "integers in order", value)
    return [int(_number(item, Integral, lambda _: True, what, "integers")) for item in value]


def ratio(given: object, what: str) -> Fraction:
    """A number between 0 and 1."""
    value = _number(given, Real, lambda value: 0 < value < 1, what, "a number between 0 and 1")
    return Fraction(value) if isinstance(value, Rational | float) else Fraction(float(value))


def path(value: object, what: str = "path") -> Path:
    """The name of a file."""
    found = Path(instance(value, str | Path, what, "the name of a file"))  # type: ignore[arg-type]
    parts = [part.encode(errors="surrogatepass") for part in found.parts]
    if value == "" or "\0" in str(found) or any(len(part) > LONGEST_PART for part in parts) or not _is_name(found):
        raise wrong(what, "the name of a file", value)
    return found


def _is_name(path: Path) -> bool:
    """Whether the system can write the name: a lone surrogate is no character of its encoding."""
    try:
        return bool(os.fsencode(path))
    except UnicodeEncodeError:
        return False


# --- choices and names --------------------------------------------------------------------------------------
def member(value: object, choices: type[Choice], what: str) -> Choice:
    """The member of an enumeration that is given, by itself or by its value."""
    try:
        return choices(value)
    except ValueError:
        raise wrong(what, f"one of {', '.join(str(m.value) for m in choices)}", value) from None


def members(value: object, choices: type[Choice], what: str) -> frozenset[Choice]:
    """Some members, in a list or set; one alone may be given as it is."""
    if isinstance(value, str | choices):
        value = (value,)
    if not isinstance(value, Iterable):
        raise wrong(what, f"some of {', '.join(str(m.value) for m in choices)}", value)
    return frozenset(member(item, choices, what) for item in value)


def name(value: object, what: str) -> str:
    """The name of a variable: a string that is not empty, or a SymPy symbol."""
    if getattr(value, "is_Symbol", False) is True:
        value = getattr(value, "name", None)
    if not isinstance(value, str) or not value:
        raise wrong(what, "the name of a variable", value)
    return value


def names(value: object, what: str = "order") -> tuple[str, ...] | None:
    """Names in order: ``"y,x"``, ``"y x"``, a list of names or SymPy symbols, each once; or None."""
    if value is None:
        return None
    if isinstance(value, str):
        found = _split(value, what)
    elif getattr(value, "is_Symbol", False) is True:
        return (name(value, what),)
    elif not isinstance(value, Iterable) or isinstance(value, bytes | bytearray | Mapping | set | frozenset):
        raise wrong(what, "names of variables in order, as in 'y, x' or ('y', 'x'),", value)
    else:
        found = tuple(name(item, what) for item in value)
    if len(set(found)) < len(found):
        twice = next(item for item in found if found.count(item) > 1)
        raise InputError(f"{what}: each name once expected, {twice} found twice")
    return found


def _split(given: str, what: str) -> tuple[str, ...]:
    """The names in a text, between commas or spaces; names in backquotes may hold both."""
    found: list[str] = []
    at = 0
    while at < len(given):
        matched = _NAMES.match(given, at)
        if matched is None:
            break
        try:
            found.append(unquoted(matched[1]) if matched[1] else matched[2])
        except ValueError as error:
            raise InputError(f"{what}: the name {matched[1]} cannot be read: {error}") from None
        at = matched.end()
    if at < len(given) or not found:
        raise wrong(what, "names of variables with commas or spaces between them", given)
    return tuple(found)


def by_name(value: object, what: str) -> dict[str, Any]:
    """A mapping from names, or SymPy symbols, each once."""
    if not isinstance(value, Mapping):
        raise wrong(what, "a mapping from names to values", value)
    found = {name(key, what): item for key, item in value.items()}
    if len(found) < len(value):
        raise InputError(f"{what}: each name once expected, a name and a symbol of the same name found")
    return found


def point(value: object, order: Sequence[str], what: str = "point") -> dict[str, Any]:
    """Values by name, from a mapping or from as many values in the order of the variables, and for no other names."""
    if isinstance(value, Mapping):
        named = by_name(value, what)
        if strangers := [name for name in named if name not in order]:
            raise InputError(f"{what}: values for {', '.join(order)} expected, {strangers[0]} found")
        return named
    values = by_place(value, what)
    if len(values) != len(order):
        raise InputError(f"{what}: values for {', '.join(order)} expected, {len(values)} found")
    return dict(zip(order, values, strict=True))


def by_place(value: object, what: str) -> list[Any]:
    """A sequence of values (also an array of numpy's); text, which is one too, is not meant."""
    if hasattr(value, "tolist") and getattr(value, "ndim", None) == 1:
        value = list(value)  # type: ignore[call-overload]
    if not isinstance(value, Sequence) or isinstance(value, str | bytes | bytearray):
        raise wrong(what, "values in order, or a mapping from names to values,", value)
    return list(value)


# --- numbers ------------------------------------------------------------------------------------------------
def rational(value: object, what: str, expected: str = "an exact number") -> Fraction:
    """A rational number: int, ``Fraction``, text such as ``-3/4`` or ``1.5e-3``; a finite float, also one of SymPy."""
    if getattr(value, "shape", None) == () and hasattr(value, "ndim") and not isinstance(value, Real):
        value = value.item()  # type: ignore[attr-defined]  # an array of numpy's that holds one number
    if isinstance(value, float):
        if not math.isfinite(value):
            raise wrong(what, expected, value)
        return Fraction(float.__repr__(value))
    if isinstance(value, str):
        return _rational(value, what, expected)
    if isinstance(value, Decimal) or getattr(value, "is_Float", False) is True:
        return _rational(str(value), what, expected)
    if _is_number(value, Rational) and isinstance(value, Rational):
        return Fraction(int(value.numerator), int(value.denominator))
    if _is_number(value, Real) and type(value).__module__ == "numpy":  # float32 and its kind
        return _rational(str(value), what, expected)
    raise wrong(what, expected, value)


def _rational(given: str, what: str, expected: str) -> Fraction:
    """The number of a text, which must not be longer than it looks: ``1e999999999`` would fill the memory."""
    decimal = _DECIMAL.fullmatch(given)
    large = decimal is not None and abs(int(decimal[1] or 0)) > LONGEST_NUMBER
    if len(given) > LONGEST_NUMBER or large or not (decimal or _FRACTION.fullmatch(given)):
        raise wrong(what, expected, given)
    try:
        return Fraction(given.replace(" ", ""))
    except (ValueError, ZeroDivisionError):
        raise wrong(what, expected, given) from None
