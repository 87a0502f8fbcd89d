"""Lexer, grammar and error messages of the text syntax: text to surface tree."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from functools import cache
from typing import TYPE_CHECKING, Any

from qe.errors import InputError
from qe.formula.syntax import Relation
from qe.io import surface as s
from qe.io.grammar import parser
from qe.io.names import check_name
from qe.io.terms import TermError, decimal
from qe.io.text_errors import SyntaxFailure, unknown_character
from qe.spelling import QUOTED, WORD, unquoted

if TYPE_CHECKING:
    from lark import Lark, Token

_LIST = rf"(?:{WORD}|{QUOTED})"
_TOKEN = re.compile(
    rf"(?P<SPACE>\s+|\#[^\n]*)"
    rf"|(?P<QUANTIFIER>[EA](?=\s+{_LIST}\s*(?:,\s*{_LIST}\s*)*\.))\b"
    rf"|(?P<NAME>{WORD})"
    r"|(?P<NUMBER>[0-9]+(?:\.[0-9]+)?(?:[eE][+-]?[0-9]+)?)"
    rf"|(?P<QUOTED>{QUOTED})"
    r"|(?P<OPERATOR><==>|<->|==>|->|<=|>=|/=|!=|/\\|\\/|[-+*/^()=<>~,.∃∀∧∨¬→↔⇒⇔≤≥≠−·])"
)
KEYWORDS = {
    **dict.fromkeys(("ex", "exists", "Ex", "all", "forall", "All"), "QUANTIFIER"),
    "and": "AND",
    "or": "OR",
    "not": "NOT",
    "true": "TRUE",
    "false": "FALSE",
}
_OPERATORS = {
    **dict.fromkeys(("∃", "∀"), "QUANTIFIER"),
    **dict.fromkeys(("=", "/=", "!=", "≠", "<", "<=", "≤", ">", ">=", "≥"), "RELATION"),
    "+": "PLUS",
    **dict.fromkeys(("-", "−"), "MINUS"),
    **dict.fromkeys(("*", "·"), "TIMES"),
    "/": "OVER",
    "^": "POWER",
    "(": "OPEN",
    ")": "CLOSE",
    ",": "COMMA",
    ".": "DOT",
    **dict.fromkeys(("/\\", "∧"), "AND"),
    **dict.fromkeys(("\\/", "∨"), "OR"),
    **dict.fromkeys(("~", "¬"), "NOT"),
    **dict.fromkeys(("->", "==>", "→", "⇒"), "IMPLIES"),
    **dict.fromkeys(("<->", "<==>", "↔", "⇔"), "IFF"),
}
_UNIVERSAL = frozenset(("all", "forall", "All", "A", "∀"))
_RELATIONS = {
    **{relation.value: relation for relation in Relation},
    "!=": Relation.NE,
    "≠": Relation.NE,
    "≤": Relation.LE,
    "≥": Relation.GE,
}

# "c" ends with a closed formula, "o" with a quantifier whose body runs on: nothing can follow an "o" inside
# its brackets, which makes the grammar unambiguous. Formulas and terms share the round brackets.
_FORMULAS = """
%declare QUANTIFIER NAME NUMBER RELATION PLUS MINUS TIMES OVER POWER OPEN CLOSE COMMA DOT
%declare AND OR NOT IMPLIES IFF TRUE FALSE
?start: c4 | o4
?c4: c3 | c4 IFF c3             -> iff
?o4: o3 | c4 IFF o3             -> iff
?c3: c2 | c2 IMPLIES c3         -> implies
?o3: o2 | c2 IMPLIES o3         -> implies
?c2: c1 | c2 OR c1              -> some
?o2: o1 | c2 OR o1              -> some
?c1: c0 | c1 AND c0             -> every
?o1: o0 | c1 AND o0             -> every
?c0: base | NOT c0              -> negation
?o0: quantified | NOT o0        -> negation
quantified: QUANTIFIER names DOT start
names: NAME | names COMMA NAME
?base: comparison | TRUE        -> true
     | FALSE                    -> false
     | OPEN start CLOSE         -> brackets
"""
TERMS = """
comparison: sum RELATION sum | comparison RELATION sum
?sum: product | sum PLUS product -> plus
     | sum MINUS product        -> minus
?product: factor | product TIMES factor -> times
     | product OVER factor      -> over
?factor: power | MINUS factor   -> negative
     | PLUS factor              -> positive
?power: primary | primary POWER exponent -> to_power
?exponent: primary | MINUS primary -> negative
?primary: NUMBER                -> number
     | NAME                     -> name
     | NAME OPEN arguments CLOSE -> call
     | OPEN sum CLOSE           -> brackets
arguments: sum | arguments COMMA sum
"""


@cache
def text_parser(start: str = "start") -> Lark:
    """The parser of the text syntax; of its terms with ``start`` "sum"."""
    return parser(_FORMULAS + TERMS, _tokens, Builder(), start=start)


def _tokens(text: str, token: Callable[..., Token]) -> Iterator[Token]:
    at, end, match = 0, len(text), _TOKEN.match
    while at < end:
        found = match(text, at)
        if found is None:
            raise unknown_character(text, at)
        kind, value = found.lastgroup, found.group()
        if kind == "NAME":
            yield token(KEYWORDS.get(value, "NAME"), value, at)
        elif kind == "OPERATOR":
            yield token(_OPERATORS[value], value, at)
        elif kind == "QUOTED":
            yield token("NAME", _name(value, at), at)
        elif kind != "SPACE":
            yield token(kind, value, at)
        at = found.end()


def _name(text: str, at: int) -> str:
    """The name between backquotes."""
    try:
        return check_name(unquoted(text))
    except ValueError as error:
        raise SyntaxFailure(f"the name {text} cannot be read: {error}", at) from None
    except InputError as error:
        raise SyntaxFailure(str(error), at) from None


class Builder:
    """The actions of the grammar; other formats share them."""

    def quantified(self, c: list[Any]) -> s.Node:
        return s.Quantification(str(c[0]) in _UNIVERSAL, c[1], c[3])

    def names(self, c: list[Any]) -> list[str]:
        if len(c) == 1:
            return [str(c[0])]
        return [*c[0], str(c[2])]

    def iff(self, c: list[Any]) -> s.Node:
        return s.Equivalence(c[0], c[2])

    def implies(self, c: list[Any]) -> s.Node:
        return s.Implication(c[0], c[2])

    def some(self, c: list[Any]) -> s.Node:
        if isinstance(c[0], s.Some):
            c[0].parts.append(c[2])
            return c[0]
        return s.Some([c[0], c[2]])

    def every(self, c: list[Any]) -> s.Node:
        if isinstance(c[0], s.Every):
            c[0].parts.append(c[2])
            return c[0]
        return s.Every([c[0], c[2]])

    def negation(self, c: list[Any]) -> s.Node:
        return c[1].part if isinstance(c[1], s.Negation) else s.Negation(c[1])

    def true(self, c: list[Any]) -> s.Node:
        return s.Truth(True)

    def false(self, c: list[Any]) -> s.Node:
        return s.Truth(False)

    def brackets(self, c: list[Any]) -> Any:
        return c[1]

    def comparison(self, c: list[Any]) -> s.Comparison:
        relation = _RELATIONS[c[1]]
        if isinstance(c[0], s.Comparison):
            c[0].relations.append(relation)
            c[0].sides.append(c[2])
            return c[0]
        return s.Comparison([c[0], c[2]], [relation], c[1].start_pos)

    def plus(self, c: list[Any]) -> s.Term:
        if isinstance(c[0], s.Sum):
            c[0].parts.append(c[2])
            return c[0]
        return s.Sum([c[0], c[2]])

    def minus(self, c: list[Any]) -> s.Term:
        return self.plus([c[0], c[1], s.Minus(c[2])])

    def times(self, c: list[Any]) -> s.Term:
        return s.Product(c[0], c[2], c[1].start_pos)

    def over(self, c: list[Any]) -> s.Term:
        return s.Quotient(c[0], c[2], c[1].start_pos)

    def negative(self, c: list[Any]) -> s.Term:
        return c[1].part if isinstance(c[1], s.Minus) else s.Minus(c[1])

    def positive(self, c: list[Any]) -> Any:
        return c[1]

    def to_power(self, c: list[Any]) -> s.Term:
        return s.Power(c[0], c[2], c[1].start_pos)

    def number(self, c: list[Any]) -> s.Term:
        try:
            value = decimal(c[0])
        except TermError as error:
            raise SyntaxFailure(str(error), c[0].start_pos) from None
        return s.Number(value)

    def name(self, c: list[Any]) -> s.Term:
        return s.Name(str(c[0]), c[0].start_pos)

    def arguments(self, c: list[Any]) -> list[s.Term]:
        if len(c) == 1:
            return [c[0]]
        return [*c[0], c[2]]

    def call(self, c: list[Any]) -> s.Term:
        name, arguments = c[0], c[2]
        if name != "root":
            hint = f"only polynomials are allowed, and a product is written {name}*(…)"
            raise SyntaxFailure(f"unknown function {name}; {hint}", name.start_pos)
        variable = arguments[2] if len(arguments) == 3 else None
        if len(arguments) not in (2, 3) or not (variable is None or isinstance(variable, s.Name)):
            usage = "root takes a number, a polynomial and perhaps a variable: root(2, x^2 - y, x)"
            raise SyntaxFailure(usage, name.start_pos)
        return s.Root(arguments[0], arguments[1], variable.name if variable else None, name.start_pos)
