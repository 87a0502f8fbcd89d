"""Redlog formulas (REDUCE syntax): ``ex(x, a*x**2 + b*x + c = 0)``, ``all({x,y}, …)``, ``and or not impl repl equiv``.

The reader also takes ``name := …`` in front, ``;`` or ``$`` at the end, comments from ``%`` to the end of the line,
and ``**`` as well as ``^``. ``e``, ``i`` and ``pi`` are constants of REDUCE and no variables. The writer renames what
REDUCE would misread (its words, letters that are not ASCII) and quotes capitals with ``!``: no case is folded.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from functools import cache
from typing import Any

from qe.errors import InputError
from qe.exact.ring import Poly
from qe.formula.notation import Notation
from qe.formula.syntax import Formula, Relation
from qe.io import surface as s
from qe.io.building import CONNECTIVES, SIGNS, TERMS, Builder
from qe.io.grammar import Failing, parse, parser
from qe.io.lalr import Parser, Token
from qe.io.lowering import lower
from qe.io.names import Renaming, check_name
from qe.io.text_errors import SyntaxFailure, unknown_character

_TOKEN = re.compile(
    r"(?P<SPACE>\s+|%[^\n]*)"
    r"|(?P<NAME>(?:[A-Za-z]|!.)(?:[A-Za-z0-9_]|!.)*)"
    r"|(?P<NUMBER>[0-9]+(?:\.[0-9]+)?(?:[eE][+-]?[0-9]+)?)"
    r"|(?P<OPERATOR>:=|<=|>=|<>|\*\*|[-+*/^()={},<>;$])"
)
_WORDS = {
    "and": "AND",
    "or": "OR",
    "not": "NOT",
    "impl": "IMPLIES",
    "repl": "REPL",
    "equiv": "IFF",
    "true": "TRUE",
    "false": "FALSE",
    "ex": "QUANTIFIER",
    "all": "QUANTIFIER",
    "neq": "RELATION",
    "geq": "RELATION",
    "leq": "RELATION",
    "equal": "RELATION",
    "lessp": "RELATION",
    "greaterp": "RELATION",
}
_RELATIONS = {
    "<>": "/=",
    "neq": "/=",
    "geq": ">=",
    "leq": "<=",
    "equal": "=",
    "lessp": "<",
    "greaterp": ">",
}
_OPERATORS = {
    **dict.fromkeys(("=", "<>", "<", "<=", ">", ">="), "RELATION"),
    **SIGNS,
    "**": "POWER",
    "{": "BEGIN",
    "}": "END",
    ",": "COMMA",
    ":=": "ASSIGN",
    ";": "STOP",
    "$": "STOP",
}
_FORMULAS = f"""
%declare QUANTIFIER NAME NUMBER RELATION PLUS MINUS TIMES OVER POWER OPEN CLOSE COMMA BEGIN END
%declare AND OR NOT IMPLIES REPL IFF TRUE FALSE ASSIGN STOP
?start: formula | NAME ASSIGN formula -> third | formula STOP -> first | NAME ASSIGN formula STOP -> third
{CONNECTIVES}?base: comparison | TRUE        -> true
     | FALSE                    -> false
     | OPEN formula CLOSE       -> brackets
     | QUANTIFIER OPEN variables COMMA formula CLOSE -> quantifier
variables: NAME                 -> names
     | BEGIN names END          -> braced
names: NAME | names COMMA NAME
"""
GRAMMAR = _FORMULAS + TERMS
_CAPITAL = re.compile(r"[A-Z]")
_PLAIN = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_RESERVED = re.compile(
    r"and|or|not|impl|repl|equiv|true|false|ex|all|neq|geq|leq|equal|lessp|greaterp|e|i|pi|t|nil|infinity|df|int|mod|"
    r"if|then|else|for|while|repeat|until|do|begin|end|let|procedure|return|symbolic|algebraic|integer|real|scalar|"
    r"list|first|rest|part|sub|solve|on|off|in|out|write|where|product|sum|union|member|memq|setdiff|freeof|mand|mor|"
    r"bex|ball|equ|cons|eq|difference|quotient|expt|plus|times|minus|go|goto|step|join|collect|each|such|that|ws",
    re.IGNORECASE,
)


def read(text: str, *, source: str = "<text>") -> Formula:
    """The formula that a Redlog text means. Raises ``ParseError`` with line and column."""
    fail = Failing(text, source)
    return lower(parse(_parser(), text, fail), fail)


@cache
def _parser() -> Parser:
    return parser("redlog", GRAMMAR, _tokens, _Builder())


def _tokens(text: str, token: Callable[..., Token]) -> Iterator[Token]:
    at = 0
    while at < len(text):
        found = _TOKEN.match(text, at)
        if found is None:
            raise unknown_character(text, at)
        kind, value = found.lastgroup, found.group()
        if kind == "NAME":
            kind = _WORDS.get(value.lower(), "NAME")
            if value.lower() in ("e", "i", "pi"):
                raise SyntaxFailure(f"{value} is a constant in REDUCE, not a variable", at)
            value = _RELATIONS.get(value.lower(), value) if kind == "RELATION" else value
            yield token(kind, _unescaped(value, at) if kind == "NAME" else value.lower(), at)
        elif kind == "OPERATOR":
            yield token(_OPERATORS[value], _RELATIONS.get(value, value), at)
        elif kind != "SPACE":
            yield token(kind, value, at)
        at = found.end()


def _unescaped(word: str, at: int) -> str:
    """The name without the marks that let a character stand for itself."""
    try:
        return check_name(re.sub(r"!(.)", r"\1", word))
    except InputError as error:
        raise SyntaxFailure(str(error), at) from None


class _Builder(Builder):
    """The actions that only this format has."""

    def first(self, c: list[Any]) -> Any:
        return c[0]

    def third(self, c: list[Any]) -> Any:
        return c[2]

    def braced(self, c: list[Any]) -> Any:
        return c[1]

    def quantifier(self, c: list[Any]) -> s.Node:
        return s.Quantification(str(c[0]) == "all", c[2], c[4])


def write(formula: Formula) -> str:
    """One line that Redlog reads. Raises ``InputError`` for a root atom, which Redlog has no text for."""
    names = Renaming(formula, keeps=_allowed, spell=lambda name: re.sub(r"[^A-Za-z0-9]", "_", f"v{name}"))

    def spelled(name: str) -> str:
        return _CAPITAL.sub(r"!\g<0>", names[name])

    def quantifier(universal: bool, variables: tuple[str, ...]) -> str:
        return f"{'all' if universal else 'ex'}({{{','.join(map(spelled, variables))}}}, "

    notation = Notation(
        name=spelled,
        relation=lambda relation: "<>" if relation is Relation.NE else relation.value,
        quantifier=quantifier,
        root=_no_root,
        conjunction=" and ",
        disjunction=" or ",
        negation="not ",
        true="true",
        false="false",
        scope=("", ")"),
    )
    return formula.written(notation)


def _allowed(name: str) -> bool:
    return bool(_PLAIN.fullmatch(name)) and not _RESERVED.fullmatch(name)


def _no_root(variable: str, relation: Relation, poly: Poly, k: int) -> str:
    raise InputError("root(…) cannot be written in Redlog syntax")
