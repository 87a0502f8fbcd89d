"""The parser that runs Lark's tables: it does what Lark does, token by token, and the stored tables are current."""

from __future__ import annotations

from functools import cache
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lark import Lark
from lark import Token as LarkToken
from lark.exceptions import UnexpectedToken as LarkUnexpectedToken
from lark.lexer import Lexer

from qe.io import lalr
from qe.io.store_tables import GRAMMARS

NAMES = sorted(GRAMMARS)


class Recorder:
    """Actions that only note what was called with what."""

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return lambda children: (name, [c if isinstance(c, tuple) else str(c) for c in children])


class Split(Lexer):
    """The words of a text, each the terminal of its name."""

    def __init__(self, conf: Any) -> None:
        pass

    def lex(self, text: str) -> Any:  # type: ignore[override]
        return words(text, LarkToken)


def words(text: str, token: Any) -> Any:
    at = 0
    for word in text.split():
        at = text.index(word, at)
        yield token(word, word.lower(), at)
        at += len(word)


@cache
def both(name: str) -> tuple[Lark, lalr.Parser]:
    grammar, start = GRAMMARS[name]
    options: dict[str, Any] = {"lexer": Split, "transformer": Recorder(), "maybe_placeholders": False}
    reference = Lark(grammar, parser="lalr", start=start, **options)
    return reference, lalr.Parser(lalr.tables(name, grammar, start), words, Recorder())


@cache
def terminals(name: str) -> list[str]:
    return sorted({key for state in lalr.computed(*GRAMMARS[name]).states for key in state if key.isupper()})


def outcome(parse: Any, text: str) -> tuple[object, ...]:
    """What was made of the text, or where it failed and what could have stood there."""
    try:
        return ("made", parse(text))
    except LarkUnexpectedToken as error:
        at = len(text) if error.token.type == lalr.END else error.token.start_pos
        return ("failed", error.token.type, at, frozenset(error.accepts))
    except lalr.UnexpectedToken as error:
        return ("failed", error.token.type, error.token.start_pos, error.accepts)


@pytest.mark.parametrize("name", NAMES)
def test_stored_tables_are_current(name: str) -> None:
    stored = lalr.stored(name, *GRAMMARS[name])
    assert stored == lalr.computed(*GRAMMARS[name]), "run python -m qe.io.store_tables"


@pytest.mark.parametrize("name", NAMES)
def test_tables_of_another_grammar_are_not_used(name: str) -> None:
    grammar, start = GRAMMARS[name]
    changed = grammar + "\n"
    assert lalr.stored(name, changed, start) is None
    assert lalr.stored(name, grammar, "sum") is None
    assert lalr.stored("nothing", grammar, start) is None
    assert lalr.tables(name, changed, start) == lalr.computed(grammar, start)


@pytest.mark.parametrize("name", NAMES)
@given(data=st.data())
def test_the_same_as_lark_on_any_tokens(name: str, data: st.DataObject) -> None:
    reference, own = both(name)
    text = " ".join(data.draw(st.lists(st.sampled_from([t for t in terminals(name) if t != lalr.END]), max_size=6)))
    assert outcome(own.parse, text) == outcome(reference.parse, text)


@pytest.mark.parametrize("name", NAMES)
@given(data=st.data())
def test_the_same_as_lark_on_what_can_go_on(name: str, data: st.DataObject) -> None:
    """Every token is one of those that the parser said could follow, so that texts are long and often right."""
    reference, own = both(name)
    text = ""
    for _ in range(data.draw(st.integers(0, 14))):
        found = outcome(own.parse, text)
        assert found == outcome(reference.parse, text)
        possible = found[3] if found[0] == "failed" and found[1] == lalr.END else frozenset()
        if not possible - {lalr.END}:
            break
        text = f"{text} {data.draw(st.sampled_from(sorted(possible - {lalr.END})))}".strip()
    assert outcome(own.parse, text) == outcome(reference.parse, text)


def test_long_repetitions_take_time_in_proportion() -> None:
    tables = lalr.computed("%declare WORD\nstart: word*\nword: WORD", "start")
    made = lalr.Parser(tables, words, Recorder()).parse("WORD " * 40_000)
    assert len(made[1]) == 40_000
