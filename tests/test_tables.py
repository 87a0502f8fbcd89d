"""Rows of tables give the parameters of their test, in order, beside those of other decorators."""

from __future__ import annotations

import pytest

from tests.tables import each


@each(5, 6)
@each((1, 2), pytest.param(3, 4))
def test_entries_are_the_first_parameters_that_nothing_below_gives(a: int, b: int, c: int) -> None:
    assert (a, b) in ((1, 2), (3, 4)) and c in (5, 6)


@each({"one": ([1], "1"), "two": ([2], "2")})
def test_rows_may_have_names(numbers: list[int], text: str, request: pytest.FixtureRequest) -> None:
    assert request.node.name.endswith(f"[{ {'1': 'one', '2': 'two'}[text] }]") and numbers == [int(text)]


def test_a_table_without_rows_is_refused() -> None:
    with pytest.raises(IndexError):
        each()
