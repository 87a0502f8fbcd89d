"""The parser of all formats: levels, sorts and deep nesting; every failure becomes one error with its place."""

from __future__ import annotations

from collections.abc import Collection
from contextlib import suppress

import pytest

from qe.errors import ParseError
from qe.io import formats
from qe.io import surface as s
from qe.io.parser import INFIX, PREFIX, parsed
from qe.io.text_errors import Failing, SyntaxFailure
from qe.io.text_parser import TextParser
from tests.tables import each


@each(
    ("x > 0 and\n  y + > 1", (2, 7), "unexpected '>'", "a number, a variable or '('"),
    ("x > 0 and\nsin(y) > 1", (2, 1), "sin(y): sin is not algebraic", ""),
    ("x > 0 and\n y ; z", (2, 4), "unknown character ';'", ""),
)
def test_every_failure_becomes_one_error(text: str, place: tuple[int, int], said: str, expected: str) -> None:
    with pytest.raises(ParseError) as error:
        parsed(TextParser, text, Failing(text, "a file"))
    found = error.value
    assert (found.line, found.column, found.source, found.expected) == (*place, "a file", expected)
    assert said in str(found) and "\n" not in str(found)


DEEP = 5000


@each(
    ("(" * DEEP + "x > 0" + ")" * DEEP, "x > 0"),
    ("[" * DEEP + "x > 0" + "]" * DEEP, "x > 0"),
    ("(" * DEEP + "x" + ")" * DEEP + " > 0", "x > 0"),
    ("not " * DEEP + "x > 0", "x > 0"),
    ("-" * DEEP + "x > 0", "x > 0"),
    ("x" + "*1" * DEEP + " > 0", "x > 0"),
    ("(" * DEEP + "x" + " + 1)" * DEEP + " > 0", f"x + {DEEP} > 0"),
    ("(" * DEEP + "x > 0" + " and y > 0)" * DEEP, "x > 0 and y > 0"),
)
def test_brackets_signs_and_chains_may_be_as_deep_as_they_like(text: str, plain: str) -> None:
    assert formats.read(text) == formats.read(plain)


@each(
    "abs(" * DEEP + "x" + ")" * DEEP + " > 0",
    "If[x > 0, " * DEEP,
    "if " * DEEP,
    "ex x in [if " * DEEP,
    "ex x. " * DEEP + "x > 0",
    "x > 0 -> " * DEEP + "x > 0",
)
def test_what_is_nested_too_deeply_is_refused_in_one_line(text: str) -> None:
    with pytest.raises(ParseError) as error:
        formats.read(text)
    assert "nested more than 120 levels deep" in str(error.value)


def test_what_could_have_stood_there_is_exactly_what_can_be_read() -> None:
    """For every token behind some beginnings: the parser takes it if and only if it is among the expected."""
    shown = {"PLUS": "+", "MINUS": "-", "TIMES": "*", "POWER": "^", "RELATION": ">", "AND": "and", "OR": "or"}
    shown |= {"IMPLIES": "->", "IFF": "<->", "CLOSE": ")", "OPEN": "(", "NAME": "z", "NUMBER": "1", "NOT": "not"}
    shown |= {"COMMA": ",", "QUANTIFIER": "∃", "IF": "if", "RADICAL": "√", "IN": "∈", "LEFT": "[", "RIGHT": "]"}
    for text in ("x", "(x", "(x > 0", "x + (y", "x^2", "x^", "-", "not", "x > 0", "x > y <", "f(", "√", "[x"):
        expected = expected_behind(text)
        for kind, sign in shown.items():
            if text[-1].isalpha() and kind in ("OPEN", "LEFT"):
                continue  # behind a name they are a call, which no name can promise
            parser = TextParser(f"{text} {sign}")
            with suppress(SyntaxFailure):
                parser.whole()
            taken = parser.token.at > len(text) + 1
            assert taken == (kind in expected), (text, sign, expected)


def expected_behind(text: str) -> set[str]:
    parser = TextParser(f"{text} else")  # which none of them goes on with
    kinds: set[str] = set()
    unexpected = parser.unexpected

    def noted(expected: Collection[str]) -> SyntaxFailure:
        kinds.update(expected)
        return unexpected(expected)

    parser.unexpected = noted  # type: ignore[method-assign]
    with pytest.raises(SyntaxFailure):
        parser.whole()
    return kinds


def test_tables() -> None:
    assert {"NAME", "NUMBER", "OPEN"} <= set(PREFIX) <= set(TextParser.prefix)
    assert all(operator.limit in (operator.level, operator.level + 1) for operator in INFIX.values())
    assert isinstance(TextParser("x > 0").whole(), s.Comparison)
