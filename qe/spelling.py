"""How the name of a variable is written in text: as it stands where it is a plain word, else between backquotes.

A name is any string without ``|`` and backslash, which SMT-LIB keeps out of its own quoted symbols. Between backquotes
a backquote is written ``\\```, and a character that cannot be seen (a line break, a control character) by its number,
``\\u{a}``.
"""

from __future__ import annotations

import re
from collections.abc import Container

NUMERALS = "⁰¹²³⁴-⁹ⁱⁿ¼-¾⅐-⅟↉"
"""Raised digits and letters and fractions of one character, which are no part of a plain word."""
WORD = rf"[^\W\d{NUMERALS}][^\W{NUMERALS}]*'*"
"""A plain word: letters, digits and ``_``, not a digit first, perhaps with primes."""

QUOTED = r"`(?:[^`\\\n]|\\.)+`"
"""A name between backquotes."""

KEYWORDS = frozenset(
    (
        *("ex", "exists", "Ex", "Exists", "EXISTS", "all", "forall", "All", "ForAll", "Forall", "FORALL"),
        *("and", "AND", "or", "OR", "not", "NOT", "implies", "iff", "in", "if", "If", "then", "Then", "else"),
        *("true", "True", "TRUE", "false", "False", "FALSE", "oo", "infinity", "Infinity", "inf", "Inf", "Reals", "ℝ"),
    )
)
"""Words that mean something else in the text syntax."""

PI, WORDS_FOR_PI = "ℼ", ("pi", "Pi", "π")
NUMBERS = (PI, "ℯ", "ℽ", "𝐺")
"""Variables that stand for pi, e, Euler's and Catalan's constant (``qe.formula.numbers``)."""
CONSTANTS = frozenset((*WORDS_FOR_PI, "nan", "NaN"))
"""Words that mathematics reads as numbers: in text they are variables only between backquotes."""

_PLAIN = re.compile(WORD)
_ESCAPE = re.compile(r"\\(?:u\{([0-9a-fA-F]{1,6})\}|([`\\]))")


def is_product(name: str, letters: Container[str], bound: Container[str] = ()) -> bool:
    """Whether text reads a word as a product: all its letters are names, or one of a few is bound and nowhere alone."""
    lone = len(name) < 4 and any(x in bound for x in name)
    return len(name) > 1 and name.isalpha() and (lone or all(x in letters for x in name))


def quoted(name: str, others: Container[str] = ()) -> str:
    """The name as text reads it, wherever it stands, among ``others``."""
    return between_quotes(name) if name in CONSTANTS or is_product(name, others) else quoted_if_needed(name)


def quoted_if_needed(name: str) -> str:
    """The name as text reads it where it is no word for a number."""
    return "pi" if name == PI else name if _PLAIN.fullmatch(name) and name not in KEYWORDS else between_quotes(name)


def between_quotes(name: str) -> str:
    """The name between backquotes, one line whatever it holds."""
    escaped = name.replace("\\", r"\\").replace("`", r"\`")
    return f"`{visible(escaped)}`"


def visible(name: str) -> str:
    """The name with a number in place of every character that cannot be seen."""
    if name.isprintable():
        return name
    return "".join(c if c.isprintable() else f"\\u{{{ord(c):x}}}" for c in name)


def on_one_line(message: str) -> str:
    """A message that may quote what somebody typed, on one line without characters that cannot be seen."""
    return message if message.isprintable() else visible(re.sub(r"\s*[\n\r\t\v\f]\s*", " ", message))


def unquoted(text: str) -> str:
    """The name that stands between these backquotes; ``ValueError`` for an escape that means nothing."""
    body = text[1:-1]
    if "\\" not in body:
        return body
    if "\\" in _ESCAPE.sub("", body):
        raise ValueError("after \\ only a backquote or u{…} is known")
    return _ESCAPE.sub(lambda found: found[2] or chr(int(found[1], 16)), body)
