"""Turns what the text parser met into one helpful line: what is wrong, and what was expected instead."""

from __future__ import annotations

import re
from collections.abc import Collection

from qe.spelling import QUOTED

_QUOTED = re.compile(QUOTED)

_BARS = (
    "bars are not read: 'or' is written or, an absolute value by its cases, "
    "and a name with other characters between backquotes, as in `a b`"
)
_CHARACTERS = {
    "`": "a name between backquotes needs both of them, on one line, and is not empty",
    "&": "'and' is written and",
    "|": _BARS,
    "!": "'not' is written not",
    "[": "only round brackets are used",
    "]": "only round brackets are used",
    "{": "only round brackets are used",
    "}": "only round brackets are used",
    ":": "the variables of a quantifier end with a dot",
    ";": "no end mark is needed",
    "√": "only polynomials are allowed",
    "$": "formulas are plain text",
    "\\": "'or' is written or, 'and' is written and",
}
_SHOWN = {
    "RELATION": "a relation (= /= < <= > >=)",
    "CLOSE": "')'",
    "DOT": "'.'",
    "COMMA": "','",
}


class SyntaxFailure(Exception):
    """A message with an offset; the reader adds the source, line and column."""

    def __init__(self, message: str, at: int, expected: str = "") -> None:
        self.message, self.at, self.expected = message, at, expected


def unknown_character(text: str, at: int) -> SyntaxFailure:
    """No token starts at ``at``."""
    character = text[at]
    if character in "⁰¹²³⁴⁵⁶⁷⁸⁹":
        return SyntaxFailure(f"unknown character '{character}'; a power is written x^2", at)
    hint = _CHARACTERS.get(character)
    shown = f"'{character}'" if character.isprintable() else f"U+{ord(character):04X}"
    return SyntaxFailure(f"unknown character {shown}" + (f"; {hint}" if hint else ""), at)


def unexpected_token(text: str, kind: str, value: str, at: int, expected: Collection[str]) -> SyntaxFailure:
    """A token that cannot stand here; ``kind`` is ``$END`` at the end of the text."""
    before = text[:at].rstrip()
    wanted = _expected(expected)
    if not before and kind == "$END":
        return SyntaxFailure("the text is empty", 0, "a formula")
    if kind == "$END":
        opening = _unmatched_opening(text)
        if opening is not None and "CLOSE" in expected:
            return SyntaxFailure("unbalanced brackets: this '(' is never closed", opening)
        return SyntaxFailure("the text ends too early", len(before), wanted)
    if kind == "CLOSE" and "CLOSE" not in expected and _unmatched_opening(text[:at]) is None:
        return SyntaxFailure("unbalanced brackets: this ')' has no partner", at)
    hint = _hint(text, before, kind, value, at, expected)
    if hint:
        return SyntaxFailure(hint, at)
    return SyntaxFailure(f"unexpected '{value}'", at, wanted)


def _hint(text: str, before: str, kind: str, value: str, at: int, expected: Collection[str]) -> str:
    """The known misunderstandings, by what stands left and right of the offset."""
    previous = before[-1:]
    if value == "*" and previous == "*":
        return "'**' is not used here; a power is written x^2"
    if value in ("=", "==>", "==") and previous == "=":
        return "'==' is not used here; an equation is written with one ="
    if value == ">" and previous == "=":
        return "'=>' is not used here; write >= for a comparison or -> for an implication"
    if value == "=" and previous in "<>" and previous:
        return f"write {previous}= without a space"
    if kind == "POWER":
        return "a^b^c is ambiguous; use brackets"
    if kind in ("NAME", "NUMBER", "OPEN") and "TIMES" in expected:
        left = _last_word(before)
        right = "(…)" if kind == "OPEN" else value
        return f"an operator is missing; a product is written {left}*{right}"
    if kind == "RELATION" and previous == ")" and "AND" in expected:
        return f"'{value}' compares terms, but a formula stands left of it; two formulas are compared with <->"
    return ""


def _last_word(before: str) -> str:
    if before.endswith(")"):
        return "(…)"
    start = len(before)
    while start and (before[start - 1].isalnum() or before[start - 1] in "_'."):
        start -= 1
    return before[start:] or "…"


def _expected(kinds: Collection[str]) -> str:
    """Readable description of the terminals that could have followed."""
    if "QUANTIFIER" in kinds:
        return "a formula"
    if "NUMBER" in kinds:
        return "a number, a variable or '('"
    if "NAME" in kinds:
        return "the name of a variable"
    parts = ["an operator"] if "PLUS" in kinds else ["'and', 'or', '->', '<->'"] if "AND" in kinds else []
    parts += [shown for kind, shown in _SHOWN.items() if kind in kinds]
    if "$END" in kinds:
        parts.append("the end of the text")
    return " or ".join(parts)


def _unmatched_opening(text: str) -> int | None:
    """The offset of the innermost '(' that has no ')' in ``text``; quoted names and comments are skipped."""
    open_at: list[int] = []
    at = 0
    while at < len(text):
        character = text[at]
        if character == "#":
            at = text.find("\n", at) % (len(text) + 1)
        elif character == "`" and (name := _QUOTED.match(text, at)):
            at = name.end() - 1
        elif character == "(":
            open_at.append(at)
        elif character == ")" and open_at:
            open_at.pop()
        at += 1
    return open_at[-1] if open_at else None
