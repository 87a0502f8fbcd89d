"""S-expressions with positions: the concrete syntax of SMT-LIB 2.6, section 3.1."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any, NamedTuple, TypeAlias

from qe.io.grammar import parser
from qe.io.lalr import END, Parser, Token, UnexpectedToken
from qe.io.surface import Fail

# the scripts of MetiTarski write 1. for 1.0, and other solvers read it
_TOKEN = re.compile(
    r"(?P<SPACE>\s+|;[^\n]*)"
    r"|(?P<OPEN>\()|(?P<CLOSE>\))"
    r"|(?P<NUMBER>[0-9]+(?:\.[0-9]*)?(?![A-Za-z0-9~!@$%^&*_+=<>.?/-]))"
    r"|(?P<SYMBOL>[A-Za-z~!@$%^&*_+=<>.?/-][A-Za-z0-9~!@$%^&*_+=<>.?/-]*)"
    r"|(?P<QUOTED>\|[^|\\]*\|)"
    r"|(?P<KEYWORD>:[A-Za-z0-9~!@$%^&*_+=<>.?/-]+)"
    r'|(?P<STRING>"(?:[^"]|"")*")'
    r"|(?P<BITS>\#x[0-9a-fA-F]+|\#b[01]+)"
)
_SYMBOL = re.compile(r"[A-Za-z~!@$%^&*_+=<>.?/-][A-Za-z0-9~!@$%^&*_+=<>.?/-]*")
GRAMMAR = """
%declare OPEN CLOSE NUMBER SYMBOL QUOTED KEYWORD STRING BITS
start: expression*
?expression: SYMBOL             -> symbol
     | QUOTED                   -> quoted
     | NUMBER                   -> number
     | (KEYWORD | STRING | BITS) -> other
     | OPEN expression* CLOSE   -> listing
"""


class Word(NamedTuple):
    """A symbol (without its bars) or, by ``kind``, a number, keyword, string or bit vector."""

    kind: str
    text: str
    at: int


class Listing(NamedTuple):
    """A bracketed list."""

    items: list[Expression]
    at: int


Expression: TypeAlias = Word | Listing


class _Bad(Exception):
    def __init__(self, message: str, at: int) -> None:
        self.message, self.at = message, at


def parse(text: str, fail: Fail) -> list[Expression]:
    """The expressions of a script; raises what ``fail`` makes."""
    try:
        return _parser().parse(text)  # type: ignore[no-any-return]
    except UnexpectedToken as error:
        if error.token.type == END:
            raise fail("unbalanced brackets: this '(' is never closed", _last_open(text)) from None
        raise fail("unbalanced brackets: this ')' has no partner", error.token.start_pos) from None
    except _Bad as error:
        raise fail(error.message, error.at) from None


@dataclass(slots=True)
class Ends:
    """Where the whole expressions of a text that goes on end; nothing is looked through again when it has.

    What is no token counts as one character; a bracket that closes nothing ends an expression. ``at``: how far the text
    was looked through, ``depth``: how many brackets are open there, ``quoted``: how far for the end of a quotation.
    """

    at: int = 0
    depth: int = 0
    quoted: int = 0

    def found(self, text: str) -> Iterator[int]:
        """The offsets behind them."""
        while self.at < len(text):
            if text[self.at] in '|"' and text.find(text[self.at], max(self.at + 1, self.quoted)) < 0:
                self.quoted = len(text)
                return
            found = _TOKEN.match(text, self.at)
            if found is None and text[self.at] in '|"':  # it may be closed by what follows
                return
            kind, end = (None, self.at + 1) if found is None else (found.lastgroup, found.end())
            if end == len(text) and kind not in ("CLOSE", "OPEN") and text[-1] != "\n":  # it may go on
                return
            self.at, self.quoted = end, 0
            if kind == "SPACE":
                continue
            self.depth = max(self.depth + {"OPEN": 1, "CLOSE": -1}.get(str(kind), 0), 0)
            if self.depth == 0:
                yield end

    def cut(self, count: int) -> None:
        """So many characters were taken away before the text."""
        self.at, self.quoted = self.at - count, max(self.quoted - count, 0)


def show(expression: Expression) -> str:
    """The text of an expression."""
    if isinstance(expression, Listing):
        return f"({' '.join(map(show, expression.items))})"
    if expression.kind == "SYMBOL" and not _SYMBOL.fullmatch(expression.text):
        return f"|{expression.text}|"
    return expression.text


def symbols(expression: Expression) -> Iterator[str]:
    """The symbols of an expression."""
    stack = [expression]
    while stack:
        part = stack.pop()
        if isinstance(part, Listing):
            stack += part.items
        elif part.kind == "SYMBOL":
            yield part.text


@cache
def _parser() -> Parser:
    return parser("smtlib", GRAMMAR, _tokens, _Builder())


def _tokens(text: str, token: Callable[..., Token]) -> Iterator[Token]:
    at, end, match = 0, len(text), _TOKEN.match
    while at < end:
        found = match(text, at)
        if found is None:
            if text[at] in '|"':
                raise _Bad(f"this {text[at]} is never closed", at)
            if text[at].isdigit():
                raise _Bad("malformed number; write (/ 1 2) for 1/2", at)
            raise _Bad(f"unknown character {text[at]!r}", at)
        if found.lastgroup != "SPACE":
            yield token(found.lastgroup, found.group(), at)
        at = found.end()


def _last_open(text: str) -> int:
    """The innermost bracket still open at the end of the text."""
    open_at: list[int] = []
    for found in _TOKEN.finditer(text):
        if found.lastgroup == "OPEN":
            open_at.append(found.start())
        elif found.lastgroup == "CLOSE" and open_at:
            open_at.pop()
    return open_at[-1] if open_at else 0


class _Builder:
    """The actions of the grammar."""

    def start(self, c: list[Any]) -> list[Expression]:
        return c

    def symbol(self, c: list[Any]) -> Word:
        return Word("SYMBOL", str(c[0]), c[0].start_pos)

    def quoted(self, c: list[Any]) -> Word:
        return Word("SYMBOL", str(c[0])[1:-1], c[0].start_pos)

    def number(self, c: list[Any]) -> Word:
        return Word("NUMBER", str(c[0]), c[0].start_pos)

    def other(self, c: list[Any]) -> Word:
        return Word(c[0].type, str(c[0]), c[0].start_pos)

    def listing(self, c: list[Any]) -> Listing:
        return Listing(c[1:-1], c[0].start_pos)
