"""S-expressions with positions: the concrete syntax of SMT-LIB 2.6, section 3.1."""

from __future__ import annotations

import gc
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

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
_INSIDE = re.compile(r'[^()|";]+')  # what opens and closes nothing


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


@contextmanager
def without_collections() -> Iterator[None]:
    """While a large tree grows, looking for circles in it takes most of the time, and there are none."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()


@without_collections()
def parse(text: str, fail: Fail) -> list[Expression]:
    """The expressions of a script; raises what ``fail`` makes."""
    items: list[Expression] = []
    outside: list[tuple[list[Expression], int]] = []
    at = 0
    for found in _TOKEN.finditer(text):
        start, kind = at, found.lastgroup
        if found.start() != start:
            break
        at = found.end()
        if kind == "OPEN":
            outside.append((items, start))
            items = []
        elif kind == "CLOSE":
            if not outside:
                raise fail("unbalanced brackets: this ')' has no partner", start)
            listing = Listing(items, outside[-1][1])
            items = outside.pop()[0]
            items.append(listing)
        elif kind == "QUOTED":
            items.append(Word("SYMBOL", found.group()[1:-1], start))
        elif kind != "SPACE":
            items.append(Word(str(kind), found.group(), start))
    if at < len(text):
        raise fail(_no_token(text[at]), at)
    if outside:
        raise fail("unbalanced brackets: this '(' is never closed", outside[-1][1])
    return items


def _no_token(character: str) -> str:
    """Why no token begins with a character."""
    if character in '|"':
        return f"this {character} is never closed"
    if character.isdigit():
        return "malformed number; write (/ 1 2) for 1/2"
    return f"unknown character {character!r}"


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
            if self.depth and (passed := _INSIDE.match(text, self.at)) is not None:
                self.at = passed.end()
                continue
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
