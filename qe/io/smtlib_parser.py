"""S-expressions with positions: the concrete syntax of SMT-LIB 2.6, section 3.1."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TypeAlias

from qe.io.surface import Fail

SYMBOL = re.compile(r"[A-Za-z~!@$%^&*_+=<>.?/-][A-Za-z0-9~!@$%^&*_+=<>.?/-]*")
# the scripts of MetiTarski write 1. for 1.0, and other solvers read it
_WORD = (
    rf"{SYMBOL.pattern}|[0-9]+(?:\.[0-9]*)?(?![A-Za-z0-9~!@$%^&*_+=<>.?/-])"
    r'|\|[^|\\]*\||:[A-Za-z0-9~!@$%^&*_+=<>.?/-]+|"(?:[^"]|"")*"|\#x[0-9a-fA-F]+|\#b[01]+'
)
_TOKEN = re.compile(rf"(?P<SPACE>\s+|;[^\n]*)|(?P<OPEN>\()|(?P<CLOSE>\))|(?P<WORD>{_WORD})")
_WORDS = re.compile(rf"[()]|{_WORD}|;[^\n]*|\S[\s\S]*")
"""Words, brackets and comments; as the last, all that follows where none of them begins."""
_QUOTING, _BRACKET = re.compile(r'[;|"]'), re.compile(r"[()]")
_INSIDE = re.compile(r'[^()|";]+')  # what opens and closes nothing


class Word(str):
    """A word and the offset ``at`` where it stands."""

    __slots__ = ("at",)
    at: int


class Listing(list["Expression"]):
    """A bracketed list and the offset ``at`` of its bracket."""

    __slots__ = ("at",)

    def __init__(self, at: int) -> None:
        super().__init__()
        self.at = at


Expression: TypeAlias = "str | list[Expression]"
"""A word as it is written, but a symbol without needless bars; or a bracketed list."""


def place(expression: Expression) -> int:
    """The offset of an expression that is a ``Word`` or ``Listing``; -1 of any other."""
    return getattr(expression, "at", -1)


def parse(text: str, fail: Fail, *, placed: bool = True) -> list[Expression]:
    """The expressions of a script; raises what ``fail`` makes. Unless they are ``placed``, they are mere strings and
    lists, which takes a third of the time, and errors have no offset."""
    items: list[Expression] = []
    outside: list[list[Expression]] = []
    for word in _placed_words(text, fail) if placed else _words(text, fail):
        if word == "(":
            outside.append(items)
            items.append(items := Listing(place(word)) if placed else [])
        elif word == ")":
            if not outside:
                raise fail("unbalanced brackets: this ')' has no partner", place(word))
            items = outside.pop()
        else:
            items.append(word)
    if outside:
        raise fail("unbalanced brackets: this '(' is never closed", place(items))
    return items


def _words(text: str, fail: Fail) -> list[str]:
    """The words and brackets."""
    if not _QUOTING.search(text):  # blanks are enough to split it, unless a word is two
        words = text.replace("(", " ( ").replace(")", " ) ").split()
        if all(map(_TOKEN.fullmatch, set(words))):
            return words
    words = _WORDS.findall(text)
    if words and not _TOKEN.fullmatch(words[-1]):
        raise fail("here no word begins", -1)
    return [simplified(word) for word in words if word[0] != ";"]


def _placed_words(text: str, fail: Fail) -> Iterator[Word]:
    """The words and brackets with their offsets."""
    at = 0
    for token in _TOKEN.finditer(text):
        start = at
        if token.start() != start:
            break
        at = token.end()
        if token.lastgroup != "SPACE":
            word = Word(simplified(token.group()))
            word.at = start
            yield word
    if at < len(text):
        raise fail(_no_token(text[at]), at)


def simplified(word: str) -> str:
    """A symbol without the bars that it does not need."""
    return word[1:-1] if word[0] == "|" and SYMBOL.fullmatch(word[1:-1]) else word


def plain(word: str) -> str:
    """What a word is called: a symbol without its bars."""
    return word[1:-1] if word[0] == "|" else word


def is_symbol(expression: Expression) -> bool:
    """Whether it is a symbol: no list, number, keyword, string or bit vector."""
    return isinstance(expression, str) and expression[0] not in '0123456789:"#'


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
            if self.depth and text[-1] == "\n" and not _QUOTING.search(text, self.at):  # brackets alone matter
                for bracket in _BRACKET.finditer(text, self.at):
                    self.depth, self.at = self.depth + (1 if bracket[0] == "(" else -1), bracket.end()
                    if not self.depth:
                        yield self.at
                        break
                else:
                    self.at = len(text)
                continue
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
    return expression if isinstance(expression, str) else f"({' '.join(map(show, expression))})"


def words(expression: Expression) -> Iterator[str]:
    """The words of an expression."""
    stack = [expression]
    while stack:
        part = stack.pop()
        if isinstance(part, str):
            yield part
        else:
            stack += part
