"""Reading back what ``bezier plan`` wrote: files, exact numbers, control points.

Everything raises ``CertificateRejected`` naming the entry that is wrong, or ``InputError`` for files that cannot be
opened.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from pathlib import Path as FilePath
from typing import Any

from bezier.curves.scalar import Vector
from bezier.input.numbers import NotANumber, parse
from bezier.input.toml_table import read_bytes
from qe.errors import CertificateRejected, InputError
from qe.proof.certificate import Certificate
from qe.proof.entry import read_json

MAX_BYTES = 200_000_000
MAX_CHARACTERS = 4000
"""Of one number: algebraic numbers of high degree have long coefficients, and Python reads up to 4300 digits."""
DIMENSION = 3


def text(path: FilePath) -> str:
    """The text of a file of moderate size."""
    try:
        return read_bytes(path, MAX_BYTES).decode("utf-8")
    except UnicodeDecodeError:
        raise CertificateRejected(path.name, "expected UTF-8 text") from None


def certificate(path: FilePath) -> Certificate:
    """The certificate in a file."""
    written = text(path)
    try:
        return Certificate.from_json(written)
    except InputError as error:
        raise InputError(f"{path}: {error}") from None


def table(path: FilePath) -> dict[str, Any]:
    """The JSON object in a file, decimals kept as text."""
    try:
        result = parsed(text(path))
    except (ValueError, RecursionError) as error:
        raise CertificateRejected(path.name, f"expected JSON, found: {error}") from None
    if not isinstance(result, dict):
        raise CertificateRejected(path.name, "expected a JSON object")
    return result


def parsed(raw: str) -> Any:
    """JSON with decimals kept as text. Raises ``ValueError`` for other text, NaN, infinity and repeated names."""
    return read_json(raw, decimal=str)


def entry(table: Mapping[str, Any], key: str, kind: type, place: str = "") -> Any:
    """A value of this type under a key."""
    value = table.get(key)
    if not isinstance(value, kind):
        words: dict[type, str] = {dict: "an object", list: "a list", str: "a string"}
        raise CertificateRejected(f"{place}{key}", f"expected {words.get(kind, kind.__name__)}")
    return value


def rational(raw: object, place: str) -> Fraction:
    """An exact number given as text."""
    try:
        return parse(raw if isinstance(raw, str) else "", MAX_CHARACTERS)
    except NotANumber as error:
        raise CertificateRejected(place, f"expected an exact number, found {error}") from None


def row(text: str, place: str) -> tuple[Fraction, ...]:
    """Exact numbers with spaces between."""
    return tuple(rational(word, place) for word in text.split())


def numbers(rows: Sequence[Any], field: Mapping[str, Any] | None, place: str) -> Vector:
    """Exact numbers from their coefficients in a number field, which is Q for None."""
    if field is None:
        return tuple(rational(row, place) for row in rows)
    from qe.exact.field import NumberField

    try:
        low, high = (rational(end, f"{place}.field.interval") for end in field["interval"])
        base = NumberField.from_root([int(c) for c in field["minimal_polynomial"]], low, high)
    except (KeyError, TypeError, ValueError, InputError) as error:
        raise CertificateRejected(f"{place}.field", f"not a number field: {error}") from None
    if not all(isinstance(row, list) and row for row in rows):
        raise CertificateRejected(place, "expected the coefficients of each number")
    values = (base.element([rational(c, place) for c in row]) for row in rows)
    return tuple(v.as_fraction() if v.is_rational else v for v in values)


def control_points(stated: Mapping[str, Any]) -> dict[str, Vector]:
    """The control points in the table of a ``path.json``."""
    points = {}
    for name, listed in entry(stated, "points", dict, "path.json: ").items():
        place = f"path.json: points.{name}"
        if not isinstance(listed, list) or len(listed) != DIMENSION or not all(isinstance(c, dict) for c in listed):
            raise CertificateRejected(place, f"expected a point of {DIMENSION} coordinates")
        points[name] = tuple(_coordinate(c, stated, f"{place}[{i}]") for i, c in enumerate(listed))
    return points


def _coordinate(stated: Mapping[str, Any], data: Mapping[str, Any], place: str) -> Any:
    if "in_field" not in stated:
        return rational(stated.get("exact"), place)
    return numbers([stated["in_field"]], entry(data, "field", dict, "path.json: "), place)[0]
