"""QEPCAD B input: a whole session or one formula, ``(E x)[ a x^2 + b x + c = 0 /\\ ~[ x < 0 ] ]``.

A session is ``[ comment ]``, the list of variables ``(a,b,c,x)``, the number of free ones, the prenex formula ended by
a dot, and commands, of which ``assume [ a > 0 ]`` says what the question is asked under. Root atoms are
``x < _root_2 x^2 - y``. The writer brings the formula into prenex form.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import ClassVar

from qe.exact.ring import Poly
from qe.formula.build import conj, convert
from qe.formula.normal import Quantifier, prenex
from qe.formula.notation import Notation, polynomial, positive
from qe.formula.syntax import TRUE, Formula, Relation
from qe.io import parser as p
from qe.io import surface as s
from qe.io.lowering import lower
from qe.io.names import renaming
from qe.io.parser import FORMULA, TERM, Infix, Parser, Prefix, Waiting, parsed
from qe.io.text_errors import Failing
from qe.io.text_quantifiers import quantified
from qe.io.tokens import SIGNS, Token, kinds, matches

_SESSION = re.compile(
    r"\s*\[[^\]]*\]\s*\((?P<names>[^()]*)\)\s*(?P<free>[0-9]+)\s*(?P<formula>[^.]*)\.(?P<rest>.*)", re.DOTALL
)
_ASSUME = re.compile(r"\bassume\s*\[")
_TOKEN = re.compile(
    r"(?P<SPACE>\s+)"
    r"|(?P<ROOT>(?:<=|>=|/=|[=<>])\s*_root_-?[0-9]+)"
    r"|(?P<NAME>[A-Za-z][A-Za-z0-9_]*'*)"
    r"|(?P<NUMBER>[0-9]+)"
    r"|(?P<OPERATOR><==>|==>|<==|<=|>=|/=|/\\|\\/|[-+*/^()=<>~\[\]])"
)
_QUANTIFIER = re.compile(r"\s*\(\s*(?P<kind>[EAFGC]|X\s*[0-9]+)(?:\s+|(?=[a-z]))(?P<name>[A-Za-z][A-Za-z0-9_]*'*)\s*\)")
_KINDS = SIGNS | kinds(r"""
RELATION = /= < <= > >=
BEGIN [
END ]
AND /\
OR \/
NOT ~
IMPLIES ==>
REPL <==
IFF <==>
TRUE TRUE
FALSE FALSE
""")


def read_posed(text: str, *, source: str = "<text>") -> tuple[Formula, Formula]:
    """The formula of a session or of a text, and over its ring what is assumed, TRUE without. Raises ``ParseError``."""
    fail = Failing(text, source)
    session = _SESSION.fullmatch(text)
    body, start = (session["formula"], session.start("formula")) if session else (text.rstrip().removesuffix("."), 0)
    node = parsed(_Parser, " " * start + body, fail)
    if session is None:
        return lower(node, fail), TRUE
    names = [name.strip() for name in session["names"].split(",") if name.strip()]
    if len(set(names)) != len(names):
        raise fail("a variable is listed twice", session.start("names"))
    formula = lower(node, fail, names=names)
    _check_session(session, names, node, fail)
    return formula, conj(_assumed(session, names, formula, fail))


def _check_session(session: re.Match[str], names: list[str], node: object, fail: s.Fail) -> None:
    """The counts of a session must fit its formula, and nothing after it may change the question."""
    free = int(session["free"])
    bound: list[str] = []
    while isinstance(node, s.Quantification | s.Quantity):
        bound += node.names if isinstance(node, s.Quantification) else [node.name]
        node = node.body
    if names[free:] != bound:
        raise fail(f"quantifiers for {', '.join(names[free:]) or 'nothing'} expected", session.start("formula"))


def _assumed(session: re.Match[str], names: list[str], formula: Formula, fail: Failing) -> Iterator[Formula]:
    """The conditions of the commands ``assume``, over the ring of the formula."""
    text = session.string
    for command in _ASSUME.finditer(text, session.start("rest")):
        depth, end = 0, command.end() - 1
        while end < len(text) and (depth := depth + {"[": 1, "]": -1}.get(text[end], 0)):
            end += 1
        condition = lower(parsed(_Parser, " " * (command.end() - 1) + text[command.end() - 1 : end + 1], fail), fail)
        if unknown := sorted({*condition.free}.difference(names)):
            raise fail(f"a variable of the session expected, {unknown[0]} found", command.end())
        yield convert(condition, formula.ring) if formula.ring else condition


def _root_comparison(left: s.Term, right: s.Term, token: Token) -> s.Node:
    relation, _, k = token.text.partition("_root_")
    return s.Comparison([left, s.Root(s.Number(int(k)), right, None, token.at)], [Relation(relation.strip())], token.at)


class _Parser(Parser):
    """What only this format has: quantifiers in front, products without a sign, and root atoms."""

    def lexed(self, text: str) -> Iterator[Token]:
        at = 0
        while match := _QUANTIFIER.match(text, at):
            kind = match["kind"]
            yield Token("QUANTIFIER", f"{kind[0]} {kind[1:]} {match['name']}", match.start("kind"))
            at = match.end()
        for kind, value, start in matches(_TOKEN, text, at):
            yield Token(_KINDS.get(value, kind), value, start)

    def quantifier(self) -> None:
        token = self.advance()
        *kind, name = token.text.split()
        mark = token._replace(text=" ".join(kind))
        self.stack.append(Waiting(p.BODY, FORMULA, FORMULA, lambda body: quantified(mark, [name], None, body)))

    def bracket(self) -> None:
        """Round brackets hold terms, square ones formulas."""
        self.open(*((TERM, "CLOSE") if self.advance().kind == "OPEN" else (FORMULA, "END")))

    calls: ClassVar = {"NAME": ()}
    infix = {  # noqa: RUF012
        **p.INFIX,
        **p.REPLIED,
        "ROOT": Infix(p.RELATION, p.RELATION, p.SIMPLE, TERM, FORMULA, _root_comparison),
        **dict.fromkeys(("NAME", "NUMBER", "OPEN"), p.JUXTAPOSED),
    }
    prefix = {  # noqa: RUF012
        **p.PREFIX,
        "QUANTIFIER": Prefix(FORMULA, p.BODY, quantifier),
        "OPEN": Prefix(TERM, p.PRIMARY, bracket),
        "BEGIN": Prefix(FORMULA, p.NOT, bracket),
    }


def write(formula: Formula) -> str:
    """A whole session, ended by ``finish``, for the prenex form of ``formula``."""
    prefix, matrix = prenex(formula)
    free = (matrix if not prefix else formula).free
    order = [*free, *(name for _, block in prefix for name in block)]
    names = renaming(matrix, keeps=_allowed, spell=lambda name: re.sub(r"[^A-Za-z0-9]", "", f"v{name}"), filler="v")
    quantifiers = "".join(
        f"({'E' if kind is Quantifier.EXISTS else 'A'} {names[name]})" for kind, block in prefix for name in block
    )
    listing = ",".join(names[name] for name in order) or "x"
    body = f"{quantifiers}[{matrix.written(_notation(names))}]"
    return f"[]\n({listing})\n{max(len(free), 0 if order else 1)}\n{body}.\nfinish\n"


def _allowed(name: str) -> bool:
    return re.fullmatch(r"[A-Za-z][A-Za-z0-9]*", name) is not None and name not in ("TRUE", "FALSE")


def _notation(names: Mapping[str, str]) -> Notation:
    def root(variable: str, relation: Relation, poly: Poly, k: int) -> str:
        return f"{names[variable]} {relation.value} _root_{k} {polynomial(positive(poly), notation)}"

    notation = Notation(
        name=lambda name: names[name],
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
