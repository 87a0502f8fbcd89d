"""Tables of cases: one test for each row."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import TypeVar, cast

import pytest
from _pytest.mark import ParameterSet

Test = TypeVar("Test", bound=Callable[..., object])


def each(*rows: object, daily: int = 1) -> Callable[[Test], Test]:
    """The test once for each row: its entries are the first parameters that no decorator below gives.

    A row that is no tuple is one value. Rows may be given with names, as one dictionary. What the entries are stands in
    the signature alone. With ``daily`` every so manyth row is one of every day, beginning with the first; the others
    are deep ones, since all of them ask the same of other cases.
    """
    names: list[str] | None = None
    if len(rows) == 1 and isinstance(rows[0], dict):
        names, rows = list(rows[0]), tuple(rows[0].values())
    first = getattr(rows[0], "values", rows[0])  # of a row with marks: its entries
    width = len(first) if isinstance(first, tuple | list) and isinstance(rows[0], tuple) else 1
    rows = tuple(_deep(row, width) if k % daily else row for k, row in enumerate(rows))

    def repeated(test: Test) -> Test:
        marks = (mark for mark in getattr(test, "pytestmark", ()) if mark.name == "parametrize")
        given = {name for mark in marks for name in _listed(mark.args[0])}
        entries = [name for name in inspect.signature(test).parameters if name not in given][:width]
        repeat = pytest.mark.parametrize(entries if width > 1 else entries[0], rows, ids=names)
        return cast(Test, repeat(test))

    return repeated


def _deep(row: object, width: int) -> object:
    if isinstance(row, ParameterSet):
        return pytest.param(*row.values, marks=[*row.marks, pytest.mark.deep], id=row.id)
    return pytest.param(*cast(tuple[object, ...], row if width > 1 else (row,)), marks=pytest.mark.deep)


def _listed(names: str | list[str] | tuple[str, ...]) -> list[str]:
    return [name.strip() for name in names.split(",")] if isinstance(names, str) else list(names)
