"""The tokens of the text syntax: what people type for the same thing becomes one token.

Bars are told apart here: between a comparison and what follows it ``|`` means "or", in front of a term it opens an
absolute value, and the next one on the same level of brackets closes it. A product without a sign is read where nothing
else can be meant: a number directly in front of a name or a bracket.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from qe.errors import InputError
from qe.io.lalr import Token
from qe.io.names import check_name
from qe.io.text_errors import SyntaxFailure, unknown_character
from qe.spelling import QUOTED, WORD, unquoted

_LIST = rf"(?:{WORD}|{QUOTED})"
_TOKEN = re.compile(
    rf"(?P<SPACE>\s+|\#[^\n]*)"
    rf"|(?P<QUANTIFIER>[EA](?=\s+{_LIST}\s*(?:,\s*{_LIST}\s*)*[.:]))\b"
    r"|(?P<CALL>(?:And|Or|Not|Implies|Equivalent|Xor|Eq|Equal|Ne|Unequal|Lt|Less|Le|LessEqual|Gt|Greater|Ge|GreaterEqual"
    r"|Element|If|ITE|ite)(?=\s*[(\[]))\b"
    rf"|(?P<NAME>{WORD})"
    r"|(?P<NUMBER>(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    rf"|(?P<QUOTED>{QUOTED})"
    r"|(?P<RAISED>⁻?[⁰¹²³⁴-⁹]+)"
    r"|(?P<OPERATOR><==>|<->|<=>|==>|->|<=|>=|==|/=|!=|~=|<>|/\\|\\/|&&|\|\||\*\*|\\\[\w+\]"
    r"|[-+*/^()=<>~,.:∃∀∧∨¬→↔⇒⇔≤≥⩽⩾≠−·×⋅÷∈∞√&|!{}]|\[|\])"
)
KEYWORDS = {
    **dict.fromkeys(("ex", "exists", "Ex", "Exists", "EXISTS", "all", "forall", "All"), "QUANTIFIER"),
    **dict.fromkeys(("ForAll", "Forall", "FORALL"), "QUANTIFIER"),
    **dict.fromkeys(("and", "AND"), "AND"),
    **dict.fromkeys(("or", "OR"), "OR"),
    **dict.fromkeys(("not", "NOT"), "NOT"),
    **dict.fromkeys(("true", "True", "TRUE"), "TRUE"),
    **dict.fromkeys(("false", "False", "FALSE"), "FALSE"),
    **dict.fromkeys(("oo", "infinity", "Infinity"), "INFINITY"),
    "implies": "IMPLIES",
    "iff": "IFF",
    "in": "IN",
    **dict.fromkeys(("Reals", "ℝ"), "REALS"),
    "if": "IF",
    "then": "THEN",
    "else": "ELSE",
}
_OPERATORS = {
    **dict.fromkeys(("∃", "∀"), "QUANTIFIER"),
    **dict.fromkeys(("=", "==", "/=", "!=", "~=", "<>", "≠", "<", "<=", "≤", "⩽", ">", ">=", "≥", "⩾"), "RELATION"),
    "+": "PLUS",
    **dict.fromkeys(("-", "−"), "MINUS"),
    **dict.fromkeys(("*", "·", "×", "⋅"), "TIMES"),
    **dict.fromkeys(("/", "÷"), "OVER"),
    **dict.fromkeys(("^", "**"), "POWER"),
    "(": "OPEN",
    ")": "CLOSE",
    "[": "LEFT",
    "]": "RIGHT",
    "{": "BEGIN",
    "}": "END",
    ",": "COMMA",
    **dict.fromkeys((".", ":"), "DOT"),
    **dict.fromkeys(("/\\", "∧", "&", "&&"), "AND"),
    **dict.fromkeys(("\\/", "∨", "||"), "OR"),
    **dict.fromkeys(("~", "¬", "!"), "NOT"),
    **dict.fromkeys(("->", "==>", "→", "⇒"), "IMPLIES"),
    **dict.fromkeys(("<->", "<=>", "<==>", "↔", "⇔"), "IFF"),
    "∈": "IN",
    "∞": "INFINITY",
    "√": "RADICAL",
    "|": "BAR",
}
_NAMED = {
    **dict.fromkeys(("ForAll", "Exists"), "QUANTIFIER"),
    **dict.fromkeys(("Equal", "NotEqual", "LessEqual", "GreaterEqual"), "RELATION"),
    "And": "AND",
    "Or": "OR",
    "Not": "NOT",
    "Implies": "IMPLIES",
    "Equivalent": "IFF",
    "Element": "IN",
    "Infinity": "INFINITY",
}
_CALLS = {
    **dict.fromkeys(("And", "Or", "Not", "Implies", "Equivalent", "Xor"), "CONNECTIVE"),
    **dict.fromkeys(("Eq", "Equal", "Ne", "Unequal", "Lt", "Less", "Le", "LessEqual"), "COMPARE"),
    **dict.fromkeys(("Gt", "Greater", "Ge", "GreaterEqual"), "COMPARE"),
    **dict.fromkeys(("If", "ITE", "ite"), "CHOICE"),
    "Element": "ELEMENT",
}
_RAISED = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
OPERAND_ENDS = frozenset(("NAME", "NUMBER", "CLOSE", "RIGHT", "END", "CLOSEBAR", "INFINITY", "REALS", "TRUE", "FALSE"))
"""Tokens after which a term or a formula may be complete."""

Make = Callable[..., Token]


def tokens(text: str, token: Make) -> Iterator[Token]:
    """The tokens of a text. Raises ``SyntaxFailure`` where there is none."""
    state = State(text, token)
    at, end, match = 0, len(text), _TOKEN.match
    while at < end:
        found = match(text, at)
        if found is None:
            raise unknown_character(text, at)
        kind, value = found.lastgroup, found.group()
        if kind == "NAME":
            yield from state.put(KEYWORDS.get(value, "NAME"), value, at)
        elif kind == "OPERATOR":
            yield from state.put(_operator(value, at), value, at)
        elif kind == "NUMBER":
            if value[0] == "." and state.header:  # the dot ends the quantifier
                yield from state.put("DOT", ".", at)
                at += 1
                continue
            if value[-1] == "." and text.startswith(".", at + len(value)):
                value = value[:-1]
            yield from state.put("NUMBER", value, at)
        elif kind == "QUOTED":
            yield from state.put("NAME", quoted_name(value, at), at)
        elif kind == "RAISED":
            yield from state.raised(value.translate(_RAISED), at)
        elif kind == "CALL":
            yield from state.put(_CALLS[value], value, at)
        elif kind != "SPACE":
            yield from state.put(str(kind), value, at)
        at += len(value) if kind == "NUMBER" else len(found.group())
        if kind != "SPACE":
            state.end = at


def _operator(value: str, at: int) -> str:
    if not value.startswith("\\["):
        return _OPERATORS[value]
    kind = _NAMED.get(value[2:-1])
    if kind is None:
        raise SyntaxFailure(f"unknown character {value}", at)
    return kind


def quoted_name(text: str, at: int) -> str:
    """The name between backquotes."""
    try:
        return check_name(unquoted(text))
    except ValueError as error:
        raise SyntaxFailure(f"the name {text} cannot be read: {error}", at) from None
    except InputError as error:
        raise SyntaxFailure(str(error), at) from None


class State:
    """What stands before the next token: ``end`` is the offset where the last one ends.

    ``header``: inside a quantifier, before its body. For every level of brackets: the bars that are open, and whether
    there was a comparison since the last connective.
    """

    def __init__(self, text: str, token: Make) -> None:
        self.text, self.token, self.end = text, token, 0
        self.last = ""
        self.header = False
        self.divided = False
        self.bars, self.compared = [0], [False]

    def put(self, kind: str, value: str, at: int) -> Iterator[Token]:
        """The token, with the sign of a product in front of it where that is left out."""
        if kind == "BAR" or (value == "||" and (self.last not in OPERAND_ENDS or self.bars[-1])):
            for k in range(len(value)):
                yield from self.bar(at + k)
            return
        if kind in ("NAME", "OPEN") and self.last == "NUMBER" and self.end == at and not self.header:
            if self.divided:
                shown = f"{self.text[:at].split()[-1]}{value}"
                hint = "write 1/2*x or 1/(2*x)"
                raise SyntaxFailure(f"{shown} is ambiguous: a product without * after a division; {hint}", at)
            yield from self.put("TIMES", "*", at)
        self.note(kind)
        yield self.token(kind, value, at)

    def raised(self, digits: str, at: int) -> Iterator[Token]:
        """A raised number is an exponent."""
        yield from self.put("POWER", "^", at)
        if digits[0] == "-":
            yield from self.put("MINUS", "-", at)
        yield from self.put("NUMBER", digits.lstrip("-"), at)

    def note(self, kind: str) -> None:
        """Keep the state up to date."""
        self.last = kind
        if kind == "QUANTIFIER":
            self.header = True
        elif kind in ("DOT", "OPEN", "LEFT"):
            self.header = False
        if kind == "OVER":
            self.divided = True
        elif kind not in ("NAME", "NUMBER", "POWER", "CLOSE", "RIGHT"):
            self.divided = False
        if kind in ("OPEN", "LEFT", "BEGIN"):
            self.bars.append(0)
            self.compared.append(False)
        elif kind in ("CLOSE", "RIGHT", "END"):
            if len(self.bars) > 1:
                self.bars.pop()
                inner = self.compared.pop()
                self.compared[-1] = self.compared[-1] or inner
        elif kind in ("RELATION", "IN", "TRUE", "FALSE"):
            self.compared[-1] = True
        elif kind in ("AND", "OR", "IMPLIES", "IFF", "DOT", "COMMA", "THEN", "ELSE"):
            self.compared[-1] = False

    def bar(self, at: int) -> Iterator[Token]:
        """A bar opens or closes an absolute value, or means "or"."""
        if self.last not in OPERAND_ENDS:
            kind = "OPENBAR"
        elif self.bars[-1]:
            kind = "CLOSEBAR"
        elif self.compared[-1]:
            kind = "OR"
        else:
            message = "this | can be neither 'or' nor the end of an absolute value; write a product as 2*|x|"
            raise SyntaxFailure(message, at)
        self.bars[-1] += {"OPENBAR": 1, "CLOSEBAR": -1}.get(kind, 0)
        self.note(kind)
        yield self.token(kind, "|", at)
