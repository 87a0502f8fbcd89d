"""Failures with their place, whatever raised them."""

from __future__ import annotations

import pytest

from qe.errors import ParseError
from qe.io.grammar import Failing, parse, position
from qe.io.text_parser import text_parser


@pytest.mark.parametrize(("at", "line", "column"), [(0, 1, 1), (2, 1, 3), (3, 1, 4), (4, 2, 1), (5, 3, 1), (8, 3, 4)])
def test_lines_and_columns(at: int, line: int, column: int) -> None:
    assert position("abc\n\nxyz", at) == (line, column)


@pytest.mark.parametrize(
    ("text", "place", "said", "expected"),
    [
        ("x > 0 and\n  y + > 1", (2, 7), "unexpected '>'", "a number, a variable or '('"),
        ("x > 0 and\nsin(y) > 1", (2, 1), "sin(y): sin is not algebraic", ""),
        ("x > 0 and\n y ; z", (2, 4), "unknown character ';'", ""),
    ],
)
def test_every_failure_becomes_one_error(text: str, place: tuple[int, int], said: str, expected: str) -> None:
    with pytest.raises(ParseError) as error:
        parse(text_parser(), text, Failing(text, "a file"))
    found = error.value
    assert (found.line, found.column, found.source, found.expected) == (*place, "a file", expected)
    assert said in str(found) and "\n" not in str(found)


def test_an_unknown_place_is_the_beginning() -> None:
    error = Failing("x\ny", "it")("wrong", -1, "right")
    assert (error.line, error.column, error.expected) == (1, 1, "right")
