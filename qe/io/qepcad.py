"""QEPCAD B input: a whole session or one formula, ``(E x)[ a x^2 + b x + c = 0 /\\ ~[ x < 0 ] ]``.

A session is ``[ comment ]``, the list of variables ``(a,b,c,x)``, the number of free ones, the prenex formula ended by
a dot, and commands. Products are written by juxtaposition, formulas are bracketed with ``[ ]``, polynomials with
``( )``. The quantifiers ``F`` (infinitely many), ``G``, ``C`` and ``X`` of QEPCAD are refused, and so are assumptions.
Root atoms are ``x < _root_2 x^2 - y``. The writer brings the formula into prenex form.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from functools import cache
from typing import Any

from qe.exact.ring import Poly
from qe.formula.normal import Quantifier, prenex
from qe.formula.notation import Notation, polynomial, positive
from qe.formula.syntax import Formula, Relation
from qe.io import surface as s
from qe.io.building import CONNECTIVES, SIGNS, TERMS, Builder
from qe.io.grammar import Failing, parse, parser
from qe.io.lalr import Parser, Token
from qe.io.lowering import lower
from qe.io.names import Renaming
from qe.io.text_errors import SyntaxFailure, unknown_character

_SESSION = re.compile(
    r"\s*\[[^\]]*\]\s*\((?P<names>[^()]*)\)\s*(?P<free>[0-9]+)\s*(?P<formula>[^.]*)\.(?P<rest>.*)", re.DOTALL
)
_TOKEN = re.compile(
    r"(?P<SPACE>\s+)"
    r"|(?P<ROOT>(?:<=|>=|/=|[=<>])\s*_root_-?[0-9]+)"
    r"|(?P<NAME>[A-Za-z][A-Za-z0-9_]*'*)"
    r"|(?P<NUMBER>[0-9]+)"
    r"|(?P<OPERATOR><==>|==>|<==|<=|>=|/=|/\\|\\/|[-+*/^()=<>~\[\]])"
)
_QUANTIFIER = re.compile(r"\s*\(\s*(?P<kind>[EAFGC]|X\s*[0-9]+)\s+(?P<name>[A-Za-z][A-Za-z0-9_]*'*)\s*\)")
_OPERATORS = {
    **dict.fromkeys(("=", "/=", "<", "<=", ">", ">="), "RELATION"),
    **SIGNS,
    "[": "BEGIN",
    "]": "END",
    "/\\": "AND",
    "\\/": "OR",
    "~": "NOT",
    "==>": "IMPLIES",
    "<==": "REPL",
    "<==>": "IFF",
}
_FORMULAS = f"""
%declare QUANTIFIER NAME NUMBER RELATION ROOT PLUS MINUS TIMES OVER POWER OPEN CLOSE COMMA BEGIN END
%declare AND OR NOT IMPLIES REPL IFF TRUE FALSE
?start: formula | QUANTIFIER start -> prefixed
{CONNECTIVES}?base: comparison | NAME ROOT sum -> root_comparison
     | TRUE                     -> true
     | FALSE                    -> false
     | BEGIN formula END        -> brackets
"""
_TERMS = TERMS.replace(
    "| product TIMES factor -> times", "| product TIMES factor -> times | product power -> juxtaposed"
)
_TERMS = _TERMS.replace("| NAME OPEN arguments CLOSE -> call", "").replace("arguments: sum | arguments COMMA sum", "")
GRAMMAR = _FORMULAS + _TERMS


def read(text: str, *, source: str = "<text>") -> Formula:
    """The formula of a QEPCAD session or formula text. Raises ``ParseError`` with line and column."""
    fail = Failing(text, source)
    session = _SESSION.fullmatch(text)
    body, start = (session["formula"], session.start("formula")) if session else (text.rstrip().removesuffix("."), 0)
    node = parse(_parser(), " " * start + body, fail)
    formula = lower(node, fail, names=_session_names(session, fail) if session else None)
    if session:
        _check_session(session, node, fail)
    return formula


def _session_names(session: re.Match[str], fail: s.Fail) -> list[str]:
    names = [name.strip() for name in session["names"].split(",") if name.strip()]
    if len(set(names)) != len(names):
        raise fail("a variable is listed twice", session.start("names"))
    return names


def _check_session(session: re.Match[str], node: object, fail: s.Fail) -> None:
    """The counts of a session must fit its formula, and nothing after it may change the question."""
    names, free = _session_names(session, fail), int(session["free"])
    bound: list[str] = []
    while isinstance(node, s.Quantification):
        bound += node.names
        node = node.body
    if names[free:] != bound:
        raise fail(f"quantifiers for {', '.join(names[free:]) or 'nothing'} expected", session.start("formula"))
    if "assume" in session["rest"]:
        at = session.start("rest") + session["rest"].index("assume")
        raise fail("assumptions are not supported; write them into the formula", at)


@cache
def _parser() -> Parser:
    return parser("qepcad", GRAMMAR, _tokens, _Builder())


def _tokens(text: str, token: Callable[..., Token]) -> Iterator[Token]:
    at = 0
    while found := _QUANTIFIER.match(text, at):
        if found["kind"] not in ("E", "A"):
            message = f"the quantifier {found['kind']} is not supported; use E or A"
            raise SyntaxFailure(message, found.start("kind"))
        yield token("QUANTIFIER", f"{found['kind']} {found['name']}", found.start("kind"))
        at = found.end()
    while at < len(text):
        found = _TOKEN.match(text, at)
        if found is None:
            raise unknown_character(text, at)
        kind, value = found.lastgroup, found.group()
        if kind == "NAME" and value in ("TRUE", "FALSE"):
            yield token(value, value, at)
        elif kind == "OPERATOR":
            yield token(_OPERATORS[value], value, at)
        elif kind != "SPACE":
            yield token(kind, value, at)
        at = found.end()


class _Builder(Builder):
    """The actions that only this format has."""

    def prefixed(self, c: list[Any]) -> s.Node:
        kind, name = str(c[0]).split()
        return s.Quantification(kind == "A", [name], c[1])

    def juxtaposed(self, c: list[Any]) -> s.Term:
        return s.Product(c[0], c[1], -1)

    def root_comparison(self, c: list[Any]) -> s.Node:
        relation, _, k = str(c[1]).partition("_root_")
        root = s.Root(s.Number(int(k)), c[2], None, c[1].start_pos)
        return s.Comparison([self.name([c[0]]), root], [Relation(relation.strip())], c[1].start_pos)


def write(formula: Formula) -> str:
    """A whole session, ended by ``finish``, for the prenex form of ``formula``."""
    prefix, matrix = prenex(formula)
    free = (matrix if not prefix else formula).free
    order = [*free, *(name for _, block in prefix for name in block)]
    names = Renaming(matrix, keeps=_allowed, spell=lambda name: re.sub(r"[^A-Za-z0-9]", "", f"v{name}"), filler="v")
    quantifiers = "".join(
        f"({'E' if kind is Quantifier.EXISTS else 'A'} {names[name]})" for kind, block in prefix for name in block
    )
    listing = ",".join(names[name] for name in order) or _UNUSED
    body = f"{quantifiers}[{matrix.written(_notation(names))}]"
    return f"[]\n({listing})\n{max(len(free), 0 if order else 1)}\n{body}.\nfinish\n"


_UNUSED = "x"


def _allowed(name: str) -> bool:
    return re.fullmatch(r"[A-Za-z][A-Za-z0-9]*", name) is not None and name not in ("TRUE", "FALSE")


def _notation(names: Renaming) -> Notation:
    def root(variable: str, relation: Relation, poly: Poly, k: int) -> str:
        return f"{names[variable]} {relation.value} _root_{k} {polynomial(positive(poly), notation)}"

    notation = Notation(
        name=lambda name: names[name],
        relation=lambda relation: relation.value,
        quantifier=lambda universal, variables: "",
        root=root,
        conjunction=" /\\ ",
        disjunction=" \\/ ",
        negation="~",
        true="0 = 0",
        false="0 = 1",
        times=" ",
        brackets=("[", "]"),
        strict=True,
    )
    return notation
