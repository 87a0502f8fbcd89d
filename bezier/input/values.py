"""Values of Python as the values of a table: numbers exactly as they print, arrays and tuples as lists.

A float is the decimal number that it prints: 0.1 is one tenth, also one of numpy in any precision. What is no number,
text, sequence or mapping stays as it is, and the reader of the table says what it expected.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sized
from decimal import Decimal
from enum import Enum
from fractions import Fraction
from numbers import Integral, Rational, Real
from typing import Any

from bezier.input.numbers import MAX_CHARACTERS, NUMBER, Literal
from qe.errors import InputError

MOST = 10_000
"""Entries of one list or mapping."""
DEEPEST = 8


def table_value(value: Any, place: str, depth: int = 0) -> Any:
    """A value for ``Table``. Raises ``InputError`` for what is too large, too deep, or has keys that are no names."""
    match value:
        case Enum():
            return value.value
        case str():
            return str(value)
        case bool() | Integral():
            return value if isinstance(value, bool) else int(value)
        case Decimal():
            return Literal(str(value).lower())
        case Rational():
            return _fraction(Fraction(int(value.numerator), int(value.denominator)), place)
        case float():
            return Literal(float.__repr__(value))
        case Real():
            return Literal(str(value))
        case Mapping():
            _check_size(value, place, depth)
            return _mapping(value, place, depth)
    kind = getattr(getattr(value, "dtype", None), "kind", "")
    if kind and getattr(value, "ndim", None) == 0:
        scalar = value[()]  # of an array without dimensions; of a scalar, which no case above knows, itself
        again = type(scalar) is not type(value)
        return bool(value) if kind == "b" else table_value(scalar, place, depth) if again else value
    is_bytes = isinstance(value, bytes | bytearray | memoryview)
    if isinstance(value, Collection) and hasattr(value, "__getitem__") and not is_bytes:
        _check_size(value, place, depth)
        return [table_value(entry, f"{place}[{i}]", depth + 1) for i, entry in enumerate(value)]
    return value


def _fraction(value: Fraction, place: str) -> str:
    if max(abs(value.numerator), value.denominator).bit_length() > 4 * MAX_CHARACTERS:
        raise InputError(f"{place}: expected {NUMBER}, found one of more than {MAX_CHARACTERS} digits")
    return str(value)


def _mapping(value: Mapping[Any, Any], place: str, depth: int) -> dict[str, Any]:
    for key in value:
        if not isinstance(key, str):
            raise InputError(f"{place}: expected a mapping from names, found a key that is a {type(key).__name__}")
    return {k: table_value(v, f"{place}.{k}", depth + 1) for k, v in value.items() if v is not None}


def _check_size(value: Sized, place: str, depth: int) -> None:
    if len(value) > MOST:
        raise InputError(f"{place}: expected at most {MOST} entries, found {len(value)}")
    if depth >= DEEPEST:
        raise InputError(f"{place}: expected lists at most {DEEPEST} deep, found deeper ones")
