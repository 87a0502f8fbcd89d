"""Whether what a file states is what follows from the exact path: the first entry that differs, by its place."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import zip_longest
from typing import Any, Never

from bezier.curves.curve import Bezier
from bezier.input.numbers import shorten
from bezier.input.stored import control_points, entry
from bezier.problem import Problem, from_json
from qe.errors import CertificateRejected, InputError

SHOWN = 60


def same_data(file: str, stated: Any, expected: Any, place: str = "") -> None:
    """Both are JSON data with decimals as text. Raises ``CertificateRejected`` naming the first difference."""
    if isinstance(expected, dict) and isinstance(stated, dict):
        for key in expected:
            inner = f"{place}.{key}" if place else key
            if key not in stated:
                _reject(file, inner, "missing")
            same_data(file, stated[key], expected[key], inner)
        for key in stated:
            if key not in expected:
                _reject(file, f"{place}.{key}" if place else key, "not expected here")
    elif isinstance(expected, list) and isinstance(stated, list):
        for i, (one, other) in enumerate(zip(stated, expected, strict=False)):
            same_data(file, one, other, f"{place}[{i}]")
        if len(stated) != len(expected):
            _reject(file, place, f"expected {len(expected)} entries, found {len(stated)}")
    elif type(stated) is not type(expected) or stated != expected:
        _reject(file, place, f"expected {_shown(expected)}, found {_shown(stated)}")


def same_rows(file: str, stated: str, expected: str) -> None:
    """Both are tables of comma-separated values. Raises ``CertificateRejected`` naming line and column."""
    names = next(line for line in expected.splitlines() if not line.startswith("#")).split(",")
    for number, (one, other) in enumerate(zip_longest(stated.split("\n"), expected.split("\n")), start=1):
        if one == other:
            continue
        if one is None or other is None:
            _reject(file, f"line {number}", "a line too few" if one is None else "a line too many")
        cells = zip_longest(names, one.split(","), other.split(","))
        for name, mine, right in cells if not other.startswith("#") else ():
            if mine != right:
                _reject(file, f"line {number}, {name}", f"expected {_shown(right)}, found {_shown(mine)}")
        _reject(file, f"line {number}", f"expected {_shown(other)}, found {_shown(one)}")


def _reject(file: str, place: str, reason: str) -> Never:
    raise CertificateRejected(f"{file}: {place}" if place else file, reason)


def _shown(value: Any) -> str:
    match value:
        case None:
            return "nothing"
        case bool():
            return str(value).lower()
        case dict():
            return "an object"
        case list():
            return f"a list of {len(value)}"
        case int() if value.bit_length() > 4 * SHOWN:
            return "a huge number"
    return repr(shorten(value, SHOWN)) if isinstance(value, str) else str(value)


def stated_problem(stated: Mapping[str, Any], file: str) -> Problem:
    """The problem that a table read from a file states."""
    try:
        return from_json(stated, "problem")
    except InputError as error:
        raise CertificateRejected(file, str(error)) from None


def stored_path(stated: Mapping[str, Any]) -> tuple[Problem, dict[str, Bezier]]:
    """The problem and the curves in the table of a ``path.json``."""
    points = control_points(stated)
    curves = {}
    for name, row in entry(stated, "curves", dict, "path.json: ").items():
        if not isinstance(row, list) or not row or not all(isinstance(p, str) and p in points for p in row):
            raise CertificateRejected(f"path.json: curves.{name}", "expected names of control points")
        curves[name] = Bezier.of([points[p] for p in row])
    return stated_problem(entry(stated, "problem", dict, "path.json: "), "path.json"), curves
