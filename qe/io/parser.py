"""One operator-precedence parser for text, LaTeX, QEPCAD and Redlog: from tokens to surface trees.

Operators are rows of a table with their level (R. W. Floyd, Syntactic analysis and operator precedence, J. ACM 10,
1963; V. R. Pratt, Top down operator precedence, POPL 1973). Formulas and terms share the round brackets: the sort of an
operand says which operators may follow it. What is not yet complete waits on a stack, so that brackets, signs and
quantifiers may be nested as deeply as they like; and the stack says what could have stood where a text goes wrong.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Iterator
from fractions import Fraction
from functools import reduce
from itertools import chain
from typing import Any, ClassVar, NamedTuple
from unicodedata import normalize

from qe.formula.quantity import MOST
from qe.formula.relation import Relation
from qe.io import surface as s
from qe.io.terms import TermError, decimal
from qe.io.text_errors import Failing, SyntaxFailure, not_understood, unexpected_token, unknown_function
from qe.io.tokens import END, Token

RELATIONS = {
    **{relation.value: relation for relation in Relation},
    **dict.fromkeys(("==", "\\[Equal]", "Eq", "Equal"), Relation.EQ),
    **dict.fromkeys(("!=", "~=", "<>", "=/=", "=!=", "≠", "\\[NotEqual]", "Ne", "Unequal"), Relation.NE),
    **dict.fromkeys(("=<", "≤", "⩽", "\\[LessEqual]", "Le", "LessEqual"), Relation.LE),
    **dict.fromkeys(("≥", "⩾", "\\[GreaterEqual]", "Ge", "GreaterEqual"), Relation.GE),
    **dict.fromkeys(("Lt", "Less"), Relation.LT),
    **dict.fromkeys(("Gt", "Greater"), Relation.GT),
}
FUNCTIONS = {
    **{spelt: name for name in s.FUNCTIONS for spelt in (name, name.capitalize(), name.upper())},
    **dict.fromkeys(("sgn", "Sgn"), "sign"),
    "CubeRoot": "cbrt",
}
OPERATIONS: dict[str, Callable[[s.Term, s.Term, int], s.Term]] = {
    "Plus": lambda a, b, at: s.Sum([a, b]),
    "Times": s.Product,
    "Power": s.Power,
    "Rational": s.Quotient,
    "Divide": s.Quotient,
    "Subtract": lambda a, b, at: s.Sum([a, s.Minus(b)]),
}
"""Mathematica's names for the signs of operations."""


def applied(text: str, token: Token, arguments: list[s.Term]) -> s.Term:
    """What the name ``token`` means in front of arguments. Raises ``SyntaxFailure`` where that is nothing."""
    name, at = token.text, token.at
    function = FUNCTIONS.get(name)
    if function is not None:
        least, most = s.FUNCTIONS[function]
        if not least <= len(arguments) <= most:
            raise SyntaxFailure(f"{name} takes {least} argument{'s' if least > 1 else ''}", at)
        return s.Apply(function, arguments, at)
    if (operation := OPERATIONS.get(name)) is not None and (
        len(arguments) == 2 or name in ("Plus", "Times") or (name == "Rational" and len(arguments) == 1)
    ):
        made: s.Term = reduce(lambda left, right: operation(left, right, at), arguments)
        return made
    if name not in ("root", "Root"):
        raise unknown_function(text, name, at)
    variable = arguments[2] if len(arguments) == 3 else None
    if len(arguments) not in (2, 3) or not (variable is None or isinstance(variable, s.Name)):
        raise SyntaxFailure("root takes a number, a polynomial and perhaps a variable: root(2, x^2 - y, x)", at)
    number, poly = arguments[:2]
    if isinstance(poly, s.Name) and isinstance(number, s.Number) and number.value > 1:
        radical = f"{poly.name}^(1/{number.value})"
        raise SyntaxFailure(f"root(k, p) is the k-th root of a polynomial; a radical is {radical}", at)
    if isinstance(poly, s.Number):
        raise SyntaxFailure(f"root takes a number, then a polynomial; a radical is t^(1/{poly.value})", at)
    return s.Root(number, poly, variable.name if variable else None, at)


BRACKET, BODY, IFF, IMPLIES, OR, AND, NOT, RELATION, ELSE, SUM, PRODUCT, SIGN, POWER, PRIMARY = range(14)
"""Levels, from loose to tight; ``BODY``: of a quantifier, ``ELSE``: the last part of a case distinction of terms."""

TERM, FORMULA, CHAIN, SIMPLE = 1, 2, 4, 8
"""Sorts, as bits: ``CHAIN`` is a comparison that another relation may extend, ``SIMPLE`` a term that takes a power."""
EITHER = TERM | FORMULA


def counted(number: str, at: int) -> int:
    """The number of a quantifier that counts; 0 without one."""
    if number and not 0 <= int(number[:9]) <= MOST:
        raise SyntaxFailure(f"at most {MOST} values are counted", at)
    return int(number or 0)


class Infix(NamedTuple):
    """An operator between two operands; what waits on the stack from the level ``limit`` on is its left operand.

    ``takes``, ``wants``: the sorts of its left and right operand; ``gives``: the sort of ``make(left, right, token)``.
    One that is not ``written`` stands in front of the token, with which the right operand begins.
    """

    level: int
    limit: int
    takes: int
    wants: int
    gives: int
    make: Callable[[Any, Any, Token], Any]
    written: bool = True


class Prefix(NamedTuple):
    """What may start an operand of these sorts behind operators up to the level ``highest``: ``read`` takes its tokens
    and gives the operand, or None where it waits on the stack for more."""

    sorts: int
    highest: int
    read: Callable[[Any], Any]


class Waiting(NamedTuple):
    """An operator that waits for its last operand, or a bracket (with ``parts``) that waits for one of ``closing``."""

    level: int
    wants: int
    gives: int
    make: Callable[[Any], Any]
    closing: Collection[str] = ()
    parts: list[Any] = []  # noqa: RUF012  (a bracket has a list of its own)


class Parser(ABC):
    """Reads one text; a format is a subclass with its tokens and its tables. ``token``: the next one."""

    calls: ClassVar[dict[str, tuple[str, ...]]] = {"NAME": ("OPEN", "LEFT")}
    """The brackets that make a call of the token in front of them."""
    infix: ClassVar[dict[str, Infix]]
    prefix: ClassVar[dict[str, Prefix]]

    def __init__(self, text: str) -> None:
        self.text = text
        self.tokens = chain(self.lexed(text), (Token(END, "", len(text)),))
        self.token = next(self.tokens)
        self.stack: list[Waiting] = []
        self.depth = 0

    @abstractmethod
    def lexed(self, text: str) -> Iterator[Token]:
        """The tokens of a text."""

    def whole(self, wants: int = FORMULA) -> Any:
        """What the text is. Raises ``SyntaxFailure`` where it is not of the sort ``wants``."""
        return self.expression(wants, END)

    def expression(self, wants: int, *ends: str) -> Any:
        """The formula or term that comes here, up to a token of the kinds ``ends``, which is not taken."""
        self.depth += 1
        if self.depth > s.MAX_DEPTH:
            raise SyntaxFailure(f"nested more than {s.MAX_DEPTH} levels deep", self.token.at)
        outside, self.stack = self.stack, [Waiting(BRACKET, wants, wants, _only, ends)]
        value = self.operand()
        while True:
            waiting = self.waiting_on(value, self.token.kind)
            if not waiting:
                raise self.unexpected(self.following(value))
            while len(self.stack) > waiting:
                value = self.stack.pop().make(value)
            operator = self.operator(self.token.kind)
            if operator is not None:
                value = self.joined(value, operator)
            elif waiting > 1:
                value = self.bracketed(value)
            else:
                self.stack = outside
                self.depth -= 1
                return value

    def operand(self) -> Any:
        """The next operand; prefix operators and opening brackets in front of it go to the stack."""
        while True:
            start = self.prefix.get(self.token.kind)
            if start is None or not self.may_start(start):
                raise self.unexpected({kind for kind, start in self.prefix.items() if self.may_start(start)})
            value = start.read(self)
            if value is not None:
                return value

    def may_start(self, start: Prefix) -> bool:
        """Whether it may start the operand that is due."""
        last = self.stack[-1]
        return last.level <= start.highest and bool(start.sorts & (last.wants | TERM))

    def waiting_on(self, value: Any, kind: str) -> int:
        """How many of the stack go on waiting if a token of this kind follows ``value``; 0 where it cannot follow."""
        operator = self.operator(kind)
        limit = BODY if operator is None else operator.limit
        sort = TERM | SIMPLE if type(value) in s.TERMS else FORMULA
        count = len(self.stack)
        while (last := self.stack[count - 1]).level >= limit:
            if not last.wants & sort:
                return 0
            sort = last.gives
            count -= 1
        if operator is None:
            fits = bool(last.wants & sort) and kind in last.closing
        else:
            fits = bool(operator.takes & sort and operator.gives & (last.wants | TERM))
        return count if fits else 0

    def operator(self, kind: str) -> Infix | None:
        """The infix operator that a token of this kind is; a product that is not written goes where it can."""
        operator = self.infix.get(kind)
        return None if operator is JUXTAPOSED and kind in self.stack[0].closing else operator

    def joined(self, left: Any, operator: Infix) -> Any:
        """Put an infix operator behind ``left``; the operand that comes after it."""
        token, make = self.advance() if operator.written else self.token, operator.make
        waiting = Waiting(operator.level, operator.wants, operator.gives, lambda right: make(left, right, token))
        self.stack.append(waiting)
        return self.operand()

    def bracketed(self, value: Any) -> Any:
        """Take the comma or the closing bracket behind the last part of a bracket; the operand that comes of it."""
        parts = self.stack[-1].parts
        parts.append(value)
        if self.advance().kind == "COMMA":
            return self.operand()
        return self.stack.pop().make(parts)

    def open(
        self, wants: int, closing: str, make: Callable[[list[Any]], Any] = lambda parts: parts[0], *, many: bool = False
    ) -> None:
        """Open a bracket of one part or of ``many``, of which ``make`` makes an operand."""
        self.stack.append(Waiting(BRACKET, wants, 0, make, (closing, "COMMA") if many else (closing,), []))

    def advance(self) -> Token:
        """Take the next token; the end stays."""
        token = self.token
        self.token = next(self.tokens, token)
        return token

    def take(self, *kinds: str) -> Token:
        """Take the next token, which has to be of one of these kinds."""
        if self.token.kind not in kinds:
            raise self.unexpected(kinds)
        return self.advance()

    def skip(self, kind: str) -> bool:
        """Take the next token if it is of this kind; whether it is."""
        return self.token.kind == kind and bool(self.advance())

    def part(self, wants: int, *ends: str) -> Any:
        """The formula or term that comes here; the token behind it, one of ``ends``, is taken."""
        value = self.expression(wants, *ends)
        self.advance()
        return value

    def several(self, wants: int, *ends: str, sign: str = "COMMA") -> list[Any]:
        """Formulas or terms with a sign between them, up to a token of the kinds ``ends``, which is not taken."""
        parts = [self.expression(wants, sign, *ends)]
        while self.skip(sign):
            parts.append(self.expression(wants, sign, *ends))
        return parts

    def following(self, value: Any) -> set[str]:
        """The kinds of tokens that could follow an operand."""
        closing = (kind for waiting in self.stack for kind in waiting.closing)
        operators = (kind for kind, operator in self.infix.items() if operator.written)
        return {kind for kind in chain(operators, closing) if self.waiting_on(value, kind)}

    def unexpected(self, expected: Collection[str]) -> SyntaxFailure:
        """The next token cannot stand here, where one of these kinds could."""
        return unexpected_token(self.text, *self.token, expected)

    # --- operands that formats share -------------------------------------------------------------------------
    def number(self) -> s.Term:
        _, text, at = self.advance()
        if not text.isascii():  # ½ and its kind
            return s.Number(Fraction(normalize("NFKC", text).replace("⁄", "/")))
        try:
            return s.Number(decimal(text))
        except TermError as error:
            raise SyntaxFailure(str(error), at) from None

    def name_or_call(self) -> s.Term | None:
        token = self.advance()
        if self.token.kind not in self.calls[token.kind]:
            return s.Name(token.text, token.at)
        self.open(TERM, CLOSES[self.advance().kind], lambda parts: applied(self.text, token, parts), many=True)
        return None

    def truth(self) -> s.Node:
        return s.Truth(self.advance().kind == "TRUE")

    def round_bracket(self) -> None:
        wants = EITHER if self.stack[-1].wants & FORMULA else TERM
        self.advance()
        self.open(wants, "CLOSE")

    def sign(self) -> None:
        """A sign; that of an exponent belongs to what stands directly behind it."""
        level = PRIMARY if self.stack[-1].level == POWER else SIGN
        make = _negative if self.advance().kind == "MINUS" else _only
        self.stack.append(Waiting(level, TERM, TERM, make))

    def negation(self) -> None:
        self.advance()
        self.stack.append(Waiting(NOT, FORMULA, FORMULA, _negated))


def parsed(parser: type[Parser], text: str, fail: Failing, wants: int = FORMULA) -> Any:
    """What ``text`` is. Raises ``ParseError``, one line with line, column and what was expected."""
    try:
        return parser(text).whole(wants)
    except SyntaxFailure as error:
        raise not_understood(fail(error.message, error.at, error.expected), text) from None


def _only(value: Any) -> Any:
    return value


def _negative(part: s.Term) -> s.Term:
    if isinstance(part, s.Number):
        return s.Number(-part.value)
    return part.part if isinstance(part, s.Minus) else s.Minus(part)


def _negated(part: s.Node) -> s.Node:
    return part.part if isinstance(part, s.Negation) else s.Negation(part)


def _joining(kind: type[s.Every] | type[s.Some] | type[s.Sum]) -> Callable[[Any, Any, Token], Any]:
    """Makes one node of many parts; long chains are not copied again and again."""

    def make(left: Any, right: Any, token: Token) -> Any:
        if isinstance(left, kind):
            left.parts.append(right)
            return left
        return kind([left, right])

    return make


def _comparison(left: Any, right: s.Term, token: Token) -> s.Comparison:
    relation = RELATIONS[token.text]
    if isinstance(left, s.Comparison):
        left.relations.append(relation)
        left.sides.append(right)
        return left
    return s.Comparison([left, right], [relation], token.at)


_plus = _joining(s.Sum)
CLOSES = {"OPEN": "CLOSE", "LEFT": "RIGHT", "BEGIN": "END"}
"""The kinds of brackets: what opens them, and what closes them."""
INFIX = {
    "IFF": Infix(IFF, IFF, FORMULA, FORMULA, FORMULA, lambda left, right, _: s.Equivalence(left, right)),
    "IMPLIES": Infix(IMPLIES, OR, FORMULA, FORMULA, FORMULA, lambda left, right, _: s.Implication(left, right)),
    "OR": Infix(OR, OR, FORMULA, FORMULA, FORMULA, _joining(s.Some)),
    "AND": Infix(AND, AND, FORMULA, FORMULA, FORMULA, _joining(s.Every)),
    "RELATION": Infix(RELATION, RELATION, TERM | CHAIN, TERM, FORMULA | CHAIN, _comparison),
    "PLUS": Infix(SUM, SUM, TERM, TERM, TERM, _plus),
    "MINUS": Infix(SUM, SUM, TERM, TERM, TERM, lambda left, right, token: _plus(left, s.Minus(right), token)),
    "TIMES": Infix(PRODUCT, PRODUCT, TERM, TERM, TERM, lambda left, right, token: s.Product(left, right, token.at)),
    "OVER": Infix(PRODUCT, PRODUCT, TERM, TERM, TERM, lambda left, right, token: s.Quotient(left, right, token.at)),
    "POWER": Infix(POWER, POWER, SIMPLE, TERM, TERM, lambda left, right, token: s.Power(left, right, token.at)),
}
"""The operators that all formats share; only implication goes to the right."""
JUXTAPOSED = INFIX["TIMES"]._replace(written=False)
"""A product without a sign."""
REPLIED = {"REPL": Infix(IMPLIES, OR, FORMULA, FORMULA, FORMULA, lambda left, right, _: s.Implication(right, left))}
"""The implication that is written backwards."""
PREFIX = {
    "NUMBER": Prefix(TERM, PRIMARY, Parser.number),
    "NAME": Prefix(TERM, PRIMARY, Parser.name_or_call),
    "OPEN": Prefix(TERM, PRIMARY, Parser.round_bracket),
    "MINUS": Prefix(TERM, POWER, Parser.sign),
    "PLUS": Prefix(TERM, SIGN, Parser.sign),
    "NOT": Prefix(FORMULA, NOT, Parser.negation),
    "TRUE": Prefix(FORMULA, NOT, Parser.truth),
    "FALSE": Prefix(FORMULA, NOT, Parser.truth),
}
"""What starts operands in all formats."""
