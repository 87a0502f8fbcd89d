"""Redlog formulas (REDUCE syntax): ``ex(x, a*x**2 + b*x + c = 0)``, ``all({x,y}, …)``, ``and or not impl repl equiv``.

The reader also takes ``name := …`` in front and ``rlqe(formula, {a > 0})`` (and ``rlcad``, …; the theory is what the
question is asked under). The writer renames what REDUCE would misread (its words, letters that are not ASCII) and
quotes capitals with ``!``: no case is folded.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from qe.errors import InputError
from qe.exact.ring import Poly
from qe.formula.build import conj
from qe.formula.notation import Notation
from qe.formula.syntax import Formula, Relation
from qe.io.lowering import lower
from qe.io.names import check_name, renaming
from qe.io.parser import FORMULA, INFIX, NOT, PREFIX, REPLIED, Prefix, parsed
from qe.io.substitution import over_one_ring
from qe.io.text_errors import Failing, SyntaxFailure
from qe.io.text_quantifiers import QuantifiedParser
from qe.io.tokens import END, REDLOG, SIGNS, Token, kinds, matches

_TOKEN = re.compile(
    r"(?P<SPACE>\s+|%[^\n]*)"
    r"|(?P<NAME>(?:[A-Za-z]|!.)(?:[A-Za-z0-9_]|!.)*)"
    r"|(?P<NUMBER>[0-9]+(?:\.[0-9]+)?(?:[eE][+-]?[0-9]+)?)"
    r"|(?P<OPERATOR>:=|<=|>=|<>|\*\*|[-+*/^()={},<>;$])"
)
_ASSIGNMENT = re.compile(r"(?:\s|%[^\n]*\n)*[A-Za-z!](?:[A-Za-z0-9_]|!.)*\s*:=")
_WORDS = kinds("""
AND and
OR or
NOT not
IMPLIES impl
REPL repl
IFF equiv
TRUE true
FALSE false
QUANTIFIER ex all
RELATION neq geq leq equal lessp greaterp
""")
_RELATIONS = kinds("/= <> neq\n>= geq\n<= leq\n= equal\n< lessp\n> greaterp")
_KINDS = {**SIGNS, **kinds("RELATION = <> < <= > >=\nPOWER **\nBEGIN {\nEND }\nASSIGN :=\nSTOP ; $")}
_CALL = re.compile(REDLOG, re.IGNORECASE)
_CAPITAL = re.compile(r"[A-Z]")
_PLAIN = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_RESERVED = re.compile(
    r"and|or|not|impl|repl|equiv|true|false|ex|all|neq|geq|leq|equal|lessp|greaterp|e|i|pi|t|nil|infinity|df|int|mod|"
    r"if|then|else|for|while|repeat|until|do|begin|end|let|procedure|return|symbolic|algebraic|integer|real|scalar|"
    r"list|first|rest|part|sub|solve|on|off|in|out|write|where|product|sum|union|member|memq|setdiff|freeof|mand|mor|"
    r"bex|ball|equ|cons|eq|difference|quotient|expt|plus|times|minus|go|goto|step|join|collect|each|such|that|ws",
    re.IGNORECASE,
)


def read_posed(text: str, *, source: str = "<text>") -> tuple[Formula, Formula]:
    """The formula that a Redlog text means, and the theory under which it is asked, TRUE without; over one ring.

    Raises ``ParseError`` with line and column."""
    fail = Failing(text, source)
    formula, *known = over_one_ring(*(lower(part, fail) for part in parsed(_Parser, text, fail)))
    return formula, conj(known)


def _is_closed(text: str) -> bool:
    """Whether the bracket with which a text begins is closed at its end, where only a sign may come after it."""
    depth = 0
    for match in re.finditer(r"%[^\n]*|[()]", text):
        depth += {"(": 1, ")": -1}.get(match.group(), 0)
        if depth == 0 and match.group() == ")":
            return not re.sub(r"%[^\n]*|[;$\s]", "", text[match.end() :])
    return True


def _unescaped(word: str, at: int) -> str:
    """The name without the marks that let a character stand for itself."""
    try:
        return check_name(re.sub(r"!(.)", r"\1", word))
    except InputError as error:
        raise SyntaxFailure(str(error), at) from None


class _Parser(QuantifiedParser):
    """What only this format has: quantifiers as calls alone, an assignment in front, and a sign at the end."""

    def lexed(self, text: str) -> Iterator[Token]:
        assignment = _ASSIGNMENT.match(text)
        for kind, value, at in matches(_TOKEN, text, assignment.end() if assignment else 0):
            word = value.lower()
            if kind != "NAME":
                yield Token(_KINDS.get(value, kind), _RELATIONS.get(value, value), at)
            elif word in ("e", "i", "pi"):
                raise SyntaxFailure(f"{value} is a constant in REDUCE, not a variable", at)
            elif word in _WORDS:
                yield Token(_WORDS[word], _RELATIONS.get(word, word), at)
            else:
                yield Token(kind, _unescaped(value, at), at)

    def whole(self, wants: int = FORMULA) -> list[Any]:
        """The formula, and the conditions of its theory."""
        called = _CALL.fullmatch(self.token.text) is not None and self.skip("NAME")
        bracket = called and _is_closed(self.text[self.token.at :]) and self.skip("OPEN")
        ends = ("COMMA", "CLOSE" if bracket else "STOP") if called else ("STOP",)
        parts = [self.expression(wants, *ends, END)]
        if self.skip("COMMA"):
            self.take("BEGIN")
            parts += [] if self.token.kind == "END" else self.several(wants, "END")
            self.take("END")
        if bracket:
            self.take("CLOSE")
        if self.take("STOP", END).kind == "STOP":
            self.take(END)
        return parts

    def quantifier(self) -> None:
        token = self.advance()
        if self.token.kind != "OPEN":
            raise self.unexpected(("OPEN",))
        self.quantified_call(token)

    infix = {**INFIX, **REPLIED}  # noqa: RUF012
    prefix = {**PREFIX, "QUANTIFIER": Prefix(FORMULA, NOT, quantifier)}  # noqa: RUF012


def write(formula: Formula) -> str:
    """One line that Redlog reads. Raises ``InputError`` for a root atom, which Redlog has no text for."""
    names = renaming(formula, keeps=_allowed, spell=lambda name: re.sub(r"[^A-Za-z0-9]", "_", f"v{name}"))

    def spelled(name: str) -> str:
        return _CAPITAL.sub(r"!\g<0>", names[name])

    def quantifier(universal: bool, variables: tuple[str, ...]) -> str:
        return f"{'all' if universal else 'ex'}({{{','.join(map(spelled, variables))}}}, "

    notation = Notation(
        name=spelled,
        relation=lambda relation: "<>" if relation is Relation.NE else relation.value,
        quantifier=quantifier,
        root=_no_root,
        scope=("", ")"),
    )
    return formula.written(notation)


def _allowed(name: str) -> bool:
    return bool(_PLAIN.fullmatch(name)) and not _RESERVED.fullmatch(name)


def _no_root(variable: str, relation: Relation, poly: Poly, k: int) -> str:
    raise InputError("root(…) cannot be written in Redlog syntax")
