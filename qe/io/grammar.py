"""What all readers share: an LALR parser over tokens that one function yields, and failures with their place."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from qe.errors import ParseError
from qe.io import surface as s
from qe.io.text_errors import SyntaxFailure, unexpected_token

if TYPE_CHECKING:
    from lark import Lark, Token

Tokens = Callable[[str, "Callable[..., Token]"], "Iterator[Token]"]
"""The tokens of a text, made by the given constructor. One compiled pattern is faster than one per terminal."""


def parser(grammar: str, tokens: Tokens, builder: object, *, start: str = "start") -> Lark:
    """The parser of a grammar whose actions are the methods of ``builder``."""
    from lark import Lark, Token
    from lark.lexer import Lexer

    class FormatLexer(Lexer):
        def __init__(self, lexer_conf: Any) -> None:
            pass

        def lex(self, text: str) -> Iterator[Token]:  # type: ignore[override]
            return tokens(text, Token)

    return Lark(grammar, parser="lalr", start=start, lexer=FormatLexer, transformer=builder, maybe_placeholders=False)


@dataclass(frozen=True, slots=True)
class Failing:
    """Makes errors about an offset of ``text``, which ``source`` names."""

    text: str
    source: str

    def __call__(self, message: str, at: int, expected: str = "") -> ParseError:
        line, column = position(self.text, max(at, 0))
        return ParseError(message, source=self.source, line=line, column=column, expected=expected)


def parse(made: Lark, text: str, fail: Failing) -> s.Node:
    """The surface tree of ``text``. Raises ``ParseError``, one line with line, column and what was expected."""
    from lark.exceptions import UnexpectedToken

    try:
        return made.parse(text)  # type: ignore[return-value]
    except UnexpectedToken as error:
        token = error.token
        at = len(text) if token.type == "$END" else token.start_pos or 0
        failed = unexpected_token(text, token.type, str(token), at, error.accepts or error.expected)
    except SyntaxFailure as error:
        failed = error
    raise fail(failed.message, failed.at, failed.expected) from None


def position(text: str, at: int) -> tuple[int, int]:
    """Line and column, from 1, of an offset."""
    return text.count("\n", 0, at) + 1, at - text.rfind("\n", 0, at)
