"""What readers share: an LALR parser over tokens that one function yields, and failures with their place."""

from __future__ import annotations

from dataclasses import dataclass

from qe.errors import ParseError
from qe.io import surface as s
from qe.io.lalr import Parser, Tokens, UnexpectedToken, tables
from qe.io.text_errors import SyntaxFailure, UnknownFunction, unexpected_token


def parser(name: str, grammar: str, tokens: Tokens, builder: object, *, start: str = "start") -> Parser:
    """The parser of the grammar called ``name``, whose actions are the methods of ``builder``."""
    return Parser(tables(name, grammar, start), tokens, builder)


@dataclass(frozen=True, slots=True)
class Failing:
    """Makes errors about an offset of ``text``, which ``source`` names."""

    text: str
    source: str

    def __call__(self, message: str, at: int, expected: str = "") -> ParseError:
        line, column = position(self.text, max(at, 0))
        return ParseError(message, source=self.source, line=line, column=column, expected=expected)


def parse(made: Parser, text: str, fail: Failing) -> s.Node:
    """The surface tree of ``text``. Raises ``ParseError``, one line with line, column and what was expected."""
    try:
        return made.parse(text)  # type: ignore[no-any-return]
    except UnexpectedToken as error:
        token = error.token
        failed = unexpected_token(text, token.type, str(token), token.start_pos, error.accepts)
    except UnknownFunction as error:
        failed = SyntaxFailure(error.about(text), error.at)
    except SyntaxFailure as error:
        failed = error
    raise fail(failed.message, failed.at, failed.expected) from None


def position(text: str, at: int) -> tuple[int, int]:
    """Line and column, from 1, of an offset."""
    return text.count("\n", 0, at) + 1, at - text.rfind("\n", 0, at)
