"""Tables of cases: one test for each row."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import TypeVar, cast

import pytest

Test = TypeVar("Test", bound=Callable[..., object])


def each(*rows: object) -> Callable[[Test], Test]:
    """The test once for each row: its entries are the first parameters that no decorator below gives.

    A row that is no tuple is one value. Rows may be given with names, as one dictionary. What the entries are stands in
    the signature alone.
    """
    names: list[str] | None = None
    if len(rows) == 1 and isinstance(rows[0], dict):
        names, rows = list(rows[0]), tuple(rows[0].values())
    first = getattr(rows[0], "values", rows[0])  # of a row with marks: its entries
    width = len(first) if isinstance(first, tuple | list) and isinstance(rows[0], tuple) else 1

    def repeated(test: Test) -> Test:
        marks = (mark for mark in getattr(test, "pytestmark", ()) if mark.name == "parametrize")
        given = {name for mark in marks for name in _listed(mark.args[0])}
        entries = [name for name in inspect.signature(test).parameters if name not in given][:width]
        repeat = pytest.mark.parametrize(entries if width > 1 else entries[0], rows, ids=names)
        return cast(Test, repeat(test))

    return repeated


def _listed(names: str | list[str] | tuple[str, ...]) -> list[str]:
    return [name.strip() for name in names.split(",")] if isinstance(names, str) else list(names)
